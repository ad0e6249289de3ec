//! Point and leaf, eight triangles at once: loops over `[f32; 8]` that the compiler turns into
//! vector instructions.
//!
//! Every branch of the scalar kernel is taken and selected, in the order that gives the same
//! result. Products and sums are written in the same order. So the bits are the same, and a test
//! checks it.

use super::lanes::WIDTH;
use crate::num::greater;
use crate::num::tolerance::LEAST_DENOMINATOR;

/// Spokes of the triangles of a leaf: `e` to ring vertex `i`, `g` to ring vertex `i + 1`, each from
/// the triangle's own centre. `[axis][lane]`.
#[derive(Clone, Copy, Debug)]
pub struct Edges8 {
    /// First spoke.
    pub e: [[f32; WIDTH]; 3],
    /// Second spoke.
    pub g: [[f32; WIDTH]; 3],
    /// The point less the centre.
    pub s: [[f32; WIDTH]; 3],
}

/// [`Nearness`](super::Nearness) of each lane.
#[derive(Clone, Copy, Debug)]
pub struct Nearness8 {
    /// Squared lengths of the residuals.
    pub distance_sq: [f32; WIDTH],
    /// Supporting planes' bounds.
    pub lower_bound_sq: [f32; WIDTH],
    /// Coordinates along the first spokes.
    pub v: [f32; WIDTH],
    /// Coordinates along the second spokes.
    pub w: [f32; WIDTH],
}

/// Bits of 2^127.
const UNUSED: u32 = 0x7F00_0000;

/// All triangles of a leaf. Lanes that `used` leaves out give 2^127.
#[inline(always)]
pub fn point_leaf8(edges: &Edges8, used: &[u32; WIDTH]) -> Nearness8 {
    let mut distance_sq = [0f32; WIDTH];
    let mut lower_bound_sq = [0f32; WIDTH];
    let (mut along_e, mut along_g) = ([0f32; WIDTH], [0f32; WIDTH]);
    let [ex, ey, ez] = &edges.e;
    let [gx, gy, gz] = &edges.g;
    let [sx, sy, sz] = &edges.s;
    for i in 0..WIDTH {
        let (ex, ey, ez) = (ex[i], ey[i], ez[i]);
        let (gx, gy, gz) = (gx[i], gy[i], gz[i]);
        let (sx, sy, sz) = (sx[i], sy[i], sz[i]);
        let d1 = ex * sx + ey * sy + ez * sz;
        let d2 = gx * sx + gy * sy + gz * sz;
        let aa = ex * ex + ey * ey + ez * ez;
        let bb = ex * gx + ey * gy + ez * gz;
        let cc = gx * gx + gy * gy + gz * gz;
        let (d3, d4, d5, d6) = (d1 - aa, d2 - bb, d1 - bb, d2 - cc);
        let vc = d1 * d4 - d3 * d2;
        let vb = d5 * d2 - d1 * d6;
        let va = d3 * d6 - d5 * d4;
        let (e, g) = (d4 - d3, d5 - d6);
        let pa = if va > 0.0 { va } else { 0.0 };
        let pb = if vb > 0.0 { vb } else { 0.0 };
        let pc = if vc > 0.0 { vc } else { 0.0 };
        let sum = pa + pb + pc;
        let rim = (va <= 0.0) & (e >= 0.0) & (g >= 0.0);
        let mut nv = if rim { g } else { pb };
        let mut nw = if rim { e } else { pc };
        let mut den = if rim { e + g } else { sum };
        let second = (vb <= 0.0) & (d2 >= 0.0) & (d6 <= 0.0);
        nv = if second { 0.0 } else { nv };
        nw = if second { d2 } else { nw };
        den = if second { cc } else { den };
        let first = (vc <= 0.0) & (d1 >= 0.0) & (d3 <= 0.0);
        nv = if first { d1 } else { nv };
        nw = if first { 0.0 } else { nw };
        den = if first { aa } else { den };
        den = if den > LEAST_DENOMINATOR { den } else { LEAST_DENOMINATOR };
        let end = (d6 >= 0.0) & (d5 <= d6);
        nv = if end { 0.0 } else { nv };
        nw = if end { 1.0 } else { nw };
        den = if end { 1.0 } else { den };
        let start = (d3 >= 0.0) & (d4 <= d3);
        nv = if start { 1.0 } else { nv };
        nw = if start { 0.0 } else { nw };
        den = if start { 1.0 } else { den };
        let centre = (d1 <= 0.0) & (d2 <= 0.0);
        nv = if centre { 0.0 } else { nv };
        nw = if centre { 0.0 } else { nw };

        let inverse = 1.0 / den;
        let (v, w) = (nv * inverse, nw * inverse);
        let rx = sx - v * ex - w * gx;
        let ry = sy - v * ey - w * gy;
        let rz = sz - v * ez - w * gz;
        let r2 = rx * rx + ry * ry + rz * rz;
        let ra = rx * ex + ry * ey + rz * ez;
        let rb = rx * gx + ry * gy + rz * gz;
        let above = if ra > 0.0 { ra } else { 0.0 };
        let support = greater(above, rb);
        let slack = support - (v * ra + w * rb);
        (along_e[i], along_g[i]) = (v, w);
        // Bits again: an unused lane may hold anything.
        let unused = !used[i] & UNUSED;
        let certified = r2 - (slack + slack);
        distance_sq[i] = f32::from_bits(r2.to_bits() & used[i] | unused);
        lower_bound_sq[i] = f32::from_bits(certified.to_bits() & used[i] | unused);
    }
    // Written to memory side by side. Else the compiler computes values lane by lane that are used
    // lane by lane.
    core::hint::black_box(Nearness8 { distance_sq, lower_bound_sq, v: along_e, w: along_g })
}
