//! The boundary of a union of triboxes, in exact arithmetic.

use super::parse::{NORMALS, Slabs};
use super::plane::{Plane, lines};
use crate::check::dyadic::Dyadic;
use crate::check::planar::Polygon;
use crate::check::vector::dot;
use glam::DVec3;

/// Larger than any parameter: a sum of 16-bit numbers and two coordinates of the origin.
const SIZE: f64 = (1u32 << 21) as f64;

/// A convex part of the boundary, with the tribox of which it is a face.
pub(super) struct Exposed {
    pub(super) node: usize,
    plane: Plane,
    /// Outwards, along the plane's normal.
    outward: f64,
    polygon: Polygon,
    /// Of those that reach beyond the plane.
    others: Vec<Slabs>,
}

/// All parts of the boundary that have an area. Every connected component of the union's complement
/// lies before one of them.
pub(super) fn exposed(union: &[(usize, Slabs)]) -> Vec<Exposed> {
    let mut parts = Vec::new();
    for (own, &(node, slabs)) in union.iter().enumerate() {
        for (slab, end) in (0..9).flat_map(|slab| [(slab, 0), (slab, 1)]) {
            let (normal, level) = (NORMALS[slab], slabs[slab][end]);
            let outward = if end == 0 { -1.0 } else { 1.0 };
            let plane = Plane::new(normal, level);
            let Some(face) =
                lines(&plane, &slabs, 0.0).and_then(|lines| Polygon::square(SIZE).inside(&lines))
            else {
                continue;
            };
            // A tribox that ends at the plane, or before it, has nothing beyond the face.
            let is_beyond = |other: &Slabs| (other[slab][end] - level) * outward > 0.0;
            let meets = |other: &Slabs| {
                (0..9).all(|k| other[k][0] <= slabs[k][1] && slabs[k][0] <= other[k][1])
            };
            let others: Vec<Slabs> = union
                .iter()
                .enumerate()
                .filter(|&(index, (_, other))| index != own && is_beyond(other) && meets(other))
                .map(|(_, (_, other))| *other)
                .collect();
            let mut rest = vec![face];
            for other in &others {
                if let Some(lines) = lines(&plane, other, 0.0) {
                    rest = rest.into_iter().flat_map(|part| part.minus(&lines)).collect();
                }
            }
            parts.extend(rest.into_iter().map(|polygon| Exposed {
                node,
                plane: plane.clone(),
                outward,
                polygon,
                others: others.clone(),
            }));
        }
    }
    parts
}

impl Exposed {
    /// Triangles about the first corner, rounded.
    pub(super) fn triangles(&self) -> Vec<[DVec3; 3]> {
        let corners: Vec<DVec3> = self.polygon.corners().map(|at| self.plane.rounded(at)).collect();
        corners.windows(2).skip(1).map(|edge| [corners[0], edge[0], edge[1]]).collect()
    }

    /// A point in the complement that lies straight before the part, so that nothing of the union
    /// is between; none if it is not found.
    pub(super) fn before(&self) -> Option<[f64; 3]> {
        let corners: Vec<DVec3> = self.polygon.corners().map(|at| self.plane.rounded(at)).collect();
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let normal = DVec3::from(self.plane.normal) * self.outward;
        (0..34)
            .map(|halvings| (middle + normal * 0.5f64.powi(halvings)).to_array())
            .find(|&p| self.is_before(p))
    }

    fn is_before(&self, p: [f64; 3]) -> bool {
        let p = p.map(Dyadic::from);
        let (foot, place, height) = self.plane.foot(&p);
        let is_outside = |q: &[Dyadic; 3], slab: usize, end: usize, other: &Slabs| {
            let over = &dot(&NORMALS[slab].map(Dyadic::from), q) - &Dyadic::from(other[slab][end]);
            over.sign() == if end == 0 { -1 } else { 1 }
        };
        let are_parted = |other: &Slabs| {
            (0..9).flat_map(|slab| [(slab, 0), (slab, 1)]).any(|(slab, end)| {
                is_outside(&p, slab, end, other) && is_outside(&foot, slab, end, other)
            })
        };
        f64::from(height.sign()) == self.outward
            && self.polygon.has_inside(&place)
            && self.others.iter().all(are_parted)
    }
}
