//! Four supporting planes at a time for targets with four lanes, one after the other elsewhere.
//! Both give the same bits.
//!
//! The lane loop takes every branch of the scalar kernel and selects. A vectorising compiler turns
//! it into four-lane arithmetic. A Cortex-M would pay for all branches, so it runs the scalar
//! kernel. Both evaluate the same formulas in the same order.

use super::support::Support;
use crate::num::greater;
use glam::Vec3;

/// Triangles bounded at a time.
pub const LANES: usize = 4;

/// Whether four lanes are worth all branches.
const VECTOR: bool = cfg!(meshsweep_wide);

/// Up to [`LANES`] triangles, one array for each coordinate of each corner, so that a vectoriser
/// loads whole arrays.
#[derive(Clone, Copy, Debug)]
pub struct Lanes {
    t: [[f32; LANES]; 9],
}

impl Lanes {
    /// Whether four lanes are worth all branches. Else a triangle alone takes less.
    pub const PAY: bool = VECTOR;

    /// No triangles.
    pub const EMPTY: Lanes = Lanes { t: [[0.0; LANES]; 9] };

    /// Puts a triangle into lane `lane` modulo [`LANES`]: no bounds check.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, [a, b, c]: [Vec3; 3]) {
        let coordinates = [a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z];
        for (row, x) in self.t.iter_mut().zip(coordinates) {
            row[lane % LANES] = x;
        }
    }

    /// Supporting planes, facing the origin, of the first `count` triangles. The other lanes hold
    /// any value.
    #[inline(always)]
    pub fn supports(&self, count: usize) -> [Support; LANES] {
        if VECTOR {
            return in_lanes(&self.t);
        }
        let mut out = [Support::default(); LANES];
        for (lane, slot) in out.iter_mut().enumerate().take(count) {
            let [ax, ay, az, bx, by, bz, cx, cy, cz] = self.t.map(|row| row[lane % LANES]);
            let corners = [[ax, ay, az], [bx, by, bz], [cx, cy, cz]];
            *slot = Support::new(corners.map(|corner| Vec3::from_array(corner).into()));
        }
        out
    }
}

#[inline(always)]
fn in_lanes(t: &[[f32; LANES]; 9]) -> [Support; LANES] {
    let (mut along, mut length_sq) = ([0f32; LANES], [0f32; LANES]);
    for i in 0..LANES {
        let (apx, apy, apz) = (-t[0][i], -t[1][i], -t[2][i]);
        let (abx, aby, abz) = (t[3][i] - t[0][i], t[4][i] - t[1][i], t[5][i] - t[2][i]);
        let (acx, acy, acz) = (t[6][i] - t[0][i], t[7][i] - t[1][i], t[8][i] - t[2][i]);
        let d1 = abx * apx + aby * apy + abz * apz;
        let d2 = acx * apx + acy * apy + acz * apz;
        let aa = abx * abx + aby * aby + abz * abz;
        let bb = abx * acx + aby * acy + abz * acz;
        let cc = acx * acx + acy * acy + acz * acz;
        let (d3, d4, d5, d6) = (d1 - aa, d2 - bb, d1 - bb, d2 - cc);
        let vc = d1 * d4 - d3 * d2;
        let vb = d5 * d2 - d1 * d6;
        let va = d3 * d6 - d5 * d4;
        let (e4, e5) = (d4 - d3, d5 - d6);
        let sum = va + vb + vc;
        // From the last branch of the scalar kernel to the first, so that the first that applies
        // wins.
        let (mut den, mut nu, mut nv) = (sum, vb, vc);
        let empty = sum <= 0.0;
        (den, nu, nv) = if empty { (1.0, 0.0, 0.0) } else { (den, nu, nv) };
        let on_bc = (va <= 0.0) & (e4 >= 0.0) & (e5 >= 0.0) & (e4 + e5 > 0.0);
        (den, nv) = if on_bc { (e4 + e5, e4) } else { (den, nv) };
        let on_ac = (vb <= 0.0) & (d2 >= 0.0) & (d6 <= 0.0) & (cc > 0.0);
        (den, nu, nv) = if on_ac { (cc, 0.0, d2) } else { (den, nu, nv) };
        let at_c = (d6 >= 0.0) & (d5 <= d6);
        (den, nu, nv) = if at_c { (1.0, 0.0, 1.0) } else { (den, nu, nv) };
        let on_ab = (vc <= 0.0) & (d1 >= 0.0) & (d3 <= 0.0) & (aa > 0.0);
        (den, nu, nv) = if on_ab { (aa, d1, 0.0) } else { (den, nu, nv) };
        let at_b = (d3 >= 0.0) & (d4 <= d3);
        (den, nu, nv) = if at_b { (1.0, 1.0, 0.0) } else { (den, nu, nv) };
        let at_a = (d1 <= 0.0) & (d2 <= 0.0);
        (den, nu, nv) = if at_a { (1.0, 0.0, 0.0) } else { (den, nu, nv) };
        let inverse = 1.0 / den;
        let v = nv * inverse;
        let only_bc = on_bc & !on_ac & !at_c & !on_ab & !at_b & !at_a;
        let u = if only_bc { 1.0 - v } else { nu * inverse };
        let rx = apx - abx * u - acx * v;
        let ry = apy - aby * u - acy * v;
        let rz = apz - abz * u - acz * v;
        let rab = rx * abx + ry * aby + rz * abz;
        let rac = rx * acx + ry * acy + rz * acz;
        let far = if rab > 0.0 { rab } else { 0.0 };
        let far = greater(far, rac);
        along[i] = (rx * apx + ry * apy + rz * apz) - far;
        length_sq[i] = rx * rx + ry * ry + rz * rz;
    }
    let mut out = [Support::default(); LANES];
    for i in 0..LANES {
        out[i] = Support { along: along[i], length_sq: length_sq[i] };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::noise::Noise;

    /// Coordinates of few values, so that every region, tie and degenerate triangle comes up.
    fn coordinate(noise: &mut Noise, coarse: bool) -> f32 {
        let bits = (noise.bits() >> 33) as u32;
        if coarse { (bits % 5) as f32 - 2.0 } else { bits as f32 / 1e9 - 1.0 }
    }

    #[test]
    fn lanes_give_the_bits_of_the_scalar_kernel() {
        let mut noise = Noise(7);
        for round in 0..100_000 {
            let mut vector = || {
                Vec3::from_array(core::array::from_fn(|_| coordinate(&mut noise, round % 2 == 0)))
            };
            let triangles: [[Vec3; 3]; LANES] =
                core::array::from_fn(|_| core::array::from_fn(|_| vector()));
            let mut rows = Lanes::EMPTY;
            for (lane, triangle) in triangles.iter().enumerate() {
                rows.set(lane, *triangle);
            }
            let lanes = in_lanes(&rows.t);
            for (triangle, lane) in triangles.iter().zip(lanes) {
                let scalar = Support::new(triangle.map(Into::into));
                // `+ 0.0` makes the two zeros one: they compare equal everywhere.
                let bits = |s: Support| ((s.along + 0.0).to_bits(), (s.length_sq + 0.0).to_bits());
                assert_eq!(bits(scalar), bits(lane), "{triangle:?}");
            }
        }
    }
}
