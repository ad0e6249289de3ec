//! The fewest faces found for a void, and for a slack.
//!
//! For a void: down in stages as long as the hull has not more, then by halves. For a slack there
//! is no number of faces to try: every move keeps within it, so that a hull comes down until no
//! edge may collapse any more.

use crate::collapse::Conditions;
use crate::tight::initial::levels::{
    InitialHull, InitialInput, OF_STAIRS, closure_hull, grown_box, lifted_levels,
};
use crate::tight::moves::editor::HullEditor;
use crate::tight::moves::rounding::Rounding;
use crate::tight::options::{Outcome, WrapError};
use crate::tight::proof::volume::NoVolume;
use crate::tight::search::faces::{
    CandidateHull, FEW_FACES, HullSearch, SHAPE, STAGE, SearchInput, better,
};

/// Faces that a search for a void begins with.
const FINEST: usize = 2000;

/// Faces that a search for a slack begins with: what they leave too far from the mesh is split, and
/// more would have to go again.
const COARSEST: usize = 250;

/// Times as many when those do not do.
const FINER: usize = 4;

/// Cubes of the first closure along what a slack leaves beyond the margin, and of the finest along
/// the longest side.
const CELLS: (f64, usize) = (2.0, 160);

/// Fewest cubes along the longest side.
const LEAST_CELLS: usize = 6;

/// A search ends when the next step would save less than one face in this many.
const NEAR_ENOUGH: usize = 25;

/// Faces that no closed surface has.
const TOO_FEW: usize = 3;

impl<'a> HullSearch<'a, '_, '_> {
    /// See [`Goal::Slack`](crate::tight::options::Goal::Slack).
    pub fn least_faces_by_slack(
        &mut self,
        from: &SearchInput<'_>,
        most: f64,
    ) -> Result<CandidateHull<'a>, WrapError> {
        let rounding = Rounding::new(from.around.grid, from.around.scale_exponent);
        let place = InitialInput {
            stored: from.around,
            obstacle: self.obstacle,
            rounding,
            deadline: self.deadline,
        };
        let mut best: Option<CandidateHull<'a>> = None;
        if let Some(first) = grown_box(self.obstacle, &rounding) {
            let done = self.within(first, rounding, most);
            better(&mut best, done);
        }
        let mut faces = COARSEST;
        let mut cells = self.closure_cells(most);
        // A closure of more cubes takes eight times as long, and where two do not do it seldom
        // does.
        let finest = (2 * cells).min(CELLS.1);
        let is_solid = self.volume.is_some() && self.round_cells().is_none();
        let mut any_level = false;
        let mut levels_end = !is_solid;
        // Moves keep some steps of the grid off the mesh: nothing comes nearer than one.
        let bounds = self.obstacle.bounds();
        let size = bounds.low.abs().max(bounds.high.abs()).max_element();
        let is_vain = most - self.obstacle.margin() <= rounding.half_step(size);
        let mut came = false;
        while !came && !self.is_late() {
            if !levels_end {
                let place = InitialInput { stored: from.stored, ..place };
                let levels = lifted_levels(&place, from.mesh, faces, self.on_progress);
                if let Some(level) = levels.plenty.or(levels.wanted) {
                    any_level = true;
                    let done = self.within(level, rounding, most);
                    came = done.stop == Outcome::Reached;
                    better(&mut best, done);
                }
                levels_end = faces >= from.mesh.triangles.len();
            }
            // Closures where there is no level, or none does.
            let mut is_finest = false;
            if !came && (!any_level || levels_end && !is_vain) {
                // Walls along the axes do better by the one, all else by the other.
                for conditions in [Conditions::PAPER, OF_STAIRS] {
                    if self.is_late() {
                        break;
                    }
                    let first = closure_hull(&place, cells, faces, conditions, self.on_progress);
                    if let Some(first) = first {
                        let done = self.within(first, rounding, most);
                        came |= done.stop == Outcome::Reached;
                        better(&mut best, done);
                    }
                }
                is_finest = cells >= finest;
                cells = (2 * cells).min(CELLS.1);
            }
            if is_vain || is_finest && (levels_end || !any_level) {
                break;
            }
            faces = faces.saturating_mul(FINER);
        }
        if self.is_late()
            && let Some(done) = &mut best
        {
            done.stop = Outcome::OutOfTime;
        }
        best.ok_or_else(|| self.no_room())
    }

    fn closure_cells(&self, most: f64) -> usize {
        let bounds = self.obstacle.bounds();
        let margin = self.obstacle.margin();
        let longest = (bounds.high - bounds.low).max_element() + 2.0 * margin;
        ((CELLS.0 * longest / (most - margin)) as usize).clamp(LEAST_CELLS, CELLS.1)
    }

    /// The hull of a start that comes down within a slack, or one that is [`Outcome::TooLoose`].
    fn within(&mut self, first: InitialHull, rounding: Rounding, most: f64) -> CandidateHull<'a> {
        let InitialHull { shell, start, filled } = first;
        let mut editor = HullEditor::new(self.obstacle, shell, rounding, SHAPE);
        editor.deadline = self.deadline;
        let mut came = editor.bring_within(most);
        if !came && !editor.is_late() {
            // What is large is also far: the least volume within what it has may let it come
            // nearer.
            editor.limit_distance(editor.slack());
            editor.relax(self.floor(), 1e-2, 4);
            came = editor.bring_within(most);
        }
        if !came {
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
            if saved < (now / NEAR_ENOUGH).max(2) || editor.is_late() {
                return CandidateHull { editor, start, filled, stop: Outcome::Reached };
            }
            // Less volume leaves more room for what the next collapses add.
            self.polish(&mut editor, self.options.effort);
        }
    }

    /// See [`Goal::Void`](crate::tight::options::Goal::Void).
    pub fn least_faces_by_void(
        &mut self,
        from: &SearchInput<'_>,
        most: f64,
    ) -> Result<CandidateHull<'a>, WrapError> {
        let mut faces = FINEST;
        let mut done = self.begin(from, faces, false)?;
        while !self.has_void(&done.editor, most)
            && faces < from.mesh.triangles.len()
            && !done.editor.is_late()
        {
            faces = faces.saturating_mul(FINER);
            done = self.begin(from, faces, false)?;
        }
        if !self.has_void(&done.editor, most) {
            self.polish(&mut done.editor, self.options.effort);
            if !self.has_void(&done.editor, most) {
                done.stop =
                    if done.editor.is_late() { Outcome::OutOfTime } else { Outcome::TooLoose };
                return Ok(done);
            }
        }
        let mut too_few = TOO_FEW;
        loop {
            self.require_measure(&done.editor)?;
            let faces = done.editor.shell.face_count();
            // A hull has an even number of faces.
            let staged = (faces as f64 * STAGE) as usize & !1;
            let next = if staged > too_few { staged } else { usize::midpoint(faces, too_few) & !1 };
            if next <= too_few || next >= faces || faces - next < (faces / NEAR_ENOUGH).max(2) {
                done.stop = Outcome::Reached;
                return Ok(done);
            }
            let mut trial = CandidateHull { editor: done.editor.clone(), ..done };
            trial.stop = self.descend(&mut trial.editor, next);
            if trial.stop == Outcome::Reached && !self.has_void(&trial.editor, most) {
                self.polish(&mut trial.editor, self.options.effort);
            }
            let mut found = trial.stop == Outcome::Reached && self.has_void(&trial.editor, most);
            if !found && next <= FEW_FACES && !self.is_late() {
                // With few faces the start decides.
                let mut other = self.begin(from, next, true)?;
                other.editor.add_counts(&trial.editor);
                trial = other;
                found = trial.stop == Outcome::Reached && self.has_void(&trial.editor, most);
            }
            if self.is_late() {
                done.stop = Outcome::OutOfTime;
                return Ok(done);
            }
            if found {
                done = trial;
            } else {
                done.editor.take_counts(&trial.editor);
                too_few = next;
            }
        }
    }

    /// That the mesh's volume is not known to count places more than once.
    fn require_measure(&self, editor: &HullEditor<'a>) -> Result<(), WrapError> {
        let hull: Vec<[[f32; 3]; 3]> = editor
            .shell
            .alive()
            .map(|f| editor.shell.triangle(f).map(|p| p.as_vec3().to_array()))
            .collect();
        match self.solid.filter(|solid| solid.is_more_than(&hull)) {
            Some(_) => Err(WrapError::NoVolume(NoVolume::Overlapping)),
            None => Ok(()),
        }
    }

    fn has_void(&self, editor: &HullEditor<'a>, most: f64) -> bool {
        self.volume.is_some_and(|volume| editor.shell.volume() <= volume * (1.0 + most))
    }
}
