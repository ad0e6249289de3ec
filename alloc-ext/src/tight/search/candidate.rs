//! Hulls that compete for a goal.

use crate::tight::moves::HullEditor;
use crate::tight::report::{Outcome, Start};

/// A hull that was brought to its goal, or as near to it as possible.
pub(crate) struct CandidateHull<'a> {
    pub editor: HullEditor<'a>,
    pub start: Start,
    /// Components of the initial hull that were dropped.
    pub filled: usize,
    pub stop: Outcome,
}

impl CandidateHull<'_> {
    /// A hull that reached its goal or ran out of time is better than a stuck one, and that is
    /// better than one that is too loose. Of two that are too loose the smaller slack wins. Of two
    /// that are stuck, or that keep a distance limit, fewer faces win, then the smaller volume. Of
    /// all others the smaller volume wins.
    fn is_better_than(&self, other: &Self) -> bool {
        if let (Outcome::TooLoose, Outcome::TooLoose) = (self.stop, other.stop) {
            return self.editor.slack() < other.editor.slack();
        }
        let rank = |hull: &Self| {
            let faces = hull.editor.shell.face_count();
            match hull.stop {
                Outcome::TooLoose => (2, 0),
                Outcome::Stuck => (1, faces),
                Outcome::Reached | Outcome::OutOfTime => {
                    (0, if hull.editor.has_distance_limit() { faces } else { 0 })
                }
            }
        };
        let (ours, theirs) = (rank(self), rank(other));
        ours < theirs || ours == theirs && self.editor.shell.volume() < other.editor.shell.volume()
    }
}

/// Keeps the better of two, with the work counters of both.
pub(super) fn keep_better<'a>(best: &mut Option<CandidateHull<'a>>, mut next: CandidateHull<'a>) {
    if let Some(best) = best {
        next.editor.add_counts(&best.editor);
        if !next.is_better_than(best) {
            best.editor.take_counts(&next.editor);
            return;
        }
    }
    *best = Some(next);
}
