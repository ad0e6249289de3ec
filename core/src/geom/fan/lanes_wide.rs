//! The kernels of leaves in the registers that the crate is compiled for.

use super::lanes::{LANES, Lanes, WIDTH, lanes_below};
use super::point8::{Edges, LaneNearness, UNUSED_SQ, define_point_lanes};
use super::ray::FanRay;
use super::ray8::{CentreShadows, Ring8, RingLanes, ShadowLanes, define_ray_lanes};
use crate::num::tolerance::{LEAST_DENOMINATOR, PRODUCT_UNDERFLOW};

define_point_lanes!(
    #[inline(always)]
    Lanes,
    pub
);

define_ray_lanes!(
    #[inline(always)]
    Lanes,
    pub
);

/// The triangles of a leaf that the line may meet, a bit each, as [`ray_leaf`](super::ray_leaf)
/// finds them. The second fan begins with triangle `turn`. The other lanes may be any numbers.
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
        lanes |= ray_lanes(ray, &ring, centres.of_lanes(first)) << (LANES * piece);
    }
    Some(lanes & !(u32::MAX << count))
}

#[inline(always)]
fn splat(x: f32) -> Lanes {
    Lanes::splat(x)
}

#[inline(always)]
fn add(a: Lanes, b: Lanes) -> Lanes {
    a + b
}

#[inline(always)]
fn sub(a: Lanes, b: Lanes) -> Lanes {
    a - b
}

#[inline(always)]
fn mul(a: Lanes, b: Lanes) -> Lanes {
    a * b
}

#[inline(always)]
fn div(a: Lanes, b: Lanes) -> Lanes {
    a / b
}

#[inline(always)]
fn neg(a: Lanes) -> Lanes {
    -a
}

#[inline(always)]
fn abs(a: Lanes) -> Lanes {
    a.abs()
}

#[inline(always)]
fn max(a: Lanes, b: Lanes) -> Lanes {
    a.fast_max(b)
}

#[inline(always)]
fn le(a: Lanes, b: Lanes) -> Lanes {
    a.simd_le(b)
}

#[inline(always)]
fn ge(a: Lanes, b: Lanes) -> Lanes {
    a.simd_ge(b)
}

#[inline(always)]
fn and(a: Lanes, b: Lanes) -> Lanes {
    a & b
}

#[inline(always)]
fn or(a: Lanes, b: Lanes) -> Lanes {
    a | b
}

/// The lanes of `b` where `mask` has zeros, and zeros elsewhere.
#[inline(always)]
fn and_not(mask: Lanes, b: Lanes) -> Lanes {
    !mask & b
}

#[inline(always)]
fn select(mask: Lanes, if_ones: Lanes, if_zeros: Lanes) -> Lanes {
    mask.select(if_ones, if_zeros)
}

#[inline(always)]
fn any(mask: Lanes) -> bool {
    mask.any()
}

/// A bit for each lane.
#[inline(always)]
fn bits(mask: Lanes) -> u32 {
    mask.to_bitmask()
}
