//! Integer pretest: most triangles of a leaf are far from a segment's line, and few products prove
//! it. For targets without an FPU: with one, the kernel in f32 is no slower.
//!
//! The *shadow* of a vertex (u, v, w), w along the line's dominant axis, is (u − at_u − slope_u·w,
//! v − at_v − slope_v·w). The line's own shadow is the origin. The line misses a triangle if it is
//! certainly left of one edge and right of another.
//!
//! The tests decide "clear" and nothing else. All other triangles go to the kernel in f32, whose
//! answer alone counts. So every bit is the same with and without these tests. Margins:
//! `core/docs/rounding.md` §9.

use crate::bvh::tree::format::LeafShape;
use crate::geom::fan::{FanRay, ShadowPlane, WIDTH, ray_leaf};
use crate::num::lesser;

/// Fraction bits of a slope, and of a shadow before it is rounded. With lengths below 2^17 it fits
/// 31 bits.
const SLOPE_BITS: u32 = 13;
/// Bits of a shadow that are rounded away: its unit is then 8 grid units. Products of two shadows
/// fit 29 bits.
const SHADOW_SHIFT: u32 = SLOPE_BITS + 3;
/// The middle of the stored numbers.
const GRID_MIDDLE: i32 = 1 << 15;
/// The line's lengths must be below this, grid units.
const MAX_LENGTH: f32 = (1 << 16) as f32;
/// Margins must be below this, shadow units.
const MAX_MARGIN: f32 = 1024.0;

/// The line of a [`FanRay`] in stored numbers. Coordinates come in the order of the ray's axes.
#[derive(Clone, Copy, Debug)]
pub struct GridLine {
    /// Where the line is at the stored number 0 of the dominant axis.
    at: [i32; 2],
    /// Grid units along the other axes for each grid unit along the dominant one, with
    /// [`SLOPE_BITS`].
    slope: [i32; 2],
    /// An edge farther than this from the line is clear of it. In shadow units. 0 if the numbers do
    /// not fit: then every triangle counts as near.
    margin: i32,
}

/// In units of 8 grid units.
type IntShadow = [i32; 2];

impl GridLine {
    /// The line of `ray`.
    #[inline(always)]
    pub fn new(ray: &FanRay, grid_origin: [i32; 3]) -> Self {
        let middle = grid_origin.map(|origin| origin.wrapping_add(GRID_MIDDLE) as f32);
        let [mu, mv, mw] = ray.in_order(middle);
        let [ou, ov, ow] = ray.origin();
        let [su, sv] = ray.shear();
        let (x, y) = ((ou - mu) + su * (mw - ow), (ov - mv) + sv * (mw - ow));
        let margin = 1.75 * ray.doubt() + 3.0;
        let fits = x.abs() < MAX_LENGTH && y.abs() < MAX_LENGTH && margin < MAX_MARGIN;
        let unit = (1 << SLOPE_BITS) as f32;
        let slope = [su, sv].map(|slope| (slope * unit) as i32);
        let at = |x: f32, slope: i32| {
            let middle = (GRID_MIDDLE << SLOPE_BITS) - (1 << (SHADOW_SHIFT - 1)) - (slope << 15);
            ((x * unit) as i32).wrapping_add(middle)
        };
        GridLine {
            at: [at(x, slope[0]), at(y, slope[1])],
            slope,
            margin: if fits { margin as i32 + 1 } else { 0 },
        }
    }

    #[inline(always)]
    fn shadow(&self, [u, v, w]: [i32; 3]) -> IntShadow {
        let along = |x: i32, slope: i32, at: i32| {
            (x << SLOPE_BITS).wrapping_sub(slope.wrapping_mul(w)).wrapping_sub(at) >> SHADOW_SHIFT
        };
        [along(u, self.slope[0], self.at[0]), along(v, self.slope[1], self.at[1])]
    }

    /// Triangles of a leaf that are not proved clear of the line, a bit for each. `centres` and
    /// `vertices` are those of the leaf, in the order of the ray's axes.
    #[inline(never)]
    pub fn near(
        &self,
        centres: [[i32; 3]; 2],
        vertices: impl Iterator<Item = [i32; 3]>,
        shape: LeafShape,
    ) -> u32 {
        if self.margin == 0 {
            return !(u32::MAX << lesser(shape.triangles(), WIDTH));
        }
        let [first, second] = centres;
        let centres = [self.shadow(first), self.shadow(second)];
        ray_leaf(self, shape.turn(), centres, vertices.map(|vertex| self.shadow(vertex)))
    }
}

impl ShadowPlane for GridLine {
    type Shadow = IntShadow;

    #[inline(always)]
    fn clear_sides(&self, from: IntShadow, to: IntShadow) -> [i32; 2] {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let area = from[0] * to[1] - from[1] * to[0];
        // At least the 1-norm: `x ^ x >> 31` is |x| or |x| − 1.
        let margin = self.margin * ((x ^ x >> 31) + (y ^ y >> 31) + 2);
        [margin - area, margin + area]
    }
}

#[cfg(all(test, meshsweep_wide))]
mod tests {
    use super::*;
    use crate::bvh::tree::node::tests::Noise;
    use glam::Vec3;

    /// Coordinates of nine ring vertices and two centres, in stored numbers.
    fn random_leaf(noise: &mut Noise) -> [[u16; 3]; WIDTH + 3] {
        let size = 1 << (4 + noise.below(12));
        let corner = [(); 3].map(|()| noise.below((1 << 16) - size));
        core::array::from_fn(|_| {
            core::array::from_fn(|axis| (corner[axis] + noise.below(size)) as u16)
        })
    }

    #[test]
    fn no_triangle_that_is_passed_over_would_be_kept() {
        let mut noise = Noise(5);
        let (mut passed, mut near) = (0, 0);
        for _ in 0..100_000 {
            let origin = [-70_000, 5, 1 << 20];
            let vertices = random_leaf(&mut noise);
            let place = |vertex: [u16; 3]| {
                Vec3::from_array(core::array::from_fn(|k| {
                    (origin[k] + i32::from(vertex[k])) as f32
                }))
            };
            // From near one vertex to near another, and on.
            let target = |noise: &mut Noise| {
                let vertex = place(vertices[noise.below(11) as usize]);
                let away = [0.5, 30.0, 3000.0][noise.below(3) as usize];
                vertex + Vec3::from_array(noise.vector(away))
            };
            let (a, b) = (target(&mut noise), target(&mut noise));
            let offset = (b - a) * [1.0, 3.0, 20.0][noise.below(3) as usize];
            if offset.abs().max_element() < 1.0 {
                continue;
            }
            let from = b - offset;
            let inverse = offset.to_array().map(|d| 1.0 / if d == 0.0 { 1e-20 } else { d });
            let surface = [0.0, 0.9, 50.0][noise.below(3) as usize];
            let size = vertices.iter().fold(0f32, |size, &vertex| {
                let offset = (place(vertex) - from).abs();
                size.max(offset.x + offset.y + offset.z)
            });
            let ray =
                FanRay::new(from.to_array(), offset.to_array(), inverse, 1.0, surface, size + 2e5);
            let line = GridLine::new(&ray, origin);
            let ordered = vertices.map(|vertex| ray.in_order(vertex));
            let [first, second, ring @ ..] = ordered.map(|vertex| vertex.map(i32::from));
            let turn = noise.below(8) as usize;
            let shape = LeafShape::new(WIDTH, turn, false);
            let kept = line.near([first, second], ring.into_iter(), shape);
            let shadow = |i: usize| ray.shadow(place(vertices[i]));
            for lane in 0..WIDTH {
                if kept >> lane & 1 != 0 {
                    near += 1;
                    continue;
                }
                passed += 1;
                let (centre, ends) = (
                    shadow(usize::from(lane >= shape.turn())),
                    [shadow(lane + 2), shadow(lane + 3)],
                );
                let flagged = ray_leaf(&ray, WIDTH, [centre; 2], ends.into_iter()) != 0;
                let crossing = ray.crossing([centre, ends[0], ends[1]], 0.0);
                assert!(!(flagged && crossing.is_some()), "{ray:?}, {vertices:?}, {lane}");
            }
        }
        assert!(passed > 100_000 && near > 10_000, "{passed} {near}");
    }
}
