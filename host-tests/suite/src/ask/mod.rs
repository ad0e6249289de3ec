//! The core's entry points as the suite asks them. The only module of the suite and the firmware that names the core's API.
//!
//! Each question folds *all* the bits of its answer, its work counters and its refusal among them. Nothing here formats or
//! indexes: the proof image links these functions, and they may not bring a panic of their own.

pub mod hull;
pub mod tree;

use meshsweep_core::query::{ClosestPoint, Ended, Hit, QueryError, SegmentHit, Work};
use meshsweep_core::{Model, OpenError, Tree};

use crate::Clock;
use crate::fold::Fold;
use crate::place::Bounds;

/// What the queries need beside a blob of lifetime `'t`: it must fit in the smallest part's RAM beside the stack.
#[derive(Debug, Default)]
pub struct Scratch<'t> {
    /// For the split hierarchy.
    pub hull: hull::Scratch,
    /// For the box tree.
    pub tree: tree::Scratch<'t>,
}

impl Scratch<'_> {
    /// Scratch that no query has used. `const`, so that it can be static.
    #[must_use]
    pub const fn new() -> Self {
        Self { hull: hull::Scratch::new(), tree: tree::Scratch::new() }
    }
}

/// A blob that was opened: its box tree if it has one, else its split hierarchy.
#[derive(Clone, Copy, Debug)]
pub enum Subject<'a> {
    /// The split hierarchy.
    Hull(Model<'a>),
    /// The box tree.
    Tree(Tree<'a>),
}

/// Why a blob was not opened, as the number of the core's error, or why it was not asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused(pub u32);

impl Refused {
    /// The suite's memory is too short for what the blob asks for.
    pub const MEMORY: Self = Self(100);
    /// The blob has no box tree.
    const NO_SECTION: Self = Self(11);

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
        })
    }
}

/// Opens a blob.
///
/// # Errors
/// The core's refusal.
pub fn open(bytes: &[u8]) -> Result<Subject<'_>, Refused> {
    match tree::open(bytes) {
        Ok(tree) => Ok(Subject::Tree(tree)),
        Err(Refused::NO_SECTION) => hull::open(bytes).map(Subject::Hull),
        Err(refused) => Err(refused),
    }
}

impl<'t> Subject<'t> {
    /// The surface's box in input units, which the queries are placed around.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Hull(model) => hull::bounds(model),
            Self::Tree(tree) => tree::bounds(tree),
        }
    }

    /// Whether no query can end early for want of [`Scratch`]: else blocks of such answers would prove little.
    #[must_use]
    pub fn memory_suffices(&self) -> bool {
        match self {
            Self::Hull(model) => hull::memory_suffices(model),
            Self::Tree(tree) => tree::memory_suffices(tree),
        }
    }

    /// Bytes of RAM that queries need beside the stack.
    #[must_use]
    pub fn memory(&self) -> usize {
        match self {
            Self::Hull(_) => size_of::<hull::Scratch>(),
            Self::Tree(tree) => tree::memory(tree),
        }
    }

    /// What the blob says of itself.
    pub fn contents(&self, fold: &mut Fold) {
        match self {
            Self::Hull(model) => hull::contents(model, fold),
            Self::Tree(tree) => tree::contents(tree, fold),
        }
    }

    /// Closest point; returns the witness, which near queries start from.
    pub fn closest(
        &self,
        point: [f32; 3],
        scratch: &mut Scratch<'t>,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) -> [f32; 3] {
        match self {
            Self::Hull(model) => hull::closest(model, point, &mut scratch.hull, clock, fold),
            Self::Tree(tree) => tree::closest(tree, point, &mut scratch.tree, clock, fold),
        }
    }

    /// Closest point to the next point of a path.
    pub fn follow(
        &self,
        point: [f32; 3],
        scratch: &mut Scratch<'t>,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        match self {
            Self::Hull(model) => {
                hull::closest(model, point, &mut scratch.hull, clock, fold);
            }
            Self::Tree(tree) => tree::follow(tree, point, &mut scratch.tree, clock, fold),
        }
    }

    /// First point of the segment from `a` to `b` on the surface.
    pub fn first_hit(
        &self,
        ends: [[f32; 3]; 2],
        scratch: &mut Scratch<'t>,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        match self {
            Self::Hull(model) => hull::first_hit(model, ends, &mut scratch.hull, clock, fold),
            Self::Tree(tree) => tree::first_hit(tree, ends, &mut scratch.tree, clock, fold),
        }
    }

    /// Every point of the segment from `a` to `b` on the surface.
    pub fn all_hits(
        &self,
        ends: [[f32; 3]; 2],
        scratch: &mut Scratch<'t>,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        match self {
            Self::Hull(model) => hull::all_hits(model, ends, &mut scratch.hull, clock, fold),
            Self::Tree(tree) => tree::all_hits(tree, ends, &mut scratch.tree, clock, fold),
        }
    }
}

/// Calls the core between the clock's two readings.
#[inline(always)]
fn timed<T>(clock: &mut impl Clock, call: impl FnOnce() -> T) -> T {
    clock.query_begins();
    let answer = call();
    clock.query_ends();
    answer
}

fn closest_point(fold: &mut Fold, answer: &ClosestPoint) {
    fold.f32(answer.lower);
    fold.f32(answer.upper);
    fold.point(answer.point);
    number(fold, answer.triangle);
    how(fold, answer.work, answer.ended);
}

fn segment_hit(fold: &mut Fold, answer: &SegmentHit) {
    fold.f32(answer.lower);
    fold.f32(answer.upper);
    hits(fold, answer.hit.as_slice());
    how(fold, answer.work, answer.ended);
}

fn hits(fold: &mut Fold, hits: &[Hit]) {
    for hit in hits {
        fold.f32(hit.t);
        fold.point(hit.point);
        number(fold, hit.triangle);
    }
}

fn number(fold: &mut Fold, number: Option<u32>) {
    fold.word(number.unwrap_or(u32::MAX));
}

fn how(fold: &mut Fold, work: Work, ended: Ended) {
    for word in [work.nodes, work.triangles, work.exact, work.splits, ended as u32] {
        fold.word(word);
    }
}

fn refusal(fold: &mut Fold, error: QueryError) {
    // A word that no answer begins with: it would be a NaN's bits.
    fold.word(0xffff_ff00 | error as u32);
}
