//! Counters of the work of a query.

use crate::num::greater;

/// The work of a query. The numbers are the same on every target, but for two questions to a box
/// tree. Processors with vector registers visit the nodes of an exact closest point in another
/// order. `within` of a model whose box is beyond the distance opens no node, except without a
/// floating-point unit or in small code. `meshsweep trade`
/// and `meshsweep worst` count in the order of boards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Work {
    /// Bounds tested: boxes of [`Bvh`](crate::Bvh) children, triboxes, swept triangles,
    /// capsules of a curve.
    pub bounds: u32,
    /// Triangles of surface or hull tested in f32.
    pub triangles: u32,
    /// Triangles, or segments of a curve, evaluated in f64; of a solid that moves, distances.
    pub exact: u32,
    /// Nodes opened, or vertex splits performed.
    pub opened: u32,
}

impl Work {
    /// No work.
    pub const NONE: Work = Work { bounds: 0, triangles: 0, exact: 0, opened: 0 };

    /// The work of this and another search together.
    #[must_use]
    pub fn and(self, other: Work) -> Work {
        Work {
            bounds: self.bounds.saturating_add(other.bounds),
            triangles: self.triangles.saturating_add(other.triangles),
            exact: self.exact.saturating_add(other.exact),
            opened: self.opened.saturating_add(other.opened),
        }
    }

    /// The work of a search that opened nothing counts as one step: its set-up takes time too.
    pub(crate) fn with_set_up(self) -> Work {
        Work { opened: greater(self.opened, 1), ..self }
    }

    /// All counters added up.
    pub fn total(&self) -> u32 {
        self.bounds
            .saturating_add(self.triangles)
            .saturating_add(self.exact)
            .saturating_add(self.opened)
    }
}
