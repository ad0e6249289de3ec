//! Placement of the new vertex of a collapse near the surface, on either side of it: least squares
//! of distances (Garland & Heckbert 1997) from the planes of the triangles below the edge, and from
//! planes that stand on the edges of holes.

use super::Conditions;
use super::placement::{Facet, Placement, Refusal, StarFace, check_shape};
use crate::surface::Grid;
use glam::{DMat3, DVec3};

/// Weight of a hole edge's plane at each of its ends, times the edge's squared length. With less,
/// holes grow.
const HOLE_WEIGHT: f64 = 1.0;

/// Weight of the distance from a triangle's corners over that from its plane. It decides where a
/// flat star puts the vertex. With more, vertices stay where curvature is small.
const CORNER_WEIGHT: f64 = 1e-3;

/// A weighted sum of squared distances from planes and points: `x·A·x − 2b·x + c`.
#[derive(Clone, Copy, Debug, Default)]
struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    const ZERO: Self = Self { a: DMat3::ZERO, b: DVec3::ZERO, c: 0.0 };

    fn plane(normal: DVec3, through: DVec3, weight: f64) -> Self {
        let offset = normal.dot(through);
        let outer = |k: f64| normal * (k * weight);
        Self {
            a: DMat3::from_cols(outer(normal.x), outer(normal.y), outer(normal.z)),
            b: normal * (offset * weight),
            c: offset * offset * weight,
        }
    }

    fn point(p: DVec3, weight: f64) -> Self {
        Self { a: DMat3::IDENTITY * weight, b: p * weight, c: p.length_squared() * weight }
    }

    fn plus(self, other: Self) -> Self {
        Self { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c }
    }

    fn at(&self, x: DVec3) -> f64 {
        (x.dot(self.a * x) - 2.0 * self.b.dot(x) + self.c).max(0.0)
    }
}

/// The inverse. Written out, for versions of glam differ in the order of the determinant's products,
/// and with it in the bits of blobs.
fn inverse(m: &DMat3) -> DMat3 {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let (yz, zx, xy) = (y.cross(z), z.cross(x), x.cross(y));
    let scale = DVec3::splat(z.dot(xy).recip());
    DMat3::from_cols(yz * scale, zx * scale, xy * scale).transpose()
}

/// The quadrics of all vertices of a mesh.
pub struct Quadrics {
    of_vertex: Vec<Quadric>,
    /// Box of the surface. No vertex leaves it, so that every radius can be stored.
    low: DVec3,
    high: DVec3,
}

impl Quadrics {
    /// Of a closed mesh whose triangles from `surface` on close holes.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]], surface: usize) -> Self {
        let (triangles, fillers) = triangles.split_at(surface);
        let mut of_vertex = vec![Quadric::ZERO; positions.len()];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        // Vertices of holes, then the sorted edges of holes. A filler is `[to, from, centre]`.
        let mut is_of_hole = vec![false; positions.len()];
        fillers.iter().for_each(|&[a, b, _]| {
            is_of_hole[a as usize] = true;
            is_of_hole[b as usize] = true;
        });
        let mut hole_edges: Vec<[u32; 2]> = fillers.iter().map(|&[a, b, _]| [b, a]).collect();
        hole_edges.sort_unstable();
        let mut add = |v: u32, quadric| {
            let slot = &mut of_vertex[v as usize];
            *slot = slot.plus(quadric);
        };
        for &corners in triangles {
            let at = corners.map(|v| positions[v as usize]);
            let Facet { normal, double_area, .. } = Facet::of(at);
            let weight = double_area / 6.0;
            for (k, &v) in corners.iter().enumerate() {
                (low, high) = (low.min(at[k]), high.max(at[k]));
                add(v, Quadric::plane(normal, at[k], weight));
                add(v, Quadric::point(at[k], weight * CORNER_WEIGHT));
                let to = corners[(k + 1) % 3];
                let may_end = is_of_hole[v as usize] && is_of_hole[to as usize];
                if may_end && hole_edges.binary_search(&[v, to]).is_ok() {
                    let edge = at[(k + 1) % 3] - at[k];
                    let across = edge.cross(normal).normalize_or_zero();
                    let wall = Quadric::plane(across, at[k], edge.length_squared() * HOLE_WEIGHT);
                    add(v, wall);
                    add(to, wall);
                }
            }
        }
        Quadrics { of_vertex, low, high }
    }

    /// The vertex that replaces edge `a b`, whose star has the given triangles of the surface. With
    /// a grid the vertex is rounded to it.
    ///
    /// # Errors
    /// Why there is no place.
    pub fn place(
        &self,
        [a, b]: [u32; 2],
        [at_a, at_b]: [DVec3; 2],
        faces: &[StarFace],
        conditions: &Conditions,
        grid: Option<&Grid>,
    ) -> Result<Placement, Refusal> {
        let quadric = self.of_vertex[a as usize].plus(self.of_vertex[b as usize]);
        let best = inverse(&quadric.a) * quadric.b;
        let middle = (at_a + at_b) * 0.5;
        let mut places: Vec<(f64, DVec3)> = [best, at_a, at_b, middle]
            .into_iter()
            .filter(|p| p.is_finite())
            .map(|p| p.clamp(self.low, self.high))
            .filter_map(|p| grid.map_or(Some(p), |grid| grid.round(p)))
            .map(|p| (quadric.at(p), p))
            .collect();
        places.sort_by(|p, q| p.0.total_cmp(&q.0));
        let Some(&(least, _)) = places.first() else { return Err(Refusal::NoVertex) };
        let fits = |&&(_, p): &&(f64, DVec3)| check_shape(faces, p, conditions).is_ok();
        let placed = places.iter().find(fits).ok_or(Refusal::Condition(least))?;
        Ok(Placement { position: placed.1, cost: placed.0 })
    }

    /// After a collapse of `b` into `a`.
    pub fn merge(&mut self, a: u32, b: u32) {
        self.of_vertex[a as usize] = self.of_vertex[a as usize].plus(self.of_vertex[b as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadric_is_the_sum_of_weighted_squared_distances() {
        let (normal, p, x) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(1.0, 2.0, 3.0), DVec3::ONE);
        let sum = Quadric::plane(normal, p, 2.0).plus(Quadric::point(p, 0.5));
        let wanted = 2.0 * normal.dot(x - p).powi(2) + 0.5 * (x - p).length_squared();
        assert!((sum.at(x) - wanted).abs() < 1e-12 && sum.at(p) < 1e-12);
    }
}
