//! Questions to the curves of a blob.

pub use meshsweep_core::Curve;
use meshsweep_core::{Budget, CurveClosest, CurveSegment, QueryError, ScratchEntry};

use super::{Refused, Subject, how, refusal, timed, verdict};
use crate::fold::Fold;
use crate::place::{Bounds, Placer};
use crate::{Clock, Kind};

/// Entries of the queue: enough for the suite's blobs, and some to go best first.
const ENTRIES: usize = 64;

/// What the queries need beside the curve.
#[derive(Debug)]
pub struct Scratch([ScratchEntry; ENTRIES]);

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self([ScratchEntry::EMPTY; ENTRIES])
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Curve<'t> {
    type Scratch = Scratch;

    fn open(bytes: &'t [u8]) -> Result<Self, Refused> {
        open(bytes)
    }

    fn bounds(&self) -> Bounds {
        bounds(self)
    }

    fn memory_suffices(&self) -> bool {
        self.scratch_entries() <= ENTRIES
    }

    fn memory(&self) -> usize {
        size_of::<Curve<'_>>() + self.scratch_entries().saturating_mul(size_of::<ScratchEntry>())
    }

    fn suits(kind: Kind) -> bool {
        matches!(
            kind,
            Kind::Arith
                | Kind::Contents
                | Kind::ClosestFar
                | Kind::ClosestNear
                | Kind::ClosestPath
                | Kind::Stopped
                | Kind::Within
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
                let base = closest(self, place.far(), scratch, &mut (), fold);
                closest(self, place.near(base), scratch, clock, fold);
            }
            Kind::ClosestPath => {
                closest(self, place.step(), scratch, clock, fold);
            }
            Kind::Stopped => stopped(self, place.far(), place.distance(), scratch, clock, fold),
            Kind::Within => is_within(self, place.far(), place.distance(), scratch, clock, fold),
            _ => {}
        }
    }
}

/// Opens the curves of a blob.
///
/// # Errors
/// The core's refusal.
pub fn open(bytes: &[u8]) -> Result<Curve<'_>, Refused> {
    Curve::open(bytes).map_err(Refused::of)
}

/// The box of all points.
#[must_use]
pub fn bounds(curve: &Curve<'_>) -> Bounds {
    curve.bounds()
}

/// Polylines, error and memory.
pub fn contents(curve: &Curve<'_>, fold: &mut Fold) {
    fold.word(curve.segment_count());
    fold.word(curve.scratch_entries() as u32);
    fold.word(u32::from(curve.is_planar()));
    for polyline in 0..curve.polyline_count() {
        fold.word(u32::from(curve.is_closed(polyline) == Some(true)));
    }
    fold.f32(curve.surface_error());
}

/// The answer's point.
fn answered(fold: &mut Fold, answer: Result<CurveClosest, QueryError>) -> [f32; 3] {
    match answer {
        Ok(near) => {
            fold.f32(near.distance.lower);
            fold.f32(near.distance.upper);
            fold.point(near.point);
            segment(fold, Some(near.segment));
            fold.f32(near.t);
            fold.f32(near.safe_motion);
            how(fold, near.work, near.ended);
            near.point
        }
        Err(error) => {
            refusal(fold, error);
            [0.0; 3]
        }
    }
}

fn segment(fold: &mut Fold, segment: Option<CurveSegment>) {
    let (polyline, segment) = segment.map_or((u32::MAX, u32::MAX), |at| (at.polyline, at.segment));
    fold.word(polyline);
    fold.word(segment);
}

/// The closest point.
#[inline(never)]
pub fn closest(
    curve: &Curve<'_>,
    point: [f32; 3],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) -> [f32; 3] {
    let answer = timed(clock, || curve.closest_point(point, Budget::EXACT, &mut scratch.0));
    answered(fold, answer)
}

/// The closest point with a tolerance, and in too few steps with one entry.
#[inline(never)]
pub fn stopped(
    curve: &Curve<'_>,
    point: [f32; 3],
    absolute: f32,
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let tolerant = Budget::EXACT.with_relative(0.1).with_absolute(absolute);
    let answer = timed(clock, || curve.closest_point(point, tolerant, &mut scratch.0));
    answered(fold, answer);
    let short = scratch.0.get_mut(..1).unwrap_or_default();
    answered(fold, curve.closest_point(point, Budget::EXACT.with_steps(9), short));
}

/// Whether the curve is within a distance.
#[inline(never)]
pub fn is_within(
    curve: &Curve<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || curve.within(point, distance, Budget::EXACT, &mut scratch.0)) {
        Ok(answer) => {
            segment(fold, answer.segment);
            verdict(fold, answer.work, answer.verdict);
        }
        Err(error) => refusal(fold, error),
    }
}
