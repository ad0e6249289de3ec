//! Questions to the split hierarchy.

pub use meshsweep_core::Hull;
use meshsweep_core::ScratchEntry;
use meshsweep_core::internal::format::Header;
use meshsweep_core::{Budget, Hit, Search};
use meshsweep_core::{Face, RefinedHull};

use super::{Refused, Subject, timed};
use crate::fold::Fold;
use crate::place::{Bounds, Placer};
use crate::{Clock, Kind};

/// Entries of the queue.
const QUEUE: usize = 256;

/// Words of each bit set of the front: 2,048 splits.
const FRONT_WORDS: usize = 64;

/// What the queries need beside the model, 4 KiB in all.
#[derive(Debug)]
pub struct Scratch {
    queue: [ScratchEntry; QUEUE],
    hits: [Hit; 16],
    performed: [u32; FRONT_WORDS],
    swept: [u32; FRONT_WORDS],
    candidates: [Face; 64],
}

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            queue: [ScratchEntry::EMPTY; QUEUE],
            hits: [Hit::EMPTY; 16],
            performed: [0; FRONT_WORDS],
            swept: [0; FRONT_WORDS],
            candidates: [Face::EMPTY; 64],
        }
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Hull<'t> {
    type Scratch = Scratch;

    fn open(bytes: &'t [u8]) -> Result<Self, Refused> {
        open(bytes)
    }

    fn bounds(&self) -> Bounds {
        bounds(self)
    }

    fn memory_suffices(&self) -> bool {
        let needed = self.capacities();
        needed.queue <= QUEUE && needed.front_words <= FRONT_WORDS
    }

    fn memory(&self) -> usize {
        size_of::<Scratch>()
    }

    fn suits(kind: Kind) -> bool {
        matches!(
            kind,
            Kind::Arith
                | Kind::Contents
                | Kind::ClosestFar
                | Kind::ClosestNear
                | Kind::ClosestPath
                | Kind::FirstHit
                | Kind::AllHits
                | Kind::OuterHits
        )
    }

    fn ask(
        &self,
        kind: Kind,
        place: &mut Placer,
        scratch: &mut Scratch,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        match kind {
            Kind::Contents => contents(self, fold),
            Kind::ClosestFar => {
                closest(self, place.far(), scratch, clock, fold);
            }
            Kind::ClosestNear => {
                // The base is an answer: a wrong one shows in this block already, so its
                // consequences mislead nobody.
                let base = closest(self, place.far(), scratch, &mut (), fold);
                closest(self, place.near(base), scratch, clock, fold);
            }
            Kind::ClosestPath => {
                closest(self, place.step(), scratch, clock, fold);
            }
            Kind::FirstHit => first_hit(self, place.segment(), scratch, clock, fold),
            Kind::AllHits => all_hits(self, place.segment(), scratch, clock, fold),
            Kind::OuterHits => outer_hits(self, place.segment(), scratch, clock, fold),
            _ => {}
        }
    }
}

/// Opens a blob.
///
/// # Errors
/// The core's refusal.
pub fn open(bytes: &[u8]) -> Result<Hull<'_>, Refused> {
    Hull::open(bytes).map_err(Refused::of)
}

/// The surface's box in input units.
#[must_use]
pub fn bounds(model: &Hull<'_>) -> Bounds {
    let Header { surface_box, .. } = *model.header();
    // A power of two: exact unless the box leaves f32's normal range, and then rounded alike
    // everywhere.
    let scale = model.scale();
    [surface_box.min, surface_box.max]
        .map(|corner| corner.as_dvec3().to_array().map(|x| (x * scale) as f32))
}

/// Sections, levels and the faces of every hull.
pub fn contents(model: &Hull<'_>, fold: &mut Fold) {
    for section in model.sections() {
        fold.word(section.kind as u32);
        fold.word(section.crc);
    }
    for level in model.levels() {
        fold.word(level.faces);
        fold.f32(level.hull_to_surface);
        for face in model.faces(&level) {
            fold.f32(face.radius);
            for corner in face.corners {
                if let Some(position) = model.position(corner) {
                    fold.point(position.to_array());
                }
            }
        }
    }
}

/// Closest point; returns the witness.
pub fn closest(
    model: &Hull<'_>,
    point: [f32; 3],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) -> [f32; 3] {
    match timed(clock, || model.closest_point(point, Budget::EXACT, &mut scratch.queue)) {
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
pub fn first_hit(
    model: &Hull<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || model.first_hit(a, b, Budget::EXACT, &mut scratch.queue)) {
        Ok(answer) => super::segment_hit(fold, &answer),
        Err(error) => super::refusal(fold, error),
    }
}

/// Every point of the segment from `a` to `b` on the surface.
pub fn all_hits(
    model: &Hull<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || {
        model.all_hits(a, b, &mut scratch.hits, Budget::EXACT, &mut scratch.queue)
    }) {
        Ok(answer) => {
            super::hits(fold, scratch.hits.get(..answer.stored).unwrap_or_default());
            fold.word(answer.dropped);
            super::how(fold, answer.work, answer.ended);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// The hits of the segment from `a` to `b` that the refined hull finds from outside.
pub fn outer_hits(
    model: &Hull<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { hits: found, performed, swept, candidates, .. } = scratch;
    let mut ask = |search| {
        let mut front = RefinedHull::new(performed, swept, candidates);
        match model.outer_hits(a, b, search, &mut front, found, Budget::EXACT) {
            Ok(answer) => {
                fold.f32(answer.lower);
                fold.f32(answer.upper);
                super::hits(fold, found.get(..answer.stored).unwrap_or_default());
                fold.word(answer.dropped);
                fold.word(u32::from(answer.starts_inside));
                super::how(fold, answer.work, answer.ended);
            }
            Err(error) => super::refusal(fold, error),
        }
    };
    timed(clock, || {
        ask(Search::First);
        ask(Search::Outer);
    });
}
