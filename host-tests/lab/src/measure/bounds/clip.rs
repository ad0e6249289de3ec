//! The solid that planes leave over, in f64.
//!
//! Each plane's face is a large square cut by all other planes. No face knows another, so rounding
//! cannot tear the solid: the worst that it does is a sliver, and what is closer than `MERGED`
//! becomes one vertex.

use glam::DVec3;

/// Vertices closer than this become one, of the reach: far above rounding, far below what a table
/// shows.
const MERGED: f64 = 1e-9;

/// A point that is no further outside counts as inside, of the reach: what is flat keeps its two
/// faces. Some hundred roundings.
const OUTSIDE: f64 = 1e-13;

/// The points x with `normal`·x ≤ `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Outward, of any length but zero.
    pub normal: DVec3,
    /// Greatest `normal`·x allowed.
    pub offset: f64,
}

/// A convex solid.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// Corners of faces, each once.
    pub vertices: Vec<DVec3>,
    /// Corners, counter-clockwise from outside, of the faces that are left; at least three each.
    pub faces: Vec<Vec<usize>>,
}

impl Solid {
    /// What is on the inner side of all planes, if it lies within `reach` of `centre` along each
    /// axis. No plane may be there twice.
    #[must_use]
    pub fn new(planes: &[Plane], centre: DVec3, reach: f64) -> Self {
        // About the centre, so that far from the origin nothing is lost but what the offsets have
        // lost.
        let about =
            |plane: &Plane| Plane { offset: plane.offset - plane.normal.dot(centre), ..*plane };
        let planes: Vec<Plane> = planes.iter().map(about).collect();
        let mut solid = Self::default();
        for (index, plane) in planes.iter().enumerate() {
            let mut face = square(plane, 4.0 * reach);
            for (_, other) in planes.iter().enumerate().filter(|(other, _)| *other != index) {
                face = cut(&face, other, OUTSIDE * reach * other.normal.length());
            }
            solid.push(&face, MERGED * reach);
        }
        solid.vertices.iter_mut().for_each(|v| *v += centre);
        solid
    }

    fn push(&mut self, face: &[DVec3], merged: f64) {
        let mut corners: Vec<usize> = face.iter().map(|p| self.vertex(*p, merged)).collect();
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() > 2 {
            self.faces.push(corners);
        }
    }

    fn vertex(&mut self, p: DVec3, merged: f64) -> usize {
        let near = self.vertices.iter().position(|v| v.distance_squared(p) <= merged * merged);
        near.unwrap_or_else(|| {
            self.vertices.push(p);
            self.vertices.len() - 1
        })
    }

    /// Its volume.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let Some(&origin) = self.vertices.first() else { return 0.0 };
        self.triangles()
            .map(|[a, b, c]| (a - origin).dot((b - origin).cross(c - origin)))
            .sum::<f64>()
            / 6.0
    }

    fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        let fan = |face: &'_ [usize]| -> Vec<[DVec3; 3]> {
            face[1..]
                .windows(2)
                .map(|pair| [face[0], pair[0], pair[1]].map(|v| self.vertices[v]))
                .collect()
        };
        self.faces.iter().flat_map(move |face| fan(face))
    }
}

/// A square on the plane about the point nearest to the origin, counter-clockwise from outside.
fn square(plane: &Plane, half: f64) -> Vec<DVec3> {
    let middle = plane.normal * (plane.offset / plane.normal.length_squared());
    let u = plane.normal.any_orthogonal_vector().normalize() * half;
    let v = plane.normal.cross(u).normalize() * half;
    vec![middle - u - v, middle + u - v, middle + u + v, middle - u + v]
}

/// The part of a polygon on the plane's inner side.
fn cut(polygon: &[DVec3], plane: &Plane, slack: f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    let above = |p: DVec3| plane.normal.dot(p) - plane.offset;
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (from, to) = (above(a), above(b));
        if from <= slack {
            kept.push(a);
        }
        if (from <= slack) != (to <= slack) {
            kept.push(a.lerp(b, (from / (from - to)).clamp(0.0, 1.0)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::{Plane, Solid};
    use crate::measure::bounds::dop::Slabs;
    use glam::DVec3;
    use meshsweep_host_tests::generate::Rng;
    use meshsweep_host_tests::oracle::polytope::{Dimension, HalfSpace, Polytope};

    /// Of the same planes, the solid and the exact one.
    fn both_ways(planes: &[HalfSpace], reach: f64) -> (Solid, Polytope) {
        let plane = |p: &HalfSpace| Plane {
            normal: DVec3::from_array(p.normal.map(|x| x as f64)),
            offset: p.offset as f64,
        };
        let floating: Vec<Plane> = planes.iter().map(plane).collect();
        (Solid::new(&floating, DVec3::new(0.5, -1.0, 2.0), reach), Polytope::new(planes))
    }

    /// Slabs of ranges about zero: solids, and many planes that touch in an edge or a vertex, or
    /// not at all.
    fn random_planes(slabs: &Slabs, reach: usize, rng: &mut Rng) -> Vec<HalfSpace> {
        let mut offset = || 1 + rng.below(reach).cast_signed() as i64;
        let mut planes = Vec::new();
        for direction in &slabs.directions {
            let normal = direction.to_array().map(|x| x as i64);
            planes.push(HalfSpace::new(normal, offset()));
            planes.push(HalfSpace::new(normal.map(|x| -x), offset()));
        }
        planes
    }

    #[test]
    fn solids_are_the_exact_ones() {
        let mut rng = Rng::new(0x636c_6970);
        for slabs in Slabs::all() {
            for reach in [4, 60, 100_000] {
                for _ in 0..150 {
                    let planes = random_planes(&slabs, reach, &mut rng);
                    let (solid, exact) = both_ways(&planes, 3.0 * reach as f64);
                    assert_eq!(exact.dimension(), Dimension::Solid);
                    assert_eq!(solid.vertices.len(), exact.vertices().len(), "{planes:?}");
                    assert_eq!(solid.faces.len(), exact.distinct_faces().count(), "{planes:?}");
                    let size = reach as f64;
                    assert!(
                        (solid.volume() - exact.volume()).abs() < 1e-10 * size.powi(3),
                        "{planes:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_flat_box_keeps_both_sides_and_contradictions_leave_nothing() {
        let axis = |k: usize, sign: i64| {
            let mut normal = [0; 3];
            normal[k] = sign;
            normal
        };
        let faces = |top: i64| {
            let sides = (0..3).flat_map(|k| [(k, 1), (k, -1)]);
            sides.map(move |(k, sign)| {
                HalfSpace::new(axis(k, sign), if k == 2 { sign * top } else { 2 })
            })
        };
        let flat: Vec<HalfSpace> = faces(1).collect();
        let (solid, exact) = both_ways(&flat, 5.0);
        assert_eq!(exact.dimension(), Dimension::Polygon);
        assert_eq!((solid.vertices.len(), solid.faces.len()), (4, 2));
        assert!(solid.volume().abs() < 1e-12);
        let mut none = flat;
        none[4].offset = 0;
        let (solid, exact) = both_ways(&none, 5.0);
        assert!(exact.is_empty() && solid.faces.is_empty());
    }
}
