//! Extent of tight triboxes along any direction, without their vertices.
//!
//! The greatest e·p of all points p between the planes nₖ·p ≤ hₖ is the least Σ λₖhₖ of all λ ≥ 0
//! with Σ λₖnₖ = e. Let e = (a, b, c) with a ≥ b ≥ c ≥ 0; the other orders and signs are mirror
//! images. Where no plane can move inward, parameters obey 2h(x) ≤ h(x + y) + h(x − y), h(x) ≤ h(x
//! − y) + h(y), h(x + z) ≤ h(x − y) + h(y + z), h(x + y) ≤ h(x) + h(y): so a least sum has none of
//! the differences, and at most one of x, y, z. One parameter for each of the three remains, and
//! the sum is linear in it. So the least sum is one of these; the last three need a < b + c, the
//! second needs a ≥ b + c:
//!
//! ```text
//! (b − c)(x + y) + c(y + z)       + (a − b + c) x
//! b(x + y)       + c(z + x)       + (a − b − c) x
//! ½(a + b − c)(x + y) + ½(a − b + c)(z + x) + ½(b + c − a)(y + z)
//! (a − c)(x + y) + c(z + x)       + (b + c − a) y
//! b(x + y)       + (a − b)(z + x) + (b + c − a) z
//! ```
//!
//! One for each way in which the faces may meet at the corner in that direction.

use super::directions::FACES;
use crate::num::lesser;

/// A direction, split into multiples of planes' directions in all ways that may be the least.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    factors: [[f32; 3]; 4],
    planes: [[u8; 3]; 4],
    count: u8,
}

/// Slab of the sum and of the difference of two axes.
const DIAGONALS: [[u8; 3]; 3] = [[0, 3, 7], [3, 0, 5], [7, 5, 0]];

impl Support {
    /// No direction.
    pub(crate) const NONE: Support =
        Support { factors: [[0.0; 3]; 4], planes: [[0; 3]; 4], count: 0 };

    /// Whether it is [`NONE`](Self::NONE).
    #[inline(always)]
    pub(crate) fn is_none(&self) -> bool {
        self.count == 0
    }

    /// Splits a finite direction.
    pub(crate) fn along(direction: [f32; 3]) -> Support {
        // Axes by falling size; each with the sign, and the sign of −x for the order in which z − x
        // is stored.
        let mut order = [0u8, 1, 2].map(|axis| {
            let x = direction.get(usize::from(axis)).copied().unwrap_or(0.0);
            (x.abs(), axis, x >= 0.0)
        });
        for [i, j] in [[0, 1], [1, 2], [0, 1]] {
            let [first, second] = [order.get(i).copied(), order.get(j).copied()];
            if let (Some(first), Some(second)) = (first, second)
                && second.0 > first.0
            {
                order
                    .iter_mut()
                    .skip(i)
                    .zip([second, first])
                    .for_each(|(slot, entry)| *slot = entry);
            }
        }
        let [(a, x, x_up), (b, y, y_up), (c, z, z_up)] = order;
        let single = |axis: u8, up: bool| 2 * axis + u8::from(up);
        let double = |(i, i_up): (u8, bool), (j, j_up): (u8, bool)| {
            let slab =
                DIAGONALS.get(usize::from(i)).and_then(|row| row.get(usize::from(j))).copied();
            // A difference is counted from the first axis. Of x and z that is z.
            let first = if (i < j) != (i + j == 2 && i != j) { i_up } else { j_up };
            2 * (slab.unwrap_or(0) + u8::from(i_up != j_up)) + u8::from(first)
        };
        let (xy, zx, yz) = (
            double((x, x_up), (y, y_up)),
            double((z, z_up), (x, x_up)),
            double((y, y_up), (z, z_up)),
        );
        let (x, y, z) = (single(x, x_up), single(y, y_up), single(z, z_up));
        let (cut, cut_planes) = ([b - c, c, a - b + c], [xy, yz, x]);
        let rest = b + c - a;
        if rest <= 0.0 {
            let factors = [cut, [b, c, a - b - c], [0.0; 3], [0.0; 3]];
            return Support {
                factors,
                planes: [cut_planes, [xy, zx, x], [0; 3], [0; 3]],
                count: 2,
            };
        }
        let three = [0.5 * (a + b - c), 0.5 * (a - b + c), 0.5 * rest];
        let factors = [cut, three, [a - c, c, rest], [b, a - b, rest]];
        Support { factors, planes: [cut_planes, [xy, zx, yz], [xy, zx, y], [xy, zx, z]], count: 4 }
    }

    #[inline(always)]
    fn least(&self, planes: &[f32; FACES], flip: u8) -> f32 {
        let mut least = f32::INFINITY;
        let sums = self.factors.iter().zip(&self.planes);
        for (&[a, b, c], &[i, j, k]) in sums.take(usize::from(self.count)) {
            let at =
                |plane: u8| planes.get(usize::from(plane ^ flip)).copied().unwrap_or(f32::INFINITY);
            let (p, q, r) = (at(i) * a, at(j) * b, at(k) * c);
            let here = (p + q) + r;
            least = lesser(least, here);
        }
        least
    }

    /// The greatest direction · point of a tight tribox, planes outward: of slab k its least value,
    /// negated, at 2k and its greatest at 2k + 1.
    ///
    /// The error is at most 22 units of rounding times the sum of the direction's sizes times the
    /// largest coordinate.
    #[inline(always)]
    pub(crate) fn greatest(&self, planes: &[f32; FACES]) -> f32 {
        self.least(planes, 0)
    }

    /// The same against the direction.
    #[inline(always)]
    pub(crate) fn greatest_against(&self, planes: &[f32; FACES]) -> f32 {
        self.least(planes, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Tribox;
    use super::*;

    /// Against the vertices.
    #[test]
    fn supports_are_those_of_the_vertices() {
        let mut state = 7u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) as f32 / 65_536.0 - 0.5
        };
        let mut ways = [0; 2];
        for run in 0..3000 {
            let mut tribox = Tribox::of_points([[(); 3]; 4].map(|p| p.map(|()| next()))).unwrap();
            if run % 2 == 0 {
                let other = Tribox::of_points([[(); 3]; 4].map(|p| p.map(|()| next()))).unwrap();
                tribox = tribox.intersection(&other).tightened();
            }
            let tribox = tribox.on_grid();
            if tribox.is_empty() {
                continue;
            }
            let mut planes = [0f32; FACES];
            for (slab, (low, high)) in tribox.slabs().enumerate() {
                (planes[2 * slab], planes[2 * slab + 1]) = (-low, high);
            }
            let vertices = tribox.boundary().vertices;
            for kind in 0..24 {
                let mut e = [next(), next(), next()];
                if kind % 3 == 0 {
                    e = e.map(|x| (4.0 * x).round());
                }
                let dot =
                    |v: &[f32; 3]| (0..3).map(|k| f64::from(v[k]) * f64::from(e[k])).sum::<f64>();
                let most = vertices.iter().map(dot).fold(f64::NEG_INFINITY, f64::max);
                let least = vertices.iter().map(dot).fold(f64::INFINITY, f64::min);
                let support = Support::along(e);
                ways[usize::from(support.count == 4)] += 1;
                let found = [support.greatest(&planes), -support.greatest_against(&planes)];
                for (found, wanted) in found.into_iter().zip([most, least]) {
                    assert!(
                        (f64::from(found) - wanted).abs() < 2e-6,
                        "{e:?} {found} {wanted} {tribox:?}"
                    );
                }
            }
        }
        assert!(ways.iter().all(|&count| count > 1000), "{ways:?}");
    }
}
