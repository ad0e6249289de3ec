//! Questions to the curves of a blob.

pub use meshsweep_core::Curve;
use meshsweep_core::{
    Budget, CurveClosest, CurveNeighbor, CurveSegment, CurveSignedDistance, Decided, ScratchEntry,
    Side,
};

use super::{Asked, Refused, Subject, how, verdict};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place, Point};

/// Entries of the queue: enough for the suite's blobs, and some to go best first.
const ENTRIES: usize = 64;
/// Room for segments.
const NEIGHBORS: usize = 4;

/// What the queries need beside the curve.
pub type Scratch = meshsweep_core::Scratch<ENTRIES>;

impl<'t> Subject<'t> for Curve<'t> {
    type Scratch = Scratch;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.scratch_entries() <= ENTRIES
    }

    fn memory(&self) -> usize {
        size_of::<Curve<'_>>() + self.scratch_entries().saturating_mul(size_of::<ScratchEntry>())
    }

    asks! { Scratch, |self, place, scratch, to|
        Arith => ();
        Contents => contents(self, to.fold);
        ClosestFar => {
            closest(self, place.far(), scratch, to);
        };
        ClosestNear => {
            let base = closest(self, place.far(), scratch, &mut Asked::new((), to.fold));
            closest(self, place.near(base), scratch, to);
        };
        ClosestPath => {
            closest(self, place.step(), scratch, to);
        };
        Stopped => stopped(self, place.far(), place.distance(), scratch, to);
        Within => is_within(self, place.far(), place.distance(), scratch, to);
        Nearest => nearest(self, place.far(), scratch, to);
        AllWithin => all_within(self, place.far(), place.distance(), scratch, to);
        Signed => signed(self, place.far(), scratch, to);
        Sweep => {
            let from = place.far();
            sweep(self, [from, place.near(from), place.far()], scratch, to);
        };
    }
}

/// Opens the curves of a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
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

pub(super) fn closest_point(fold: &mut Fold, answer: &CurveClosest) {
    fold.f32(answer.distance.lower);
    fold.f32(answer.distance.upper);
    fold.point(answer.point);
    segment(fold, Some(answer.segment));
    fold.f32(answer.t);
    fold.f32(answer.safe_motion);
    how(fold, answer.ended);
}

fn segment(fold: &mut Fold, segment: Option<CurveSegment>) {
    let (polyline, segment) = segment.map_or((u32::MAX, u32::MAX), |at| (at.polyline, at.segment));
    fold.word(polyline);
    fold.word(segment);
}

/// The closest point; returns it.
#[inline(never)]
pub fn closest(
    curve: &Curve<'_>,
    p: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) -> Point {
    let call = || curve.closest_point(p, Budget::EXACT, scratch);
    to.answer(call, closest_point).map_or(p, |answer| answer.point)
}

/// The closest point with a tolerance, and in too few steps with one entry.
#[inline(never)]
pub fn stopped(
    curve: &Curve<'_>,
    p: Point,
    absolute: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let tolerant = Budget::EXACT.with_relative(0.1).with_absolute(absolute);
    let brief = Budget::EXACT.with_steps(9);
    for (budget, entries) in [(tolerant, ENTRIES), (brief, 1)] {
        let queue = scratch.get_mut(..entries).unwrap_or_default();
        to.answer(|| curve.closest_point(p, budget, queue), closest_point);
    }
}

/// The closest point by a search that is kept: in a few steps, and after two motions.
#[inline(never)]
pub fn sweep(
    curve: &Curve<'_>,
    [p, near, far]: [Point; 3],
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let Ok(mut sweep) = curve.sweep(p, scratch) else { return to.fold.word(u32::MAX) };
    for (point, steps) in [(p, 9), (p, u32::MAX), (near, u32::MAX), (far, u32::MAX)] {
        let budget = Budget::EXACT.with_steps(steps);
        let ask = || {
            sweep.move_to(point)?;
            sweep.closest_point(budget)
        };
        to.answer(ask, closest_point);
    }
}

/// Whether the curve is within a distance.
#[inline(never)]
pub fn is_within(
    curve: &Curve<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    to.answer(|| curve.within(p, distance, Budget::EXACT, scratch), of_verdict);
}

pub(super) fn of_verdict(fold: &mut Fold, answer: &Decided<CurveSegment>) {
    segment(fold, answer.witness);
    verdict(fold, answer.verdict);
}

/// Whether the fence allows a point, and how far its line is.
#[inline(never)]
pub fn signed(
    curve: &Curve<'_>,
    [x, y, _]: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    to.answer(|| curve.signed_distance([x, y], Budget::EXACT, scratch), signed_distance);
}

pub(super) fn signed_distance(fold: &mut Fold, answer: &CurveSignedDistance) {
    fold.f32(answer.distance.lower);
    fold.f32(answer.distance.upper);
    fold.word(match answer.side {
        Side::Outside => 1,
        Side::Inside => 2,
        _ => 0,
    });
    closest_point(fold, &answer.closest);
}

fn neighbors(fold: &mut Fold, found: &[CurveNeighbor]) {
    for near in found {
        fold.f32(near.distance().lower);
        fold.f32(near.distance().upper);
        fold.point(near.point());
        segment(fold, Some(near.segment()));
        fold.f32(near.t());
    }
}

/// The closest segments.
#[inline(never)]
pub fn nearest(
    curve: &Curve<'_>,
    p: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let mut out = [CurveNeighbor::EMPTY; NEIGHBORS];
    let answer = to.answer(
        || curve.nearest(p, &mut out, Budget::EXACT, scratch),
        |fold, answer| {
            fold.f32(answer.rest_lower);
            how(fold, answer.ended);
        },
    );
    let stored = answer.map_or(0, |answer| answer.stored);
    neighbors(to.fold, out.get(..stored).unwrap_or_default());
}

/// All segments within a distance.
#[inline(never)]
pub fn all_within(
    curve: &Curve<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let mut out = [CurveNeighbor::EMPTY; NEIGHBORS];
    let answer = to.answer(
        || curve.all_within(p, distance, &mut out, Budget::EXACT, scratch),
        |fold, answer| {
            fold.word(answer.certain as u32);
            fold.word(answer.dropped);
            how(fold, answer.ended);
        },
    );
    let stored = answer.map_or(0, |answer| answer.stored);
    neighbors(to.fold, out.get(..stored).unwrap_or_default());
}
