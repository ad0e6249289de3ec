//! The way from an initial hull to fewer faces, in stages.

use super::hull_search::HullSearch;
use super::polish::Polish;
use crate::progress::Stage;
use crate::tight::initial::InitialHull;
use crate::tight::moves::{HullEditor, Shape};
use crate::tight::report::Outcome;

/// Conditions of collapses as long as enough edges pass them: later edits find places for vertices.
const SHAPE: Shape =
    Shape { min_compactness: 0.01, min_turn: 0.25, upright: Some(0.05), max_valence: 24 };

/// Conditions once [`SHAPE`] lets no edge collapse: nearly every edit that is proved is made.
const LOOSE: Shape =
    Shape { min_compactness: 0.001, min_turn: -0.9, upright: None, max_valence: 48 };

/// Fraction of the faces that a stage leaves. The hull relaxes before the next stage.
pub(super) const STAGE: f64 = 0.7;

/// After edits that change the number of faces, a hull relaxes until a round gains at most this
/// fraction of the volume beyond the floor. Polishing gains the rest.
const RELAXED: f64 = 1e-2;

/// Most rounds in which it relaxes.
const RELAX_ROUNDS: usize = 4;

impl<'a> HullSearch<'a, '_> {
    /// Settles and flips after edits that changed the number of faces.
    pub(super) fn relax(&self, editor: &mut HullEditor<'a>) {
        editor.relax(self.floor(), RELAXED, RELAX_ROUNDS);
    }

    pub(super) fn editor(&self, initial: InitialHull) -> HullEditor<'a> {
        let mut editor = HullEditor::new(self.obstacle, initial.shell, self.rounding(), SHAPE);
        editor.deadline = self.deadline;
        editor
    }

    /// Collapses edges until `faces` are left, or as few as possible; without polish.
    pub(super) fn descend(&mut self, editor: &mut HullEditor<'a>, faces: usize) -> Outcome {
        let from = editor.shell.face_count();
        let mut stop = Outcome::Reached;
        while editor.shell.face_count() > faces {
            if editor.is_late() {
                return Outcome::OutOfTime;
            }
            let next = ((editor.shell.face_count() as f64 * STAGE) as usize).max(faces);
            let on_progress = &mut *self.on_progress;
            let mut show = |left: usize| {
                on_progress(Stage::Shrinking {
                    done: from.saturating_sub(left),
                    of: from.saturating_sub(faces),
                });
            };
            let mut reached = editor.decimate(next, &mut show);
            if !reached && editor.is_late() {
                return Outcome::OutOfTime;
            }
            if !reached && editor.shape != LOOSE {
                editor.shape = LOOSE;
                reached = editor.decimate(next, &mut show);
            }
            if !reached {
                stop = Outcome::Stuck;
                break;
            }
            self.relax(editor);
        }
        editor.drop_enclosed();
        // Polishing copies the hull often.
        editor.shell.drop_dead();
        stop
    }

    pub(super) fn polish(&mut self, editor: &mut HullEditor<'a>) -> Outcome {
        let floor = self.floor();
        let on_progress = &mut *self.on_progress;
        Polish::new(editor, self.options.effort).run(editor, floor, |done, of| {
            on_progress(Stage::Polishing { done: done as usize, of: of as usize });
        });
        editor.drop_enclosed();
        if editor.is_late() { Outcome::OutOfTime } else { Outcome::Reached }
    }
}
