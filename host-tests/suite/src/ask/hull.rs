//! Questions to the hull hierarchy.

pub use meshsweep_core::Focus;
use meshsweep_core::{
    Blob, Budget, Hit, Hull, OuterSearch, RefinedHull, ScratchEntry, SplitChange, TriangleHit,
};

use super::{Refused, Subject, timed};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place};

/// A blob, and its hull hierarchy.
#[derive(Clone, Copy, Debug)]
pub struct Model<'t> {
    blob: Blob<'t>,
    pub(super) hull: Hull<'t>,
}

/// Entries of the queue.
const QUEUE: usize = 256;

/// Splits of the refined hull.
const SPLITS: usize = 256;

/// What the queries need beside the model, 7 KiB in all.
#[derive(Debug)]
pub struct Scratch<'t> {
    queue: [ScratchEntry; QUEUE],
    hits: [Hit; 16],
    met: [TriangleHit; 16],
    refined: RefinedHull<'t, SPLITS>,
    changes: [SplitChange; 64],
}

impl Scratch<'_> {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            queue: [ScratchEntry::EMPTY; QUEUE],
            hits: [Hit::EMPTY; 16],
            met: [TriangleHit::EMPTY; 16],
            refined: RefinedHull::new(),
            changes: [SplitChange::EMPTY; 64],
        }
    }
}

impl Default for Scratch<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Model<'t> {
    type Scratch = Scratch<'t>;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.hull.scratch_entries() <= QUEUE
    }

    asks! { Scratch<'t>, |self, place, scratch, observer, fold|
        Arith => ();
        Contents => contents(self, fold);
        ClosestFar => {
            closest(self, place.far(), scratch, observer, fold);
        };
        ClosestNear => {
            // The base is an answer: a wrong one shows in this block already, so its
            // consequences mislead nobody.
            let base = closest(self, place.far(), scratch, &mut (), fold);
            closest(self, place.near(base), scratch, observer, fold);
        };
        ClosestPath => {
            closest(self, place.step(), scratch, observer, fold);
        };
        FirstHit => first_hit(self, place.segment(), scratch, observer, fold);
        AllHits => all_hits(self, place.segment(), scratch, observer, fold);
        Ray => ray(self, place.segment(), scratch, observer, fold);
        OuterHits => outer_hits(self, place.segment(), scratch, observer, fold);
        Refine => {
            let (focus, error) = focus(self, place);
            refine(self, &focus, error, scratch, observer, fold);
        };
    }
}

/// Opens a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<Model<'_>, Refused> {
    let blob = Blob::open(bytes).map_err(Refused::of)?;
    let hull = blob.hull().map_err(|_| Refused::NO_SECTION)?;
    Ok(Model { blob, hull })
}

/// The surface's box in input units.
#[must_use]
pub fn bounds(model: &Model<'_>) -> Bounds {
    model.hull.bounds()
}

/// Sections, levels and the faces of every hull.
pub fn contents(model: &Model<'_>, fold: &mut Fold) {
    for section in model.blob.sections() {
        fold.word(section.kind as u32);
        fold.word(section.crc);
    }
    for level in model.hull.levels() {
        fold.word(level.faces);
        fold.f32(level.hull_to_surface);
        for face in model.hull.faces(&level) {
            fold.f32(face.radius);
            for corner in face.corners {
                if let Some(position) = model.hull.position(corner) {
                    fold.point(position.to_array());
                }
            }
        }
    }
}

/// Closest point; returns the witness.
#[inline(never)]
pub fn closest(
    model: &Model<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    observer: &mut impl Observer,
    fold: &mut Fold,
) -> [f32; 3] {
    match timed(observer, || model.hull.closest_point(point, Budget::EXACT, &mut scratch.queue)) {
        Ok(answer) => {
            super::closest_point(fold, &answer);
            answer.point
        }
        Err(error) => {
            super::refusal(fold, error);
            point
        }
    }
}

/// First point of the segment from `a` to `b` on the surface.
#[inline(never)]
pub fn first_hit(
    model: &Model<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    match timed(observer, || model.hull.first_hit(a, b, Budget::EXACT, &mut scratch.queue)) {
        Ok(answer) => super::segment_hit(fold, &answer),
        Err(error) => super::refusal(fold, error),
    }
}

/// First point of the ray through two points on the surface.
#[inline(never)]
pub fn ray(
    model: &Model<'_>,
    [from, through]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let ([x, y, z], [a, b, c]) = (through, from);
    let (way, queue) = ([x - a, y - b, z - c], &mut scratch.queue);
    match timed(observer, || model.hull.first_hit_of_ray(from, way, Budget::EXACT, queue)) {
        Ok(answer) => super::segment_hit(fold, &answer),
        Err(error) => super::refusal(fold, error),
    }
}

/// Every point of the segment from `a` to `b` on the surface.
#[inline(never)]
pub fn all_hits(
    model: &Model<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    match timed(observer, || {
        model.hull.all_hits(a, b, &mut scratch.met, Budget::EXACT, &mut scratch.queue)
    }) {
        Ok(answer) => {
            super::listed(fold, scratch.met.get(..answer.stored).unwrap_or_default());
            fold.word(answer.dropped);
            super::how(fold, answer.ended);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// The hits of the segment from `a` to `b` that the refined hull finds from outside: from the base
/// hull, then from the hull that this leaves.
#[inline(never)]
pub fn outer_hits<'t>(
    model: &Model<'t>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'t>,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let Scratch { queue, hits: found, refined, .. } = scratch;
    timed(observer, || {
        refined.reset();
        for search in [OuterSearch::First, OuterSearch::Outer] {
            match model.hull.outer_hits(a, b, search, refined, found, Budget::EXACT, queue) {
                Ok(answer) => {
                    fold.f32(answer.t.lower);
                    fold.f32(answer.t.upper);
                    super::hits(fold, found.get(..answer.stored).unwrap_or_default());
                    fold.word(answer.dropped);
                    fold.word(u32::from(answer.starts_inside));
                    super::how(fold, answer.ended);
                }
                Err(error) => super::refusal(fold, error),
            }
        }
    });
}

/// The focus of a path that seldom jumps, half of the time a ball; and the error.
fn focus(model: &Model<'_>, place: &mut impl Place) -> (Focus, f32) {
    let [least, greatest] = bounds(model);
    let size = greatest[0] - least[0];
    let here = place.step_or_jump();
    let focus = match place.word() & 7 {
        0 => Focus::Box { a: here, b: place.near(here) },
        1 => Focus::Segment { a: here, b: place.far(), radius: size / 64.0 },
        2 => Focus::Eye {
            position: here,
            axis: core::array::from_fn(|_| place.share()),
            cosine: place.share(),
            error_per_distance: 0.03125,
        },
        3 => Focus::Everywhere,
        _ => Focus::Ball { centre: here, radius: size / 8.0 },
    };
    (focus, if focus == Focus::Everywhere { size / 64.0 } else { size / 1024.0 })
}

/// The hull that a focus needs: the update, its changes, and all faces.
#[inline(never)]
pub fn refine<'t>(
    model: &Model<'t>,
    focus: &Focus,
    error: f32,
    scratch: &mut Scratch<'t>,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let Scratch { refined, changes, .. } = scratch;
    match timed(observer, || refined.update(&model.hull, focus, error, changes)) {
        Ok(update) => {
            for word in [update.faces, update.performed, update.undone, update.dropped] {
                fold.word(word);
            }
            fold.f32(update.error_left);
            for change in changes.get(..update.stored).unwrap_or_default() {
                change.removed(&model.hull).flatten().for_each(|corner| fold.word(corner.0));
            }
        }
        Err(error) => super::refusal(fold, error),
    }
    for face in refined.faces(&model.hull) {
        face.corners.into_iter().for_each(|corner| fold.word(corner.0));
    }
}
