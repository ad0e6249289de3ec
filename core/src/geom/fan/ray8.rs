//! Segment and leaf, eight triangles at once: loops over `[f32; 8]` that the compiler turns into
//! vector instructions.
//!
//! It flags the triangles that the line may meet, with the arithmetic and the bits of the scalar
//! kernel; a test checks it. Few are flagged, so the decision about them is scalar.

use super::lanes::WIDTH;
use super::ray::FanRay;
use crate::num::tolerance::PRODUCT_UNDERFLOW;

/// Ring vertices of the triangles of a leaf, grid units, in the order of [`FanRay::axes`].
/// `[axis][lane]`.
#[derive(Clone, Copy, Debug)]
pub struct Ring8 {
    /// Ring vertex `i` of triangle `i`.
    pub here: [[f32; WIDTH]; 3],
    /// Ring vertex `i + 1`.
    pub next: [[f32; WIDTH]; 3],
    /// Both centres, alike if there is one fan.
    pub centres: [[f32; 3]; 2],
}

#[inline(always)]
fn blend(mask: u32, first: f32, second: f32) -> f32 {
    f32::from_bits(first.to_bits() & mask | second.to_bits() & !mask)
}

/// Triangles of a leaf that the segment's line may meet, as [`ray_leaf`](super::ray_leaf) says.
/// `first` has ones in the lanes of the first fan, `used` in those of triangles.
#[inline(always)]
pub fn ray_leaf8(ray: &FanRay, ring: &Ring8, first: &[u32; WIDTH], used: &[u32; WIDTH]) -> u32 {
    let [ox, oy, oz] = ray.origin();
    let [sx, sy] = ray.shear();
    let doubt = ray.doubt();
    let [c, d] = ring.centres.map(|[x, y, z]| {
        let (x, y, z) = (x - ox, y - oy, z - oz);
        [x - sx * z, y - sy * z]
    });
    let [hx, hy, hz] = &ring.here;
    let [nx, ny, nz] = &ring.next;
    let mut lanes = 0u32;
    for i in 0..WIDTH {
        let (cx, cy) = (blend(first[i], c[0], d[0]), blend(first[i], c[1], d[1]));
        let z = hz[i] - oz;
        let (ax, ay) = ((hx[i] - ox) - sx * z, (hy[i] - oy) - sy * z);
        let z = nz[i] - oz;
        let (bx, by) = ((nx[i] - ox) - sx * z, (ny[i] - oy) - sy * z);
        let (ex, ey) = (ax - cx, ay - cy);
        let a = cx * ey - cy * ex;
        let a_doubt = doubt * (ex.abs() + ey.abs()) + PRODUCT_UNDERFLOW;
        let (ex, ey) = (bx - cx, by - cy);
        let b = cx * ey - cy * ex;
        let b_doubt = doubt * (ex.abs() + ey.abs()) + PRODUCT_UNDERFLOW;
        let (ex, ey) = (bx - ax, by - ay);
        let rim = ax * ey - ay * ex;
        let rim_doubt = doubt * (ex.abs() + ey.abs()) + PRODUCT_UNDERFLOW;
        let positive = (a >= -a_doubt) & (b <= b_doubt) & (rim >= -rim_doubt);
        let negative = (a <= a_doubt) & (b >= -b_doubt) & (rim <= rim_doubt);
        let met = if positive | negative { 1u32 << i } else { 0 };
        lanes |= met & used[i];
    }
    lanes
}
