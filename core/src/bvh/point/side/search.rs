//! State that the descents of one search for a side share: the caller's memory, the work, and why
//! one was truncated.

use crate::bvh::point::query::PointQuery;
use crate::bvh::tree::descent::{Descent, LeafVisitor, descend};
use crate::bvh::tree::format::Bvh;
use crate::query::{Ended, ScratchEntry, Work};

/// What a search found. The outer `None`: the tree is unchecked. The inner `None`: undecided.
///
/// An error in place of the outer `None` would be copied at each call.
pub(crate) type Searched<T> = Option<Option<T>>;

/// The state that the descents of one question share.
pub(crate) struct SideSearch<'a, 't> {
    pub(crate) tree: &'a Bvh<'t>,
    pub(crate) steps: u32,
    pub(crate) stack: &'a mut [ScratchEntry],
    pub(crate) work: Work,
    /// Why a descent was truncated.
    pub(crate) truncated: Option<Ended>,
}

impl SideSearch<'_, '_> {
    /// One descent. Returns whether it ran to its end.
    pub(crate) fn descend(
        &mut self,
        query: &PointQuery,
        visitor: &mut impl LeafVisitor,
    ) -> Option<bool> {
        let descent = descend(self.tree, query, self.steps, self.stack, visitor, &mut self.work);
        let descent = descent.ok()?;
        if let Descent::Truncated { ended, .. } = descent {
            self.truncated = Some(ended);
        }
        Some(descent == Descent::Done)
    }
}
