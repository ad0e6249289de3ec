//! A box tree whose records were not checked. Its answers may be anything, but every question ends.

use super::input::Input;
use super::tree::tree_seeds;
use meshsweep_core::{
    Budget, Bvh, CoherentPair, CoherentQuery, Eye, Facing, Hint, Motion, Neighbor, PlacedModel,
    Pose, QueryError, Scene, ScratchEntry, Solid, TightHulls, TriangleHit, TrianglePair, Work,
};

/// Opens an edited blob without a check of its records, and asks everything about points, segments,
/// solids, and about it and another model.
pub fn tree_trusted(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(tree_seeds());
    let Ok(tree) = Bvh::open_trusted(&blob) else { return };
    let stack = &mut vec![ScratchEntry::EMPTY; usize::from(input.byte())];
    let points = [input.point(), input.point(), input.point()];
    let size = input.float();
    ask_points(&tree, &points, size, stack);
    ask_segments(&tree, &points, size, stack);
    let other = &tree_seeds()[usize::from(input.byte()) % tree_seeds().len()];
    let Ok(other) = Bvh::open(other) else { return };
    let pose = input.pose();
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
    let points = [point, input.point(), input.point()];
    for index in 0..hulls.count() {
        let Some(hull) = hulls.get(index) else { continue };
        let bound = bounds(hull.bvh());
        ends(hull.closest_point(point, Budget::EXACT, stack).map(|found| found.work), bound);
        ends(hull.within(point, distance, Budget::EXACT, stack).map(|found| found.work), bound);
        ask_points(hull.bvh(), &points, distance, stack);
        ask_segments(hull.bvh(), &points, distance, stack);
    }
}

fn ask_points(tree: &Bvh<'_>, points: &[[f32; 3]; 3], size: f32, stack: &mut [ScratchEntry]) {
    let bound = bounds(tree);
    let budget = Budget::EXACT;
    let mut near = [Neighbor::EMPTY; 4];
    let mut hint = Hint::NONE;
    let mut coherent = CoherentQuery::<64>::new();
    for &point in points {
        ends(tree.closest_point(point, budget, stack).map(|found| found.work), bound);
        let precise = tree.closest_point_precise(point, budget, stack);
        ends(precise.map(|found| found.work), 3 * bound);
        let hinted = tree.closest_point_from(point, &mut hint, budget, stack);
        ends(hinted.map(|found| found.work), bound);
        ends(tree.within(point, size, budget, stack).map(|found| found.work), bound);
        ends(tree.nearest(point, &mut near, budget, stack).map(|found| found.work), bound);
        let all = tree.all_within(point, size, &mut near, budget, stack);
        ends(all.map(|found| found.work), bound);
        ends(tree.winding_number(point, budget, stack).map(|found| found.work), 8 * bound);
        ends(
            tree.signed_distance(point, budget, stack).map(|found| found.closest.work),
            44 * bound,
        );
        let signed = tree.signed_distance_by_winding(point, budget, stack);
        ends(signed.map(|found| found.closest.work), 16 * bound);
        let followed = coherent.closest_point(tree, point, budget, stack);
        ends(followed.map(|found| found.closest.work), 4 * bound);
        for eye in [Eye::At(point), Eye::Along(point)] {
            let _ = tree.front_facing(eye, &mut [0; 16]);
        }
    }
}

fn ask_segments(
    tree: &Bvh<'_>,
    &[a, b, c]: &[[f32; 3]; 3],
    radius: f32,
    stack: &mut [ScratchEntry],
) {
    let bound = bounds(tree);
    let budget = Budget::EXACT;
    let mut hits = [TriangleHit::EMPTY; 4];
    for facing in [Facing::Both, Facing::Front] {
        ends(tree.first_hit(a, b, facing, budget, stack).map(|found| found.work), bound);
        ends(tree.any_hit(a, b, facing, budget, stack).map(|found| found.work), bound);
        ends(tree.all_hits(b, c, facing, &mut hits, budget, stack).map(|found| found.work), bound);
    }
    let (corners, moved) = ([a, b], [b, c]);
    let (Ok(from), Ok(to)) = (Solid::new(&corners, radius), Solid::new(&moved, radius)) else {
        return;
    };
    ends(tree.solid_distance(&from, budget, stack).map(|found| found.work), 2 * bound);
    ends(tree.solid_within(&from, radius, budget, stack).map(|found| found.work), 2 * bound);
    ends(tree.solid_first_contact(&from, &to, budget, stack).map(|found| found.work), 140 * bound);
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
