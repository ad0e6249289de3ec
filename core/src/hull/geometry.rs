//! Where the triangles of all levels lie, and how far from them their parts of the surface may be:
//! as the blob stores them, at a key frame, or moved.

use crate::geom::Aabb;
use crate::hull::format::{Hull, VertIdx};
use crate::query::{Frame, QueryError};
use glam::Vec3;

/// The geometry that a sweep reads: [`Hull`], [`FrameHull`](crate::FrameHull) or
/// [`MovedHull`](crate::MovedHull). Lengths are in the local frame. Its functions may change in any
/// release.
pub trait Geometry<'a> {
    /// The split tables.
    fn tables(&self) -> &Hull<'a>;

    /// Corners of a triangle, and the radius whose swept triangle contains its part of the surface.
    /// `number` is that of [`Hull::radius`]. Positions of a triangle of the surface are off by no
    /// more than [`surface_error`](Self::surface_error).
    fn triangle(
        &self,
        corners: [VertIdx; 3],
        number: u32,
        is_surface: bool,
    ) -> Option<([Vec3; 3], f32)>;

    /// Where a vertex of any level lies.
    fn place(&self, vertex: VertIdx) -> Option<Vec3>;

    /// Corners and radius of a swept triangle around a group of base triangles.
    fn group(&self, index: u32) -> Option<([Vec3; 3], f32)>;

    /// Box of every vertex of every level.
    fn vertex_box(&self) -> Aabb;

    /// Box of the surface, or a larger one.
    fn surface_box(&self) -> Aabb {
        self.vertex_box()
    }

    /// No point of the mesh is farther than this from the triangles of the surface, nor the
    /// reverse; and no radius is too small by more than this.
    fn surface_error(&self) -> f64;

    /// Whether there is anything to ask about.
    ///
    /// # Errors
    /// [`QueryError::NoPose`].
    fn check(&self) -> Result<(), QueryError> {
        Ok(())
    }
}

/// Conversion of units, with the surface error.
pub(super) fn frame<'a>(geometry: &impl Geometry<'a>) -> Frame {
    Frame::of(geometry.tables().header()).with_surface_error(geometry.surface_error())
}

/// Coordinates of a vertex of any level, input units, rounded to f32.
pub(super) fn vertex<'a>(geometry: &impl Geometry<'a>, vertex: VertIdx) -> Option<[f32; 3]> {
    let place = geometry.place(vertex)?.as_dvec3() * geometry.tables().scale();
    Some(place.to_array().map(|x| x as f32))
}

impl<'a, G: Geometry<'a>> Geometry<'a> for &G {
    #[inline(always)]
    fn tables(&self) -> &Hull<'a> {
        (**self).tables()
    }

    #[inline(always)]
    fn triangle(
        &self,
        corners: [VertIdx; 3],
        number: u32,
        is_surface: bool,
    ) -> Option<([Vec3; 3], f32)> {
        (**self).triangle(corners, number, is_surface)
    }

    #[inline(always)]
    fn place(&self, vertex: VertIdx) -> Option<Vec3> {
        (**self).place(vertex)
    }

    #[inline(always)]
    fn group(&self, index: u32) -> Option<([Vec3; 3], f32)> {
        (**self).group(index)
    }

    fn vertex_box(&self) -> Aabb {
        (**self).vertex_box()
    }

    fn surface_box(&self) -> Aabb {
        (**self).surface_box()
    }

    fn surface_error(&self) -> f64 {
        (**self).surface_error()
    }

    fn check(&self) -> Result<(), QueryError> {
        (**self).check()
    }
}

impl<'a> Geometry<'a> for Hull<'a> {
    #[inline(always)]
    fn tables(&self) -> &Hull<'a> {
        self
    }

    #[inline(always)]
    fn triangle(
        &self,
        corners: [VertIdx; 3],
        number: u32,
        _is_surface: bool,
    ) -> Option<([Vec3; 3], f32)> {
        Some((self.positions(corners)?, self.radius(number)?))
    }

    #[inline(always)]
    fn place(&self, vertex: VertIdx) -> Option<Vec3> {
        self.position(vertex)
    }

    #[inline(always)]
    fn group(&self, index: u32) -> Option<([Vec3; 3], f32)> {
        let (corners, radius) = self.base_group(index)?;
        Some((self.positions(corners)?, radius))
    }

    fn vertex_box(&self) -> Aabb {
        self.hull_box()
    }

    fn surface_box(&self) -> Aabb {
        Aabb::of(self.header().surface_box)
    }

    fn surface_error(&self) -> f64 {
        f64::from(self.header().surface_error)
    }
}
