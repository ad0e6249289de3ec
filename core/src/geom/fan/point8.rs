//! Point and leaf, as many triangles at once as a register has lanes.
//!
//! Every branch of the scalar kernel is taken and selected, in the order that gives the same
//! result. Products and sums are written in the same order. So the bits are the same, and a test
//! checks it.

use super::lanes::Lanes;
use crate::num::tolerance::LEAST_DENOMINATOR;

/// Triangles of a leaf as seen from a point, one in each lane. `[axis]`.
#[derive(Clone, Copy, Debug)]
pub struct Edges {
    /// From the triangle's own centre to ring vertex `i`.
    pub e: [Lanes; 3],
    /// From the centre to ring vertex `i + 1`.
    pub g: [Lanes; 3],
    /// The point less the centre.
    pub s: [Lanes; 3],
}

impl Edges {
    /// Triangles that are points where the query is.
    pub const NONE: Edges = Edges { e: [Lanes::ZERO; 3], g: [Lanes::ZERO; 3], s: [Lanes::ZERO; 3] };
}

/// [`Nearness`](super::Nearness) of each lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneNearness {
    /// Squared lengths of the residuals.
    pub distance_sq: Lanes,
    /// Supporting planes' bounds.
    pub lower_bound_sq: Lanes,
    /// Coordinates along the first spokes.
    pub v: Lanes,
    /// Coordinates along the second spokes.
    pub w: Lanes,
}

impl LaneNearness {
    /// No triangle.
    pub const NONE: LaneNearness = LaneNearness {
        distance_sq: UNUSED,
        lower_bound_sq: UNUSED,
        v: Lanes::ZERO,
        w: Lanes::ZERO,
    };
}

/// 2^127.
const UNUSED: Lanes = Lanes::splat(f32::from_bits(0x7F00_0000));

/// The triangles of lanes whose bits in `used` are ones. Other lanes give 2^127. `None` if all
/// triangles lie beyond the squared limit, by the supporting planes of
/// [`PointFan::is_beyond`](super::PointFan::is_beyond).
#[inline(always)]
pub fn point_lanes(edges: &Edges, used: Lanes, limit: Option<f32>) -> Option<LaneNearness> {
    let ([ex, ey, ez], [gx, gy, gz], [sx, sy, sz]) = (edges.e, edges.g, edges.s);
    let (zero, one) = (Lanes::ZERO, Lanes::ONE);
    let d1 = ex * sx + ey * sy + ez * sz;
    let d2 = gx * sx + gy * sy + gz * sz;
    if let Some(limit) = limit {
        let centre_sq = sx * sx + sy * sy + sz * sz;
        let least = centre_sq - d2.fast_max(d1.fast_max(zero));
        let is_near =
            least.simd_le(zero) | (least * least).simd_le(centre_sq * Lanes::splat(limit));
        if !(is_near & used).any() {
            return None;
        }
    }
    let aa = ex * ex + ey * ey + ez * ez;
    let bb = ex * gx + ey * gy + ez * gz;
    let cc = gx * gx + gy * gy + gz * gz;
    let (d3, d4, d5, d6) = (d1 - aa, d2 - bb, d1 - bb, d2 - cc);
    let vc = d1 * d4 - d3 * d2;
    let vb = d5 * d2 - d1 * d6;
    let va = d3 * d6 - d5 * d4;
    let (e, g) = (d4 - d3, d5 - d6);
    let (pa, pb, pc) = (va.fast_max(zero), vb.fast_max(zero), vc.fast_max(zero));
    let rim = va.simd_le(zero) & e.simd_ge(zero) & g.simd_ge(zero);
    let second = vb.simd_le(zero) & d2.simd_ge(zero) & d6.simd_le(zero);
    let first = vc.simd_le(zero) & d1.simd_ge(zero) & d3.simd_le(zero);
    let end = d6.simd_ge(zero) & d5.simd_le(d6);
    let start = d3.simd_ge(zero) & d4.simd_le(d3);
    let centre = d1.simd_le(zero) & d2.simd_le(zero);
    let v = first.select(d1, !second & rim.select(g, pb));
    let w = !first & second.select(d2, rim.select(e, pc));
    let den = first.select(aa, second.select(cc, rim.select(e + g, pa + pb + pc)));
    let den = den.fast_max(Lanes::splat(LEAST_DENOMINATOR));
    // Corners: 0 and 1 in place of the weights, 1 in place of the denominator.
    let (ring, corner) = (end | start, end | start | centre);
    let inverse = one / ((!ring & den) | (ring & one));
    let v = ((!corner & v) | (!centre & (start & one))) * inverse;
    let w = ((!corner & w) | (!(start | centre) & (end & one))) * inverse;
    let rx = sx - v * ex - w * gx;
    let ry = sy - v * ey - w * gy;
    let rz = sz - v * ez - w * gz;
    let r2 = rx * rx + ry * ry + rz * rz;
    let ra = rx * ex + ry * ey + rz * ez;
    let rb = rx * gx + ry * gy + rz * gz;
    let support = rb.fast_max(ra.fast_max(zero));
    let slack = support - (v * ra + w * rb);
    let certified = r2 - (slack + slack);
    Some(LaneNearness {
        distance_sq: used.select(r2, UNUSED),
        lower_bound_sq: used.select(certified, UNUSED),
        v,
        w,
    })
}
