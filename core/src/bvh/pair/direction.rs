//! The direction along which pairs are apart.

use crate::bvh::tree::format::FanLeaf;
use crate::num::tolerance::U32;
use crate::num::{dot, greater, sqrt_approx};
use glam::Vec3;

/// A direction in the first grid, towards the second model. Any direction serves, so its own
/// rounding does not matter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direction {
    /// The size of the greatest component is at least 1 and below 2.
    pub(crate) vector: Vec3,
    /// An upper bound of the length of `vector`.
    pub(crate) length: f32,
}

impl Direction {
    /// `None` of a vector that is zero or not finite, or nearly so.
    #[inline(always)]
    pub(crate) fn of(vector: Vec3) -> Option<Direction> {
        let vector = vector * power_for(vector)?;
        Some(Direction { vector, length: sqrt_approx(dot(vector, vector)) * (1.0 + 8.0 * U32) })
    }
}

/// The power of two that brings the size of the greatest component to at least 1 and below 2. It is
/// from 2^-86 to 2^87; `None` beyond.
#[inline(always)]
fn power_for(vector: Vec3) -> Option<f32> {
    // Positive f32 have the order of their bits.
    let size = |x: f32| x.to_bits() & !(1 << 31);
    let [x, y, z] = vector.to_array().map(size);
    let exponent = x.max(y).max(z) >> 23;
    (40..214).contains(&exponent).then(|| f32::from_bits((254 - exponent) << 23))
}

/// A direction in integers of at most 2^30, for vertices of 16 bits. Heights along it are exact
/// sums of integers. No height is below the true one, because components are rounded up and no
/// stored coordinate is negative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IntDirection {
    pub(crate) vector: [i32; 3],
    /// An integer height times this is a height along the direction that was rounded.
    pub(crate) unit: f32,
}

impl IntDirection {
    /// The components are rounded up, not to the nearest: see `core/docs/rounding.md` §26,
    /// *Vertices of leaves along w*. `None` as for [`Direction::of`].
    #[inline(always)]
    pub(crate) fn of(vector: Vec3) -> Option<IntDirection> {
        let (vector, unit) = rounded_up(vector, (1u32 << 29) as f32)?;
        Some(IntDirection { vector, unit })
    }

    /// The greatest `vector · vertex` of a leaf. It is not divided by the length of `vector`.
    #[inline(never)]
    pub(crate) fn top(&self, leaf: &FanLeaf<'_>) -> Option<f32> {
        let ring = leaf.grid_ring()?;
        let [x, y, z] = self.vector.map(i64::from);
        let height = |[p, q, r]: [i32; 3]| i64::from(p) * x + i64::from(q) * y + i64::from(r) * z;
        let [first, second] = ring.centres;
        let mut top = greater(height(first), height(second));
        for ((x, y), z) in ring.x.iter().zip(ring.y).zip(ring.z) {
            let integer = |pair: &[u8; 2]| i32::from(u16::from_le_bytes(*pair));
            top = greater(top, height([integer(x), integer(y), integer(z)]));
        }
        Some(top as f32 * self.unit)
    }
}

/// The same in integers of at most 2^13, so that heights are sums in 32 bits. They are less than 96
/// units of the grid higher: a component is raised by up to 2 of 2^12. Only time depends on that.
pub(super) struct ShortDirection {
    vector: [i32; 3],
    unit: f32,
}

impl ShortDirection {
    /// As [`IntDirection::of`].
    #[inline(always)]
    pub(super) fn of(vector: Vec3) -> Option<ShortDirection> {
        let (vector, unit) = rounded_up(vector, (1u32 << 12) as f32)?;
        Some(ShortDirection { vector, unit })
    }

    /// As [`IntDirection::top`].
    #[inline(never)]
    pub(super) fn top(&self, leaf: &FanLeaf<'_>) -> Option<f32> {
        let ring = leaf.grid_ring()?;
        let [x, y, z] = self.vector;
        let height = |[p, q, r]: [i32; 3]| {
            p.wrapping_mul(x).wrapping_add(q.wrapping_mul(y)).wrapping_add(r.wrapping_mul(z))
        };
        let [first, second] = ring.centres;
        let mut top = greater(height(first), height(second));
        for ((x, y), z) in ring.x.iter().zip(ring.y).zip(ring.z) {
            let integer = |pair: &[u8; 2]| i32::from(u16::from_le_bytes(*pair));
            top = greater(top, height([integer(x), integer(y), integer(z)]));
        }
        Some(top as f32 * self.unit)
    }
}

/// The direction, scaled by a power of two so that the size of its greatest component is from
/// `scale` to twice that, each component rounded up; and the inverse of that power.
#[inline(always)]
fn rounded_up(vector: Vec3, scale: f32) -> Option<([i32; 3], f32)> {
    let power = power_for(vector)?;
    let [x, y, z] = (vector * (power * scale)).to_array();
    // Cut towards 0, and 1 more: above the component, whatever its sign.
    Some(([x as i32 + 1, y as i32 + 1, z as i32 + 1], 1.0 / (power * scale)))
}
