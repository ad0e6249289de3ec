//! Questions compiled for AVX2, whatever the crate is compiled for.
//!
//! A search is the same code as for other targets, with kernels for registers of 256 bits. They are
//! closures, made here: so they are compiled for the instructions of the functions of this file,
//! and no `unsafe` is needed. Nothing between these functions and an instruction may be a call,
//! because a function that was compiled for less is slow to cross: `cargo xtask count` has a limit
//! for this path.
//!
//! The list of features has no fused multiply-add, so the bits stay.

use crate::bvh::point::hint::Hint;
use crate::bvh::point::leaf::distance::nearest_avx2;
use crate::bvh::point::leaf::limit::LeafLimit;
use crate::bvh::point::query::PointQuery;
use crate::bvh::point::search::blocks::{Kernels, search_by_blocks};
use crate::bvh::segment::any_hit::any_hit_by_blocks;
use crate::bvh::segment::blocks::SegmentKernels;
use crate::bvh::segment::first_hit::first_hit_by_blocks;
use crate::bvh::segment::leaf::{Facing, flagged_avx2};
use crate::bvh::segment::query::SegmentQuery;
use crate::bvh::tree::format::{Bvh, FanLeaf};
use crate::bvh::tree::node::{OpenedNode, take_least_avx2};
use crate::geom::fan::WIDTH;
use crate::query::{Budget, ClosestPoint, Decided, FirstHit, QueryError, ScratchEntry};

/// [`Bvh::closest_point_from`].
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
pub(super) fn closest_point_from(
    tree: &Bvh<'_>,
    point: [f32; 3],
    hint: &mut Hint,
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    let found = search_by_blocks(
        tree,
        point,
        hint,
        &budget,
        scratch,
        Kernels::new(
            |query: &PointQuery, opened: &OpenedNode| query.keys_avx2(tree, opened),
            |keys: &[u32; WIDTH], limit: u32| take_least_avx2(keys, limit),
            |leaf: &FanLeaf<'_>, query: &PointQuery, limit: &LeafLimit| {
                nearest_avx2(leaf, query, limit)
            },
            |leaf: &FanLeaf<'_>, query: &PointQuery, limit: &LeafLimit| {
                nearest_avx2(leaf, query, limit)
            },
        ),
    );
    found.unwrap_or_else(|| tree.closest_point_from(point, hint, budget, scratch))
}

/// [`Bvh::first_hit`].
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
pub(super) fn first_hit(
    tree: &Bvh<'_>,
    a: [f32; 3],
    b: [f32; 3],
    facing: Facing,
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> Result<FirstHit, QueryError> {
    let kernels = SegmentKernels::new(
        |query: &SegmentQuery, opened: &OpenedNode| query.keys_avx2(tree, opened),
        |keys: &[u32; WIDTH], limit: u32| take_least_avx2(keys, limit),
        |leaf: &FanLeaf<'_>, query: &SegmentQuery| flagged_avx2(leaf, query),
    );
    let found = first_hit_by_blocks(tree, [a, b], facing, &budget, scratch, kernels);
    found.unwrap_or_else(|| tree.first_hit(a, b, facing, budget, scratch))
}

/// [`Bvh::any_hit`].
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
pub(super) fn any_hit(
    tree: &Bvh<'_>,
    a: [f32; 3],
    b: [f32; 3],
    facing: Facing,
    budget: Budget,
    scratch: &mut [ScratchEntry],
) -> Result<Decided<()>, QueryError> {
    let kernels = SegmentKernels::new(
        |query: &SegmentQuery, opened: &OpenedNode| query.keys_avx2(tree, opened),
        |keys: &[u32; WIDTH], limit: u32| take_least_avx2(keys, limit),
        |leaf: &FanLeaf<'_>, query: &SegmentQuery| flagged_avx2(leaf, query),
    );
    let found = any_hit_by_blocks(tree, [a, b], facing, &budget, scratch, kernels);
    found.unwrap_or_else(|| tree.any_hit(a, b, facing, budget, scratch))
}
