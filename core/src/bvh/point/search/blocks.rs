//! The search of an exact closest point on vector targets, nearest child first at every level.

use super::closest::{Closest, NearestOfLeaf, is_exact};
use crate::bvh::point::hint::Hint;
use crate::bvh::point::leaf::limit::LeafLimit;
use crate::bvh::point::query::{Asked, PointQuery, PreparedPoint};
use crate::bvh::tree::block_walk::{BlockWalk, walk};
use crate::bvh::tree::descent::Descent;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::node::{OpenedNode, TakenLeast};
use crate::geom::fan::WIDTH;
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry, Work};

/// What a search takes from the vector unit. All kernels give the same bits.
///
/// They are closures, because a closure is compiled for the instructions of the function that makes
/// it. A method of a trait is not.
pub(crate) struct Kernels<K, T, N, H> {
    keys_of: K,
    take_least: T,
    nearest: N,
    nearest_of_hint: H,
}

impl<K, T, N: NearestOfLeaf, H: NearestOfLeaf> Kernels<K, T, N, H>
where
    K: Fn(&PointQuery, &OpenedNode) -> Option<[u32; WIDTH]>,
    T: Fn(&[u32; WIDTH], u32) -> TakenLeast,
{
    /// Keys of a node's children, the least key of a block, the nearest triangle of a leaf, and of
    /// the hint's leaf. As arguments of a function they may carry `inline(always)`.
    #[inline(always)]
    pub(crate) fn new(keys_of: K, take_least: T, nearest: N, nearest_of_hint: H) -> Self {
        Kernels { keys_of, take_least, nearest, nearest_of_hint }
    }
}

/// The answer, if neither a tolerance nor steps nor memory may end the search: in the nearest-first
/// order of [`block_walk`](crate::bvh::tree::block_walk). Otherwise the order decides the answer,
/// and it is that of all targets.
#[inline(always)]
pub(crate) fn search_by_blocks(
    tree: &Bvh<'_>,
    point: [f32; 3],
    hint: &mut Hint,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    kernels: Kernels<
        impl Fn(&PointQuery, &OpenedNode) -> Option<[u32; WIDTH]>,
        impl Fn(&[u32; WIDTH], u32) -> TakenLeast,
        impl NearestOfLeaf,
        impl NearestOfLeaf,
    >,
) -> Option<Result<ClosestPoint, QueryError>> {
    if !is_exact(budget)
        || budget.steps < tree.most_steps()
        || scratch.len() < tree.scratch_entries()
    {
        return None;
    }
    let prepared = match PreparedPoint::prepare(tree, point, budget, scratch) {
        Ok(prepared) => prepared,
        Err(error) => return Some(Err(error)),
    };
    let query = match prepared.asked() {
        Asked::Near(query) => query,
        Asked::Far(far) => return Some(far.closest_point(tree, point)),
    };
    let mut work = Work::default();
    let Kernels { keys_of, take_least, nearest, nearest_of_hint } = kernels;
    let mut visitor = Closest::new(tree, point, query, budget, nearest);
    if *hint != Hint::NONE
        && let Some(leaf) = tree.leaf(hint.node(), hint.child())
    {
        match nearest_of_hint(&leaf, query, &LeafLimit::NONE) {
            Some(near) => visitor.bound_by(&near),
            None => return Some(Err(QueryError::Unchecked)),
        }
    }
    let ended = walk(
        tree,
        tree.frames,
        scratch,
        &mut visitor,
        &mut work,
        #[inline(always)]
        |opened| keys_of(query, opened),
        take_least,
    );
    match ended {
        None => Some(Err(QueryError::Unchecked)),
        Some(BlockWalk::Unfinished) => None,
        Some(BlockWalk::Done | BlockWalk::Answered) => {
            Some(visitor.answer(Descent::Done, work, hint))
        }
    }
}
