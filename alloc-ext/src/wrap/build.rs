//! From a mesh to its hull: a first hull that is proved to enclose it, then as few faces as wanted, then as tight as they can be.

use super::boxes::Bounds;
use super::obstacle::Obstacle;
use super::options::{Goal, Options, Progress, Report, Stage, Start, Stop, WrapError};
use super::polish::Polish;
use super::rounding::Rounding;
use super::shell::Shell;
use super::slack::slack;
use super::start::{First, first_box, first_closure, first_levels};
use super::work::{Shape, Work};
use crate::mesh::{Mesh, require_closed_manifold};
use crate::precision::{Stored, VertexBits, store};
use glam::DVec3;
use meshsweep_core::num::exp2;
use rustc_hash::FxHashMap;
use std::time::Instant;

/// A hull and what is known of it.
#[derive(Clone, Debug)]
pub struct Hull {
    /// Closed, embedded, counter-clockwise seen from outside; `source` counts from 0.
    pub mesh: Mesh,
    /// What it is, and what it took.
    pub report: Report,
}

/// Conditions while faces are plenty: the hull keeps room to move.
pub(super) const SHAPE: Shape =
    Shape { min_compactness: 0.01, min_turn: 0.25, upright: Some(0.05), max_valence: 24 };

/// Conditions where the first get stuck: whatever is proved will do.
const LOOSE: Shape = Shape { min_compactness: 0.001, min_turn: -0.9, upright: None, max_valence: 48 };

/// Faces that a stage of the way down leaves; the hull is settled before the next.
const STAGE: f64 = 0.7;

/// A hull of any triangles: see the module for what is proved of it.
///
/// Vertices that were moved to a grid before (see [`snap`](crate::precision::snap)) are enclosed where they are in `mesh`.
///
/// # Errors
/// [`WrapError`].
pub fn wrap(mesh: &Mesh, options: &Options, on_progress: impl FnMut(Progress)) -> Result<Hull, WrapError> {
    wrap_all(mesh, &[], options, on_progress)
}

/// As [`wrap`], of a mesh and further triangles, by their corners: those without area that [`repair`](crate::mesh::repair) leaves out, and that are segments or points.
/// They are enclosed as the mesh is, and have no part in what bounds a volume.
///
/// # Errors
/// [`WrapError`].
pub fn wrap_all(
    mesh: &Mesh,
    further: &[[[f32; 3]; 3]],
    options: &Options,
    mut on_progress: impl FnMut(Progress),
) -> Result<Hull, WrapError> {
    let started = Instant::now();
    if mesh.triangles.is_empty() {
        return Err(WrapError::Empty);
    }
    if !(options.margin >= 0.0 && options.margin.is_finite()) {
        return Err(WrapError::BadMargin);
    }
    if matches!(options.goal, Goal::Slack(most) if most <= options.margin) {
        return Err(WrapError::SlackWithinMargin);
    }
    let positions: Vec<DVec3> =
        mesh.positions.iter().map(|&[x, y, z]| glam::Vec3::new(x, y, z).as_dvec3()).collect();
    let solid = require_closed_manifold(mesh).is_ok();
    let volume = if solid { Shell::new(positions.clone(), &mesh.triangles).volume() } else { 0.0 };
    if matches!(options.goal, Goal::Void(_)) && volume <= 0.0 {
        return Err(WrapError::NoVolume);
    }
    // A hull keeps some steps of its grid off the mesh: a coarse one that holds the mesh is no reason to store the hull on it.
    let bits = match options.vertex_bits {
        VertexBits::Auto => VertexBits::F32,
        bits => bits,
    };
    let stored = store(mesh, bits);
    let (positions, triangles) = joined(positions, &mesh.triangles, further);
    let obstacle = Obstacle::new(&positions, &triangles).with_margin(options.margin);
    let around = if further.is_empty() && options.margin <= 0.0 {
        stored.clone()
    } else {
        around(&positions, options.margin, bits)?
    };
    // A grid that the mesh is not on is for the hull alone: what it starts from is the mesh where it is.
    let moved = stored.surface_error > mesh.rounding * exp2(-stored.scale_exponent);
    let stored = if moved { store(mesh, VertexBits::F32) } else { stored };
    let solid = solid && volume > 0.0;
    let mut builder = Builder {
        obstacle: &obstacle,
        volume: solid.then_some(volume),
        options,
        // A limit that the clock has no number for is none.
        deadline: options.time_limit.and_then(|limit| started.checked_add(limit)),
        is_hurried: false,
        on_progress: &mut on_progress,
    };
    let Done { mut work, start, filled, mut stop } = builder.build(mesh, &stored, &around)?;
    work.drop_swallowed();
    if builder.is_hurried && stop == Stop::Reached {
        stop = Stop::OutOfTime;
    }
    let (at, triangles) = work.shell.compact();
    let hull_volume = work.shell.volume();
    let report = Report {
        faces: triangles.len(),
        margin: options.margin,
        volume: hull_volume,
        void: solid.then(|| hull_volume / volume - 1.0),
        slack: slack(&work.shell, &obstacle),
        start,
        filled: filled + work.swallowed,
        stop,
        stars: work.placer.stars,
        programs: work.placer.programs,
        proofs: work.proofs,
        refused: work.refused,
        time: started.elapsed(),
    };
    let single = at.iter().map(|p| p.as_vec3().to_array()).collect();
    Ok(Hull { mesh: Mesh::new(single, triangles), report })
}

/// Positions and triangles with further ones, which share the vertices that are at the same place.
fn joined(
    mut positions: Vec<DVec3>,
    triangles: &[[u32; 3]],
    further: &[[[f32; 3]; 3]],
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut triangles = triangles.to_vec();
    if further.is_empty() {
        return (positions, triangles);
    }
    // Both zeros are one place.
    let place = |p: DVec3| (p + 0.0).to_array().map(f64::to_bits);
    let mut number: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    for (v, &p) in positions.iter().enumerate() {
        number.entry(place(p)).or_insert(v as u32);
    }
    for corners in further {
        triangles.push(corners.map(|[x, y, z]| {
            let p = glam::Vec3::new(x, y, z).as_dvec3();
            *number.entry(place(p)).or_insert_with(|| {
                positions.push(p);
                positions.len() as u32 - 1
            })
        }));
    }
    (positions, triangles)
}

/// The frame and the format of coordinates that hold all positions, or their box with the margin around it.
fn around(positions: &[DVec3], margin: f64, bits: VertexBits) -> Result<Stored, WrapError> {
    let single = |p: &[DVec3]| p.iter().map(|p| p.as_vec3().to_array()).collect();
    if margin <= 0.0 {
        return Ok(store(&Mesh::new(single(positions), Vec::new()), bits));
    }
    let bounds = Bounds::of(positions).grown(margin);
    let corners = [bounds.low, bounds.high];
    if !corners.iter().all(|p| p.as_vec3().is_finite()) {
        return Err(WrapError::MarginTooLarge);
    }
    // The mesh's own grid says nothing about the places that a margin asks for.
    let bits = if bits == VertexBits::Auto { VertexBits::F32 } else { bits };
    Ok(store(&Mesh::new(single(&corners), Vec::new()), bits))
}

/// Faces that a search for the fewest begins with.
const FINEST: usize = 2000;

/// Cubes along the longest side of closures, in the order in which they are tried after the [`finest`]; `None` is the box.
const COARSER: [Option<usize>; 4] = [Some(40), Some(16), Some(6), None];

/// Cubes along the longest side of the finest closure for so many faces: gaps of a cube are filled for good, and faces that could follow them would be
/// there for nothing. Beyond 160 the grid takes more time than the hull.
fn finest(wanted: usize) -> usize {
    let cells = (40.0 * (wanted as f64 / 200.0).sqrt()) as usize;
    cells.clamp(40, 160)
}

/// Part of the mesh's longest side from which on a margin is round: a few cubes of the first closure.
const ROUND: f64 = 0.02;

/// Least and most cubes along its longest side.
const ROUND_CELLS: [usize; 2] = [12, 32];

/// Faces up to which closures are tried beside the progressive hull.
const FEW_FACES: usize = 60;

/// A hull with the wanted number of faces, or as few as can be.
struct Done<'a> {
    work: Work<'a>,
    start: Start,
    filled: usize,
    stop: Stop,
}

impl Done<'_> {
    /// One that came down to the faces first, then the one with less volume.
    fn is_better_than(&self, other: &Self) -> bool {
        let stuck = (self.stop == Stop::Stuck, other.stop == Stop::Stuck);
        match stuck {
            (false, true) => true,
            (true, false) => false,
            (true, true) => self.work.shell.face_count() < other.work.shell.face_count(),
            (false, false) => self.work.shell.volume() < other.work.shell.volume(),
        }
    }
}

/// Keeps the better of two, and the counts of both.
fn better<'a>(best: &mut Option<Done<'a>>, mut done: Done<'a>) {
    match best {
        Some(best) => {
            done.work.add_counts(&best.work);
            if done.is_better_than(best) {
                *best = done;
            } else {
                best.work.take_counts(&done.work);
            }
        }
        None => *best = Some(done),
    }
}

struct Builder<'a, 'o, 'p> {
    obstacle: &'a Obstacle,
    volume: Option<f64>,
    options: &'o Options,
    deadline: Option<Instant>,
    /// Whether the best start was given up for lack of time.
    is_hurried: bool,
    on_progress: &'p mut dyn FnMut(Progress),
}

impl<'a> Builder<'a, '_, '_> {
    /// What relaxing measures its gains against.
    fn floor(&self) -> f64 {
        self.volume.unwrap_or(0.0)
    }

    /// `around` is how the hull is stored.
    fn build(&mut self, mesh: &Mesh, stored: &Stored, around: &Stored) -> Result<Done<'a>, WrapError> {
        if let Goal::Faces(faces) = self.options.goal {
            let mut done = self.begin(mesh, stored, around, faces)?;
            let polished = self.polish(&mut done.work, self.options.effort);
            if done.stop == Stop::Reached {
                done.stop = polished;
            }
            return Ok(done);
        }
        let mut faces = FINEST;
        let mut done = self.begin(mesh, stored, around, faces)?;
        while !self.is_tight(&done.work) && faces < mesh.triangles.len() && !done.work.is_late() {
            faces = faces.saturating_mul(4);
            done = self.begin(mesh, stored, around, faces)?;
        }
        (done.work, done.stop) = self.fewest(done.work);
        Ok(done)
    }

    /// Cubes of the first closure where the margin is so large that the mesh's own shape says less than what is left of it at that distance: then cubes
    /// of half the margin show it all.
    fn round_cells(&self) -> Option<usize> {
        let margin = self.obstacle.margin();
        let bounds = self.obstacle.bounds();
        let longest = (bounds.high - bounds.low).max_element();
        let cells = (longest + 2.0 * margin) / (0.5 * margin);
        (margin > ROUND * longest).then(|| (cells as usize).clamp(ROUND_CELLS[0], ROUND_CELLS[1]))
    }

    /// The hull of the best start, without polish. A mesh that bounds a volume starts from its progressive hull, any other from its closure. With few faces left, coarse
    /// closures, which have fewer handles and narrow places, may come to less volume: then all are tried.
    fn begin(
        &mut self,
        mesh: &Mesh,
        stored: &Stored,
        around: &Stored,
        wanted: usize,
    ) -> Result<Done<'a>, WrapError> {
        let rounding = Rounding::new(around.grid, around.scale_exponent);
        let mut best: Option<Done<'a>> = None;
        let round = self.round_cells();
        if self.volume.is_some() && round.is_none() {
            // The other half of the time is for what there is instead.
            let half = self.deadline.map(|deadline| {
                let now = Instant::now();
                now + deadline.saturating_duration_since(now) / 2
            });
            let first = first_levels(mesh, stored, self.obstacle, &rounding, wanted, half, self.on_progress);
            for first in [first.plenty, first.wanted].into_iter().flatten() {
                let done = self.prepare(first, rounding, wanted);
                better(&mut best, done);
            }
            self.is_hurried |= best.is_none() && half.is_some_and(|half| Instant::now() >= half);
        }
        let is_few = matches!(self.options.goal, Goal::Faces(faces) if faces <= FEW_FACES);
        let is_enough = best.is_some() || round.is_some();
        let finest = Some(finest(wanted));
        let coarser = COARSER.into_iter().filter(|&cells| cells != finest);
        let first = if self.is_hurried { None } else { Some(finest) };
        for cells in round.map(Some).into_iter().chain(first).chain(coarser) {
            let late = self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
            if late && best.is_none() && cells.is_some() {
                self.is_hurried = true;
                continue;
            }
            let settled = is_enough && !is_few && best.as_ref().is_some_and(|best| best.stop != Stop::Stuck);
            if best.is_some() && (settled || late) {
                break;
            }
            let first = match cells {
                Some(cells) => {
                    first_closure(around, self.obstacle, &rounding, cells, wanted, self.on_progress)
                }
                None => first_box(self.obstacle, &rounding),
            };
            let Some(first) = first else { continue };
            let done = self.prepare(first, rounding, wanted);
            better(&mut best, done);
        }
        let margin = self.obstacle.margin();
        best.ok_or(if margin > 0.0 { WrapError::MarginTooLarge } else { WrapError::NoRoom })
    }

    /// Settles a first hull and brings it to the wanted number of faces, without polish.
    fn prepare(&mut self, first: First, rounding: Rounding, wanted: usize) -> Done<'a> {
        let First { shell, start, filled } = first;
        let mut work = Work::new(self.obstacle, shell, rounding, SHAPE);
        work.deadline = self.deadline;
        for _ in 0..2 {
            work.sweep();
            work.flip_all();
        }
        let stop = match self.options.goal {
            Goal::Faces(_) => self.descend(&mut work, wanted),
            Goal::Void(_) | Goal::Slack(_) => Stop::Reached,
        };
        work.refine(wanted);
        work.relax(self.floor(), 1e-2, 4);
        Done { work, start, filled, stop }
    }

    /// Down to so many faces, or as few as can be, without polish.
    fn descend(&mut self, work: &mut Work<'a>, faces: usize) -> Stop {
        let from = work.shell.face_count();
        let mut stop = Stop::Reached;
        while work.shell.face_count() > faces {
            if work.is_late() {
                return Stop::OutOfTime;
            }
            let next = ((work.shell.face_count() as f64 * STAGE) as usize).max(faces);
            let on_progress = &mut *self.on_progress;
            let mut show = |left: usize| {
                on_progress(Progress {
                    stage: Stage::Wrapping,
                    done: from.saturating_sub(left),
                    of: from.saturating_sub(faces),
                });
            };
            let mut reached = work.decimate(next, &mut show);
            if !reached && work.is_late() {
                return Stop::OutOfTime;
            }
            if !reached && work.shape != LOOSE {
                work.shape = LOOSE;
                reached = work.decimate(next, &mut show);
            }
            if !reached {
                stop = Stop::Stuck;
                break;
            }
            work.relax(self.floor(), 1e-2, 4);
        }
        work.drop_swallowed();
        stop
    }

    fn polish(&mut self, work: &mut Work<'a>, effort: f64) -> Stop {
        let on_progress = &mut *self.on_progress;
        Polish::new(work, effort).run(work, self.volume.unwrap_or(0.0), |done, of| {
            on_progress(Progress { stage: Stage::Polishing, done: done as usize, of: of as usize });
        });
        work.drop_swallowed();
        if work.is_late() { Stop::OutOfTime } else { Stop::Reached }
    }

    /// Whether a hull is as tight as asked for.
    fn is_tight(&self, work: &Work<'a>) -> bool {
        match self.options.goal {
            Goal::Faces(_) => true,
            Goal::Void(most) => {
                self.volume.is_some_and(|volume| work.shell.volume() <= volume * (1.0 + most))
            }
            Goal::Slack(most) => slack(&work.shell, self.obstacle).upper <= most,
        }
    }

    /// The hull with the fewest faces that is tight: down in stages as long as it is, then halving the last step.
    fn fewest(&mut self, mut work: Work<'a>) -> (Work<'a>, Stop) {
        if !self.is_tight(&work) {
            self.polish(&mut work, self.options.effort);
            if !self.is_tight(&work) {
                let stop = if work.is_late() { Stop::OutOfTime } else { Stop::TooLoose };
                return (work, stop);
            }
        }
        let mut best = work;
        let mut too_few = 3;
        loop {
            let faces = best.shell.face_count();
            let staged = (faces as f64 * STAGE) as usize;
            let next = if staged > too_few { staged } else { usize::midpoint(faces, too_few) };
            // A hull has an even number of faces.
            let next = next & !1;
            if next <= too_few || next >= faces || faces - next < (faces / NEAR_ENOUGH).max(2) {
                return (best, Stop::Reached);
            }
            let mut trial = best.clone();
            let stop = self.descend(&mut trial, next);
            if stop == Stop::OutOfTime || trial.is_late() {
                return (best, Stop::OutOfTime);
            }
            if trial.shell.face_count() >= faces {
                return (best, Stop::Stuck);
            }
            if stop == Stop::Reached && !self.is_tight(&trial) {
                self.polish(&mut trial, self.options.effort);
            }
            if self.is_tight(&trial) {
                best = trial;
            } else {
                best.take_counts(&trial);
                too_few = next;
            }
        }
    }
}

/// A search for the fewest faces ends when the next step would save less than one in this many.
const NEAR_ENOUGH: usize = 25;
