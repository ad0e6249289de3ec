//! The first hit of a segment on vector targets, and any hit with AVX2: nearest child first at
//! every level.

use super::leaf::{CrossingCollector, Facing, FlaggedOfLeaf, SegmentVisitor};
use super::query::SegmentQuery;
use crate::bvh::tree::block_walk::{BlockWalk, walk};
use crate::bvh::tree::descent::OpenedNode;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::node::TakenLeast;
use crate::geom::fan::WIDTH;
use crate::query::{Budget, QueryError, ScratchEntry, Work};

/// What a segment's search takes from the vector unit. All kernels give the same bits. They are
/// closures for the reason of [`Kernels`](crate::bvh::point::search::blocks::Kernels).
pub(crate) struct SegmentKernels<K, T, F> {
    keys_of: K,
    take_least: T,
    flagged: F,
}

impl<K, T, F: FlaggedOfLeaf> SegmentKernels<K, T, F>
where
    K: Fn(&SegmentQuery, &OpenedNode) -> Option<[u32; WIDTH]>,
    T: Fn(&[u32; WIDTH], u32) -> TakenLeast,
{
    /// Keys of a node's children, the least key of a block, and the flagged triangles of a leaf.
    #[inline(always)]
    pub(crate) fn new(keys_of: K, take_least: T, flagged: F) -> Self {
        SegmentKernels { keys_of, take_least, flagged }
    }

    /// Lets `collector` see the triangles that the segment may meet, up to its limit. `None`: the
    /// memory does not suffice for blocks, and the search has to begin anew with entries.
    #[inline(always)]
    pub(crate) fn search<C: CrossingCollector>(
        self,
        tree: &Bvh<'_>,
        query: &SegmentQuery,
        facing: Facing,
        collector: C,
        scratch: &mut [ScratchEntry],
    ) -> Option<Result<(C, Work), QueryError>> {
        let SegmentKernels { keys_of, take_least, flagged } = self;
        let mut visitor = SegmentVisitor { query, facing, flagged, collector };
        let mut work = Work::default();
        let ended = walk(
            tree,
            tree.boxes,
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
            Some(BlockWalk::Done | BlockWalk::Answered) => Some(Ok((visitor.collector, work))),
        }
    }
}

/// Whether neither steps nor memory may end the search.
#[inline(always)]
pub(crate) fn is_unlimited(tree: &Bvh<'_>, budget: &Budget, scratch: &[ScratchEntry]) -> bool {
    budget.steps >= tree.most_steps() && scratch.len() >= tree.scratch_entries()
}
