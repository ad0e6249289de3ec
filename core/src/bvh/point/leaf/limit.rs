//! What limits the triangles of a leaf that a question looks at.

use super::plane::LeafPlane;

/// What a triangle has to be near to count.
#[derive(Clone, Copy)]
pub(crate) struct LeafLimit {
    /// A triangle that is farther than the root of this does not count.
    pub(crate) distance_sq: f32,
    /// Nor does a triangle behind this plane.
    #[cfg_attr(
        meshsweep_wide,
        expect(dead_code, reason = "vector targets look at all lanes of a leaf")
    )]
    pub(crate) plane: LeafPlane,
    /// [`PointQuery::allowance`](crate::bvh::point::query::PointQuery::allowance), by which a
    /// triangle of a leaf limits the others; infinite if all count.
    pub(crate) allowance: f32,
    /// Triangles whose squared lower bound is not above this are told, by
    /// [`low`](super::nearest::LeafNearest::low). At most
    /// [`EVERYTHING_SQ`](crate::num::tolerance::EVERYTHING_SQ): unused lanes have more.
    pub(crate) low_sq: f32,
    /// A nearest triangle is wanted only if its squared distance is below this.
    pub(crate) wanted_sq: f32,
}

impl LeafLimit {
    /// All triangles count.
    pub(crate) const NONE: LeafLimit = LeafLimit {
        distance_sq: f32::INFINITY,
        plane: LeafPlane::NONE,
        allowance: f32::INFINITY,
        low_sq: 0.0,
        wanted_sq: f32::INFINITY,
    };
}
