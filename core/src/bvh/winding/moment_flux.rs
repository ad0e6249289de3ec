//! The flux of a node: its triangles' solid angles together, from their moments.

use crate::bvh::tree::format::NodeMoments;
use crate::num::sqrt_approx;
use crate::num::tolerance::{MOMENT_FLUX, SOLID_ANGLE_NEAREST, U32};
use glam::Vec3;

/// A change of the flux, 2^-8, that is not worth a closer look: 3e-4 of a winding number.
const SMALL_MOVE: f32 = 1.0 / 256.0;

/// A node as seen from the query point.
pub(super) struct SeenNode {
    moments: NodeMoments,
    /// From the query point to the node's centre.
    to_centre: Vec3,
    /// Length of the way.
    distance: f32,
    /// Lower bound of the distance of the triangles, at their places in the input and as stored. 0
    /// or less: not known.
    gap: f32,
}

impl SeenNode {
    /// `error`: how far vertices were moved, grid units.
    pub(super) fn new(moments: NodeMoments, p: Vec3, error: f32) -> SeenNode {
        let to_centre = moments.centre - p;
        let distance = sqrt_approx(to_centre.dot(to_centre));
        let gap = if distance >= SOLID_ANGLE_NEAREST {
            distance * (1.0 - 8.0 * U32) - moments.radius - error
        } else {
            0.0
        };
        SeenNode { moments, to_centre, distance, gap }
    }

    /// Whether all triangles are certainly away from the point.
    pub(super) fn is_away(&self) -> bool {
        self.gap > 0.0
    }

    /// Whether the node is small beside its distance.
    pub(super) fn is_small(&self, ratio: f32) -> bool {
        self.is_away() && self.moments.radius <= ratio * self.distance
    }

    /// Whether the node as a whole bounds well what its vertices' moves change.
    pub(super) fn bounds_moves(&self, error: f32) -> bool {
        self.is_away() && (self.gap >= 0.5 * self.moments.radius || self.moved(error) <= SMALL_MOVE)
    }

    /// How much the flux may have changed when vertices moved by `error`. The boundary's length
    /// allows for the builder's moves; an error of the place moves all vertices alike.
    pub(super) fn moved(&self, error: f32) -> f32 {
        if error > 0.0 {
            self.moments.boundary * error / (self.gap * self.gap) * (1.0 + 16.0 * U32)
        } else {
            0.0
        }
    }

    /// The flux of the stored triangles, and a bound of its error. The node must be
    /// [away](Self::is_away).
    ///
    /// The field x/|x|³ is expanded about the centre to its first derivative. Its second is at most
    /// 6/|x|⁴ in every direction.
    pub(super) fn flux(&self) -> (f32, f32) {
        let NodeMoments { area, first: [xx, xy, xz, yy, yz], spread, area_error, .. } =
            self.moments;
        let near = 1.0 / self.distance;
        let Vec3 { x, y, z } = self.to_centre * near;
        let zero_order = [area.x * x, area.y * y, area.z * z];
        let zz = xx + yy;
        let first_order = [
            xx * (x * x),
            yy * (y * y),
            -zz * (z * z),
            2.0 * xy * (x * y),
            2.0 * xz * (x * z),
            2.0 * yz * (y * z),
        ];
        let sum = |terms: &[f32]| terms.iter().fold(0.0, |sum, term| sum + term);
        let size = |terms: &[f32]| terms.iter().fold(0.0, |sum, term| sum + term.abs());
        let scale = 3.0 * near;
        let flux = sum(&zero_order) - scale * sum(&first_order);
        let sizes =
            size(&zero_order) + scale * (size(&first_order) + (xx.abs() + yy.abs()) * (z * z));
        let inverse_sq = near * near;
        let gap_sq = self.gap * self.gap;
        let truncation = (spread / gap_sq + area_error) / gap_sq;
        let error = (sizes * inverse_sq * (MOMENT_FLUX * U32) + truncation) * (1.0 + 16.0 * U32);
        (flux * inverse_sq, error)
    }
}
