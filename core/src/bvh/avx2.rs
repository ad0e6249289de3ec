//! Closest points, compiled for AVX2 whatever the crate is compiled for.
//!
//! The search is the same code as for other targets ([`search_by_blocks`]), with kernels for
//! registers of 256 bits. They are closures, made here: so they are compiled for the instructions
//! of the functions of this file, and no `unsafe` is needed. Nothing between these functions and an
//! instruction may be a call, because a function that was compiled for less is slow to cross:
//! `cargo xtask count` has a limit for this path.
//!
//! The list of features has no fused multiply-add, so the bits stay.

use super::closest_point::{Hint, Kernels, search_by_blocks};
use super::leaf_distance::{LeafLimit, nearest_avx2};
use super::node::{OpenedNode, take_least_avx2};
use super::point_query::PointQuery;
use crate::bvh::format::{Bvh, FanLeaf};
use crate::geom::fan::WIDTH;
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry};

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
