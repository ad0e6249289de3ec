//! Bounds of single triangles of a leaf, for the questions that ask about more than the nearest one.

use super::probe::Probe;
use crate::blob::Patch;
use crate::fan::{PointFan, certified_distance, point_patch};
use crate::num::root;
use glam::Vec3;

/// Part of the squared residual that a supporting plane along it has to reach for its square to be taken as it is: 15/16. Below that the
/// rounding of the square would grow by the ratio of the two when the root is taken; then [`certified_distance`] is asked.
const STRONG: f32 = 0.9375;

/// Squared limit that every stored box is within, below the key of a lane without a child.
pub(super) const EVERYTHING: f32 = f32::from_bits(0x7E80_0000);

/// Least distance, grid units, that a limit is made for: its square is far above underflow.
const LEAST: f32 = 1.0 / (1u64 << 40) as f32;

/// All triangles of a patch, in order: lane, squared distance and its supporting plane's bound, as the wide kernel computes them.
#[inline]
pub(super) fn each_triangle(patch: &Patch<'_>, p: Vec3, mut each: impl FnMut(usize, f32, f32)) {
    let s = [p - patch.centre(0), p - patch.centre(patch.tag().centres() - 1)];
    point_patch(
        patch.tag().triangles(),
        patch.tag().turn(),
        s,
        |i, which| patch.spoke(i, which),
        |lane, near| each(lane, near.distance_sq, near.certified_sq),
    );
}

/// The closest point of one triangle, grid units.
pub(super) fn witness(patch: &Patch<'_>, lane: usize, p: Vec3) -> Vec3 {
    let which = usize::from(lane >= patch.tag().turn());
    let centre = patch.centre(which);
    let fan = PointFan::new(p - centre);
    let (a, b) = (fan.spoke(patch.spoke(lane, which)), fan.spoke(patch.spoke(lane + 1, which)));
    let near = fan.triangle(&a, &b);
    centre + a.edge * near.v + b.edge * near.w
}

/// Distance, grid units, that a triangle is not nearer than, but for the rounding that [`Probe::lower`] takes off.
#[inline]
pub(super) fn lower_of(patch: &Patch<'_>, lane: usize, p: Vec3, distance_sq: f32, certified_sq: f32) -> f32 {
    if certified_sq >= distance_sq * STRONG { root(certified_sq) } else { certified(patch, lane, p) }
}

#[cold]
#[inline(never)]
fn certified(patch: &Patch<'_>, lane: usize, p: Vec3) -> f32 {
    let which = usize::from(lane >= patch.tag().turn());
    certified_distance(p - patch.centre(which), patch.spoke(lane, which), patch.spoke(lane + 1, which))
}

/// Squared bound above which nothing is within `distance` (input units) of the input mesh.
pub(super) fn limit_within(probe: &Probe, distance: f32) -> f32 {
    // The roundings here are less than what `limit` adds.
    limit_of(probe, probe.units.inward(distance) + probe.units.surface_error)
}

/// Squared bound above which nothing is within `distance` (grid units) of the stored surface.
pub(super) fn limit_of(probe: &Probe, distance: f32) -> f32 {
    let distance = if distance > LEAST { distance } else { LEAST };
    let limit = probe.limit(distance * distance);
    if limit < EVERYTHING { limit } else { EVERYTHING }
}

/// What a box's squared bound says of the distance to the input mesh, input units. Unlike a triangle's distance it carries the rounding of
/// boxes, whose 2100-fold square is the limit's allowance.
pub(super) fn lower_of_box(probe: &Probe, key: f32) -> f32 {
    let rounding = root(probe.limit(0.0)) * (1.0 / 45.0);
    probe.lower(root(key) - rounding)
}
