//! Bounds of single triangles of a leaf, for questions that look at triangles one by one.

use super::limit::LeafLimit;
#[cfg(not(meshsweep_wide))]
use super::plain_side::showing_at_centre;
use super::squares::LeafSquares;
use crate::bvh::point::query::PointQuery;
use crate::bvh::tree::format::{FanLeaf, lanes_of};
#[cfg(not(meshsweep_wide))]
use crate::geom::fan::SpokeTerms;
use crate::geom::fan::{Nearness, PointFan, lone_triangle, lower_bound, refined};
use crate::num::tolerance::{CERTIFIED_PART, EVERYTHING_SQ, LEAST_LIMIT};
use crate::num::{Real, SOFT_FLOAT, difference, greater, lesser, sqrt_approx};
use glam::Vec3;

/// The distance of a triangle: as computed, or refined if its lower bound falls far short of it.
/// The result depends on the triangle and the query alone, so that all questions agree.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(crate) fn refine_sliver(query: &PointQuery, seen: &[Vec3; 3], near: Nearness) -> Nearness {
    if Real(near.lower_bound_sq) >= Real(query.refine_below(near.distance_sq)) {
        return near;
    }
    sliver(query, near, &refined(seen, &near))
}

/// [`refine_sliver`] for a triangle that is [`refined`] already.
#[inline(always)]
pub(crate) fn sliver(query: &PointQuery, near: Nearness, better: &Nearness) -> Nearness {
    let falls_short =
        |of: &Nearness| Real(near.lower_bound_sq) < Real(query.refine_below(of.distance_sq));
    if falls_short(&near) && falls_short(better) { *better } else { near }
}

/// Triangle `lane` from `p`: the way from its centre, and its spokes.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
pub(crate) fn seen_from(leaf: &FanLeaf<'_>, lane: usize, p: Vec3) -> [Vec3; 3] {
    let [centre, e, g] = leaf.spokes(lane);
    [difference(p, centre), e, g]
}

/// The distance of a triangle that is [seen](seen_from), as computed.
#[cfg_attr(meshsweep_wide, inline(always))]
pub(crate) fn nearness(seen: &[Vec3; 3]) -> Nearness {
    let &[s, e, g] = seen;
    let fan = PointFan::new(s);
    lone_triangle(&fan, &fan.spoke(e), &fan.spoke(g))
}

/// What takes the triangles of a leaf one by one.
pub(crate) trait TriangleTaker {
    /// Takes a triangle: lane, the triangle [seen](seen_from) from the query where that costs
    /// nothing, its squared distance and lower bound.
    fn triangle(&mut self, lane: usize, seen: Option<&[Vec3; 3]>, squares: [f32; 2]);

    /// Triangle `lane`, whose closest point is the centre of its fan, was taken last. Those after
    /// it in the fan with the same closest point change nothing if they show this side, which is
    /// the front in the fan's winding or the back.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    fn told_side(&self, _lane: usize) -> Option<bool> {
        None
    }
}

/// Hands over the triangles of a leaf whose bits in `low` are ones, in order. Triangles beyond the
/// limit may be left out.
#[inline]
pub(crate) fn each_triangle(
    query: &PointQuery,
    leaf: &FanLeaf<'_>,
    limit: &LeafLimit,
    (low, known): (u32, &LeafSquares),
    mut each: impl TriangleTaker,
) {
    let low = low & !(u32::MAX << (leaf.shape().triangles() & 31));
    // A copy of the kernel's loop for each question.
    #[cfg(not(meshsweep_wide))]
    if !SOFT_FLOAT && !cfg!(meshsweep_small) {
        each_by_fans(query, leaf, limit, low, each);
        return;
    }
    for lane in lanes_of(low) {
        match known.of(lane) {
            Some([_, lower_bound_sq]) if Real(lower_bound_sq) > Real(limit.low_sq) => {}
            Some(squares) if !is_sliver(query, squares) => each.triangle(lane, None, squares),
            _ => {
                let seen = seen_from(leaf, lane, query.p);
                let near = refined_nearness(query, &seen);
                each.triangle(lane, Some(&seen), [near.distance_sq, near.lower_bound_sq]);
            }
        }
    }
}

/// [`each_triangle`] where what two neighbours share is computed once.
#[cfg(not(meshsweep_wide))]
#[inline(always)]
fn each_by_fans<T: TriangleTaker>(
    query: &PointQuery,
    leaf: &FanLeaf<'_>,
    limit: &LeafLimit,
    low: u32,
    mut each: T,
) {
    let of_first_fan = !(u32::MAX << (leaf.shape().turn() & 31));
    let (mut which, mut lanes, mut of_next_fan) = (0, low & of_first_fan, low & !of_first_fan);
    loop {
        if lanes != 0 {
            let (centre, spoke) = leaf.fan(which);
            let fan = PointFan::new(query.p - centre);
            let mut next = usize::MAX;
            let mut second = fan.spoke(Vec3::ZERO);
            lanes &= 0xFF;
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let first = if next == lane { second } else { fan.spoke(spoke(lane)) };
                next = lane + 1;
                second = fan.spoke(spoke(next));
                let seen = [fan.s, first.edge, second.edge];
                let at_centre = fan.at_centre(&first, &second);
                let mut squares = match at_centre {
                    Some(distance_sq) => [distance_sq; 2],
                    None => of_triangle(fan, first, second),
                };
                if squares[1] > limit.low_sq {
                    continue;
                }
                if is_sliver(query, squares) {
                    squares = refined_squares(query, seen);
                }
                each.triangle(lane, Some(&seen), squares);
                if at_centre.is_some()
                    && let Some(side) = each.told_side(lane)
                    && lanes != 0
                {
                    lanes &= !showing_at_centre(leaf, which, &fan, lanes, side).unwrap_or(0);
                }
            }
        }
        if of_next_fan == 0 {
            return;
        }
        (which, lanes, of_next_fan) = (1, of_next_fan, 0);
    }
}

#[inline(always)]
fn is_sliver(query: &PointQuery, [distance_sq, lower_bound_sq]: [f32; 2]) -> bool {
    !is_tight(distance_sq, lower_bound_sq)
        && Real(lower_bound_sq) < Real(query.refine_below(distance_sq))
}

/// Whether it is plain, without floating point, that a bound falls short of a distance by nothing.
#[inline(always)]
fn is_tight(distance_sq: f32, lower_bound_sq: f32) -> bool {
    SOFT_FLOAT && distance_sq.to_bits() == lower_bound_sq.to_bits()
}

/// By value, so that a loop keeps its own in registers.
#[cfg(not(meshsweep_wide))]
#[inline(always)]
fn of_triangle(fan: PointFan, first: SpokeTerms, second: SpokeTerms) -> [f32; 2] {
    let near = lone_triangle(&fan, &first, &second);
    [near.distance_sq, near.lower_bound_sq]
}

#[cfg(not(meshsweep_wide))]
#[inline(never)]
fn refined_squares(query: &PointQuery, seen: [Vec3; 3]) -> [f32; 2] {
    let near = refined_nearness(query, &seen);
    [near.distance_sq, near.lower_bound_sq]
}

/// The closest point of one triangle, grid units.
pub(crate) fn witness(query: &PointQuery, leaf: &FanLeaf<'_>, lane: usize) -> Vec3 {
    let near = refined_nearness(query, &seen_from(leaf, lane, query.p));
    leaf.point(lane, near.v, near.w)
}

/// [`nearness`], then [`refine_sliver`].
#[cfg_attr(meshsweep_wide, inline(always))]
fn refined_nearness(query: &PointQuery, seen: &[Vec3; 3]) -> Nearness {
    refine_sliver(query, seen, nearness(seen))
}

/// Whether the lower bound is so near the distance that its root serves. Else planes bound the
/// triangle anew.
#[inline(always)]
pub(crate) fn is_certified(distance_sq: f32, lower_bound_sq: f32) -> bool {
    is_tight(distance_sq, lower_bound_sq)
        || Real(lower_bound_sq) >= Real(distance_sq) * Real(CERTIFIED_PART)
}

/// Lower bound of a triangle's distance, grid units. [`PointQuery::lower`] then subtracts the
/// rounding.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline)]
pub(crate) fn lower_of(
    leaf: &FanLeaf<'_>,
    lane: usize,
    p: Vec3,
    distance_sq: f32,
    lower_bound_sq: f32,
) -> f32 {
    if is_certified(distance_sq, lower_bound_sq) {
        sqrt_approx(lower_bound_sq)
    } else {
        supporting_plane_bound(leaf, lane, p)
    }
}

#[cold]
#[inline(never)]
fn supporting_plane_bound(leaf: &FanLeaf<'_>, lane: usize, p: Vec3) -> f32 {
    let seen = seen_from(leaf, lane, p);
    lower_bound(&seen, &refined(&seen, &nearness(&seen)))
}

/// Squared bound above which nothing is within `distance` (input units) of the input mesh.
pub(crate) fn limit_within(query: &PointQuery, distance: f32) -> f32 {
    // Lower ends below the least normal number are 0, which is within any distance.
    let distance = greater(Real(distance), Real(f32::MIN_POSITIVE)).0;
    // `PointQuery::limit` adds more than the roundings here.
    let limit = Real(query.units.inward(distance)) + Real(query.units.surface_error);
    limit_of(query, limit.0)
}

/// Squared bound above which nothing is within `distance` (grid units) of the stored surface.
#[cfg_attr(meshsweep_small, inline(never))]
pub(crate) fn limit_of(query: &PointQuery, distance: f32) -> f32 {
    let distance = greater(Real(LEAST_LIMIT), Real(distance));
    let limit = Real(query.limit((distance * distance).0));
    lesser(Real(EVERYTHING_SQ), limit).0
}

/// Lower bound of the distance to the input mesh for a box's key, input units.
pub(crate) fn lower_of_box(query: &PointQuery, key: u32) -> f32 {
    query.lower(query.distance_of_key(key))
}
