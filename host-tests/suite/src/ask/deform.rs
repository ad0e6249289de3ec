//! Questions to a hull hierarchy that deforms.

pub use meshsweep_core::DeformableHull;
use meshsweep_core::{Budget, Decided, MovedHull, MovedVertex, Pose, QueryError, ScratchEntry};

use super::{Asked, Refused, Subject, closest_point};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place, Point};

/// Entries of the queue: enough for the suite's blob.
const ENTRIES: usize = 128;

/// Vertex records: enough for the suite's blob.
const RECORDS: usize = 256;

/// What the queries need beside the hull, 5 KiB in all.
#[derive(Debug)]
pub struct Scratch {
    queue: [ScratchEntry; ENTRIES],
    records: [MovedVertex; RECORDS],
}

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self { queue: [ScratchEntry::EMPTY; ENTRIES], records: [MovedVertex::EMPTY; RECORDS] }
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for DeformableHull<'t> {
    type Scratch = Scratch;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.rest().scratch_entries() <= ENTRIES && self.vertex_records() <= RECORDS
    }

    asks! { Scratch, |self, place, scratch, observer, fold|
        Arith => ();
        Contents => contents(self, fold);
        Frame => {
            let part = place.share().abs();
            at_frame(self, part, place.far(), scratch, &mut Asked::new(observer, fold));
        };
        Update => {
            let ends = [place.far(), place.far()];
            moved(self, ends, place.far(), scratch, [Some(observer), None], fold);
        };
        Moved => {
            let ends = [place.far(), place.far()];
            moved(self, ends, place.far(), scratch, [None, Some(observer)], fold);
        };
        FrameOverlap => {
            let part = place.share().abs();
            let (rotation, translation) = place.motion();
            let pose = Pose::rigid(rotation, translation);
            frame_overlap(self, part, pose, scratch, &mut Asked::new(observer, fold));
        };
        MovedOverlap => {
            let ends = [place.far(), place.far()];
            let (rotation, translation) = place.motion();
            let pose = Pose::rigid(rotation, translation);
            moved_overlap(self, ends, pose, scratch, observer, fold);
        };
    }
}

/// Opens the hull of a blob that deforms.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<DeformableHull<'_>, Refused> {
    DeformableHull::open(bytes).map_err(Refused::of)
}

/// The surface's box at rest in input units.
#[must_use]
pub fn bounds(hull: &DeformableHull<'_>) -> Bounds {
    hull.rest().bounds()
}

/// Key frames and memory.
pub fn contents(hull: &DeformableHull<'_>, fold: &mut Fold) {
    fold.word(hull.frames());
    fold.word(hull.input_vertices());
    fold.word(hull.vertex_records() as u32);
}

/// The closest point between the first two key frames.
#[inline(never)]
pub fn at_frame(
    hull: &DeformableHull<'_>,
    part: f32,
    p: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let call = || hull.at_frame(part)?.closest_point(p, Budget::EXACT, &mut scratch.queue);
    to.answer(call, closest_point);
}

/// The closest point after a free motion. The vertices are put on an arc between two ends. The
/// observers: of the update, of the question.
#[inline(never)]
pub fn moved(
    hull: &DeformableHull<'_>,
    [a, b]: [Point; 2],
    p: Point,
    scratch: &mut Scratch,
    [update_observer, observer]: [Option<&mut impl Observer>; 2],
    fold: &mut Fold,
) {
    let Scratch { queue, records } = scratch;
    let mut moved = match hull.moved(records) {
        Ok(moved) => moved,
        Err(error) => return super::refusal(fold, error),
    };
    let mut update = || put_on_arc(&mut moved, [a, b]);
    let updated = match update_observer {
        Some(observer) => super::timed(observer, update),
        None => update(),
    };
    if let Err(error) = updated {
        super::refusal(fold, error);
    }
    let call = || moved.closest_point(p, Budget::EXACT, queue);
    match observer {
        Some(observer) => Asked::new(observer, fold).answer(call, closest_point),
        None => Asked::new((), fold).answer(call, closest_point),
    };
}

/// Moves the vertices onto an arc between two ends.
#[inline(never)]
fn put_on_arc(moved: &mut MovedHull<'_, '_>, [a, b]: [Point; 2]) -> Result<(), QueryError> {
    moved.update(|vertex| {
        // Rings of eight vertices, as those of the suite's torus.
        let along = (vertex / 8) as f32 * 0.0625;
        let across = (vertex % 8) as f32 * 0.125;
        let swing = [across, along * along, across * across];
        let mut place = a;
        for ((x, end), swing) in place.iter_mut().zip(b).zip(swing) {
            *x = *x + (end - *x) * along + swing;
        }
        place
    })
}

/// Triangles that an overlap may open.
const STEPS: u32 = 48;

/// Whether the hull at rest, moved by `pose`, meets the one between the first two key frames.
#[inline(never)]
pub fn frame_overlap(
    hull: &DeformableHull<'_>,
    part: f32,
    pose: Pose,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let budget = Budget::EXACT.with_steps(STEPS);
    let call = || hull.at_frame(part)?.overlap(&hull.rest(), pose, budget, &mut scratch.queue);
    to.answer(call, meeting);
}

/// Whether the hull at rest, moved by `pose`, meets the one whose vertices lie on an arc.
#[inline(never)]
pub fn moved_overlap(
    hull: &DeformableHull<'_>,
    ends: [Point; 2],
    pose: Pose,
    scratch: &mut Scratch,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let Scratch { queue, records } = scratch;
    let mut moved = match hull.moved(records) {
        Ok(moved) => moved,
        Err(error) => return super::refusal(fold, error),
    };
    if let Err(error) = put_on_arc(&mut moved, ends) {
        super::refusal(fold, error);
    }
    let budget = Budget::EXACT.with_steps(STEPS);
    let call = || moved.overlap(&hull.rest(), pose, budget, queue);
    Asked::new(observer, fold).answer(call, meeting);
}

fn meeting(fold: &mut Fold, answer: &Decided<[u32; 2]>) {
    let triangles = answer.witness.unwrap_or([u32::MAX; 2]);
    triangles.into_iter().for_each(|number| fold.word(number));
    super::verdict(fold, answer.verdict);
}
