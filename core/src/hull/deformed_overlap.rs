//! Whether a hull that deforms meets one at rest: by key frames or by free motion, in one piece of
//! code.

use super::format::{Hull, VertIdx};
use super::frame_hull::FrameHull;
use super::geometry::Geometry;
use super::moved_hull::MovedHull;
use super::overlap::query::overlap;
use crate::geom::{Aabb, Pose};
use crate::query::{Budget, Decided, QueryError, ScratchEntry};
use glam::Vec3;

impl FrameHull<'_> {
    /// Whether the surface of `other`, moved by `pose` to this hull's frame, meets the surface at
    /// this frame.
    ///
    /// Verdicts, witness, `scratch`, errors and degenerate cases are those of [`Hull::overlap`], of
    /// the mesh whose vertices are interpolated from those of the input files. Between keys a
    /// contact nearer than 1.5 millionths of the largest coordinate is undecided. The search begins
    /// with all base triangles, for a hull that deforms has no bound of groups of them.
    ///
    /// Source: Guéziec 2000, section 5, with deformation (5.3) and rigid motion (5.2).
    ///
    /// # Errors
    /// Those of [`Hull::overlap`].
    #[inline(never)]
    pub fn overlap(
        &self,
        other: &Hull<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        Deformed::Frame(*self).overlap(other, pose, budget, scratch)
    }
}

impl MovedHull<'_, '_> {
    /// Whether the surface of `other`, moved by `pose` to this hull's frame, meets the moved
    /// surface of this hull.
    ///
    /// Verdicts, witness, `scratch`, errors and degenerate cases are those of [`Hull::overlap`], of
    /// the mesh whose vertices are where the last update put them. The search begins
    /// with all base triangles, for a hull that deforms has no bound of groups of them.
    ///
    /// Source: Guéziec 2000, section 5, with both deforming (5.3) and rigid motion (5.2).
    ///
    /// # Errors
    /// Those of [`Hull::overlap`]; [`QueryError::NoPose`] after an update that failed.
    #[inline(never)]
    pub fn overlap(
        &self,
        other: &Hull<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        self.check()?;
        Deformed::Moved(self).overlap(other, pose, budget, scratch)
    }
}

/// A hull that deforms, either way.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "there is no heap, and one lives at a time")]
enum Deformed<'a, 'v> {
    Frame(FrameHull<'a>),
    Moved(&'v MovedHull<'a, 'v>),
}

impl Deformed<'_, '_> {
    /// [`Hull::overlap`].
    #[inline(never)]
    fn overlap(
        self,
        other: &Hull<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        overlap(&self, other, &pose, &budget, scratch)
    }
}

impl<'a> Geometry<'a> for Deformed<'a, '_> {
    fn tables(&self) -> &Hull<'a> {
        match self {
            Deformed::Frame(hull) => hull.tables(),
            Deformed::Moved(hull) => hull.tables(),
        }
    }

    fn triangle(
        &self,
        corners: [VertIdx; 3],
        number: u32,
        is_surface: bool,
    ) -> Option<([Vec3; 3], f32)> {
        match self {
            Deformed::Frame(hull) => hull.triangle(corners, number, is_surface),
            Deformed::Moved(hull) => hull.triangle(corners, number, is_surface),
        }
    }

    fn place(&self, vertex: VertIdx) -> Option<Vec3> {
        match self {
            Deformed::Frame(hull) => hull.place(vertex),
            Deformed::Moved(hull) => hull.place(vertex),
        }
    }

    fn group(&self, index: u32) -> Option<([Vec3; 3], f32)> {
        match self {
            Deformed::Frame(hull) => hull.group(index),
            Deformed::Moved(hull) => hull.group(index),
        }
    }

    fn vertex_box(&self) -> Aabb {
        match self {
            Deformed::Frame(hull) => hull.vertex_box(),
            Deformed::Moved(hull) => hull.vertex_box(),
        }
    }

    fn surface_error(&self) -> f64 {
        match self {
            Deformed::Frame(hull) => hull.surface_error(),
            Deformed::Moved(hull) => hull.surface_error(),
        }
    }
}
