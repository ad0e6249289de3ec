//! The kernels of leaves in the registers that the crate is compiled for.

use super::lanes::Lanes;
use super::point8::{Edges, LaneNearness, UNUSED_SQ, define_point_lanes};
use super::ray::FanRay;
use super::ray8::{RingLanes, ShadowLanes, define_ray_lanes};
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
