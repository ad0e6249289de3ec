//! Questions to the finest tight hull of a blob, about the mesh within.

pub use meshsweep_core::TightHull;
use meshsweep_core::{Budget, ScratchEntry, TightHulls, Verdict};

use super::{Asked, Refused, Subject, closest_point, tree, verdict};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place, Point};

/// Entries of the stack.
const STACK: usize = 64;

/// What the queries need beside the hull.
pub type Scratch = meshsweep_core::Scratch<STACK>;

/// All hulls of a blob, and the finest of them, which is asked.
#[derive(Clone, Copy, Debug)]
pub struct Hulls<'t> {
    all: TightHulls<'t>,
    finest: TightHull<'t>,
}

impl<'t> Subject<'t> for Hulls<'t> {
    type Scratch = Scratch;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.finest.scratch_entries() <= STACK
    }

    /// The opened hull, and the entries that it asks for.
    fn memory(&self) -> usize {
        let entries = self.finest.scratch_entries();
        size_of::<TightHull<'_>>() + entries.saturating_mul(size_of::<ScratchEntry>())
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
        Stopped => stopped(self, place.far(), place.distance(), scratch, to);
        Within => is_within(self, place.far(), place.distance(), scratch, to);
    }
}

/// Opens the tight hulls of a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<Hulls<'_>, Refused> {
    finest(TightHulls::open(bytes).map_err(Refused::of)?)
}

/// Opens without a check of the records.
///
/// # Errors
/// The core's refusal.
pub fn trusted(bytes: &[u8]) -> Result<Hulls<'_>, Refused> {
    finest(TightHulls::open_trusted(bytes).map_err(Refused::of)?)
}

fn finest(all: TightHulls<'_>) -> Result<Hulls<'_>, Refused> {
    let finest = all.finest().ok_or(Refused::NO_SECTION)?;
    Ok(Hulls { all, finest })
}

/// The finest hull's box.
#[must_use]
pub fn bounds(hulls: &Hulls<'_>) -> Bounds {
    tree::bounds(hulls.finest.bvh())
}

/// What the table says of each hull, its tree, and its distances.
pub fn contents(hulls: &Hulls<'_>, fold: &mut Fold) {
    fold.word(hulls.all.count());
    for record in hulls.all.records() {
        fold.word(record.faces);
        [record.slack, record.depth, record.void_ratio].into_iter().for_each(|x| fold.f32(x));
    }
    for index in 0..hulls.all.count() {
        let Some(hull) = hulls.all.get(index) else { continue };
        tree::contents(hull.bvh(), fold);
        (0..hull.record().faces)
            .filter_map(|face| hull.slack(face))
            .for_each(|slack| fold.f32(slack));
    }
}

/// An interval of the mesh's distance; returns the closest point of the hull.
#[inline(never)]
pub fn closest(
    hulls: &Hulls<'_>,
    p: Point,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) -> Point {
    let call = || hulls.finest.closest_point(p, Budget::EXACT, scratch);
    to.answer(call, closest_point).map_or(p, |answer| answer.point)
}

/// The same of the coarsest hull with a tolerance of `distance`, and of the finest with two nodes
/// to open and with a stack of four.
#[inline(never)]
pub fn stopped(
    hulls: &Hulls<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let coarsest = hulls.all.get(0).unwrap_or(hulls.finest);
    let tolerant = Budget::EXACT.with_absolute(distance);
    let brief = Budget::EXACT.with_steps(2);
    for (hull, stop, entries) in [
        (&coarsest, tolerant, STACK),
        (&hulls.finest, brief, STACK),
        (&hulls.finest, Budget::EXACT, 4),
    ] {
        let stack = scratch.get_mut(..entries).unwrap_or_default();
        to.answer(|| hull.closest_point(p, stop, stack), closest_point);
    }
}

/// Whether the mesh is within a distance.
#[inline(never)]
pub fn is_within(
    hulls: &Hulls<'_>,
    p: Point,
    distance: f32,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    to.answer(
        || hulls.finest.within(p, distance, Budget::EXACT, scratch),
        |fold, answer| {
            fold.word(match answer.verdict {
                Verdict::Yes => 1,
                Verdict::No => 2,
                _ => 3,
            });
            verdict(fold, answer.verdict);
        },
    );
}
