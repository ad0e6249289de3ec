//! The core's entry points as the suite asks them. The only module of the suite and the firmware
//! that names the core's questions.
//!
//! Each question is a call, so that the stack that is measured is its own. It folds *all* the bits
//! of its answer or its refusal, but for the work counters: processors with vector registers may
//! visit nodes in another order. Nothing here formats or indexes: the proof image links these
//! functions, and they may not bring a panic of their own.

/// The questions of a subject, one a row: the kind, and how it is asked. Host and boards run them,
/// the proof image links them, and fuzzers ask them of any bytes. With `to` the answer goes through
/// [`Asked`]; with `observer, fold` the row makes its own.
macro_rules! asks {
    ($scratch:ty, |$model:ident, $place:ident, $memory:ident, $to:ident| $($rows:tt)*) => {
        asks! { @rows $scratch, $model, $place, $memory, observer, fold,
            { let $to = &mut Asked::new(observer, fold); } $($rows)* }
    };
    ($scratch:ty, |$model:ident, $place:ident, $memory:ident, $observer:ident, $fold:ident|
        $($rows:tt)*) => {
        asks! { @rows $scratch, $model, $place, $memory, $observer, $fold, {} $($rows)* }
    };
    (@rows $scratch:ty, $model:ident, $place:ident, $memory:ident, $observer:ident, $fold:ident,
        { $($first:stmt;)? } $($kind:ident => $ask:expr;)*) => {
        fn suits(kind: Kind) -> bool {
            matches!(kind, $(Kind::$kind)|*)
        }

        fn ask(
            &$model,
            kind: Kind,
            $place: &mut impl Place,
            $memory: &mut $scratch,
            $observer: &mut impl Observer,
            $fold: &mut Fold,
        ) {
            $($first)?
            match kind {
                $(Kind::$kind => $ask,)*
                _ => {}
            }
        }
    };
}

/// A subject whose module has functions that open the blob and tell the box.
macro_rules! opened_here {
    ($bytes:lifetime) => {
        fn open(bytes: &$bytes [u8]) -> Result<Self, Refused> {
            open(bytes)
        }

        fn bounds(&self) -> Bounds {
            bounds(self)
        }
    };
}

pub mod apart;
pub mod both;
pub mod curve;
pub mod deform;
pub mod hull;
pub mod hull_moving;
pub mod joints;
pub mod placed;
pub mod robot;
pub mod sdf;
pub mod tight;
pub mod tree;
pub mod tribox;
pub mod triboxes;
mod worked;

use meshsweep_core::OpenError;
use meshsweep_core::{
    Budget, ClosestPoint, Ended, FirstHit, Hit, QueryError, ScratchEntry, TriangleHit, Undecided,
    Verdict,
};
use worked::Worked;

use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place};

/// The structure of a blob that answers. It is a trait and not an enum, so that an image links only
/// the structure that it asks.
pub trait Subject<'t>: Sized {
    /// Whether questions about triboxes of points are asked too, without the blob. Images of other
    /// subjects leave their code out.
    const ASKS_TRIBOXES_OF_POINTS: bool = false;

    /// What the queries need beside the blob: it must fit in the smallest part's RAM beside the
    /// stack.
    type Scratch;

    /// Opens the blob.
    ///
    /// # Errors
    /// The core's refusal.
    fn open(bytes: &'t [u8]) -> Result<Self, Refused>;

    /// The surface's box in input units, which the queries are placed around.
    fn bounds(&self) -> Bounds;

    /// Whether no query can end early for want of scratch: else blocks of such answers would prove
    /// little.
    fn memory_suffices(&self) -> bool;

    /// Bytes of RAM that queries need beside the stack.
    fn memory(&self) -> usize {
        size_of::<Self::Scratch>()
    }

    /// Whether it can be asked this.
    fn suits(kind: Kind) -> bool;

    /// Asks one query of a kind, placed by `place`.
    fn ask(
        &self,
        kind: Kind,
        place: &mut impl Place,
        scratch: &mut Self::Scratch,
        observer: &mut impl Observer,
        fold: &mut Fold,
    );
}

/// Why a blob was not opened, as the number of the core's error, or why it was not asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused(pub u32);

impl Refused {
    /// The suite's memory is too short for what the blob asks for.
    pub const MEMORY: Self = Self(100);
    /// The blob lacks a section: it has no box tree, for one.
    pub const NO_SECTION: Self = Self(11);

    const fn of(error: OpenError) -> Self {
        Self(match error {
            OpenError::Truncated { .. } => 1,
            OpenError::TrailingBytes { .. } => 2,
            OpenError::NotABlob => 3,
            OpenError::Version { .. } => 4,
            OpenError::VertexFormat { .. } => 5,
            OpenError::NotFinite { .. } => 6,
            OpenError::Reserved => 7,
            OpenError::Counts { .. } => 8,
            OpenError::Crc { .. } => 9,
            OpenError::Section { .. } => 10,
            OpenError::MissingSection { .. } => Self::NO_SECTION.0,
            OpenError::Record { .. } => 12,
            _ => 13,
        })
    }
}

/// One query: the observer of the core's work, and the fold that takes the answer.
#[derive(Debug)]
pub struct Asked<'f, C> {
    observer: C,
    fold: &'f mut Fold,
}

impl<'f, C: Observer> Asked<'f, C> {
    /// Nothing asked yet; `()` observes nothing.
    pub const fn new(observer: C, fold: &'f mut Fold) -> Self {
        Self { observer, fold }
    }

    /// Calls the core between the observer's two calls.
    #[inline(always)]
    fn timed<T>(&mut self, call: impl FnOnce() -> T) -> T {
        timed(&mut self.observer, call)
    }

    /// The budget and the scratch of the next call, from those of the suite.
    #[inline(always)]
    fn terms<'s>(
        &mut self,
        budget: Budget,
        scratch: &'s mut [ScratchEntry],
    ) -> (Budget, &'s mut [ScratchEntry]) {
        self.observer.terms(budget, scratch)
    }

    /// Calls the core, and folds its answer by `told`, or its refusal.
    #[inline(always)]
    fn answer<T: Worked>(
        &mut self,
        call: impl FnOnce() -> Result<T, QueryError>,
        told: impl FnOnce(&mut Fold, &T),
    ) -> Option<T> {
        let answer = self.timed(call);
        self.observer.answered(answer.as_ref().map(Worked::work).map_err(|error| *error));
        match &answer {
            Ok(answer) => told(self.fold, answer),
            Err(error) => refusal(self.fold, *error),
        }
        answer.ok()
    }
}

/// Calls the core between the observer's two calls.
#[inline(always)]
fn timed<T>(observer: &mut impl Observer, call: impl FnOnce() -> T) -> T {
    observer.query_begins();
    let answer = call();
    observer.query_ends();
    answer
}

fn closest_point(fold: &mut Fold, answer: &ClosestPoint) {
    fold.f32(answer.distance.lower);
    fold.f32(answer.distance.upper);
    fold.point(answer.point);
    number(fold, answer.triangle);
    how(fold, answer.ended);
}

fn segment_hit(fold: &mut Fold, answer: &FirstHit) {
    fold.f32(answer.t.lower);
    fold.f32(answer.t.upper);
    hits(fold, answer.hit.as_slice());
    how(fold, answer.ended);
}

fn hits(fold: &mut Fold, hits: &[Hit]) {
    hits.iter().for_each(|hit| place(fold, hit));
}

/// Places only: whether a hit is certain follows from the same numbers.
fn listed(fold: &mut Fold, hits: &[TriangleHit]) {
    hits.iter().for_each(|listed| place(fold, &listed.hit));
}

fn place(fold: &mut Fold, hit: &Hit) {
    fold.f32(hit.t);
    fold.point(hit.point);
    number(fold, hit.triangle);
}

fn number(fold: &mut Fold, number: Option<u32>) {
    fold.word(number.unwrap_or(u32::MAX));
}

fn how(fold: &mut Fold, ended: Ended) {
    fold.word(ended as u32);
}

/// Why there is no verdict, by the number of the reason.
fn verdict(fold: &mut Fold, verdict: Verdict) {
    let ended = match verdict {
        Verdict::Yes | Verdict::No => Ended::Exact,
        Verdict::Undecided(Undecided::Steps) => Ended::Steps,
        Verdict::Undecided(Undecided::Scratch) => Ended::Scratch,
        _ => Ended::Resolution,
    };
    how(fold, ended);
}

fn refusal(fold: &mut Fold, error: QueryError) {
    let number = match error {
        QueryError::NotFinite => 0,
        QueryError::Tolerance => 1,
        QueryError::OutOfDomain => 2,
        QueryError::PoseOutOfDomain => 3,
        QueryError::NoScratch => 4,
        QueryError::NotServed { .. } => 5,
        QueryError::Unchecked => 6,
        QueryError::NotEnclosing => 8,
        _ => 7,
    };
    // A word that no answer begins with: it would be a NaN's bits.
    fold.word(0xffff_ff00 | number);
}
