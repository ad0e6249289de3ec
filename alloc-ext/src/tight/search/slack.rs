//! The fewest faces for a slack.
//!
//! Every edit keeps within the slack. So there is no number of faces to try: a hull comes down
//! until no edge may collapse any more.

use super::candidate::{CandidateHull, keep_better};
use super::hull_search::HullSearch;
use super::void::{FINER, LEAST_SAVING, TOO_FEW};
use crate::collapse::Conditions;
use crate::error::BuildError;
use crate::tight::initial::{
    InitialHull, InitialInput, STAIR_CONDITIONS, closure_hull, grown_box, lifted_levels,
};
use crate::tight::report::Outcome;

/// Target faces of the first level. Faces that are too far from the mesh are split; more faces
/// would have to be collapsed again.
const COARSEST: usize = 250;

/// Voxels of the first closure along the distance that the slack leaves beyond the margin.
const VOXELS_PER_SLACK: f64 = 2.0;

/// Fewest and most voxels along the longest side of a closure.
const VOXELS: [usize; 2] = [6, 160];

impl<'a> HullSearch<'a, '_> {
    /// See [`Goal::Slack`](crate::tight::Goal::Slack).
    pub(super) fn fewest_faces_by_slack(
        &mut self,
        slack: f64,
    ) -> Result<CandidateHull<'a>, BuildError> {
        let input = self.initial_input();
        let mut best: Option<CandidateHull<'a>> = None;
        if let Some(initial) = grown_box(&input) {
            keep_better(&mut best, self.within_slack(initial, slack));
        }
        let mut faces = COARSEST;
        let mut voxels = self.slack_voxels(slack);
        // Twice the voxels take eight times as long, and rarely help where two closures do not.
        let finest = (2 * voxels).min(VOXELS[1]);
        let mut has_level = false;
        let mut no_finer_level = self.solid.is_none() || self.large_margin_voxels().is_some();
        // Edits keep some steps of the grid off the mesh. So no hull reaches such a slack, and
        // finer initial hulls do not help.
        let is_below_grid =
            slack - self.obstacle.margin() <= input.rounding.half_step(self.largest_coordinate());
        let mut reached = false;
        while !reached && !self.is_late() {
            if !no_finer_level {
                let input = InitialInput { stored: self.stored, ..input };
                let levels = lifted_levels(&input, self.mesh, faces, self.on_progress);
                if let Some(level) = levels.ample.or(levels.exact) {
                    has_level = true;
                    let hull = self.within_slack(level, slack);
                    reached = hull.stop == Outcome::Reached;
                    keep_better(&mut best, hull);
                }
                no_finer_level = faces >= self.mesh.triangles.len();
            }
            // Closures where there is no level, or no level is within the slack.
            let mut is_finest = false;
            if !reached && (!has_level || no_finer_level && !is_below_grid) {
                // Walls along the axes do better by the first, all others by the second.
                for conditions in [Conditions::PAPER, STAIR_CONDITIONS] {
                    if self.is_late() {
                        break;
                    }
                    let closure = closure_hull(&input, voxels, faces, conditions, self.on_progress);
                    if let Some(closure) = closure {
                        let hull = self.within_slack(closure, slack);
                        reached |= hull.stop == Outcome::Reached;
                        keep_better(&mut best, hull);
                    }
                }
                is_finest = voxels >= finest;
                voxels = (2 * voxels).min(VOXELS[1]);
            }
            if is_below_grid || is_finest && (no_finer_level || !has_level) {
                break;
            }
            faces = faces.saturating_mul(FINER);
        }
        let mut best = best.ok_or_else(|| self.no_room())?;
        if self.is_late() {
            best.stop = Outcome::OutOfTime;
        }
        Ok(best)
    }

    fn slack_voxels(&self, slack: f64) -> usize {
        let margin = self.obstacle.margin();
        let longest = self.longest_side() + 2.0 * margin;
        ((VOXELS_PER_SLACK * longest / (slack - margin)) as usize).clamp(VOXELS[0], VOXELS[1])
    }

    /// The hull of few faces that an initial hull comes to within a slack, or one that is
    /// [`Outcome::TooLoose`].
    fn within_slack(&mut self, initial: InitialHull, slack: f64) -> CandidateHull<'a> {
        let InitialHull { start, filled, .. } = initial;
        let mut editor = self.editor(initial);
        let mut is_within = editor.bring_within(slack);
        if !is_within && !editor.is_late() {
            // Large hulls are far hulls: with least volume within its present slack the hull may
            // come nearer.
            editor.limit_distance(editor.slack());
            editor.relax(self.floor(), 1e-2, 4);
            is_within = editor.bring_within(slack);
        }
        if !is_within {
            editor.drop_enclosed();
            return CandidateHull { editor, start, filled, stop: Outcome::TooLoose };
        }
        editor.relax(self.floor(), 1e-2, 4);
        let mut faces = usize::MAX;
        loop {
            self.descend(&mut editor, TOO_FEW + 1);
            let now = editor.shell.face_count();
            let saved = faces.saturating_sub(now);
            faces = now;
            if saved < (now / LEAST_SAVING).max(2) || editor.is_late() {
                return CandidateHull { editor, start, filled, stop: Outcome::Reached };
            }
            // Less volume leaves more room for the volume that the next collapses add.
            self.polish(&mut editor);
        }
    }
}
