//! Squared distances of a point from eight boxes.
//!
//! The wide form is loops over `[f32; 8]` without branches. The narrow form goes axis by axis and
//! skips an axis on which the point is inside. Both give the same bits.

use super::frame::NodeFrame;
use super::keys::{CHILD_MASK, NO_CHILD, WIDE, in_memory};
use crate::bvh::format::layout::FRAME_BYTES;
use crate::geom::fan::WIDTH;
use crate::num::greater;

/// Keys of a node's children: squared distances from the point, grid units. No key is below the
/// parent's, and the low three bits hold the number of the child. Keys from `count` on are
/// [`NO_CHILD`].
///
/// The distance is a lower bound up to the rounding of `core/docs/rounding.md` §8.
#[inline(always)]
pub fn box_distances(
    record: &[u8; FRAME_BYTES],
    frame: &NodeFrame,
    count: u32,
    parent: f32,
) -> [f32; WIDTH] {
    if WIDE {
        return wide(record, frame, count, parent);
    }
    narrow(record, frame, count, parent)
}

/// The key of one child.
#[inline(always)]
fn key(distance_sq: f32, parent: f32, count: u32, child: u32) -> f32 {
    let far = greater(parent, distance_sq);
    let far = if child < count { far } else { NO_CHILD };
    f32::from_bits(far.to_bits() & !CHILD_MASK | child)
}

#[inline(always)]
pub(crate) fn wide(
    record: &[u8; FRAME_BYTES],
    frame: &NodeFrame,
    count: u32,
    parent: f32,
) -> [f32; WIDTH] {
    let mut keys = [0f32; WIDTH];
    let (rows, _) = record.as_chunks::<WIDTH>();
    let Some([lx, hx, ly, hy, lz, hz]) = rows.first_chunk::<6>() else { return keys };
    let [qx, qy, qz] = frame.q;
    let [wx, wy, wz] = frame.weight;
    for i in 0..WIDTH {
        let x = outside(lx[i], hx[i], qx, wx);
        let y = outside(ly[i], hy[i], qy, wy);
        let z = outside(lz[i], hz[i], qz, wz);
        keys[i] = key(x + y + z, parent, count, i as u32);
    }
    in_memory(keys)
}

/// Squared distance along one axis.
#[inline(always)]
fn outside(low: u8, high: u8, q: f32, weight: f32) -> f32 {
    let below = f32::from(low) - q;
    let beyond = q - f32::from(high);
    let far = greater(beyond, below);
    let far = if far > 0.0 { far } else { 0.0 };
    // This order keeps every product within f32's range. A flat node's steps are tiny, so a far
    // point is very many steps away.
    far * (far * weight)
}

#[inline(always)]
pub(crate) fn narrow(
    record: &[u8; FRAME_BYTES],
    frame: &NodeFrame,
    count: u32,
    parent: f32,
) -> [f32; WIDTH] {
    let mut keys = [NO_CHILD; WIDTH];
    let (rows, _) = record.as_chunks::<WIDTH>();
    let Some([lx, hx, ly, hy, lz, hz]) = rows.first_chunk::<6>() else { return keys };
    let [qx, qy, qz] = frame.q;
    let [wx, wy, wz] = frame.weight;
    let count = (count as usize).min(WIDTH);
    let mut sum = [0f32; WIDTH];
    add_along(lx, hx, qx, wx, count, &mut sum);
    add_along(ly, hy, qy, wy, count, &mut sum);
    add_along(lz, hz, qz, wz, count, &mut sum);
    // No number here is negative. So bits compare as numbers do, and cost less.
    let parent = parent.to_bits();
    for (child, (key, sum)) in (0u32..).zip(keys.iter_mut().zip(sum)).take(count) {
        let far = sum.to_bits().max(parent);
        *key = f32::from_bits(far & !CHILD_MASK | child);
    }
    keys
}

/// Adds the squared distances along one axis.
#[inline(never)]
fn add_along(
    low: &[u8; WIDTH],
    high: &[u8; WIDTH],
    q: f32,
    weight: f32,
    count: usize,
    sum: &mut [f32; WIDTH],
) {
    let (low, high, sum) = (low.iter().take(count), high.iter().take(count), sum.iter_mut());
    if q <= 0.0 {
        // The point is below all boxes on this axis, so only their low planes count.
        for (sum, &low) in sum.zip(low) {
            let out = f32::from(low) - q;
            *sum += out * (out * weight);
        }
    } else if q >= 255.0 {
        for (sum, &high) in sum.zip(high) {
            let out = q - f32::from(high);
            *sum += out * (out * weight);
        }
    } else {
        let whole = q as i32;
        for ((sum, &low), &high) in sum.zip(low).zip(high) {
            if i32::from(low) > whole {
                let out = f32::from(low) - q;
                *sum += out * (out * weight);
            } else if i32::from(high) <= whole {
                let out = q - f32::from(high);
                *sum += out * (out * weight);
            }
        }
    }
}
