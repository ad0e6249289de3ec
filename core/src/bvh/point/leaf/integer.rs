//! The triangles of a leaf in integers, for processors without floating point: bounds of all, and
//! the f32 kernel only for those that may be the nearest.

use super::bounds::nearness;
use super::limit::LeafLimit;
use super::nearest::LeafNearest;
use super::plane::{LeafPlane, Residual};
use super::squares::LeafSquares;
use crate::bvh::point::query::limit_of;
use crate::bvh::tree::format::{FanLeaf, FullRing, lanes_of};
use crate::geom::fan::{
    Corner, CornerWay, EdgeWay, IntBounds, IntLimit, IntLower, IntPoint, IntVector, Nearness,
    WIDTH, integer_bounds, less, sharp_lower,
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
    let (wanted, likeliest) = leaf_bounds(leaf, point, &limit.plane, &mut bounds)?;
    if wanted == 0 {
        return Some(nearest);
    }
    let mut within = limit.distance_sq;
    let mut integer_limit = IntLimit::of(within);
    let mut squares = [0f32; WIDTH];
    // Bits of the triangles that were looked at, and the others.
    let (mut seen, mut left) = (0u32, wanted & !(1 << (likeliest & 31)));
    let mut lane = likeliest;
    loop {
        let bounds = bounds.get(lane)?;
        let first = usize::from(bounds.first);
        if first != lane {
            // The same square. The other one has the lesser number.
            if seen >> (first & 31) & 1 != 0 {
                let &distance_sq = squares.get(first)?;
                nearest.low |= (nearest.low >> (first & 31) & 1) << (lane & 31);
                if let Some(known) = &mut known {
                    known.keep(lane, [distance_sq; 2]);
                }
            }
        } else if !bounds.lower.is_beyond(integer_limit) {
            seen |= 1 << (lane & 31);
            let near = nearness_by_corner(leaf, p, point, lane, bounds.corner)?;
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
        lane = lowest(left);
        left &= left - 1;
    }
}

/// Bounds of the triangles of a leaf that are not behind a plane: their bits, and the likeliest.
///
/// Some have no bounds but the number of a [`first`](IntBounds::first) triangle before, of which
/// the f32 kernel certainly finds the same square: they share the fan's centre and a corner, and
/// the corner is the closest point of both.
#[inline(never)]
pub(crate) fn leaf_bounds(
    leaf: &FanLeaf<'_>,
    point: &IntPoint,
    plane: &LeafPlane,
    bounds: &mut [IntBounds; WIDTH],
) -> Option<(u32, usize)> {
    let (ring, shape) = (leaf.full_ring()?, leaf.shape());
    let wanted = plane.in_front(&ring, shape);
    let (mut least, mut likeliest, mut left) = (u32::MAX, 0, wanted);
    let mut of_fan = !(u32::MAX << (shape.turn() & 31));
    let (mut next, mut corners) = (usize::MAX, [ring.centre(0); 3]);
    while left != 0 {
        let lane = lowest(left);
        left &= left - 1;
        if lane >= shape.turn() && of_fan != u32::MAX {
            (corners[0], of_fan) = (ring.centre(1), u32::MAX);
        }
        corners[1] = if lane == next { corners[2] } else { ring.vertex(lane)? };
        next = lane + 1;
        corners[2] = ring.vertex(next)?;
        let slot = bounds.get_mut(lane)?;
        integer_bounds(point, &corners, slot);
        slot.first = (lane & 7) as u8;
        if slot.upper > least {
            continue;
        }
        if slot.upper < least {
            likeliest = lane;
        }
        least = slot.upper;
        let ties = match slot.corner.number {
            0 => left & of_fan,
            // The ring vertex that the next triangle has too.
            2 => left & of_fan & 2 << (lane & 31),
            _ => 0,
        };
        if ties == 0 || !is_certain(point, &corners, slot.corner) {
            continue;
        }
        let ties = match slot.corner.number {
            0 => certain_at_centre(point, &ring, corners[0], ties)?,
            _ if is_certain(point, &ring.corners(shape, lane + 1)?, Corner::new(1)) => ties,
            _ => 0,
        };
        slot.corner.is_certain = true;
        left &= !ties;
        for tie in lanes_of(ties) {
            bounds.get_mut(tie)?.first = (lane & 7) as u8;
        }
    }
    Some((wanted, likeliest))
}

/// Those of a fan's triangles whose closest point is certainly the centre.
#[inline(never)]
fn certain_at_centre(
    point: &IntPoint,
    ring: &FullRing<'_>,
    centre: IntVector,
    mut lanes: u32,
) -> Option<u32> {
    let way = CornerWay::new(point, centre);
    let (mut certain, mut next) = (0, usize::MAX);
    let mut second = EdgeWay::NONE;
    while lanes != 0 {
        let lane = lowest(lanes);
        let first = if lane == next { second } else { way.edge(less(ring.vertex(lane)?, centre)) };
        next = lane + 1;
        second = way.edge(less(ring.vertex(next)?, centre));
        if way.is_certain(first, second) {
            certain |= lanes & lanes.wrapping_neg();
        }
        lanes &= lanes - 1;
    }
    Some(certain)
}

/// The first of a leaf's triangles whose bits are ones.
#[inline(always)]
fn lowest(lanes: u32) -> usize {
    lanes.trailing_zeros() as usize & (WIDTH - 1)
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
    let way = CornerWay::new(point, vertex);
    way.is_certain(way.edge(less(one, vertex)), way.edge(less(other, vertex)))
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
        None => {
            let [centre, e, g] = leaf.spokes_of(&corners);
            nearness(&[difference(p, centre), e, g])
        }
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
