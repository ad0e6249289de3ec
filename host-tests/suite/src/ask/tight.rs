//! Questions to the finest tight hull of a blob, about the mesh within.

use meshsweep_core::Budget;
pub use meshsweep_core::TightHull;
use meshsweep_core::TightHulls;
use meshsweep_core::{ScratchEntry, Verdict};

use super::{Refused, Subject, closest_point as fold_answer, refusal, timed, tree, verdict};
use crate::fold::Fold;
use crate::place::{Bounds, Placer};
use crate::{Clock, Kind};

/// Entries of the stack.
const STACK: usize = 64;

/// What the queries need beside the hull.
#[derive(Debug)]
pub struct Scratch {
    stack: [ScratchEntry; STACK],
}

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self { stack: [ScratchEntry::EMPTY; STACK] }
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

/// All hulls of a blob, and the finest of them, which is asked.
#[derive(Clone, Copy, Debug)]
pub struct Hulls<'t> {
    all: TightHulls<'t>,
    finest: TightHull<'t>,
}

impl<'t> Subject<'t> for Hulls<'t> {
    type Scratch = Scratch;

    fn open(bytes: &'t [u8]) -> Result<Self, Refused> {
        open(bytes)
    }

    fn bounds(&self) -> Bounds {
        bounds(self)
    }

    fn memory_suffices(&self) -> bool {
        self.finest.scratch_entries() <= STACK
    }

    /// The opened hull, and the entries that it asks for.
    fn memory(&self) -> usize {
        let entries = self.finest.scratch_entries();
        size_of::<TightHull<'_>>() + entries.saturating_mul(size_of::<ScratchEntry>())
    }

    fn suits(kind: Kind) -> bool {
        matches!(
            kind,
            Kind::Arith
                | Kind::Contents
                | Kind::ClosestFar
                | Kind::ClosestNear
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
            Kind::Stopped => stopped(self, place.far(), place.distance(), scratch, clock, fold),
            Kind::Within => is_within(self, place.far(), place.distance(), scratch, clock, fold),
            _ => {}
        }
    }
}

/// Opens the tight hulls of a blob.
///
/// # Errors
/// The core's refusal.
pub fn open(bytes: &[u8]) -> Result<Hulls<'_>, Refused> {
    let all = TightHulls::open(bytes).map_err(Refused::of)?;
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
    point: [f32; 3],
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) -> [f32; 3] {
    match timed(clock, || hulls.finest.closest_point(point, Budget::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            fold_answer(fold, &answer);
            answer.point
        }
        Err(error) => {
            refusal(fold, error);
            point
        }
    }
}

/// The same of the coarsest hull with a tolerance of `distance`, and of the finest with two nodes
/// to open and with a stack of four.
#[inline(never)]
pub fn stopped(
    hulls: &Hulls<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let coarsest = hulls.all.get(0).unwrap_or(hulls.finest);
    let tolerant = Budget::EXACT.with_absolute(distance);
    let brief = Budget::EXACT.with_steps(2);
    for (hull, stop, entries) in [
        (&coarsest, tolerant, STACK),
        (&hulls.finest, brief, STACK),
        (&hulls.finest, Budget::EXACT, 4),
    ] {
        let stack = scratch.stack.get_mut(..entries).unwrap_or_default();
        match timed(clock, || hull.closest_point(point, stop, stack)) {
            Ok(answer) => fold_answer(fold, &answer),
            Err(error) => refusal(fold, error),
        }
    }
}

/// Whether the mesh is within a distance.
#[inline(never)]
pub fn is_within(
    hulls: &Hulls<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || hulls.finest.within(point, distance, Budget::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            fold.word(match answer.verdict {
                Verdict::Yes => 1,
                Verdict::No => 2,
                _ => 3,
            });
            verdict(fold, answer.work, answer.verdict);
        }
        Err(error) => refusal(fold, error),
    }
}
