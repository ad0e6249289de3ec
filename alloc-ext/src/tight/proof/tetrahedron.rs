//! The tetrahedron that an edit cuts off the hull, in floating point. Placements find their planes
//! in it. Nothing is proved here.

use crate::geom::{Bounds, Plane, Triangle};
use arrayvec::ArrayVec;
use glam::DVec3;

/// A tetrahedron between a face and an apex behind it.
#[derive(Clone, Debug)]
pub(crate) struct Tetrahedron {
    planes: ArrayVec<Plane, 4>,
    /// Whether the last plane is that of the face.
    has_face: bool,
    corners: [DVec3; 4],
    bounds: Bounds,
}

/// Triangles with less double area than this fraction of the sum of two squared edges have no
/// plane: their corners are nearly on a line.
const FLAT: f64 = 1e-10;

/// Corners of a triangle that was cut by four planes. Each plane adds at most one corner.
type Polygon = ArrayVec<DVec3, 8>;

impl Tetrahedron {
    /// Of a face's corners and an apex. A side without a plane is left out. The first plane is that
    /// through the apex and the face's first two corners.
    pub fn new(face: &Triangle, apex: DVec3) -> Self {
        let [a, b, c] = *face;
        let corners = [a, b, c, apex];
        let mut planes = ArrayVec::new();
        let mut has_face = false;
        for i in [2, 0, 1, 3] {
            let opposite = corners[i];
            let [p, q, r] = [1, 2, 3].map(|k| corners[(i + k) % 4]);
            let (u, v) = (q - p, r - p);
            let normal = u.cross(v);
            let length = normal.length();
            if length <= FLAT * (u.length_squared() + v.length_squared()) {
                continue;
            }
            let mut normal = normal / length;
            if normal.dot(opposite - p) < 0.0 {
                normal = -normal;
            }
            planes.push(Plane { normal, offset: normal.dot(p) });
            has_face = i == 3;
        }
        Self { planes, has_face, corners, bounds: Bounds::of(&corners) }
    }

    /// Planes that all of its points are in front of, but for that of the face: little of the mesh
    /// is above the face.
    pub fn turning_planes(&self) -> &[Plane] {
        &self.planes[..self.planes.len() - usize::from(self.has_face)]
    }

    /// Its box.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether a box may hold a point of the tetrahedron.
    pub fn may_meet(&self, bounds: &Bounds) -> bool {
        bounds.meets(&self.bounds) && self.planes.iter().all(|p| p.reaches(bounds))
    }

    /// Whether a box may hold a point within `distance` of the tetrahedron.
    #[inline]
    pub fn may_come_near(&self, bounds: &Bounds, distance: f64) -> bool {
        bounds.meets(&self.bounds.grown(distance))
            && self.planes.iter().all(|p| bounds.support(p.normal) >= p.offset - distance)
    }

    /// Whether a point is in it.
    #[inline]
    pub fn holds(&self, p: DVec3) -> bool {
        self.planes.iter().all(|plane| plane.holds(p))
    }

    /// Whether a triangle lies behind one plane, or the tetrahedron on one side of the triangle.
    #[inline]
    fn misses(&self, triangle: &Triangle) -> bool {
        let [a, b, c] = *triangle;
        if self.planes.iter().any(|plane| !plane.holds(a) && !plane.holds(b) && !plane.holds(c)) {
            return true;
        }
        let normal = (b - a).cross(c - a);
        let heights = self.corners.map(|p| normal.dot(p - a));
        heights.iter().all(|&h| h > 0.0) || heights.iter().all(|&h| h < 0.0)
    }

    /// Calls `visit` with the corners of the part of a triangle that lies in the tetrahedron.
    #[inline]
    pub fn clip(&self, triangle: &Triangle, visit: impl FnMut(DVec3)) {
        if self.misses(triangle) {
            return;
        }
        let mut polygons = [Polygon::new(), Polygon::new()];
        let [polygon, cut] = &mut polygons;
        let (mut polygon, mut cut) = (polygon, cut);
        polygon.extend(*triangle);
        for plane in &self.planes {
            cut.clear();
            let Some(&last) = polygon.last() else { return };
            let (mut p, mut of_p) = (last, plane.height(last));
            for &q in polygon.iter() {
                let of_q = plane.height(q);
                if (of_p > 0.0 && of_q < 0.0) || (of_p < 0.0 && of_q > 0.0) {
                    let _ = cut.try_push(p + (q - p) * (of_p / (of_p - of_q)));
                }
                if of_q >= 0.0 {
                    let _ = cut.try_push(q);
                }
                (p, of_p) = (q, of_q);
            }
            std::mem::swap(&mut polygon, &mut cut);
        }
        polygon.iter().copied().for_each(visit);
    }
}
