//! A segment against the model's box. Two thirds of all segments miss it, so a miss has to cost
//! little.
//!
//! [`misses`] alone decides. Boards look first by fewer operations: [`Glance::Clear`] and
//! [`Glance::Meets`] say that [`misses`] would decide so, [`Glance::Unsure`] says nothing. Margins:
//! `core/docs/rounding.md` §9.
//!
//! | file | owns |
//! | --- | --- |
//! | `plain` | a glance in f32, for boards with an FPU |
//! | `integer` | a glance in integers, for boards without |
//! | `wide` | the test in registers, for hosts |

mod integer;
mod plain;
#[cfg(test)]
mod tests;
#[cfg(meshsweep_wide)]
mod wide;

use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::node::WIDE;
use crate::geom::norm_1;
use crate::num::tolerance::BVH_FAR;
#[cfg(any(test, not(meshsweep_wide)))]
use crate::num::tolerance::{LEAST_DENOMINATOR, U32};
use crate::num::{SOFT_FLOAT, greater};
use crate::query::QueryError;
use glam::Vec3;

/// What a look by fewer operations tells of a segment and the model's box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Glance {
    /// They are proved clear of each other.
    Clear,
    /// No axis separates them.
    Meets,
    /// Too near to tell, or out of range.
    Unsure,
}

/// A segment and the model's box, grid units.
#[derive(Clone, Copy, Debug)]
pub(super) struct SegmentAndBox {
    pub(super) a: Vec3,
    pub(super) b: Vec3,
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

impl SegmentAndBox {
    #[inline(always)]
    pub(super) fn new(tree: &Bvh<'_>, [a, b]: [[f32; 3]; 2]) -> Self {
        let units = tree.units();
        let (low, high) = tree.grid_bounds();
        SegmentAndBox { a: units.inward_point(a), b: units.inward_point(b), low, high }
    }

    /// The segment between `ends` (input units), unless it is proved clear of the model's box.
    #[inline(always)]
    pub(super) fn unless_clear(
        tree: &Bvh<'_>,
        ends: [[f32; 3]; 2],
    ) -> Result<Option<SegmentAndBox>, QueryError> {
        let mut glance = Glance::Unsure;
        if SOFT_FLOAT {
            glance = integer::glance(tree, ends);
            if glance == Glance::Clear {
                return Ok(None);
            }
        }
        let both = SegmentAndBox::new(tree, ends);
        let surface_error = tree.units().surface_error;
        if !(SOFT_FLOAT || WIDE) {
            glance = plain::glance(&both, surface_error);
        }
        match glance {
            Glance::Meets => Ok(Some(both)),
            Glance::Clear => Ok(None),
            Glance::Unsure if both.is_clear(ends, surface_error)? => Ok(None),
            Glance::Unsure => Ok(Some(both)),
        }
    }

    /// [`misses`], after the checks of the `ends` (input units).
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), cold, inline(never))]
    fn is_clear(&self, [a, b]: [[f32; 3]; 2], surface_error: f32) -> Result<bool, QueryError> {
        // By bits, without a branch for each number.
        let magnitude = |x: f32| x.to_bits() & !SIGN;
        let largest =
            |[x, y, z]: [f32; 3]| greater(greater(magnitude(x), magnitude(y)), magnitude(z));
        if greater(largest(a), largest(b)) >= f32::INFINITY.to_bits() {
            return Err(QueryError::NotFinite);
        }
        let (size_a, size_b) = (norm_1(self.farthest(self.a)), norm_1(self.farthest(self.b)));
        if !((size_a <= BVH_FAR) & (size_b <= BVH_FAR)) {
            return Err(QueryError::OutOfDomain);
        }
        #[cfg(meshsweep_wide)]
        return Ok(wide::misses(self, surface_error, size_a + size_b));
        #[cfg(not(meshsweep_wide))]
        Ok(self.misses(surface_error, size_a + size_b))
    }

    /// By axis, the way from a place to the farthest corner of the box.
    #[inline(always)]
    pub(super) fn farthest(&self, p: Vec3) -> Vec3 {
        #[cfg(meshsweep_wide)]
        return wide::farthest(p, self.low, self.high);
        #[cfg(not(meshsweep_wide))]
        {
            let (l, h) = ((p - self.low).abs(), (p - self.high).abs());
            if SOFT_FLOAT {
                // By bits, for a comparison of floats is a call.
                let greater = |l: f32, h: f32| f32::from_bits(greater(h.to_bits(), l.to_bits()));
                return Vec3::new(greater(l.x, h.x), greater(l.y, h.y), greater(l.z, h.z));
            }
            Vec3::new(greater(h.x, l.x), greater(h.y, l.y), greater(h.z, l.z))
        }
    }

    /// Whether the segment is proved clear of the box, by their six separating axes, all lengths
    /// doubled (Ericson, *Real-Time Collision Detection*, 2005, 5.3.3). `size`: the distance of
    /// both ends' farthest corners. The margin is in `core/docs/rounding.md` §9.
    #[cfg(any(test, not(meshsweep_wide)))]
    #[inline(always)]
    fn misses(&self, surface_error: f32, size: f32) -> bool {
        let &SegmentAndBox { a, b, low, high } = self;
        let margin = 2.0 * surface_error + size * (32.0 * U32) + LEAST_DENOMINATOR;
        let (d, m) = (b - a, (a - low) + (b - high));
        let (half, d_abs) = ((high - low) + Vec3::splat(margin), d.abs());
        // By bits, for a comparison is a branch that no processor guesses, or a call. No number is
        // negative, so the difference of bits has the right sign.
        let beyond = |x: f32, limit: f32| limit.to_bits().wrapping_sub(x.to_bits());
        let apart = |m: f32, half: f32, d: f32| beyond(m.abs(), half + d);
        let along =
            apart(m.x, half.x, d_abs.x) | apart(m.y, half.y, d_abs.y) | apart(m.z, half.z, d_abs.z);
        if along & SIGN != 0 {
            return true;
        }
        let apart_across = |[m, n]: [f32; 2], [d, e]: [f32; 2], [h, k]: [f32; 2]| {
            beyond((m * e - n * d).abs(), (h * e.abs() + k * d.abs()) + LEAST_DENOMINATOR)
        };
        let (mut across, mut axes) = (0, [m, d, half]);
        for _ in 0..3 {
            let [m, d, half] = axes;
            across |= apart_across([m.x, m.y], [d.x, d.y], [half.x, half.y]);
            let turned = |v: Vec3| Vec3::new(v.y, v.z, v.x);
            axes = [turned(m), turned(d), turned(half)];
        }
        across & SIGN != 0
    }
}

/// The bit of a number's sign.
const SIGN: u32 = 1 << 31;
