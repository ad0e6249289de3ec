//! Segment and leaf, a register of triangles at once.
//!
//! It flags the triangles that the line may meet, with the arithmetic and the bits of the scalar
//! kernel; a test checks it. Few are flagged, so the decision about them is scalar.

use super::lanes::{LANES, Lanes, WIDTH, lanes_below};
use super::ray::FanRay;
use crate::num::tolerance::PRODUCT_UNDERFLOW;

/// Corners of the triangles of a leaf, grid units, in the order of [`FanRay::axes`]:
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

/// The ring of the triangles in a register's lanes.
#[derive(Clone, Copy, Debug)]
pub struct RingLanes {
    /// Ring vertex `i` of triangle `i`.
    pub here: [Lanes; 3],
    /// Ring vertex `i + 1`.
    pub next: [Lanes; 3],
}

/// A vertex in the shadow plane.
type Shadow = [Lanes; 2];

/// Both centres of a leaf in the shadow plane, in all lanes.
#[derive(Clone, Copy, Debug)]
pub struct CentreShadows([Shadow; 2]);

impl CentreShadows {
    /// `centres` in the order of [`FanRay::axes`].
    #[inline(always)]
    pub fn new(ray: &FanRay, centres: [[f32; 3]; 2]) -> Self {
        let ([ox, oy, oz], [sx, sy]) = (ray.origin(), ray.shear());
        let shadow = |[x, y, z]: [f32; 3]| {
            let z = z - oz;
            [Lanes::splat((x - ox) - sx * z), Lanes::splat((y - oy) - sy * z)]
        };
        CentreShadows([shadow(centres[0]), shadow(centres[1])])
    }
}

/// Triangles that the segment's line may meet, as [`ray_leaf`](super::ray_leaf) says: a bit for
/// each lane. `first` has ones in the lanes of the first fan.
#[inline(always)]
pub fn ray_lanes(ray: &FanRay, ring: &RingLanes, centres: &CentreShadows, first: Lanes) -> u32 {
    let [ox, oy, oz] = ray.origin().map(Lanes::splat);
    let [sx, sy] = ray.shear().map(Lanes::splat);
    let doubt = Lanes::splat(ray.doubt());
    let underflow = Lanes::splat(PRODUCT_UNDERFLOW);
    let shadow = |[x, y, z]: [Lanes; 3]| -> Shadow {
        let z = z - oz;
        [(x - ox) - sx * z, (y - oy) - sy * z]
    };
    let side = |from: Shadow, to: Shadow| {
        let [ex, ey] = [to[0] - from[0], to[1] - from[1]];
        (from[0] * ey - from[1] * ex, doubt * (ex.abs() + ey.abs()) + underflow)
    };
    let CentreShadows([c, d]) = centres;
    let centre = [first.select(c[0], d[0]), first.select(c[1], d[1])];
    let (here, next) = (shadow(ring.here), shadow(ring.next));
    let (a, a_doubt) = side(centre, here);
    let (b, b_doubt) = side(centre, next);
    let (rim, rim_doubt) = side(here, next);
    let positive = a.simd_ge(-a_doubt) & b.simd_le(b_doubt) & rim.simd_ge(-rim_doubt);
    let negative = a.simd_le(a_doubt) & b.simd_ge(-b_doubt) & rim.simd_le(rim_doubt);
    (positive | negative).to_bitmask()
}

/// The same for a leaf of `count` triangles, the second fan of which begins with triangle `turn`.
/// The other lanes may be any numbers.
#[inline(always)]
pub fn ray_leaf8(ray: &FanRay, ring: &Ring8, turn: usize, count: usize) -> Option<u32> {
    let first = lanes_below(turn)?;
    let centres = CentreShadows::new(ray, ring.centres);
    let mut lanes = 0;
    for (piece, first) in first.into_iter().enumerate() {
        let row = |row: &[f32; WIDTH]| {
            Some(Lanes::new(*row.get(LANES * piece..)?.first_chunk::<LANES>()?))
        };
        let rows = |[x, y, z]: &[[f32; WIDTH]; 3]| Some([row(x)?, row(y)?, row(z)?]);
        let ring = RingLanes { here: rows(&ring.here)?, next: rows(&ring.next)? };
        lanes |= ray_lanes(ray, &ring, &centres, first) << (LANES * piece);
    }
    Some(lanes & !(u32::MAX << count))
}
