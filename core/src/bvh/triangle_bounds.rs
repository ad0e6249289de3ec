//! Bounds of single triangles of a leaf, for the questions that ask about more than the nearest
//! one.

use super::point_query::PointQuery;
use crate::bvh::format::FanLeaf;
use crate::geom::fan::{Nearness, PointFan, lone_triangle, lower_bound, refined};
use crate::num::sqrt_approx;
use crate::num::tolerance::TREE_WEAK;
use glam::Vec3;

/// Squared limit that every stored box is within, below the key of a lane without a child.
pub(crate) const EVERYTHING: f32 = f32::from_bits(0x7E80_0000);

/// Least distance, grid units, that a limit is made for: its square is far above underflow.
const LEAST: f32 = 1.0 / (1u64 << 40) as f32;

/// What is known of a triangle: as computed, or, where its certificate says that this may be far
/// off and it is, refined. Depends on the triangle alone, so that all questions agree.
#[inline(always)]
pub(crate) fn refine_sliver(probe: &PointQuery, seen: &[Vec3; 3], near: Nearness) -> Nearness {
    if near.lower_bound_sq >= probe.weak(near.distance_sq) {
        return near;
    }
    let better = refined(seen, &near);
    if near.lower_bound_sq < probe.weak(better.distance_sq) { better } else { near }
}

/// Triangle `lane` from `p`: the way from its centre, and its spokes.
#[inline(always)]
pub(crate) fn seen_from(patch: &FanLeaf<'_>, lane: usize, p: Vec3) -> [Vec3; 3] {
    let [centre, e, g] = patch.spokes(lane);
    [p - centre, e, g]
}

#[inline(always)]
pub(crate) fn nearness(seen: &[Vec3; 3]) -> Nearness {
    let &[s, e, g] = seen;
    let fan = PointFan::new(s);
    lone_triangle(&fan, &fan.spoke(e), &fan.spoke(g))
}

/// All triangles of a patch, in order: lane, squared distance and its supporting plane's bound.
#[inline]
pub(crate) fn each_triangle(
    probe: &PointQuery,
    patch: &FanLeaf<'_>,
    mut each: impl FnMut(usize, f32, f32),
) {
    for lane in 0..patch.tag().triangles() {
        let seen = seen_from(patch, lane, probe.p);
        let near = refine_sliver(probe, &seen, nearness(&seen));
        each(lane, near.distance_sq, near.lower_bound_sq);
    }
}

/// The closest point of one triangle, grid units.
pub(crate) fn witness(probe: &PointQuery, patch: &FanLeaf<'_>, lane: usize) -> Vec3 {
    let seen = seen_from(patch, lane, probe.p);
    let near = refine_sliver(probe, &seen, nearness(&seen));
    patch.point(lane, near.v, near.w)
}

/// Distance, grid units, that a triangle is not nearer than, but for the rounding that
/// [`PointQuery::lower`] takes off.
#[inline]
pub(crate) fn lower_of(
    patch: &FanLeaf<'_>,
    lane: usize,
    p: Vec3,
    distance_sq: f32,
    lower_bound_sq: f32,
) -> f32 {
    if lower_bound_sq >= distance_sq * TREE_WEAK {
        sqrt_approx(lower_bound_sq)
    } else {
        certified(patch, lane, p)
    }
}

#[cold]
#[inline(never)]
fn certified(patch: &FanLeaf<'_>, lane: usize, p: Vec3) -> f32 {
    let [s, e, g] = seen_from(patch, lane, p);
    lower_bound(s, e, g)
}

/// Squared bound above which nothing is within `distance` (input units) of the input mesh.
pub(crate) fn limit_within(probe: &PointQuery, distance: f32) -> f32 {
    // The roundings here are less than what `limit` adds.
    limit_of(probe, probe.units.inward(distance) + probe.units.surface_error)
}

/// Squared bound above which nothing is within `distance` (grid units) of the stored surface.
pub(crate) fn limit_of(probe: &PointQuery, distance: f32) -> f32 {
    let distance = if distance > LEAST { distance } else { LEAST };
    let limit = probe.limit(distance * distance);
    if limit < EVERYTHING { limit } else { EVERYTHING }
}

/// Distance, grid units, that a box's squared bound stands for, but for the rounding that
/// [`PointQuery::lower`] takes off. Unlike a triangle's it carries the rounding of boxes, whose
/// 2100-fold square is the limit's allowance.
pub(crate) fn distance_of_box(probe: &PointQuery, key: f32) -> f32 {
    let distance = sqrt_approx(key) - sqrt_approx(probe.limit(0.0)) * (1.0 / 45.0);
    if distance > 0.0 { distance } else { 0.0 }
}

/// What it says of the distance to the input mesh, input units.
pub(crate) fn lower_of_box(probe: &PointQuery, key: f32) -> f32 {
    probe.lower(distance_of_box(probe, key))
}
