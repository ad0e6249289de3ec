//! Integer pretest: most triangles of a leaf are far from a segment's line, and few products prove
//! it. For targets without floating point.
//!
//! The *shadow* of a vertex (u, v, w), w along the line's dominant axis, is
//! (u − at_u − slope_u·w, v − at_v − slope_v·w). The line's own shadow is the origin.
//!
//! For an edge with the shadow (x, y) at its start and the vector (du, dv, dw):
//!
//! ```text
//! area = −y·du + x·dv + (y·slope_u − x·slope_v)·dw
//! ```
//!
//! The line misses a triangle if it is certainly left of one edge and right of another.
//!
//! The tests decide "clear" and nothing else. All other triangles go to the kernel in f32, whose
//! answer alone counts. So every bit is the same with and without these tests. Margins:
//! `core/docs/rounding.md` §9.

use crate::bvh::format::GridRing;
use crate::geom::fan::FanRay;

/// Fraction bits of a slope, and of a shadow before it is rounded. With lengths below 2^16 it fits
/// 32 bits.
const SLOPE_BITS: u32 = 14;
/// Bits of a shadow that are rounded away: its unit is then 16 grid units.
const SHADOW_SHIFT: u32 = SLOPE_BITS + 4;
/// Greatest rounded shadow. Its products with differences of grid points fit 32 bits.
const MAX_SHADOW: u32 = 1 << 12;
/// The middle of the stored numbers.
const GRID_MIDDLE: i32 = 1 << 15;
/// Lengths must be below this, grid units. A shadow that leaves 32 bits all the same wraps around
/// to one that is still above [`MAX_SHADOW`].
const MAX_LENGTH: f32 = (1 << 16) as f32;

/// The line of a [`FanRay`] in stored numbers. Coordinates come in the order of the ray's axes.
#[derive(Clone, Copy, Debug)]
pub struct GridLine {
    /// Where the line is at the stored number 0 of the dominant axis. All sums wrap around.
    at: [i32; 2],
    /// Grid units along the other axes for each grid unit along the dominant one, with
    /// [`SLOPE_BITS`].
    slope: [i32; 2],
    /// An edge farther than this from the line is clear of it. In units of 16 grid units. 0 if the
    /// numbers do not fit: then every triangle counts as near.
    margin: i32,
}

/// The coefficients of `area` for all edges that start at one vertex.
struct EdgeFunction {
    from: [i32; 3],
    weights: [i32; 3],
    margin: i32,
}

impl GridLine {
    /// Nothing is clear of it.
    pub const NONE: GridLine = GridLine { at: [0; 2], slope: [0; 2], margin: 0 };

    /// The line of `ray`.
    pub fn new(ray: &FanRay, grid_origin: [i32; 3]) -> Self {
        let middle = grid_origin.map(|origin| origin.wrapping_add(GRID_MIDDLE) as f32);
        let [mu, mv, mw] = ray.in_order(middle);
        let [ou, ov, ow] = ray.origin();
        let [su, sv] = ray.shear();
        let (x, y) = ((ou - mu) + su * (mw - ow), (ov - mv) + sv * (mw - ow));
        let margin = 1.5 * ray.doubt() + 3.0;
        let fits = x.abs() < MAX_LENGTH && y.abs() < MAX_LENGTH && margin < 1024.0;
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
    fn edge_function(&self, from: [i32; 3]) -> Option<EdgeFunction> {
        let [u, v, w] = from;
        let [(at_x, slope_x), (at_y, slope_y)] =
            [(self.at[0], self.slope[0]), (self.at[1], self.slope[1])];
        let x = (u << SLOPE_BITS).wrapping_sub(slope_x.wrapping_mul(w)).wrapping_sub(at_x)
            >> SHADOW_SHIFT;
        let y = (v << SLOPE_BITS).wrapping_sub(slope_y.wrapping_mul(w)).wrapping_sub(at_y)
            >> SHADOW_SHIFT;
        if self.margin == 0 || x.unsigned_abs() > MAX_SHADOW || y.unsigned_abs() > MAX_SHADOW {
            return None;
        }
        let along = (y * slope_x - x * slope_y + (1 << (SLOPE_BITS - 1))) >> SLOPE_BITS;
        Some(EdgeFunction { from, weights: [-y, x, along], margin: self.margin })
    }

    /// Triangles of a leaf that are not proved clear of the line, a bit for each. The second fan
    /// begins with triangle `turn`.
    #[inline(never)]
    pub fn near(&self, ring: &GridRing<'_>, turn: usize) -> u32 {
        let [first, second] = ring.centres;
        let end = ring.x.len();
        let turn = turn.min(end.saturating_sub(1));
        let near = self.fan(ring, first, 0, turn + 1);
        if turn + 1 < end { near | self.fan(ring, second, turn, end) << turn } else { near }
    }

    /// The same for the fan of the vertices `begin..end`.
    #[inline(never)]
    fn fan(&self, ring: &GridRing<'_>, centre: [i32; 3], begin: usize, end: usize) -> u32 {
        let (Some(x), Some(y), Some(z)) =
            (ring.x.get(begin..end), ring.y.get(begin..end), ring.z.get(begin..end))
        else {
            return 0;
        };
        let Some(edge_function) = self.edge_function(centre) else {
            return (1 << (x.len() - 1)) - 1;
        };
        let short = |pair: &[u8; 2]| i32::from(u16::from_le_bytes(*pair));
        let (mut near, mut lane) = (0u32, 1u32);
        // The first vertex ends no triangle, so the spoke before it counts as clear on both sides.
        let (mut vertex, mut last) = ([0; 3], [-1; 2]);
        for ((x, y), z) in x.iter().zip(y).zip(z) {
            let from = vertex;
            vertex = [short(x), short(y), short(z)];
            let spoke = edge_function.edge(vertex);
            // The last edge runs back to the centre: the spoke's, with the opposite sign.
            // Sign bits: `left` is set if the line is clear of some edge on the left, `right`
            // likewise. Both set: the triangle is missed.
            let (left, right) = (last[0] | spoke[1], last[1] | spoke[0]);
            if left & right >= 0 {
                let rim = self.rim(from, vertex);
                if (left | rim[0]) & (right | rim[1]) >= 0 {
                    near |= lane;
                }
            }
            last = spoke;
            lane <<= 1;
        }
        near >> 1
    }

    #[inline(never)]
    fn rim(&self, from: [i32; 3], to: [i32; 3]) -> [i32; 2] {
        self.edge_function(from).map_or([0; 2], |edge_function| edge_function.edge(to))
    }
}

impl EdgeFunction {
    /// The edge to a vertex, by two signs: the first is negative if the line is clear of the edge
    /// on the left, the second if it is clear on the right.
    #[inline(always)]
    fn edge(&self, to: [i32; 3]) -> [i32; 2] {
        let [u, v, w] = self.from;
        let [x, y, z] = [to[0] - u, to[1] - v, to[2] - w];
        let [p, q, r] = self.weights;
        let area = p * x + q * y + r * z;
        // At least the 1-norm: `x ^ x >> 31` is |x| or |x| − 1.
        let length = (x ^ x >> 31) + (y ^ y >> 31) + (z ^ z >> 31) + 3;
        let margin = self.margin * length;
        [margin - area, margin + area]
    }
}
