//! The fewest faces for a slack.
//!
//! Every edit keeps within the slack. So there is no number of faces to try: a hull comes down
//! until no edge may collapse any more.
//!
//! | initial hull | when it is tried |
//! | --- | --- |
//! | grown box | first, once |
//! | level of the mesh's own progressive hull | in each round up to the finest level, which has as many faces as the mesh; not if the mesh bounds no volume or the margin is large |
//! | two voxel closures of one grid | in a round before any level is proved; in a round after which no finer level is left, unless the slack is below the steps of the grid |
//!
//! The next round's level has [`FINER`] times the faces. The next closures have twice the voxels.
//! Rounds end with the first hull within the slack, with the finest closures, with the time, or
//! after the first round if the slack is below the steps of the grid.

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

/// How fine the initial hulls of a round are.
struct Round {
    /// Target faces of the level.
    faces: usize,
    /// Voxels along the longest side of the closures.
    voxels: usize,
    /// Whether some round had a level.
    has_level: bool,
    /// Whether later rounds have no finer level.
    no_finer_level: bool,
}

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
        // Edits keep some steps of the grid off the mesh. So no hull reaches such a slack, and
        // finer initial hulls do not help.
        let is_below_grid =
            slack - self.obstacle.margin() <= input.rounding.half_step(self.largest_coordinate());
        let mut round = Round {
            faces: COARSEST,
            voxels: self.slack_voxels(slack),
            has_level: false,
            no_finer_level: self.solid.is_none() || self.large_margin_voxels().is_some(),
        };
        // Twice the voxels take eight times as long, and rarely help where two closures do not.
        let finest = (2 * round.voxels).min(VOXELS[1]);
        while !self.is_late() {
            if !round.no_finer_level && self.try_level(&mut round, slack, &mut best) {
                break;
            }
            let mut is_finest = false;
            if !round.has_level || round.no_finer_level && !is_below_grid {
                if self.try_closures(&round, slack, &mut best) {
                    break;
                }
                is_finest = round.voxels >= finest;
                round.voxels = (2 * round.voxels).min(VOXELS[1]);
            }
            if is_below_grid || is_finest && (round.no_finer_level || !round.has_level) {
                break;
            }
            round.faces = round.faces.saturating_mul(FINER);
        }
        let mut best = best.ok_or_else(|| self.no_room())?;
        if self.is_late() {
            best.stop = Outcome::OutOfTime;
        }
        Ok(best)
    }

    /// Tries a level; whether it comes within the slack.
    fn try_level(
        &mut self,
        round: &mut Round,
        slack: f64,
        best: &mut Option<CandidateHull<'a>>,
    ) -> bool {
        let input = InitialInput { stored: self.stored, ..self.initial_input() };
        let levels = lifted_levels(&input, self.mesh, round.faces, self.on_progress);
        round.no_finer_level = round.faces >= self.mesh.triangles.len();
        let Some(level) = levels.ample.or(levels.exact) else { return false };
        round.has_level = true;
        let hull = self.within_slack(level, slack);
        let is_within = hull.stop == Outcome::Reached;
        keep_better(best, hull);
        is_within
    }

    /// Tries two closures of one grid; whether one comes within the slack.
    fn try_closures(
        &mut self,
        round: &Round,
        slack: f64,
        best: &mut Option<CandidateHull<'a>>,
    ) -> bool {
        let input = self.initial_input();
        let mut is_within = false;
        // Walls along the axes do better by the first, all others by the second.
        for conditions in [Conditions::STANDARD, STAIR_CONDITIONS] {
            if self.is_late() {
                break;
            }
            let Round { voxels, faces, .. } = *round;
            if let Some(closure) = closure_hull(&input, voxels, faces, conditions, self.on_progress)
            {
                let hull = self.within_slack(closure, slack);
                is_within |= hull.stop == Outcome::Reached;
                keep_better(best, hull);
            }
        }
        is_within
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
            self.relax(&mut editor);
            is_within = editor.bring_within(slack);
        }
        if !is_within {
            editor.drop_enclosed();
            return CandidateHull { editor, start, filled, stop: Outcome::TooLoose };
        }
        self.relax(&mut editor);
        let mut faces = usize::MAX;
        loop {
            self.descend(&mut editor, TOO_FEW + 1);
            let now = editor.shell.face_count();
            let saved = faces.saturating_sub(now);
            faces = now;
            if saved < (now / LEAST_SAVING).max(2) || editor.is_late() {
                return CandidateHull { editor, start, filled, stop: Outcome::Reached };
            }
            // Collapses add volume within the slack: from less volume more of them are possible.
            self.polish(&mut editor);
        }
    }
}
