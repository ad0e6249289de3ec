//! Segments, and what faces an eye.

use meshsweep_core::{Budget, Eye, Facing, FrontFacing, Verdict};

use super::{Bvh, Scratch};
use crate::ask::{self, Asked};
use crate::observer::Observer;
use crate::place::{Ends, Point};

/// First point of the segment from `a` to `b` on the surface.
#[inline(never)]
pub fn first_hit(tree: &Bvh<'_>, ab: Ends, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    hit_of(tree, ab, Facing::Both, s, to);
}

/// First point of the segment from `a` to `b` on a triangle's front, then on a back.
#[inline(never)]
pub fn facing(tree: &Bvh<'_>, ab: Ends, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    hit_of(tree, ab, Facing::Front, s, to);
    hit_of(tree, ab, Facing::Back, s, to);
}

fn hit_of(
    tree: &Bvh<'_>,
    [a, b]: Ends,
    facing: Facing,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.stack);
    to.answer(|| tree.first_hit(a, b, facing, budget, stack), ask::segment_hit);
}

/// Whether the segment from `a` to `b` meets the surface.
#[inline(never)]
pub fn any_hit(tree: &Bvh<'_>, ab: Ends, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let [a, b] = ab;
    let (budget, stack) = to.terms(Budget::EXACT, &mut s.stack);
    to.answer(
        || tree.any_hit(a, b, Facing::Both, budget, stack),
        |fold, answer| {
            fold.word(match answer.verdict {
                Verdict::Yes => 1,
                Verdict::No => 2,
                _ => 3,
            });
        },
    );
}

/// Every point of the segment from `a` to `b` on the surface.
#[inline(never)]
pub fn all_hits(tree: &Bvh<'_>, ab: Ends, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let Scratch { stack, hits, .. } = s;
    let [a, b] = ab;
    let (budget, stack) = to.terms(Budget::EXACT, stack);
    let call = || tree.all_hits(a, b, Facing::Both, hits, budget, stack);
    if let Some(answer) = to.answer(call, |_, _| ()) {
        ask::listed(to.fold, hits.get(..answer.stored).unwrap_or_default());
        to.fold.word(answer.dropped);
        ask::how(to.fold, answer.ended);
    }
}

/// What a ray through two points meets: first, any, and all.
#[inline(never)]
pub fn ray(tree: &Bvh<'_>, ab: Ends, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let Scratch { stack, hits, .. } = s;
    let [from, through] = ab;
    let ([x, y, z], [a, b, c]) = (through, from);
    let (way, both) = ([x - a, y - b, z - c], Facing::Both);
    let (budget, stack) = to.terms(Budget::EXACT, stack);
    to.answer(|| tree.first_hit_of_ray(from, way, both, budget, stack), ask::segment_hit);
    to.answer(
        || tree.any_hit_of_ray(from, way, both, budget, stack),
        |fold, answer| ask::verdict(fold, answer.verdict),
    );
    let call = || tree.all_hits_of_ray(from, way, both, hits, budget, stack);
    if let Some(answer) = to.answer(call, |_, _| ()) {
        ask::listed(to.fold, hits.get(..answer.stored).unwrap_or_default());
        ask::how(to.fold, answer.ended);
    }
}

/// Triangles that may face an eye at `p`, then along the way to there from the origin.
#[inline(never)]
pub fn cull(
    tree: &Bvh<'_>,
    p: Point,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) {
    for sight in [Eye::At(p), Eye::Along(p)] {
        let call = || tree.front_facing(sight, &mut scratch.facing);
        if let Some(answer) = to.answer(call, |_, _| ()) {
            let FrontFacing { stored, dropped, leaves, culled_leaves, culled, .. } = answer;
            let counts = [dropped, leaves, culled_leaves, culled];
            scratch.facing.iter().take(stored).chain(&counts).for_each(|&word| to.fold.word(word));
        }
    }
}
