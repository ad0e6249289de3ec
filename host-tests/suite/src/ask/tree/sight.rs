//! Segments, and what faces an eye.

use meshsweep_core::query::tree::{
    AnyHit, Facing, FrontFacing, Sight, all_hits as core_all_hits, any_hit as core_any_hit,
    first_hit as core_first_hit, front_facing,
};

use super::{Bvh, Scratch};
use crate::Clock;
use crate::ask::{self, timed};
use crate::fold::Fold;

/// First point of the segment from `a` to `b` on the surface.
#[inline(never)]
pub fn first_hit(
    tree: &Bvh<'_>,
    ends: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    hit_of(tree, ends, Facing::Both, scratch, clock, fold);
}

/// First point of the segment from `a` to `b` on a triangle's front, then on a back.
#[inline(never)]
pub fn facing(
    tree: &Bvh<'_>,
    ends: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    for facing in [Facing::Front, Facing::Back] {
        hit_of(tree, ends, facing, scratch, clock, fold);
    }
}

fn hit_of(
    tree: &Bvh<'_>,
    [a, b]: [[f32; 3]; 2],
    facing: Facing,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || core_first_hit(tree, a, b, &facing, &mut scratch.stack)) {
        Ok(answer) => ask::segment_hit(fold, &answer),
        Err(error) => ask::refusal(fold, error),
    }
}

/// Whether the segment from `a` to `b` meets the surface.
#[inline(never)]
pub fn any_hit(
    tree: &Bvh<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || core_any_hit(tree, a, b, &Facing::Both, &mut scratch.stack)) {
        Ok(answer) => fold.word(match answer {
            AnyHit::Hit => 1,
            AnyHit::Clear => 2,
            AnyHit::Unknown => 3,
        }),
        Err(error) => ask::refusal(fold, error),
    }
}

/// Every point of the segment from `a` to `b` on the surface.
#[inline(never)]
pub fn all_hits(
    tree: &Bvh<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, hits, .. } = scratch;
    match timed(clock, || core_all_hits(tree, a, b, &Facing::Both, hits, stack)) {
        Ok(answer) => {
            ask::hits(fold, hits.get(..answer.stored).unwrap_or_default());
            fold.word(answer.dropped);
            ask::how(fold, answer.work, answer.ended);
        }
        Err(error) => ask::refusal(fold, error),
    }
}

/// Triangles that may face an eye at `point`, then along the way to there from the origin.
#[inline(never)]
pub fn cull(
    tree: &Bvh<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    for sight in [Sight::From(point), Sight::Along(point)] {
        match timed(clock, || front_facing(tree, &sight, &mut scratch.facing)) {
            Ok(answer) => {
                scratch.facing.iter().take(answer.stored).for_each(|&triangle| fold.word(triangle));
                let FrontFacing { dropped, leaves, culled_leaves, culled, .. } = answer;
                [dropped, leaves, culled_leaves, culled]
                    .into_iter()
                    .for_each(|count| fold.word(count));
            }
            Err(error) => ask::refusal(fold, error),
        }
    }
}
