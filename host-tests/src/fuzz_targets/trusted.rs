//! A box tree whose records were not checked. Its answers may be anything, but every question ends.

use super::input::Input;
use super::suite::{STEPS, ask_within_bounds};
use super::tree::tree_seeds;
use crate::corrupt::Asker;
use meshsweep_core::{
    Budget, Bvh, Facing, QueryError, ScratchEntry, TightHulls, TriangleHit, Work,
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
    let (asker, pose) = (Asker::new(stack.len(), 4).of_unchecked(), input.pose());
    let distance = input.float();
    for [a, b] in [[&tree, &other], [&other, &tree]] {
        asker.two_models(a, b, &pose, STEPS);
        asker.two_models_within([a, b], &pose, distance, STEPS);
    }
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

/// Every question of the suite, and those that it has no kind for.
fn ask_tree(tree: &Bvh<'_>, input: &Input<'_>, stack: &mut [ScratchEntry]) {
    ask_within_bounds(tree, bounds(tree), stack.len(), input);
    let mut input = Input(input.0);
    for _ in 0..3 {
        let signed = tree.signed_distance_by_winding(input.point(), Budget::EXACT, stack);
        ends(signed.map(|found| found.closest.work), 16 * bounds(tree));
        let (a, b, facing) = (input.point(), input.point(), Facing::Front);
        let any = tree.any_hit(a, b, facing, Budget::EXACT, stack);
        ends(any.map(|found| found.work), bounds(tree));
        let all = tree.all_hits(a, b, facing, &mut [TriangleHit::EMPTY; 4], Budget::EXACT, stack);
        ends(all.map(|found| found.work), bounds(tree));
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
