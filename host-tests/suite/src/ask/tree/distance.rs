//! Distances: closest points, one and many, with a tolerance and with a sign.

use meshsweep_core::{Budget, Neighbor, Side, Verdict};

use super::{Bvh, Scratch};
use crate::ask::{self, Asked};
use crate::fold::Fold;
use crate::observer::Observer;
use crate::place::Point;

/// Closest point; returns the witness.
#[inline(never)]
pub fn closest(
    tree: &Bvh<'_>,
    p: Point,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) -> Point {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.stack);
    let call = || tree.closest_point(p, budget, stack);
    to.answer(call, ask::closest_point).map_or(p, |answer| answer.point)
}

/// Closest point, from where the last one was found.
#[inline(never)]
pub fn follow(tree: &Bvh<'_>, p: Point, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut s.stack);
    let call = || tree.closest_point_from(p, &mut s.hint, budget, stack);
    to.answer(call, ask::closest_point);
}

/// Closest point, its candidates in f64.
#[inline(never)]
pub fn precise(tree: &Bvh<'_>, p: Point, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut s.stack);
    to.answer(|| tree.closest_point_precise(p, budget, stack), ask::closest_point);
}

/// Closest point, by a query that remembers what the last answers ruled out.
#[inline(never)]
pub fn coherent<'t>(
    tree: &Bvh<'t>,
    p: Point,
    scratch: &mut Scratch<'t>,
    to: &mut Asked<'_, impl Observer>,
) {
    let Scratch { stack, coherent, .. } = scratch;
    let (budget, stack) = to.terms(Budget::EXACT, stack);
    to.answer(
        || coherent.closest_point(tree, p, budget, stack),
        |fold, answer| {
            ask::closest_point(fold, &answer.closest);
            fold.f32(answer.safe_radius);
        },
    );
}

/// Closest point with a tolerance of a tenth, with one of `distance`, and with three nodes to open.
#[inline(never)]
pub fn stopped(
    tree: &Bvh<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) {
    let stops = [
        Budget::EXACT.with_relative(0.1),
        Budget::EXACT.with_absolute(distance),
        Budget::EXACT.with_steps(3),
    ];
    for stop in stops {
        let (budget, stack) = to.terms(stop, &mut scratch.stack);
        to.answer(|| tree.closest_point(p, budget, stack), ask::closest_point);
    }
}

/// Whether the surface is within a distance.
#[inline(never)]
pub fn is_within(
    tree: &Bvh<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.stack);
    to.answer(
        || tree.within(p, distance, budget, stack),
        |fold, answer| {
            let [kind, triangle] = match answer.verdict {
                Verdict::Yes => [1, answer.witness.unwrap_or(u32::MAX)],
                Verdict::No => [2, 0],
                _ => [3, 0],
            };
            fold.word(kind);
            fold.word(triangle);
            ask::verdict(fold, answer.verdict);
        },
    );
}

/// The eight closest triangles.
#[inline(never)]
pub fn nearest(tree: &Bvh<'_>, p: Point, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let Scratch { stack, near, .. } = s;
    let (budget, stack) = to.terms(Budget::EXACT, stack);
    if let Some(answer) = to.answer(|| tree.nearest(p, near, budget, stack), |_, _| ()) {
        found(to.fold, near.get(..answer.stored).unwrap_or_default());
        to.fold.f32(answer.rest_lower);
        ask::how(to.fold, answer.ended);
    }
}

/// All triangles within a distance, as far as eight places hold them.
#[inline(never)]
pub fn all_within(
    tree: &Bvh<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) {
    let Scratch { stack, near, .. } = scratch;
    let (budget, stack) = to.terms(Budget::EXACT, stack);
    let call = || tree.all_within(p, distance, near, budget, stack);
    if let Some(answer) = to.answer(call, |_, _| ()) {
        found(to.fold, near.get(..answer.stored).unwrap_or_default());
        to.fold.word(answer.certain as u32);
        to.fold.word(answer.dropped);
        ask::how(to.fold, answer.ended);
    }
}

/// Distance with the sign of the side.
#[inline(never)]
pub fn signed(tree: &Bvh<'_>, p: Point, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut s.stack);
    to.answer(
        || tree.signed_distance(p, budget, stack),
        |fold, answer| {
            fold.f32(answer.distance.lower);
            fold.f32(answer.distance.upper);
            fold.word(match answer.side {
                Side::Outside => 1,
                Side::Inside => 2,
                _ => 3,
            });
            ask::closest_point(fold, &answer.closest);
        },
    );
}

fn found(fold: &mut Fold, triangles: &[Neighbor]) {
    for near in triangles {
        fold.f32(near.distance().lower);
        fold.f32(near.distance().upper);
        fold.point(near.point());
        fold.word(near.triangle());
    }
}
