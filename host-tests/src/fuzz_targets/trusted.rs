//! A box tree whose records were not checked. Its answers may be anything, but every question ends.

use super::input::Input;
use super::suite::ask_within_bounds;
use super::tree::tree_seeds;
use meshsweep_core::{
    Budget, Bvh, CoherentPair, Motion, PlacedModel, Pose, QueryError, Scene, ScratchEntry,
    TightHulls, TrianglePair, Work,
};

/// Opens an edited blob without a check of its records, and asks everything about it, and about it
/// and another model.
pub fn tree_trusted(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(tree_seeds());
    let Ok(tree) = Bvh::open_trusted(&blob) else { return };
    let stack = &mut vec![ScratchEntry::EMPTY; usize::from(input.byte())];
    ask_tree(&tree, &input, stack);
    let other = &tree_seeds()[usize::from(input.byte()) % tree_seeds().len()];
    let Ok(other) = Bvh::open(other) else { return };
    let (pose, size) = (input.pose(), input.float());
    ask_pair([&tree, &other], &pose, size, stack);
    ask_pair([&other, &tree], &pose, size, stack);
}

/// Opens edited tight hulls without a check of their records, and asks all about points.
pub fn tight_trusted(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(super::tight_seeds());
    let Ok(hulls) = TightHulls::open_trusted(&blob) else { return };
    let stack = &mut vec![ScratchEntry::EMPTY; usize::from(input.byte())];
    let (point, distance) = (input.point(), input.float());
    for index in 0..hulls.count() {
        let Some(hull) = hulls.get(index) else { continue };
        let bound = bounds(hull.bvh());
        ends(hull.closest_point(point, Budget::EXACT, stack).map(|found| found.work), bound);
        ends(hull.within(point, distance, Budget::EXACT, stack).map(|found| found.work), bound);
        ask_tree(hull.bvh(), &input, stack);
    }
}

/// Every question of the suite, and the one that it has no kind for.
fn ask_tree(tree: &Bvh<'_>, input: &Input<'_>, stack: &mut [ScratchEntry]) {
    ask_within_bounds(tree, bounds(tree), stack.len(), input);
    let mut input = Input(input.0);
    for _ in 0..3 {
        let signed = tree.signed_distance_by_winding(input.point(), Budget::EXACT, stack);
        ends(signed.map(|found| found.closest.work), 16 * bounds(tree));
    }
}

fn ask_pair([a, b]: [&Bvh<'_>; 2], pose: &Pose, size: f32, stack: &mut [ScratchEntry]) {
    // Without a budget the search ends too, but a fuzzer would not wait for all pairs.
    let budget = Budget::EXACT.with_steps(300);
    let mut pairs = [TrianglePair::EMPTY; 4];
    let _ = a.overlap(b, *pose, budget, stack);
    let _ = a.all_overlaps(b, *pose, &mut pairs, budget, stack);
    let _ = a.distance_to(b, *pose, budget, stack);
    let _ = a.within_of(b, *pose, size, budget, stack);
    let _ = a.penetration(b, *pose, budget, stack);
    let motion = Motion::straight(*pose, Pose::IDENTITY);
    let _ = a.first_contact_of(b, &motion, size, budget, stack);
    let mut pair = CoherentPair::<16>::new();
    for _ in 0..2 {
        let _ = pair.distance(a, b, *pose, budget, stack);
        let _ = pair.within(a, b, *pose, size, budget, stack);
    }
    let models =
        [(a, Pose::IDENTITY), (b, *pose)].map(|(tree, pose)| PlacedModel::new(*tree, pose));
    if let [Ok(one), Ok(other)] = models {
        let models = [one.with_least_ball(), other];
        let _ = Scene::new(&models).nearest_pair(|_, _| true, budget, stack);
        let _ = Scene::new(&models).within(size, |_, _| true, budget, stack);
    }
}

/// More than one descent can cost: a record of links names up to fifteen children, each of up to
/// fifteen triangles.
fn bounds(tree: &Bvh<'_>) -> u64 {
    300 * u64::from(tree.header().nodes) + 300
}

fn ends(work: Result<Work, QueryError>, most: u64) {
    if let Ok(work) = work {
        assert!(u64::from(work.total()) <= most, "{work:?}, where {most} are enough");
    }
}
