//! Convex hulls of points, every side of a plane decided exactly (Barber, Dobkin & Huhdanpaa 1996:
//! quickhull).
//!
//! parry3d's hull is f32 throughout and may leave points outside; a reference has to hold what it
//! is the reference of.

use std::collections::HashMap;

use glam::DVec3;
use robust::{Coord3D, orient3d};

/// A convex hull.
#[derive(Clone, Debug)]
pub struct ConvexHull {
    /// Its vertices, some of which may lie within a flat side.
    pub points: Vec<DVec3>,
    /// Its faces, counter-clockwise seen from outside; several may share a plane.
    pub triangles: Vec<[usize; 3]>,
}

impl ConvexHull {
    /// The hull, or `None` of points that all lie in a plane. No point is outside. Coordinates
    /// below 1e-50 of the others may be lost to underflow.
    #[must_use]
    pub fn new(points: &[DVec3]) -> Option<Self> {
        let mut growing = Growing::new(points)?;
        while let Some(face) = growing.pending.pop() {
            growing.extend(face);
        }
        let mut numbers = HashMap::new();
        let mut hull = Self { points: Vec::new(), triangles: Vec::new() };
        for face in growing.faces.iter().filter(|face| face.is_alive) {
            hull.triangles.push(face.corners.map(|corner| {
                *numbers.entry(corner).or_insert_with(|| {
                    hull.points.push(points[corner]);
                    hull.points.len() - 1
                })
            }));
        }
        Some(hull)
    }

    /// Its volume.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let origin = self.points[0];
        let sixfold = |[a, b, c]: [DVec3; 3]| (a - origin).dot((b - origin).cross(c - origin));
        self.corners().map(sixfold).sum::<f64>() / 6.0
    }

    fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.triangles.iter().map(|t| t.map(|v| self.points[v]))
    }
}

struct Face {
    corners: [usize; 3],
    /// Points in front of it that no other face has: each point that is still outside is in one
    /// list.
    outside: Vec<usize>,
    is_alive: bool,
}

struct Growing<'a> {
    points: &'a [DVec3],
    faces: Vec<Face>,
    /// The face to the left of a directed edge.
    left: HashMap<[usize; 2], usize>,
    /// Faces that may have points outside.
    pending: Vec<usize>,
}

impl<'a> Growing<'a> {
    /// A tetrahedron and the points outside of it.
    fn new(points: &'a [DVec3]) -> Option<Self> {
        let farthest = |measure: &dyn Fn(DVec3) -> f64| {
            (0..points.len()).max_by(|a, b| measure(points[*a]).total_cmp(&measure(points[*b])))
        };
        let a = farthest(&|p| -p.x)?;
        let b = farthest(&|p| p.distance_squared(points[a]))?;
        let c = farthest(&|p| (p - points[a]).cross(points[b] - points[a]).length_squared())?;
        let normal = (points[b] - points[a]).cross(points[c] - points[a]);
        let d = farthest(&|p| (p - points[a]).dot(normal).abs())?;
        let mut growing =
            Self { points, faces: Vec::new(), left: HashMap::new(), pending: Vec::new() };
        let side = growing.height([a, b, c], d);
        if side == 0.0 {
            return None;
        }
        let [b, c] = if side > 0.0 { [c, b] } else { [b, c] };
        for corners in [[a, b, c], [a, d, b], [b, d, c], [c, d, a]] {
            growing.push(corners);
        }
        growing.share((0..points.len()).collect(), 0);
        Some(growing)
    }

    /// Positive in front of the face, exactly zero on its plane.
    fn height(&self, corners: [usize; 3], point: usize) -> f64 {
        let at = |v: usize| {
            let p = self.points[v];
            Coord3D { x: p.x, y: p.y, z: p.z }
        };
        -orient3d(at(corners[0]), at(corners[1]), at(corners[2]), at(point))
    }

    fn push(&mut self, corners: [usize; 3]) {
        let index = self.faces.len();
        for k in 0..3 {
            self.left.insert([corners[k], corners[(k + 1) % 3]], index);
        }
        self.faces.push(Face { corners, outside: Vec::new(), is_alive: true });
        self.pending.push(index);
    }

    /// Gives each point to a face from `first` on that it is in front of; the others are inside.
    fn share(&mut self, points: Vec<usize>, first: usize) {
        for point in points {
            let seen = (first..self.faces.len())
                .find(|face| self.height(self.faces[*face].corners, point) > 0.0);
            if let Some(face) = seen {
                self.faces[face].outside.push(point);
            }
        }
    }

    /// Takes the point farthest in front of a face in.
    fn extend(&mut self, face: usize) {
        let Face { corners, outside, is_alive } = &self.faces[face];
        // The height is the determinant, which grows with the distance.
        let far = |a: &&usize, b: &&usize| {
            self.height(*corners, **a).total_cmp(&self.height(*corners, **b))
        };
        let Some(&apex) = outside.iter().max_by(far).filter(|_| *is_alive) else { return };
        let mut seen = vec![face];
        self.faces[face].is_alive = false;
        let (mut horizon, mut orphans, mut next) = (Vec::new(), Vec::new(), 0);
        while let Some(&visible) = seen.get(next) {
            next += 1;
            orphans.append(&mut self.faces[visible].outside);
            let corners = self.faces[visible].corners;
            for k in 0..3 {
                let edge = [corners[k], corners[(k + 1) % 3]];
                let Some(&beyond) = self.left.get(&[edge[1], edge[0]]) else { continue };
                if !self.faces[beyond].is_alive {
                    continue;
                }
                if self.height(self.faces[beyond].corners, apex) > 0.0 {
                    self.faces[beyond].is_alive = false;
                    seen.push(beyond);
                } else {
                    horizon.push(edge);
                }
            }
        }
        let first = self.faces.len();
        for [a, b] in horizon {
            self.push([a, b, apex]);
        }
        // In front of a face that is gone and of no new one: inside, for the way to the lost face
        // enters through a new one.
        self.share(orphans, first);
    }
}

#[cfg(test)]
mod tests {
    use super::ConvexHull;
    use glam::DVec3;
    use meshsweep_host_tests::generate::{Rng, Triangles, cube, icosphere, torus};

    fn points((positions, _): &Triangles) -> Vec<DVec3> {
        positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect()
    }

    /// Closed, of genus 0, and no point outside by more than rounding.
    fn check(points: &[DVec3]) -> ConvexHull {
        let hull = ConvexHull::new(points).expect("not flat");
        assert_eq!(hull.triangles.len() + 4, 2 * hull.points.len());
        let size = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        for t in &hull.triangles {
            let [a, b, c] = t.map(|v| hull.points[v]);
            let normal = (b - a).cross(c - a).normalize();
            assert!(points.iter().all(|p| normal.dot(*p - a) < 1e-6 * size));
        }
        hull
    }

    #[test]
    fn flat_sides_of_many_points_are_no_difficulty() {
        let hull = check(&points(&cube(9)));
        assert!((hull.volume() - 8.0).abs() < 1e-12);
    }

    #[test]
    fn convex_meshes_are_their_own_hulls() {
        let sphere = icosphere(3);
        let hull = check(&points(&sphere));
        assert_eq!((hull.points.len(), hull.triangles.len()), (sphere.0.len(), sphere.1.len()));
        check(&points(&torus(2.0, 0.7, 40, 20)));
    }

    #[test]
    fn grids_and_repeated_points_are_no_difficulty() {
        let mut rng = Rng::new(1996);
        for side in [2, 3, 5, 100] {
            for _ in 0..30 {
                let some: Vec<DVec3> = (0..80)
                    .map(|_| DVec3::from_array([(); 3].map(|()| rng.below(side) as f64)))
                    .chain([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z])
                    .collect();
                check(&some);
            }
        }
    }

    #[test]
    fn what_is_flat_has_no_hull() {
        let plate: Vec<DVec3> =
            (0..20).map(|k| DVec3::new(f64::from(k % 5), f64::from(k / 5), 1.0)).collect();
        assert!(ConvexHull::new(&plate).is_none());
        assert!(ConvexHull::new(&plate[..2]).is_none());
        assert!(ConvexHull::new(&[]).is_none());
    }
}
