//! Segments, and what faces an eye.

use meshsweep_core::{Budget, Eye, Facing, FrontFacing, Verdict};

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
    match timed(clock, || tree.first_hit(a, b, facing, Budget::EXACT, &mut scratch.stack)) {
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
    match timed(clock, || tree.any_hit(a, b, Facing::Both, Budget::EXACT, &mut scratch.stack)) {
        Ok(answer) => fold.word(match answer.verdict {
            Verdict::Yes => 1,
            Verdict::No => 2,
            _ => 3,
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
    match timed(clock, || tree.all_hits(a, b, Facing::Both, hits, Budget::EXACT, stack)) {
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
    for sight in [Eye::At(point), Eye::Along(point)] {
        match timed(clock, || tree.front_facing(sight, &mut scratch.facing)) {
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
