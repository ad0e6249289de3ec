//! A plane with coordinates, and what slabs are in them.

use super::parse::{NORMALS, Slabs};
use crate::check::dyadic::Dyadic;
use crate::check::planar::Line;
use crate::check::vector::dot;
use glam::DVec3;

/// Points `origin + s·u + t·v`.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) normal: [f64; 3],
    level: f64,
    origin: [f64; 3],
    u: [f64; 3],
    v: [f64; 3],
    /// Axes along which s and t are coordinates.
    axes: [usize; 2],
}

impl Plane {
    /// The plane `normal · p = level`, for a normal of 0 and ±1.
    pub(super) fn new(normal: [f64; 3], level: f64) -> Self {
        let solved = (0..3).find(|&axis| normal[axis] != 0.0).unwrap_or(0);
        let axes = [(solved + 1) % 3, (solved + 2) % 3];
        let mut origin = [0.0; 3];
        origin[solved] = level * normal[solved];
        let along = |axis: usize| {
            let mut way = [0.0; 3];
            way[axis] = 1.0;
            way[solved] = -normal[axis] * normal[solved];
            way
        };
        Self { normal, level, origin, u: along(axes[0]), v: along(axes[1]), axes }
    }

    pub(super) fn rounded(&self, [s, t]: [f64; 2]) -> DVec3 {
        DVec3::from(self.origin) + DVec3::from(self.u) * s + DVec3::from(self.v) * t
    }

    /// The foot of a point, its coordinates in the plane, and a number with the sign of the height.
    pub(super) fn foot(&self, p: &[Dyadic; 3]) -> ([Dyadic; 3], [Dyadic; 2], Dyadic) {
        let normal = self.normal.map(Dyadic::from);
        let height = &dot(&normal, p) - &Dyadic::from(self.level);
        // The normal's square is 1 or 2.
        let square: f64 = self.normal.iter().map(|x| x * x).sum();
        let part = &height * &Dyadic::from(1.0 / square);
        let foot: [Dyadic; 3] = std::array::from_fn(|k| &p[k] - &(&part * &normal[k]));
        let place = self.axes.map(|axis| foot[axis].clone());
        (foot, place, height)
    }
}

/// Points `origin + s·u + t·v`, by their products with the normals of slabs.
pub(super) trait Patch {
    fn products(&self, normal: [f64; 3]) -> [Dyadic; 3];
}

impl Patch for Plane {
    fn products(&self, normal: [f64; 3]) -> [Dyadic; 3] {
        let product = |way: [f64; 3]| Dyadic::from((0..3).map(|k| normal[k] * way[k]).sum::<f64>());
        // Sums of integers below 2^21.
        [product(self.u), product(self.v), product(self.origin)]
    }
}

/// A triangle, from its first corner along two edges.
impl Patch for [[f64; 3]; 3] {
    fn products(&self, normal: [f64; 3]) -> [Dyadic; 3] {
        let normal = normal.map(Dyadic::from);
        let [a, b, c] = self.map(|p| dot(&normal, &p.map(Dyadic::from)));
        [&b - &a, &c - &a, a]
    }
}

/// The lines of a tribox's slabs, each plane moved inwards by `inward` times a bound of its
/// normal's length; none if a slab leaves out the whole patch.
pub(super) fn lines(patch: &impl Patch, slabs: &Slabs, inward: f64) -> Option<Vec<Line>> {
    let zero = Dyadic::from(0.0);
    let mut lines = Vec::new();
    for (slab, normal) in NORMALS.into_iter().enumerate() {
        let length = if slab < 3 { 1.0 } else { std::f64::consts::SQRT_2.next_up() };
        let inward = &Dyadic::from(inward) * &Dyadic::from(length);
        let [u, v, at] = patch.products(normal);
        let [low, high] = slabs[slab].map(Dyadic::from);
        let above = [u.clone(), v.clone(), &(&at - &low) - &inward];
        let below = [&zero - &u, &zero - &v, &(&high - &at) - &inward];
        for line in [above, below] {
            if line[0].sign() != 0 || line[1].sign() != 0 {
                lines.push(Line::new(line));
            } else if line[2].sign() < 0 {
                return None;
            }
        }
    }
    Some(lines)
}
