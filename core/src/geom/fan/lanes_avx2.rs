//! The kernels of leaves in registers of 256 bits, whatever the crate is compiled for.

use super::point8::{Edges, LaneNearness, UNUSED_SQ, define_point_lanes};
use super::ray::FanRay;
use super::ray8::{RingLanes, ShadowLanes, define_ray_lanes};
use crate::num::lesser;
use crate::num::tolerance::{LEAST_DENOMINATOR, PRODUCT_UNDERFLOW};
use core::arch::x86_64::{
    __m256, _CMP_GE_OQ, _CMP_LE_OQ, _mm_cvtss_f32, _mm_min_ps, _mm_shuffle_ps,
    _mm256_add_ps as add, _mm256_and_ps as and, _mm256_andnot_ps as and_not, _mm256_blendv_ps,
    _mm256_castps256_ps128, _mm256_cmp_ps, _mm256_div_ps as div, _mm256_extractf128_ps,
    _mm256_max_ps as max, _mm256_movemask_ps, _mm256_mul_ps as mul, _mm256_or_ps as or,
    _mm256_set1_ps as splat, _mm256_sub_ps as sub, _mm256_xor_ps,
};

define_point_lanes!(
    #[target_feature(enable = "avx2")]
    #[inline]
    __m256, pub(crate)
);

define_ray_lanes!(
    #[target_feature(enable = "avx2")]
    #[inline]
    __m256, pub(crate)
);

impl LaneNearness<__m256> {
    /// No triangle.
    #[target_feature(enable = "avx2")]
    #[inline]
    pub(crate) fn none_avx2() -> Self {
        let (unused, zero) = (splat(UNUSED_SQ), splat(0.0));
        LaneNearness { distance_sq: unused, lower_bound_sq: unused, v: zero, w: zero }
    }
}

#[target_feature(enable = "avx2")]
#[inline]
fn neg(a: __m256) -> __m256 {
    _mm256_xor_ps(a, splat(-0.0))
}

#[target_feature(enable = "avx2")]
#[inline]
fn abs(a: __m256) -> __m256 {
    and_not(splat(-0.0), a)
}

#[target_feature(enable = "avx2")]
#[inline]
fn le(a: __m256, b: __m256) -> __m256 {
    _mm256_cmp_ps::<_CMP_LE_OQ>(a, b)
}

#[target_feature(enable = "avx2")]
#[inline]
fn ge(a: __m256, b: __m256) -> __m256 {
    _mm256_cmp_ps::<_CMP_GE_OQ>(a, b)
}

#[target_feature(enable = "avx2")]
#[inline]
fn select(mask: __m256, if_ones: __m256, if_zeros: __m256) -> __m256 {
    _mm256_blendv_ps(if_zeros, if_ones, mask)
}

#[target_feature(enable = "avx2")]
#[inline]
fn any(mask: __m256) -> bool {
    bits(mask) != 0
}

/// A bit for each lane.
#[target_feature(enable = "avx2")]
#[inline]
fn bits(mask: __m256) -> u32 {
    _mm256_movemask_ps(mask).cast_unsigned()
}

/// A bit for each lane that is not above `limit`.
#[target_feature(enable = "avx2")]
#[inline]
pub(crate) fn up_to(numbers: __m256, limit: f32) -> u32 {
    bits(le(numbers, splat(limit)))
}

/// The least of eight numbers, in the order of [`least`](super::lanes::least).
#[target_feature(enable = "avx2")]
#[inline]
pub(crate) fn least(numbers: __m256) -> f32 {
    let (low, high) = (_mm256_castps256_ps128(numbers), _mm256_extractf128_ps::<1>(numbers));
    let four = _mm_min_ps(low, high);
    let two = _mm_min_ps(four, _mm_shuffle_ps::<0b11_10_11_10>(four, four));
    lesser(_mm_cvtss_f32(two), _mm_cvtss_f32(_mm_shuffle_ps::<0b01_01_01_01>(two, two)))
}
