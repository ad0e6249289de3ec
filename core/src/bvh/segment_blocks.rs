//! The first hit of a segment on vector targets, and any hit with AVX2: nearest child first at every
//! level.

use super::block_walk::{BlockWalk, walk};
use super::descent::OpenedNode;
use super::node::TakenLeast;
use super::segment_leaf::{CrossingCollector, Facing, FlaggedOfLeaf, SegmentVisitor};
use super::segment_query::SegmentQuery;
use crate::bvh::format::Bvh;
use crate::geom::fan::WIDTH;
use crate::query::{Budget, QueryError, ScratchEntry, Work};

/// What a segment's search takes from the vector unit. All kernels give the same bits. They are
/// closures for the reason of [`Kernels`](super::point_blocks::Kernels).
pub(super) struct SegmentKernels<K, T, F> {
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
    pub(super) fn new(keys_of: K, take_least: T, flagged: F) -> Self {
        SegmentKernels { keys_of, take_least, flagged }
    }

    /// Lets `collector` see the triangles that the segment may meet, up to its limit. `None`: the
    /// memory does not suffice for blocks, and the search has to begin anew with entries.
    #[inline(always)]
    pub(super) fn search<C: CrossingCollector>(
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
pub(super) fn is_unlimited(tree: &Bvh<'_>, budget: &Budget, scratch: &[ScratchEntry]) -> bool {
    budget.steps >= tree.most_steps() && scratch.len() >= tree.scratch_entries()
}
