//! Distances: closest points, one and many, with a tolerance and with a sign.

use meshsweep_core::{Budget, ClosestPoint};
use meshsweep_core::{Neighbor, QueryError, Side, Verdict};

use super::{Bvh, Scratch};
use crate::Clock;
use crate::ask::{self, timed};
use crate::fold::Fold;

/// Closest point; returns the witness.
#[inline(never)]
pub fn closest(
    tree: &Bvh<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) -> [f32; 3] {
    match timed(clock, || tree.closest_point(point, Budget::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            ask::closest_point(fold, &answer);
            answer.point
        }
        Err(error) => {
            ask::refusal(fold, error);
            point
        }
    }
}

/// Closest point, from where the last one was found.
#[inline(never)]
pub fn follow(
    tree: &Bvh<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, hint, .. } = scratch;
    match timed(clock, || tree.closest_point_from(point, hint, Budget::EXACT, stack)) {
        Ok(answer) => ask::closest_point(fold, &answer),
        Err(error) => ask::refusal(fold, error),
    }
}

/// Closest point, by a session that remembers what the last answers ruled out.
#[inline(never)]
pub fn session<'t>(
    tree: &Bvh<'t>,
    point: [f32; 3],
    scratch: &mut Scratch<'t>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, session, .. } = scratch;
    match timed(clock, || session.closest_point(tree, point, Budget::EXACT, stack)) {
        Ok(answer) => {
            ask::closest_point(fold, &answer.closest);
            fold.f32(answer.safe_radius);
        }
        Err(error) => ask::refusal(fold, error),
    }
}

/// Closest point with a tolerance of a tenth, with one of `distance`, and with three nodes to open.
#[inline(never)]
pub fn stopped(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let stops = [
        Budget::EXACT.with_relative(0.1),
        Budget::EXACT.with_absolute(distance),
        Budget::EXACT.with_steps(3),
    ];
    for stop in &stops {
        match timed(clock, || tree.closest_point(point, *stop, &mut scratch.stack)) {
            Ok(answer) => ask::closest_point(fold, &answer),
            Err(error) => ask::refusal(fold, error),
        }
    }
}

/// Whether the surface is within a distance.
#[inline(never)]
pub fn is_within(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || tree.within(point, distance, Budget::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            let [kind, triangle] = match answer.verdict {
                Verdict::Yes => [1, answer.triangle.unwrap_or(u32::MAX)],
                Verdict::No => [2, 0],
                _ => [3, 0],
            };
            fold.word(kind);
            fold.word(triangle);
            ask::verdict(fold, answer.work, answer.verdict);
        }
        Err(error) => ask::refusal(fold, error),
    }
}

/// The eight closest triangles.
#[inline(never)]
pub fn nearest(
    tree: &Bvh<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, near, .. } = scratch;
    match timed(clock, || tree.nearest(point, near, Budget::EXACT, stack)) {
        Ok(answer) => {
            found(fold, near.get(..answer.stored).unwrap_or_default());
            fold.f32(answer.rest_lower);
            ask::how(fold, answer.work, answer.ended);
        }
        Err(error) => ask::refusal(fold, error),
    }
}

/// All triangles within a distance, as far as eight places hold them.
#[inline(never)]
pub fn all_within(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, near, .. } = scratch;
    match timed(clock, || tree.all_within(point, distance, near, Budget::EXACT, stack)) {
        Ok(answer) => {
            found(fold, near.get(..answer.stored).unwrap_or_default());
            fold.word(answer.certain as u32);
            fold.word(answer.dropped);
            ask::how(fold, answer.work, answer.ended);
        }
        Err(error) => ask::refusal(fold, error),
    }
}

/// Distance with the sign of the side.
#[inline(never)]
pub fn signed(
    tree: &Bvh<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || tree.signed_distance(point, Budget::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            fold.f32(answer.distance.lower);
            fold.f32(answer.distance.upper);
            fold.word(match answer.side {
                Side::Outside => 1,
                Side::Inside => 2,
                _ => 3,
            });
            ask::closest_point(fold, &answer.closest);
        }
        Err(error) => ask::refusal(fold, error),
    }
}

/// Queries of a batch.
const BATCH: usize = 8;

/// Closest points of eight points, in an order of the core's own.
#[inline(never)]
pub fn batch<'t>(
    tree: &Bvh<'t>,
    points: &[[f32; 3]; BATCH],
    scratch: &mut Scratch<'t>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    // The longer memory: the entries beyond the stack hold the order of the queries.
    let Scratch { pairs, hint, .. } = scratch;
    let mut answers = [ClosestPoint::EMPTY; BATCH];
    match timed(clock, || tree.closest_points(points, hint, &mut answers, Budget::EXACT, pairs)) {
        Ok(()) => answers.iter().for_each(|answer| ask::closest_point(fold, answer)),
        Err(QueryError::AnswerCount { .. }) => fold.word(u32::MAX),
        Err(error) => {
            fold.word(if let QueryError::PointNotFinite { index } = error { index } else { 0 });
            ask::refusal(fold, error);
        }
    }
}

fn found(fold: &mut Fold, triangles: &[Neighbor]) {
    for near in triangles {
        fold.f32(near.distance().lower);
        fold.f32(near.distance().upper);
        fold.point(near.point());
        fold.word(near.triangle());
    }
}
