//! The shape of a tribox in `f64`: its corners and its volume.

use super::parse::{NORMALS, Slabs};
use glam::DVec3;

/// The part of a convex polygon where `height` is at least 0.
fn part(polygon: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (k, &p) in polygon.iter().enumerate() {
        let next = polygon[(k + 1) % polygon.len()];
        let (here, there) = (height(p), height(next));
        if here >= 0.0 {
            kept.push(p);
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            kept.push(p + (next - p) * (here / (here - there)));
        }
    }
    kept
}

/// The part of a convex polygon in a tribox, whose planes are moved outward by `room`.
pub(super) fn inside(polygon: &[DVec3], slabs: &Slabs, room: f64) -> Vec<DVec3> {
    between(polygon, slabs, room, 0..9)
}

/// The same of some slabs alone.
fn between(
    polygon: &[DVec3],
    slabs: &Slabs,
    room: f64,
    of: impl Iterator<Item = usize> + Clone,
) -> Vec<DVec3> {
    let normal = |slab: usize| DVec3::from(NORMALS[slab]);
    let is_in = |p: &DVec3| {
        of.clone().all(|slab| {
            let ([low, high], at) = (slabs[slab], normal(slab).dot(*p));
            low - room <= at && at <= high + room
        })
    };
    let mut rest = polygon.to_vec();
    if rest.iter().all(is_in) {
        return rest;
    }
    for slab in of {
        let ([low, high], normal) = (slabs[slab], normal(slab));
        rest = part(&rest, |p| normal.dot(p) - low + room);
        rest = part(&rest, |p| high - normal.dot(p) + room);
    }
    rest
}

/// A tribox's corners, some of them more than once, and its volume.
pub(super) struct Shape {
    pub(super) corners: Vec<DVec3>,
    pub(super) volume: f64,
}

impl Shape {
    /// In grid units. A corner is halves of integers, so most of it is exact.
    pub(super) fn of(slabs: &Slabs) -> Self {
        let mut corners = Vec::new();
        let mut six_volumes = 0.0;
        let middle = DVec3::from([0, 1, 2].map(|k| 0.5 * (slabs[k][0] + slabs[k][1])));
        // A square of twice this side about the middle's foot holds every face.
        let size: f64 = slabs[..3].iter().map(|[low, high]| high - low).sum();
        for (slab, sign) in (0..9).flat_map(|slab| [(slab, -1.0), (slab, 1.0)]) {
            let normal = DVec3::from(NORMALS[slab]) * sign;
            let level = if sign < 0.0 { -slabs[slab][0] } else { slabs[slab][1] };
            let height = level - normal.dot(middle);
            let from = middle + normal * (height / normal.length_squared());
            let (u, v) = across(normal);
            let square = [u + v, v - u, -u - v, u - v].map(|way| from + way * size);
            // Its own plane would cut off what rounding moved.
            let face = between(&square, slabs, 0.0, (0..9).filter(|&other| other != slab));
            for edge in face.windows(2).skip(1) {
                let [a, b, c] = [face[0], edge[0], edge[1]].map(|p| p - middle);
                six_volumes += a.dot(b.cross(c)).abs();
            }
            corners.extend(face);
        }
        Self { corners, volume: six_volumes / 6.0 }
    }
}

/// Two ways in a plane, square to each other, of 0 and ±1.
fn across(normal: DVec3) -> (DVec3, DVec3) {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let u = axes.into_iter().find(|axis| axis.dot(normal) == 0.0).unwrap_or(DVec3::X);
    (u, normal.cross(u))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_and_a_rhombic_dodecahedron_have_their_textbook_volumes() {
        let cube = [[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-2.0, 2.0]];
        let cube: Slabs = std::array::from_fn(|slab| cube[slab.min(3)]);
        assert!((Shape::of(&cube).volume - 8.0).abs() < 1e-12);
        let dodecahedron = [[-1.0, 1.0]; 9];
        let shape = Shape::of(&dodecahedron);
        assert!((shape.volume - 2.0).abs() < 1e-12, "{}", shape.volume);
        for corner in [DVec3::X, DVec3::NEG_Z, DVec3::splat(0.5)] {
            assert!(shape.corners.iter().any(|p| p.distance(corner) < 1e-12), "{corner}");
        }
        // Off the origin, as parts of a blob lie.
        let moved = std::array::from_fn(|slab| {
            let by = DVec3::from(NORMALS[slab]).dot(DVec3::new(1000.0, -300.0, 70.0));
            dodecahedron[slab].map(|end| end + by)
        });
        assert!((Shape::of(&moved).volume - 2.0).abs() < 1e-9);
    }
}
