//! The side of a point, and what the descents that look for it share.

use super::descent::{Descent, LeafVisitor, descend};
use crate::bvh::format::Bvh;
use crate::query::{Ended, QueryError, ScratchEntry, Work};
use glam::Vec3;

/// On which side of the surface a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The nearest surface has its front to the point.
    Outside,
    /// It has its back to the point.
    Inside,
    /// The mesh is not closed, the point is not clear of the surface, or rounding leaves it open.
    Undefined,
}

/// What the descents of one question share.
pub(crate) struct Search<'a, 't> {
    pub(crate) tree: &'a Bvh<'t>,
    pub(crate) steps: u32,
    pub(crate) stack: &'a mut [ScratchEntry],
    pub(crate) work: Work,
    /// Why a descent was cut short.
    pub(crate) cut: Option<Ended>,
}

impl Search<'_, '_> {
    /// One descent; whether it ran to its end.
    pub(crate) fn descend(
        &mut self,
        p: Vec3,
        visitor: &mut impl LeafVisitor,
    ) -> Result<bool, QueryError> {
        let descent = descend(self.tree, p, self.stack, self.steps, visitor, &mut self.work)?;
        if let Descent::Truncated { steps, .. } = descent {
            self.cut = Some(if steps { Ended::Steps } else { Ended::Capacity });
        }
        Ok(descent == Descent::Done)
    }
}
