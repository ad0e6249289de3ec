//! The model and its moved copy.

use meshsweep_core::{Budget, Pose, Verdict};

use super::{Bvh, Scratch};
use crate::ask::{self, Asked};
use crate::observer::Observer;
use crate::place::Motion;

/// A motion as the core takes it.
#[must_use]
pub fn pose((rotation, translation): Motion) -> Pose {
    Pose::rigid(rotation, translation)
}

/// Whether the surface meets its moved copy.
#[inline(never)]
pub fn overlap(tree: &Bvh<'_>, pose: Pose, s: &mut Scratch<'_>, to: &mut Asked<'_, impl Observer>) {
    let (budget, pairs) = to.terms(Budget::EXACT, &mut s.pairs);
    to.answer(
        || tree.overlap(tree, pose, budget, pairs),
        |fold, answer| {
            fold.word(match answer.verdict {
                Verdict::No => 1,
                Verdict::Yes => 2,
                _ => 3,
            });
            let triangles = answer.witness.unwrap_or([u32::MAX; 2]);
            triangles.into_iter().for_each(|number| fold.word(number));
            ask::verdict(fold, answer.verdict);
        },
    );
}

/// Pairs of nodes that a search for all pairs may open: what it needs differs by orders of
/// magnitude.
const STEPS: u32 = 4;

/// All pairs of triangles that meet, as far as a few steps go.
#[inline(never)]
pub fn all_overlaps(
    tree: &Bvh<'_>,
    pose: Pose,
    scratch: &mut Scratch<'_>,
    to: &mut Asked<'_, impl Observer>,
) {
    let Scratch { pairs, meeting, .. } = scratch;
    let (budget, pairs) = to.terms(Budget::EXACT.with_steps(STEPS), pairs);
    let call = || tree.all_overlaps(tree, pose, meeting, budget, pairs);
    if let Some(answer) = to.answer(call, |_, _| ()) {
        for pair in meeting.iter().take(answer.stored) {
            pair.triangles.into_iter().for_each(|number| to.fold.word(number));
            to.fold.word(u32::from(pair.is_certain));
        }
        to.fold.word(answer.dropped);
        ask::how(to.fold, answer.ended);
    }
}
