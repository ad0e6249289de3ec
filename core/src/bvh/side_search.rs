//! The descents of one search for a side.

use super::descent::{Descent, LeafVisitor, descend};
use super::point_query::PointQuery;
use crate::bvh::format::Bvh;
use crate::query::{Ended, QueryError, ScratchEntry, Side, Undecided, Work};

/// No side is proved yet.
pub(crate) const OPEN: Side = Side::Undecided(Undecided::Feature);

/// The state that the descents of one question share.
pub(crate) struct Search<'a, 't> {
    pub(crate) tree: &'a Bvh<'t>,
    pub(crate) steps: u32,
    pub(crate) stack: &'a mut [ScratchEntry],
    pub(crate) work: Work,
    /// Why a descent was cut short.
    pub(crate) cut: Option<Ended>,
}

impl Search<'_, '_> {
    /// One descent. Returns whether it ran to its end.
    pub(crate) fn descend(
        &mut self,
        query: &PointQuery,
        visitor: &mut impl LeafVisitor,
    ) -> Result<bool, QueryError> {
        let descent = descend(self.tree, query, self.steps, self.stack, visitor, &mut self.work)?;
        if let Descent::Truncated { ended, .. } = descent {
            self.cut = Some(ended);
        }
        Ok(descent == Descent::Done)
    }
}
