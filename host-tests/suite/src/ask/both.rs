//! Questions to the box tree and the distance field of one blob, the field first.

pub use meshsweep_core::BvhWithSdf;
use meshsweep_core::{
    Budget, DistanceBounds, FirstHit, QueryError, ScratchEntry, Side, SignedBounds, Solid,
};

use super::{Asked, Refused, Subject, sdf, tree, verdict};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Ends, Place, Point};

/// Entries of the stack.
const STACK: usize = 64;

/// What the queries need beside the blob.
#[derive(Debug)]
pub struct Scratch([ScratchEntry; STACK]);

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self([ScratchEntry::EMPTY; STACK])
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for BvhWithSdf<'t> {
    type Scratch = Scratch;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.tree().scratch_entries() <= STACK
    }

    fn memory(&self) -> usize {
        let entries = self.tree().scratch_entries();
        size_of::<BvhWithSdf<'_>>() + entries.saturating_mul(size_of::<ScratchEntry>())
    }

    asks! { Scratch, |self, place, scratch, to|
        Stopped => closest(self, place.far(), scratch, to);
        Within => is_within(self, place.far(), place.distance(), scratch, to);
        Signed => signed(self, place.far(), scratch, to);
        Bounds => bounded(self, place.far(), place.distance(), scratch, to);
        SignedBounds => signed_bounded(self, place.far(), place.distance(), scratch, to);
        Solid => solid(self, place.segment(), place.distance(), scratch, to);
        Contact => {
            let (start, end) = (place.far(), place.far());
            let motion = [[start, place.near(start)], [end, place.near(end)]];
            contact(self, motion, 0.25 * place.distance(), scratch, to);
        };
        // Of the field alone, which here is a tree.
        FieldDistance => sdf::distance(self.field(), sdf::within(self.field(), place.far()), to);
        FieldUnits => sdf::in_units_of(self.field(), place, to);
        FieldGradient => sdf::gradient(self.field(), sdf::within(self.field(), place.far()), to);
        FieldBeyond => sdf::beyond(self.field(), place, to);
    }
}

/// Opens box tree and field of a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<BvhWithSdf<'_>, Refused> {
    BvhWithSdf::open(bytes).map_err(Refused::of)
}

/// The box of the tree.
#[must_use]
pub fn bounds(both: &BvhWithSdf<'_>) -> Bounds {
    tree::bounds(both.tree())
}

pub(super) fn distance_bounds(fold: &mut Fold, found: &DistanceBounds) {
    fold.f32(found.distance.lower);
    fold.f32(found.distance.upper);
    super::how(fold, found.ended);
}

fn side(fold: &mut Fold, side: Side) {
    fold.word(match side {
        Side::Outside => 1,
        Side::Inside => 2,
        _ => 0,
    });
}

/// Closest point with a tolerance of a tenth.
#[inline(never)]
pub fn closest(
    both: &BvhWithSdf<'_>,
    p: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT.with_relative(0.1), &mut scratch.0);
    to.answer(|| both.closest_point(p, budget, stack), super::closest_point);
}

/// Whether the surface is within a distance.
#[inline(never)]
pub fn is_within(
    both: &BvhWithSdf<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.0);
    let call = || both.within(p, distance, budget, stack);
    to.answer(call, |fold, answer| {
        fold.word(u32::from(answer.is_clear()));
        super::number(fold, answer.witness);
        verdict(fold, answer.verdict);
    });
}

/// Distance with the sign of the side.
#[inline(never)]
pub fn signed(
    both: &BvhWithSdf<'_>,
    p: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.0);
    to.answer(
        || both.signed_distance(p, budget, stack),
        |fold, answer| {
            side(fold, answer.side);
            super::closest_point(fold, &answer.closest);
        },
    );
}

/// Bounds of the distance, with a tolerance.
#[inline(never)]
pub fn bounded(
    both: &BvhWithSdf<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let tolerance = Budget::EXACT.with_absolute(0.125 * distance);
    let (budget, stack) = to.terms(tolerance, &mut scratch.0);
    to.answer(|| both.distance_bounds(p, budget, stack), distance_bounds);
}

/// Bounds of the signed distance, with a tolerance.
#[inline(never)]
pub fn signed_bounded(
    both: &BvhWithSdf<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let tolerance = Budget::EXACT.with_absolute(0.125 * distance);
    let (budget, stack) = to.terms(tolerance, &mut scratch.0);
    to.answer(
        || both.signed_bounds(p, budget, stack),
        |fold, answer: &SignedBounds| {
            fold.f32(answer.distance.lower);
            fold.f32(answer.distance.upper);
            side(fold, answer.side);
            super::how(fold, answer.ended);
        },
    );
}

/// Whether a capsule and the surface are within a distance, the radius of the capsule.
#[inline(never)]
pub fn solid(
    both: &BvhWithSdf<'_>,
    ends: Ends,
    radius: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.0);
    to.answer(
        || both.solid_within(&Solid::new(&ends, radius)?, radius, budget, stack),
        |fold, answer| {
            fold.word(u32::from(answer.is_clear()));
            verdict(fold, answer.verdict);
        },
    );
}

/// Where a capsule that goes from one place to another first meets the surface.
#[inline(never)]
pub fn contact(
    both: &BvhWithSdf<'_>,
    [from, end]: [Ends; 2],
    radius: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let (budget, stack) = to.terms(Budget::EXACT, &mut scratch.0);
    let call = || -> Result<FirstHit, QueryError> {
        let (from, end) = (Solid::new(&from, radius)?, Solid::new(&end, radius)?);
        both.solid_first_contact(&from, &end, budget, stack)
    };
    to.answer(call, super::segment_hit);
}
