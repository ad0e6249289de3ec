//! The corners of two models in one frame, in f32 or f64.

use crate::geom::{Contact, Precision, SweptTriangle, triangles_meet};
use crate::hull::front::Candidate;
use crate::num::tolerance::F32_EXTENT;
use crate::num::{each, greater, lesser, up_to_f32};
use crate::query::{Extended, RelativePose};
use glam::Vec3;

/// Both models in common units, from the first one's origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places<T> {
    origins: [[T; 3]; 2],
    /// Common units in one unit of the first model, and an upper bound of those in a moved one of
    /// the second.
    units: [T; 2],
    matrix: [[T; 3]; 3],
    shift: [T; 3],
    /// Greatest error of a corner, surface errors included.
    doubt: T,
    /// What the bounds of swept triangles may be off by.
    margin: T,
}

/// Whether f32 tells the parts of both models from each other.
pub(super) fn is_f32_enough(pose: &RelativePose, sides: [&Extended; 2]) -> bool {
    let size =
        |side: &Extended, unit: f32| side.extent.into_iter().fold(0.0, greater) * f64::from(unit);
    let [a, b] = sides;
    let [first, second] = &pose.frames;
    lesser(size(a, first.unit), size(b, second.unit)) >= F32_EXTENT
}

impl Places<f32> {
    pub(super) fn of(pose: &RelativePose) -> Self {
        let RelativePose { frames: [first, second], vertices } = pose;
        let rounding = up_to_f32(vertices.rounding[0]);
        Places {
            origins: [first.origin, second.origin],
            units: [first.unit, up_to_f32(vertices.longest)],
            matrix: vertices.matrix,
            shift: vertices.shift,
            doubt: vertices.vertex_error,
            margin: 2.0 * vertices.vertex_error + rounding,
        }
    }
}

impl Places<f64> {
    pub(super) fn of(pose: &RelativePose) -> Self {
        let RelativePose { frames: [first, second], vertices } = pose;
        let wide = |v: [f32; 3]| v.map(f64::from);
        Places {
            origins: [wide(first.origin), wide(second.origin)],
            units: [f64::from(first.unit), vertices.longest],
            matrix: vertices.matrix.map(wide),
            shift: vertices.shift_f64,
            doubt: vertices.vertex_error_f64,
            margin: 2.0 * vertices.vertex_error_f64 + vertices.rounding[1],
        }
    }
}

impl<T: Precision> Places<T> {
    /// Where a corner of the first (0) or the second (1) model lies.
    #[inline(always)]
    fn corner(&self, side: usize, corner: Vec3) -> [T; 3] {
        let [[ox, oy, oz], [px, py, pz]] = self.origins;
        let [x, y, z] = corner.to_array().map(T::from);
        if side == 0 {
            let [unit, _] = self.units;
            return [(x - ox) * unit, (y - oy) * unit, (z - oz) * unit];
        }
        let (x, y, z) = (x - px, y - py, z - pz);
        let along = |[a, b, c]: [T; 3], shift: T| (a * x + b * y) + (c * z + shift);
        let ([r, s, t], [u, v, w]) = (self.matrix, self.shift);
        [along(r, u), along(s, v), along(t, w)]
    }

    #[inline(always)]
    pub(super) fn swept(&self, side: usize, triangle: &Candidate) -> SweptTriangle<T> {
        let [first, second] = self.units;
        let unit = if side == 0 { first } else { second };
        let corners = each(triangle.corners, |corner| self.corner(side, corner));
        SweptTriangle::new(corners, T::from(triangle.radius) * unit)
    }

    #[inline(always)]
    pub(super) fn is_apart(&self, a: &SweptTriangle<T>, b: &SweptTriangle<T>) -> bool {
        a.is_apart(b, self.margin)
    }

    /// Whether the input's triangles meet. Of triangles of the surface.
    #[inline(never)]
    pub(super) fn meet(&self, [a, b]: [&Candidate; 2]) -> Contact {
        let [a, b] = [(0, a), (1, b)]
            .map(|(side, triangle)| triangle.corners.map(|corner| self.corner(side, corner)));
        triangles_meet(a, b, self.doubt)
    }
}
