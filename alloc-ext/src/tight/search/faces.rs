//! The best start, and from there as few faces as wanted, as tight as they can be.

use crate::collapse::Conditions;
use crate::mesh::Mesh;
use crate::precision::Stored;
use crate::tight::initial::levels::{
    InitialHull, InitialInput, closure_hull, grown_box, lifted_levels,
};
use crate::tight::moves::editor::{HullEditor, Shape};
use crate::tight::moves::kick::Polish;
use crate::tight::moves::rounding::Rounding;
use crate::tight::options::{Goal, Options, Outcome, Progress, Stage, Start, WrapError};
use crate::tight::proof::obstacle::Obstacle;
use crate::tight::proof::volume::Solid;
use std::time::Instant;

/// Conditions while faces are plenty: the hull keeps room to move.
pub(crate) const SHAPE: Shape =
    Shape { min_compactness: 0.01, min_turn: 0.25, upright: Some(0.05), max_valence: 24 };

/// Conditions where the first get stuck: whatever is proved will do.
const LOOSE: Shape =
    Shape { min_compactness: 0.001, min_turn: -0.9, upright: None, max_valence: 48 };

/// Faces that a stage of the way down leaves; the hull is settled before the next.
pub(crate) const STAGE: f64 = 0.7;

/// Cubes along the longest side of closures, in the order in which they are tried after the
/// [`finest`]; `None` is the box.
const COARSER: [Option<usize>; 4] = [Some(40), Some(16), LAST_RESORT, None];

/// One that is tried only where all before it got stuck.
const LAST_RESORT: Option<usize> = Some(6);

/// Faces that the box grows to first where faces are few, and how many times as many each time:
/// with all at once the first splits decide, and no polish undoes them.
const GROWTH: (f64, f64) = (16.0, 1.2);

/// Cubes along the longest side of the finest closure for so many faces: gaps of a cube are filled
/// for good, and faces that could follow them would be there for nothing. Beyond 160 the grid takes
/// more time than the hull.
pub(crate) fn finest(wanted: usize) -> usize {
    let cells = (40.0 * (wanted as f64 / 200.0).sqrt()) as usize;
    cells.clamp(40, 160)
}

/// Part of the mesh's longest side from which on a margin is round: a few cubes of the first
/// closure.
const ROUND: f64 = 0.02;

/// Least and most cubes along its longest side.
const ROUND_CELLS: [usize; 2] = [12, 32];

/// Faces up to which closures are tried beside the progressive hull.
pub(crate) const FEW_FACES: usize = 60;

/// Void with which the solid's own faces are a hull that no other start can better by more.
const NEXT_TO_NONE: f64 = 1e-4;

/// The most that may be due to the grid's steps.
const NEARLY_NONE: f64 = 1e-2;

/// Half-steps of the grid that keep such a hull off the mesh.
const STEPS_OFF: f64 = 12.0;

/// What a hull is made of.
pub(crate) struct SearchInput<'m> {
    pub mesh: &'m Mesh,
    /// The mesh in the frame of its own coordinates.
    pub stored: &'m Stored,
    /// How the hull is stored.
    pub around: &'m Stored,
}

/// What is done with a start.
struct How {
    rounding: Rounding,
    wanted: usize,
    /// Whether it comes down to the wanted faces, or only up to them.
    descends: bool,
}

impl How {
    /// So few faces that all starts compete, each polished at once: that decides between them.
    fn is_few(&self) -> bool {
        self.descends && self.wanted <= FEW_FACES
    }
}

/// A hull with the wanted number of faces, or as few as can be.
pub(crate) struct CandidateHull<'a> {
    pub editor: HullEditor<'a>,
    pub start: Start,
    pub filled: usize,
    pub stop: Outcome,
}

impl CandidateHull<'_> {
    /// One that reached the goal, then one with fewer faces if either is stuck or a slack is asked
    /// for, then the one nearer to the mesh, or with less volume.
    fn is_better_than(&self, other: &Self) -> bool {
        if let (Outcome::TooLoose, Outcome::TooLoose) = (self.stop, other.stop) {
            return self.editor.slack() < other.editor.slack();
        }
        let rank = |done: &Self| match done.stop {
            Outcome::TooLoose => (2, 0),
            Outcome::Stuck => (1, done.editor.shell.face_count()),
            Outcome::Reached | Outcome::OutOfTime => (
                0,
                if done.editor.has_distance_limit() { done.editor.shell.face_count() } else { 0 },
            ),
        };
        let (ours, theirs) = (rank(self), rank(other));
        ours < theirs || ours == theirs && self.editor.shell.volume() < other.editor.shell.volume()
    }
}

/// Keeps the better of two, and the counts of both.
pub(crate) fn better<'a>(best: &mut Option<CandidateHull<'a>>, mut done: CandidateHull<'a>) {
    match best {
        Some(best) => {
            done.editor.add_counts(&best.editor);
            if done.is_better_than(best) {
                *best = done;
            } else {
                best.editor.take_counts(&done.editor);
            }
        }
        None => *best = Some(done),
    }
}

/// What is known while a hull is made.
pub(crate) struct HullSearch<'a, 'o, 'p> {
    pub obstacle: &'a Obstacle,
    /// The mesh's volume, if it bounds one.
    pub volume: Option<f64>,
    pub solid: Option<Solid>,
    pub options: &'o Options,
    pub deadline: Option<Instant>,
    /// Whether the best start was given up for lack of time.
    pub is_hurried: bool,
    pub on_progress: &'p mut dyn FnMut(Progress),
}

impl<'a> HullSearch<'a, '_, '_> {
    /// What relaxing measures its gains against.
    pub fn floor(&self) -> f64 {
        self.volume.unwrap_or(0.0)
    }

    /// `around` is how the hull is stored.
    pub fn build(
        &mut self,
        mesh: &Mesh,
        stored: &Stored,
        around: &Stored,
    ) -> Result<CandidateHull<'a>, WrapError> {
        let from = SearchInput { mesh, stored, around };
        match self.options.goal {
            Goal::Faces(faces) => self.begin(&from, faces, true),
            Goal::Void(most) => self.least_faces_by_void(&from, most),
            Goal::Slack(most) => self.least_faces_by_slack(&from, most),
        }
    }

    /// Cubes of the first closure where the margin is so large that the mesh's own shape says less
    /// than what is left of it at that distance: then cubes of half the margin show it all.
    pub fn round_cells(&self) -> Option<usize> {
        let margin = self.obstacle.margin();
        let bounds = self.obstacle.bounds();
        let longest = (bounds.high - bounds.low).max_element();
        let cells = (longest + 2.0 * margin) / (0.5 * margin);
        (margin > ROUND * longest).then(|| (cells as usize).clamp(ROUND_CELLS[0], ROUND_CELLS[1]))
    }

    /// The hull of the best start, without polish. A mesh that bounds a volume starts from its
    /// progressive hull, any other from its closure. With few faces left, coarse
    /// closures, which have fewer handles and narrow places, may come to less volume: then all are
    /// tried.
    pub fn begin(
        &mut self,
        &SearchInput { mesh, stored, around }: &SearchInput<'_>,
        wanted: usize,
        descends: bool,
    ) -> Result<CandidateHull<'a>, WrapError> {
        let rounding = Rounding::new(around.grid, around.scale_exponent);
        let place = InitialInput {
            stored: around,
            obstacle: self.obstacle,
            rounding,
            deadline: self.deadline,
        };
        let how = How { rounding, wanted, descends };
        let is_few = how.is_few();
        let is_small = mesh.triangles.len() <= wanted;
        let mut best: Option<CandidateHull<'a>> = None;
        let round = self.round_cells();
        if self.volume.is_some() && round.is_none() {
            // The other half of the time is for what there is instead.
            let half = self.deadline.map(|deadline| {
                let now = Instant::now();
                now + deadline.saturating_duration_since(now) / 2
            });
            let first = lifted_levels(
                &InitialInput { stored, deadline: half, ..place },
                mesh,
                wanted,
                self.on_progress,
            );
            for first in [first.plenty, first.wanted].into_iter().flatten() {
                if !is_small || !best.as_ref().is_some_and(|best| self.is_solid_itself(best)) {
                    let done = self.prepare(first, &how);
                    better(&mut best, done);
                }
            }
            self.is_hurried |= best.is_none() && half.is_some_and(|half| Instant::now() >= half);
        }
        let is_itself = is_small && best.as_ref().is_some_and(|best| self.is_solid_itself(best));
        let is_enough = best.is_some() || round.is_some();
        let finest = Some(finest(wanted));
        // Where the finest has narrow places that its levels grow together in, the grid next to it
        // may do.
        let finer = finest.map(|cells| cells * 2 / 3).filter(|&cells| Some(cells) > COARSER[0]);
        let coarser =
            finer.map(Some).into_iter().chain(COARSER.into_iter().filter(|&cells| cells != finest));
        let first = if self.is_hurried { None } else { Some(finest) };
        for cells in round.map(Some).into_iter().chain(first).chain(coarser) {
            let late = self.is_late();
            if late && best.is_none() && cells.is_some() {
                self.is_hurried = true;
                continue;
            }
            let is_reached = best.as_ref().is_some_and(|best| best.stop != Outcome::Stuck);
            let settled = is_enough && (!is_few || is_itself) && is_reached;
            if best.is_some() && (settled || late) {
                break;
            }
            if is_reached && cells == LAST_RESORT {
                continue;
            }
            let first = match cells {
                Some(cells) => {
                    closure_hull(&place, cells, wanted, Conditions::PAPER, self.on_progress)
                }
                None => grown_box(self.obstacle, &rounding),
            };
            let Some(first) = first else { continue };
            let done = self.prepare(first, &how);
            better(&mut best, done);
        }
        let mut done = best.ok_or_else(|| self.no_room())?;
        if descends && !is_few {
            self.finish(&mut done);
        }
        Ok(done)
    }

    /// Whether a hull that reached its goal has next to no void. One that holds less than the
    /// mesh's volume says nothing: parts overlap.
    fn is_solid_itself(&self, done: &CandidateHull<'a>) -> bool {
        let HullEditor { shell, rounding, .. } = &done.editor;
        let bounds = self.obstacle.bounds();
        let size = bounds.low.abs().max(bounds.high.abs()).max_element();
        let area = shell.alive().map(|f| {
            let [a, b, c] = shell.triangle(f);
            0.5 * (b - a).cross(c - a).length()
        });
        let off = STEPS_OFF * rounding.half_step(size) * area.sum::<f64>();
        let near = |volume: f64| {
            let more = volume * NEXT_TO_NONE + off.min(volume * NEARLY_NONE);
            (volume..=volume + more).contains(&shell.volume())
        };
        done.stop == Outcome::Reached && self.volume.is_some_and(near)
    }

    /// Why there is no start.
    pub fn no_room(&self) -> WrapError {
        if self.obstacle.margin() > 0.0 { WrapError::MarginTooLarge } else { WrapError::NoRoom }
    }

    pub fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Settles a first hull and brings it to the wanted number of faces.
    fn prepare(&mut self, first: InitialHull, how: &How) -> CandidateHull<'a> {
        let InitialHull { shell, start, filled } = first;
        let mut editor = HullEditor::new(self.obstacle, shell, how.rounding, SHAPE);
        editor.deadline = self.deadline;
        for _ in 0..2 {
            editor.sweep();
            editor.flip_all();
        }
        let stop =
            if how.descends { self.descend(&mut editor, how.wanted) } else { Outcome::Reached };
        if how.is_few() && start == Start::Box {
            self.grow(&mut editor, how.wanted);
        }
        editor.refine(how.wanted);
        editor.relax(self.floor(), 1e-2, 4);
        let mut done = CandidateHull { editor, start, filled, stop };
        if how.is_few() && stop == Outcome::Reached {
            self.finish(&mut done);
        }
        done
    }

    fn grow(&mut self, editor: &mut HullEditor<'a>, wanted: usize) {
        let mut faces = GROWTH.0;
        while (faces as usize) < wanted && !editor.is_late() {
            editor.refine(faces as usize);
            editor.relax(self.floor(), 1e-2, 4);
            self.polish(editor, self.options.effort);
            faces *= GROWTH.1;
        }
    }

    fn finish(&mut self, done: &mut CandidateHull<'a>) {
        let polished = self.polish(&mut done.editor, self.options.effort);
        if done.stop == Outcome::Reached {
            done.stop = polished;
        }
    }

    /// Down to so many faces, or as few as can be, without polish.
    pub fn descend(&mut self, editor: &mut HullEditor<'a>, faces: usize) -> Outcome {
        let from = editor.shell.face_count();
        let mut stop = Outcome::Reached;
        while editor.shell.face_count() > faces {
            if editor.is_late() {
                return Outcome::OutOfTime;
            }
            let next = ((editor.shell.face_count() as f64 * STAGE) as usize).max(faces);
            let on_progress = &mut *self.on_progress;
            let mut show = |left: usize| {
                on_progress(Progress {
                    stage: Stage::Wrapping,
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
            editor.relax(self.floor(), 1e-2, 4);
        }
        editor.drop_enclosed();
        stop
    }

    pub fn polish(&mut self, editor: &mut HullEditor<'a>, effort: f64) -> Outcome {
        let on_progress = &mut *self.on_progress;
        Polish::new(editor, effort).run(editor, self.volume.unwrap_or(0.0), |done, of| {
            on_progress(Progress { stage: Stage::Polishing, done: done as usize, of: of as usize });
        });
        editor.drop_enclosed();
        if editor.is_late() { Outcome::OutOfTime } else { Outcome::Reached }
    }
}
