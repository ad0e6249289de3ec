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
    /// Reached goals win. Among hulls that are stuck, or that a slack is asked of, fewer faces win;
    /// among hulls that are too loose the smaller slack wins; then the smaller volume wins.
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
