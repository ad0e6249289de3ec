//! The tightest hull of a number of faces.
//!
//! A row holds unless a row above it does.
//!
//! | mesh and goal | initial hulls, in this order |
//! | --- | --- |
//! | the hull comes down to few faces | all compete: levels if the mesh bounds a volume and the margin is not large; the closure of the next row if it is; voxel closures; the grown box. Each is polished at once. Levels alone if one is the solid itself |
//! | margin that is large beside the mesh | one voxel closure as fine as the margin needs; if it is missing or stuck, the hulls of the last row until one reaches the goal |
//! | bounds a volume | levels of its own progressive hull; if they are stuck, the hulls of the last row until one reaches the goal; if none is proved, the last row |
//! | any other | all compete: voxel closures from fine to coarse, the grown box |
//!
//! The coarsest closure is skipped once a hull has reached the goal, unless a finer closure failed
//! and faces are not few. A hull that only comes up to the goal, by splits, reaches it always, and
//! is not polished here.
//!
//! With few faces a coarse closure may come to less volume, because it has fewer handles and narrow
//! places.

use super::candidate::{CandidateHull, keep_better};
use super::hull_search::HullSearch;
use crate::collapse::Conditions;
use crate::error::BuildError;
use crate::tight::initial::{
    InitialHull, InitialInput, ample_faces, closure_hull, grown_box, lifted_levels,
};
use crate::tight::moves::HullEditor;
use crate::tight::report::{Outcome, Start};

/// Voxels along the longest side of the closures that are tried after the [`finest`]; `None` is the
/// grown box.
const COARSER: [Option<usize>; 4] = [Some(40), Some(16), LAST_RESORT, None];

/// A closure that is tried only where one before it failed; for few faces, where all did.
const LAST_RESORT: Option<usize> = Some(6);

/// A level of a closure with more faces than this, in parts of those wanted, has too many handles to
/// come down to few faces. It would take most of the time, and get stuck.
const MOST_HANDLES: f64 = 1.5;

/// Faces that the grown box is split to first, and the factor of each further step. If all splits
/// came at once the first would decide, and no polish undoes them.
const GROWTH: (f64, f64) = (16.0, 1.2);

/// Voxels along the longest side of the finest closure for a number of faces. A hull never reopens
/// a gap narrower than a voxel, so that more faces need smaller voxels. Above 160 the grid takes
/// more time than the hull.
fn finest(faces: usize) -> usize {
    let voxels = (40.0 * (faces as f64 / 200.0).sqrt()) as usize;
    voxels.clamp(40, 160)
}

/// A margin above this fraction of the mesh's longest side is a few voxels of the first closure.
const LARGE_MARGIN: f64 = 0.02;

/// Least and most voxels along the longest side of the closure for a large margin.
const LARGE_MARGIN_VOXELS: [usize; 2] = [12, 32];

/// Up to this number of faces all initial hulls compete.
pub(super) const FEW_FACES: usize = 60;

/// Void of a hull that no other initial hull can improve by more.
const NEXT_TO_NO_VOID: f64 = 1e-4;

/// Largest void that may be due to the steps of the grid.
const MOST_GRID_VOID: f64 = 1e-2;

/// Half-steps of the grid that keep such a hull off the mesh.
const HALF_STEPS_OFF: f64 = 12.0;

/// The number of faces that is asked for.
#[derive(Clone, Copy)]
pub(super) struct Target {
    pub faces: usize,
    /// Whether hulls come down to that number. Otherwise they only come up to it, by splits.
    pub descends: bool,
}

impl Target {
    /// Whether all initial hulls compete, each polished at once, which decides between them.
    fn is_few(self) -> bool {
        self.descends && self.faces <= FEW_FACES
    }
}

/// What happens to an initial hull whose turn it is.
enum Next {
    Try,
    Skip,
    Stop,
}

impl<'a> HullSearch<'a, '_> {
    /// Voxels of the first closure if the margin is so large that the mesh's shape shows little at
    /// that distance. Voxels of half the margin then show all of it.
    pub(super) fn large_margin_voxels(&self) -> Option<usize> {
        let margin = self.obstacle.margin();
        let longest = self.longest_side();
        let voxels = (longest + 2.0 * margin) / (0.5 * margin);
        let [least, most] = LARGE_MARGIN_VOXELS;
        (margin > LARGE_MARGIN * longest).then(|| (voxels as usize).clamp(least, most))
    }

    /// The best hull of a number of faces. It is polished if it descends.
    pub(super) fn of_faces(&mut self, target: Target) -> Result<CandidateHull<'a>, BuildError> {
        let mut best: Option<CandidateHull<'a>> = None;
        let large_margin = self.large_margin_voxels();
        if self.solid.is_some() && large_margin.is_none() {
            self.try_levels(target, &mut best);
        }
        // A level, or the closure for a large margin, needs no competitor once it reaches the goal.
        let is_enough = best.is_some() || large_margin.is_some();
        let all_compete = target.is_few() && !self.is_solid_itself(best.as_ref(), target);
        let mut is_hard = false;
        for voxels in self.closures(target, large_margin) {
            let is_skipped = voxels == LAST_RESORT && (target.is_few() || !is_hard);
            match self.next(voxels, best.as_ref(), !is_enough || all_compete, is_skipped) {
                Next::Try => {}
                Next::Skip => continue,
                Next::Stop => break,
            }
            let input = self.initial_input();
            let initial = match voxels {
                Some(voxels) => closure_hull(
                    &input,
                    voxels,
                    target.faces,
                    Conditions::STANDARD,
                    self.on_progress,
                ),
                None => grown_box(&input),
            };
            let comes_down = |initial: &InitialHull| {
                let most = MOST_HANDLES * ample_faces(target.faces) as f64;
                !target.descends || initial.shell.face_count() as f64 <= most
            };
            let initial = initial.filter(comes_down);
            is_hard |= initial.is_none();
            if let Some(initial) = initial {
                let hull = self.prepare(initial, target, best.as_ref());
                is_hard |= hull.stop == Outcome::Stuck && best.is_none();
                keep_better(&mut best, hull);
            }
        }
        let mut best = best.ok_or_else(|| self.no_room())?;
        if target.descends && !target.is_few() {
            self.finish(&mut best);
        }
        Ok(best)
    }

    /// Voxels of the closures in the order in which they are tried; `None` is the grown box.
    fn closures(
        &self,
        target: Target,
        large_margin: Option<usize>,
    ) -> impl Iterator<Item = Option<usize>> + use<> {
        let finest = finest(target.faces);
        // If the hull of the finest closure gets stuck, that of a slightly coarser one may not.
        let second = Some(finest * 2 / 3).filter(|&voxels| Some(voxels) > COARSER[0]);
        let coarser = COARSER.into_iter().filter(move |&voxels| voxels != Some(finest));
        let finest = if self.is_hurried { None } else { Some(finest) };
        [large_margin, finest, second].into_iter().flatten().map(Some).chain(coarser)
    }

    /// Whether the next initial hull is tried. With `is_open` a hull that reached its goal has to
    /// compete with the others.
    ///
    /// | best so far | in time | out of time |
    /// | --- | --- | --- |
    /// | none | try | skip to the grown box, which is quick; stop if the caller wants no hull |
    /// | stuck | try | stop |
    /// | reached, `is_open` | try unless `is_skipped` | stop |
    /// | reached, not `is_open` | stop | stop |
    fn next(
        &mut self,
        voxels: Option<usize>,
        best: Option<&CandidateHull<'a>>,
        is_open: bool,
        is_skipped: bool,
    ) -> Next {
        let is_late = self.is_late();
        let Some(best) = best else {
            if self.deadline.is_cancelled() {
                return Next::Stop;
            }
            if is_late && voxels.is_some() {
                self.is_hurried = true;
                return Next::Skip;
            }
            return Next::Try;
        };
        let is_reached = best.stop != Outcome::Stuck;
        if is_late || is_reached && !is_open {
            Next::Stop
        } else if is_reached && is_skipped {
            Next::Skip
        } else {
            Next::Try
        }
    }

    /// Tries levels of the mesh's own progressive hull, in half of the time: the other half is for
    /// the other initial hulls.
    fn try_levels(&mut self, target: Target, best: &mut Option<CandidateHull<'a>>) {
        let half = self.deadline.half();
        let input = InitialInput { stored: self.stored, deadline: half, ..self.initial_input() };
        let levels = lifted_levels(&input, self.mesh, target.faces, self.on_progress);
        for initial in [levels.ample, levels.exact].into_iter().flatten() {
            if !self.is_solid_itself(best.as_ref(), target) {
                let hull = self.prepare(initial, target, None);
                keep_better(best, hull);
            }
        }
        self.is_hurried |= best.is_none() && half.has_passed();
    }

    /// Whether the mesh has no more faces than asked for, and a hull that reached its goal has next
    /// to no void. A hull of less volume than the mesh says nothing: components overlap.
    fn is_solid_itself(&self, hull: Option<&CandidateHull<'a>>, target: Target) -> bool {
        let Some((hull, volume)) = hull.zip(self.volume()) else { return false };
        if self.mesh.triangles.len() > target.faces || hull.stop != Outcome::Reached {
            return false;
        }
        let HullEditor { shell, rounding, .. } = &hull.editor;
        let area = shell.alive().map(|f| {
            let [a, b, c] = shell.triangle(f);
            0.5 * (b - a).cross(c - a).length()
        });
        let off =
            HALF_STEPS_OFF * rounding.half_step(self.largest_coordinate()) * area.sum::<f64>();
        let more = volume * NEXT_TO_NO_VOID + off.min(volume * MOST_GRID_VOID);
        (volume..=volume + more).contains(&shell.volume())
    }

    /// Settles an initial hull and brings it to the number of faces. It counts as stuck if it has
    /// more volume with all its faces than the best hull has with few.
    fn prepare(
        &mut self,
        initial: InitialHull,
        target: Target,
        best: Option<&CandidateHull<'a>>,
    ) -> CandidateHull<'a> {
        let InitialHull { start, filled, .. } = initial;
        let mut editor = self.editor(initial);
        for _ in 0..2 {
            editor.settle_all();
            editor.flip_all();
        }
        let is_larger = |best: &CandidateHull<'_>| {
            best.stop == Outcome::Reached && best.editor.shell.volume() < editor.shell.volume()
        };
        let comes_down = editor.shell.face_count() > target.faces && !target.is_few();
        if comes_down && best.is_some_and(is_larger) {
            return CandidateHull { editor, start, filled, stop: Outcome::Stuck };
        }
        let stop = if target.descends {
            self.descend(&mut editor, target.faces)
        } else {
            Outcome::Reached
        };
        if target.is_few() && start == Start::Box {
            self.grow(&mut editor, target.faces);
        }
        editor.refine(target.faces);
        self.relax(&mut editor);
        let mut hull = CandidateHull { editor, start, filled, stop };
        if target.is_few() && stop == Outcome::Reached {
            self.finish(&mut hull);
        }
        hull
    }

    /// Splits in steps, each polished.
    fn grow(&mut self, editor: &mut HullEditor<'a>, target: usize) {
        let mut faces = GROWTH.0;
        while (faces as usize) < target && !editor.is_late() {
            editor.refine(faces as usize);
            self.relax(editor);
            self.polish(editor);
            faces *= GROWTH.1;
        }
    }

    fn finish(&mut self, hull: &mut CandidateHull<'a>) {
        let polished = self.polish(&mut hull.editor);
        if hull.stop == Outcome::Reached {
            hull.stop = polished;
        }
    }
}
