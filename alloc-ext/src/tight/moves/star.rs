//! The star of a vertex or an edge before an edit: the faces that the edit replaces.

use crate::geom::Triangle;
use glam::DVec3;

/// A face of a star before the edit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StarFace {
    pub corners: Triangle,
    /// The edge that stays, if the face does. The new face is the new vertex, then these.
    pub ring: Option<[DVec3; 2]>,
    /// Unit normal; zero without area.
    pub normal: DVec3,
    pub double_area: f64,
}

impl StarFace {
    pub fn new(corners: Triangle, ring: Option<[DVec3; 2]>) -> Self {
        let [a, b, c] = corners;
        let cross = (b - a).cross(c - a);
        let double_area = cross.length();
        let normal = if double_area > 0.0 { cross / double_area } else { DVec3::ZERO };
        Self { corners, ring, normal, double_area }
    }

    /// The corners in their order, from the first end of the ring edge.
    pub fn ring_first(&self) -> Triangle {
        let [a, b, c] = self.corners;
        match self.ring {
            Some([_, end]) if end == c => [b, c, a],
            Some([_, end]) if end == a => [c, a, b],
            _ => [a, b, c],
        }
    }
}

/// Volume that the hull gains if the vertex of a star goes to `x`.
pub(super) fn added_volume(star: &[StarFace], x: DVec3) -> f64 {
    star.iter().map(|f| f.normal.dot(x - f.corners[0]) * f.double_area).sum::<f64>() / 6.0
}

/// All corners of a star.
pub(super) fn corners(star: &[StarFace]) -> impl Iterator<Item = DVec3> + '_ {
    star.iter().flat_map(|f| f.corners)
}

/// Distance of the farthest corner of a star from `centre`.
pub(super) fn radius(star: &[StarFace], centre: DVec3) -> f64 {
    corners(star).map(|p| (p - centre).length_squared()).fold(0.0, f64::max).sqrt()
}

/// The frame of a star's linear program: origin in the star, the star's radius as unit.
pub(super) struct Frame {
    pub centre: DVec3,
    pub radius: f64,
}

impl Frame {
    pub fn local(&self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.radius
    }
}
