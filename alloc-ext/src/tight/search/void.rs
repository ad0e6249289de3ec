//! The fewest faces for a void.
//!
//! The search begins with a hull of many faces. It removes faces in stages as long as the void
//! stays within the goal. After the first stage that fails, it bisects between the fewest faces
//! that are enough and the most that are too few.

use super::candidate::CandidateHull;
use super::descent::STAGE;
use super::faces::{FEW_FACES, Target};
use super::hull_search::HullSearch;
use crate::error::BuildError;
use crate::mesh::NoVolume;
use crate::tight::moves::HullEditor;
use crate::tight::report::Outcome;

/// Faces of the first hull. Only if its void is too large, a finer one follows.
const FIRST_FACES: usize = 2000;

/// Factor of the number of faces if these are not enough.
pub(super) const FINER: usize = 4;

/// A search ends when the next step would save less than one face in this many.
pub(super) const LEAST_SAVING: usize = 25;

/// Faces that no closed surface has.
pub(super) const TOO_FEW: usize = 3;

impl<'a> HullSearch<'a, '_> {
    /// See [`Goal::Void`](crate::tight::Goal::Void).
    pub(super) fn fewest_faces_by_void(
        &mut self,
        void: f64,
    ) -> Result<CandidateHull<'a>, BuildError> {
        let mut faces = FIRST_FACES;
        let mut best = self.of_faces(Target { faces, descends: false })?;
        while !self.is_within_void(&best.editor, void)
            && faces < self.mesh.triangles.len()
            && !best.editor.is_late()
        {
            faces = faces.saturating_mul(FINER);
            best = self.of_faces(Target { faces, descends: false })?;
        }
        if !self.is_within_void(&best.editor, void) {
            let polished = self.polish(&mut best.editor);
            if !self.is_within_void(&best.editor, void) {
                best.stop = match polished {
                    Outcome::OutOfTime => Outcome::OutOfTime,
                    _ => Outcome::TooLoose,
                };
                return Ok(best);
            }
        }
        let mut too_few = TOO_FEW;
        loop {
            self.require_measure(&best.editor)?;
            let faces = best.editor.shell.face_count();
            // A hull has an even number of faces.
            let staged = (faces as f64 * STAGE) as usize & !1;
            let next = if staged > too_few { staged } else { usize::midpoint(faces, too_few) & !1 };
            if next <= too_few || next >= faces || faces - next < (faces / LEAST_SAVING).max(2) {
                best.stop = Outcome::Reached;
                return Ok(best);
            }
            let mut trial = CandidateHull { editor: best.editor.clone(), ..best };
            trial.stop = self.descend(&mut trial.editor, next);
            if trial.stop == Outcome::Reached && !self.is_within_void(&trial.editor, void) {
                self.polish(&mut trial.editor);
            }
            let is_found = |search: &Self, trial: &CandidateHull<'_>| {
                trial.stop == Outcome::Reached && search.is_within_void(&trial.editor, void)
            };
            if !is_found(self, &trial) && next <= FEW_FACES && !self.is_late() {
                // With few faces the initial hull decides.
                let mut other = self.of_faces(Target { faces: next, descends: true })?;
                other.editor.add_counts(&trial.editor);
                trial = other;
            }
            if self.is_late() {
                best.stop = Outcome::OutOfTime;
                return Ok(best);
            }
            if is_found(self, &trial) {
                best = trial;
            } else {
                best.editor.take_counts(&trial.editor);
                too_few = next;
            }
        }
    }

    /// Refuses a mesh that overlaps itself, as a hull of less volume proves. The mesh's volume then
    /// counts places more than once, and no void can be measured against it.
    fn require_measure(&self, editor: &HullEditor<'a>) -> Result<(), BuildError> {
        let shell = &editor.shell;
        let corner = |p: glam::DVec3| p.as_vec3().to_array();
        let hull: Vec<[[f32; 3]; 3]> =
            shell.alive().map(|f| shell.triangle(f).map(corner)).collect();
        match self.solid.filter(|solid| solid.is_more_than(&hull)) {
            Some(_) => Err(BuildError::NoVolume(NoVolume::Overlapping)),
            None => Ok(()),
        }
    }

    /// Whether the void is at most `void`. False if the mesh bounds no volume.
    fn is_within_void(&self, editor: &HullEditor<'a>, void: f64) -> bool {
        self.volume().is_some_and(|volume| editor.shell.volume() <= volume * (1.0 + void))
    }
}
