//! Questions to the distance field of a blob.

pub use meshsweep_core::Sdf;
use meshsweep_core::{FieldDistance, QueryError, Side, UnitDistance};

use super::{Asked, Refused, Subject, refusal, verdict};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place, Point};

/// The queries need nothing beside the field.
#[derive(Debug, Default)]
pub struct Scratch;

impl Scratch {
    /// Nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self
    }
}

impl<'t> Subject<'t> for Sdf<'t> {
    type Scratch = Scratch;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        true
    }

    fn memory(&self) -> usize {
        size_of::<Sdf<'_>>()
    }

    asks! { Scratch, |self, place, scratch, to|
        Arith => {
            let Scratch = *scratch;
        };
        Contents => contents(self, to.fold);
        FieldDistance => distance(self, within(self, place.far()), to);
        FieldUnits => in_units_of(self, place, to);
        FieldGradient => gradient(self, within(self, place.far()), to);
        Signed => distance(self, place.far(), to);
        Within => is_within(self, place.far(), place.distance(), to);
        FieldBeyond => beyond(self, place, to);
    }
}

/// Opens the distance field of a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<Sdf<'_>, Refused> {
    Sdf::open(bytes).map_err(Refused::of)
}

/// The box of the field.
#[must_use]
pub fn bounds(field: &Sdf<'_>) -> Bounds {
    field.bounds()
}

/// Kind, cells, unit and box.
pub fn contents(field: &Sdf<'_>, fold: &mut Fold) {
    fold.word(field.kind() as u32);
    field.cells().into_iter().for_each(|cells| fold.word(cells));
    fold.f32(field.unit());
    let [least, greatest] = field.bounds();
    fold.point(least);
    fold.point(greatest);
}

/// In whole units at a point of the box. The conversion is no part of the question.
pub(super) fn in_units_of(
    field: &Sdf<'_>,
    place: &mut impl Place,
    to: &mut Asked<'_, impl Observer>,
) {
    if let Ok(whole) = field.units_of(within(field, place.far())) {
        in_units(field, whole, to);
    }
}

/// In whole units far from the box.
pub(super) fn beyond(field: &Sdf<'_>, place: &mut impl Place, to: &mut Asked<'_, impl Observer>) {
    let mut word = || place.word().cast_signed() >> 10;
    in_units(field, core::array::from_fn(|_| word()), to);
}

/// A point of the doubled box, drawn into the box.
pub(super) fn within(field: &Sdf<'_>, [x, y, z]: Point) -> Point {
    let [[a, b, c], [d, e, f]] = field.bounds();
    let drawn = |x: f32, a: f32, b: f32| 0.5 * (x + 0.5 * (a + b));
    [drawn(x, a, d), drawn(y, b, e), drawn(z, c, f)]
}

pub(super) fn field_distance(fold: &mut Fold, found: &FieldDistance) {
    fold.f32(found.distance.lower);
    fold.f32(found.distance.upper);
    fold.word(match found.side {
        Side::Outside => 1,
        Side::Inside => 2,
        _ => 0,
    });
}

pub(super) fn unit_distance(fold: &mut Fold, found: UnitDistance) {
    fold.word(found.lower.cast_unsigned());
    fold.word(found.upper.cast_unsigned());
}

fn told(fold: &mut Fold, answer: Result<FieldDistance, QueryError>) {
    match answer {
        Ok(found) => field_distance(fold, &found),
        Err(error) => refusal(fold, error),
    }
}

/// The distance of a point.
#[inline(never)]
pub fn distance(field: &Sdf<'_>, p: Point, to: &mut Asked<'_, impl Observer>) {
    let answer = to.timed(|| field.distance(p));
    told(to.fold, answer);
}

/// The distance and the gradient.
#[inline(never)]
pub fn gradient(field: &Sdf<'_>, p: Point, to: &mut Asked<'_, impl Observer>) {
    let answer = to.timed(|| field.distance_and_gradient(p));
    told(to.fold, answer.map(|(found, _)| found));
    if let Ok((_, gradient)) = answer {
        to.fold.point(gradient);
    }
}

/// Whether the mesh is within a distance.
#[inline(never)]
pub fn is_within(field: &Sdf<'_>, p: Point, distance: f32, to: &mut Asked<'_, impl Observer>) {
    match to.timed(|| field.within(p, distance)) {
        Ok(answer) => verdict(to.fold, answer),
        Err(error) => refusal(to.fold, error),
    }
}

/// The distance of a place in whole units, and the gradient there.
#[inline(never)]
pub fn in_units(field: &Sdf<'_>, place: [i32; 3], to: &mut Asked<'_, impl Observer>) {
    match to.timed(|| field.distance_in_units(place)) {
        Ok(answer) => unit_distance(to.fold, answer),
        Err(error) => refusal(to.fold, error),
    }
    if let Ok(gradient) = field.gradient_in_units(place) {
        gradient.into_iter().for_each(|slope| to.fold.word(slope.cast_unsigned()));
    }
}
