//! The triangles of a leaf in integers, for processors without floating point: bounds of all, and
//! the f32 kernel only for those that may be the nearest.

use super::bounds::{nearness, seen_from};
use super::limit::LeafLimit;
use super::nearest::LeafNearest;
use super::plane::{LeafPlane, Residual};
use super::squares::LeafSquares;
use crate::bvh::point::query::limit_of;
use crate::bvh::tree::format::{FanLeaf, lanes_of};
use crate::geom::fan::{
    Corner, IntBounds, IntLimit, IntLower, IntPoint, IntVector, Nearness, WIDTH, integer_bounds,
    is_certain_corner, less, sharp_lower,
};
use crate::num::{Real, difference, dot, float, lesser};
use glam::Vec3;

/// In integers, but for the triangles that may be the nearest: the likeliest first, then those
/// that are not certainly farther.
#[inline(never)]
pub(crate) fn integer_nearest(
    leaf: &FanLeaf<'_>,
    p: Vec3,
    point: &IntPoint,
    limit: &LeafLimit,
    mut known: Option<&mut LeafSquares>,
) -> Option<LeafNearest> {
    let mut nearest = LeafNearest::NONE;
    let mut bounds = [IntBounds::NONE; WIDTH];
    let wanted = leaf_bounds(leaf, point, &limit.plane, &mut bounds)?;
    if wanted == 0 {
        return Some(nearest);
    }
    let (mut likeliest, mut least) = (0, u32::MAX);
    for (lane, bounds) in bounds.iter().enumerate() {
        if bounds.upper < least {
            (likeliest, least) = (lane, bounds.upper);
        }
    }
    let mut within = limit.distance_sq;
    let mut integer_limit = IntLimit::of(within);
    let mut squares = [0f32; WIDTH];
    // The others: bits, the lowest that of `next`.
    let (mut lane, mut next, mut left) = (likeliest, 0, wanted & !(1 << (likeliest & 31)));
    loop {
        let bounds = bounds.get(lane)?;
        if !bounds.lower.is_beyond(integer_limit) {
            let near = if usize::from(bounds.first) == lane {
                nearness_by_corner(leaf, p, point, lane, bounds.corner)?
            } else {
                at_corner(*squares.get(usize::from(bounds.first))?, bounds.corner)
            };
            *squares.get_mut(lane)? = near.distance_sq;
            if Real(near.distance_sq) < Real(nearest.distance_sq) {
                let limit = Real(limit_of(near.distance_sq, limit.allowance));
                within = lesser(Real(within), limit).0;
                integer_limit = IntLimit::of(within);
            }
            nearest.take(lane, &near, limit.low_sq);
            if let Some(known) = &mut known {
                known.keep(lane, [near.distance_sq, near.lower_bound_sq]);
            }
            nearest.lanes.tell(lane, Residual::of_integers(bounds.direction));
        }
        if left == 0 {
            return Some(nearest);
        }
        while left & 1 == 0 {
            (left, next) = (left >> 1, next + 1);
        }
        lane = next;
        (left, next) = (left >> 1, next + 1);
    }
}

/// Bounds of the triangles of a leaf that are not behind a plane.
///
/// Some have the bounds of a [`first`](IntBounds::first) triangle before, of which the f32
/// kernel certainly finds the same square: they share the fan's centre and a corner, and the
/// corner is the closest point of both.
#[inline(never)]
pub(crate) fn leaf_bounds(
    leaf: &FanLeaf<'_>,
    point: &IntPoint,
    plane: &LeafPlane,
    bounds: &mut [IntBounds; WIDTH],
) -> Option<u32> {
    let (ring, shape) = (leaf.full_ring()?, leaf.shape());
    let wanted = plane.in_front(&ring, shape);
    let mut least = u32::MAX;
    // The nearest corner so far: its fan, its number in the ring if it is there, and its triangle.
    let (mut of_fan, mut in_ring, mut first) = (2, None, 0);
    for lane in lanes_of(wanted) {
        let corners = ring.corners(shape, lane)?;
        let fan = usize::from(lane >= shape.turn());
        if fan == of_fan {
            let number = match in_ring {
                None => 0,
                Some(vertex) if vertex == lane => 1,
                Some(vertex) if vertex == lane + 1 => 2,
                Some(_) => Corner::NONE.number,
            };
            let known = bounds.get_mut(first)?;
            if is_certain(point, &corners, Corner::new(number)) {
                let corner = known.corner;
                if is_certain(point, &ring.corners(shape, first)?, corner) {
                    known.corner = Corner::certain(corner.number);
                    // Field by field: else it would be a call of `memmove`.
                    let IntBounds { upper, direction: [x, y, z], first, lower, .. } = *known;
                    let slot = bounds.get_mut(lane)?;
                    (slot.upper, slot.first, slot.lower) = (upper, first, lower);
                    (slot.direction, slot.corner) = ([x, y, z], Corner::certain(number));
                    continue;
                }
                of_fan = 2;
            }
        }
        let slot = bounds.get_mut(lane)?;
        *slot = integer_bounds(point, &corners);
        slot.first = (lane & 7) as u8;
        if slot.upper <= least {
            least = slot.upper;
            let Corner { number, .. } = slot.corner;
            if number != Corner::NONE.number {
                (of_fan, first) = (fan, lane);
                in_ring = if number > 0 { Some(lane + usize::from(number) - 1) } else { None };
            }
        }
    }
    Some(wanted)
}

/// Whether the f32 kernel certainly takes a corner for the closest point.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn is_certain(point: &IntPoint, &[a, b, c]: &[IntVector; 3], corner: Corner) -> bool {
    let (vertex, [one, other]) = match corner.number {
        _ if corner.is_certain => return true,
        0 => (a, [b, c]),
        1 => (b, [c, a]),
        2 => (c, [a, b]),
        _ => return false,
    };
    is_certain_corner(point, vertex, [less(one, vertex), less(other, vertex)])
}

/// [`sharp_lower`] of a triangle.
pub(crate) fn sharp_lower_of(
    leaf: &FanLeaf<'_>,
    point: &IntPoint,
    lane: usize,
) -> Option<IntLower> {
    Some(sharp_lower(point, &leaf.full_ring()?.corners(leaf.shape(), lane)?))
}

/// What the f32 kernel finds of a triangle. `corner`: see [`IntBounds::corner`].
#[inline(never)]
pub(crate) fn nearness_by_corner(
    leaf: &FanLeaf<'_>,
    p: Vec3,
    point: &IntPoint,
    lane: usize,
    corner: Corner,
) -> Option<Nearness> {
    let corners = leaf.full_ring()?.corners(leaf.shape(), lane)?;
    Some(match corner_nearness(leaf, p, point, &corners, lane, corner) {
        Some(near) => near,
        None => nearness(&seen_from(leaf, lane, p)),
    })
}

/// What the f32 kernel finds where a corner is certainly the closest point: the same bits.
#[inline(never)]
fn corner_nearness(
    leaf: &FanLeaf<'_>,
    p: Vec3,
    point: &IntPoint,
    corners: &[IntVector; 3],
    lane: usize,
    corner: Corner,
) -> Option<Nearness> {
    if !is_certain(point, corners, corner) {
        return None;
    }
    let mut offset = difference(p, leaf.centre(usize::from(lane >= leaf.shape().turn())));
    if corner.number > 0 {
        let [x, y, z] = less(*corners.get(usize::from(corner.number))?, corners[0]);
        offset = difference(offset, Vec3::new(float(x), float(y), float(z)));
    }
    let distance_sq = dot(offset, offset);
    Some(at_corner(distance_sq, corner))
}

/// What the f32 kernel finds at this squared distance from a corner.
#[inline(always)]
fn at_corner(distance_sq: f32, corner: Corner) -> Nearness {
    let share = |of: u8| if corner.number == of { 1.0 } else { 0.0 };
    Nearness { distance_sq, lower_bound_sq: distance_sq, v: share(1), w: share(2) }
}
