//! One question to one blob at many places, as bytes that a board finds in its memory.
//!
//! The host chooses the places. The simulator counts the question on the host, and the emulator on
//! a board.

use core::mem::size_of;

use meshsweep_core::{
    Blob, Budget, Change, ClosestPoint, Focus, QueryError, RefinedHull, Refinement, ScratchEntry,
};

use super::{Refused, timed};
use crate::Clock;
use crate::fold::Fold;

/// The question at each place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Question {
    /// The box tree's closest point, to a relative tolerance.
    Tree(f32),
    /// The closest point of a fresh sweep, to a relative tolerance.
    Sweep(f32),
    /// The closest point of one sweep that moves from place to place, to a relative tolerance.
    KeptSweep(f32),
    /// The hull refined for a ball of a radius, to an error; both in input units.
    Refine(f32, f32),
}

impl Question {
    fn words(self) -> [u32; 3] {
        match self {
            Self::Tree(relative) => [0, relative.to_bits(), 0],
            Self::Sweep(relative) => [1, relative.to_bits(), 0],
            Self::KeptSweep(relative) => [2, relative.to_bits(), 0],
            Self::Refine(radius, error) => [3, radius.to_bits(), error.to_bits()],
        }
    }

    fn of_words([kind, first, second]: [u32; 3]) -> Option<Self> {
        let (first, second) = (f32::from_bits(first), f32::from_bits(second));
        Some(match kind {
            0 => Self::Tree(first),
            1 => Self::Sweep(first),
            2 => Self::KeptSweep(first),
            3 => Self::Refine(first, second),
            _ => return None,
        })
    }
}

/// A question, the blob and the places.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'t> {
    /// The question.
    pub question: Question,
    /// The blob.
    pub blob: &'t [u8],
    places: &'t [[u8; 12]],
}

/// Bytes of the header: the question in three words, then the bytes of the blob, then the places.
pub const HEADER: usize = 20;

/// The header of a blob of `bytes` bytes and of some places. The blob follows, then three f32 a
/// place, little-endian.
#[must_use]
pub fn header(question: Question, bytes: u32, places: u32) -> [u8; HEADER] {
    let [kind, first, second] = question.words();
    let mut header = [0; HEADER];
    let (words, _) = header.as_chunks_mut();
    for (to, word) in words.iter_mut().zip([kind, first, second, bytes, places]) {
        *to = word.to_le_bytes();
    }
    header
}

impl<'t> Placed<'t> {
    /// Reads what the host wrote; what follows the last place is no part of it.
    #[must_use]
    pub fn read(bytes: &'t [u8]) -> Option<Self> {
        let (header, rest) = bytes.split_first_chunk::<HEADER>()?;
        let mut words = header.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word));
        let mut next = || words.next();
        let question = Question::of_words([next()?, next()?, next()?])?;
        let (blob, rest) = rest.split_at_checked(next()? as usize)?;
        let places = rest.as_chunks().0.get(..next()? as usize)?;
        Some(Self { question, blob, places })
    }
}

/// Entries of a sweep: 4 KiB. With fewer a fresh one answers too, more slowly.
const ENTRIES: usize = 512;

/// Splits of the refined hull: 8 KiB.
const SPLITS: usize = 500;

/// What the questions need beside the blob.
#[derive(Debug)]
pub struct Memory<'t> {
    entries: [ScratchEntry; ENTRIES],
    refined: RefinedHull<'t, SPLITS>,
    changes: [Change; 64],
}

impl Memory<'_> {
    /// Memory that no question has used.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            entries: [ScratchEntry::EMPTY; ENTRIES],
            refined: RefinedHull::new(),
            changes: [Change::EMPTY; 64],
        }
    }
}

impl Default for Memory<'_> {
    fn default() -> Self {
        Self::new()
    }
}

/// The answer at a place.
#[derive(Clone, Copy, Debug)]
pub enum Answer {
    /// A closest point.
    Closest(ClosestPoint),
    /// An update of the refined hull.
    Refined(Refinement),
    /// A refusal.
    Refused(QueryError),
}

impl Answer {
    /// Folds the bits of the answer.
    pub fn told(&self, fold: &mut Fold) {
        match self {
            Self::Closest(answer) => super::closest_point(fold, answer),
            Self::Refined(update) => {
                for word in [update.faces, update.performed, update.undone, update.dropped] {
                    fold.word(word);
                }
                fold.f32(update.error_left);
            }
            Self::Refused(error) => super::refusal(fold, *error),
        }
    }
}

/// Asks at the first `queries` places, and tells each answer. Returns the bytes of RAM that the
/// question needs beside the stack.
///
/// # Errors
/// The blob is refused, or asks for more scratch than there is.
pub fn ask<'t>(
    placed: &Placed<'t>,
    queries: usize,
    memory: &mut Memory<'t>,
    clock: &mut impl Clock,
    mut told: impl FnMut(&Answer),
) -> Result<usize, Refused> {
    let Memory { entries, refined, changes } = memory;
    let blob = Blob::open(placed.blob).map_err(Refused::of)?;
    let hull = || blob.hull().map_err(|_| Refused::NO_SECTION);
    let places = placed.places.iter().take(queries).map(place);
    let closest =
        |answer: Result<ClosestPoint, _>| answer.map_or_else(Answer::Refused, Answer::Closest);
    let bytes = |entries: usize| entries.saturating_mul(size_of::<ScratchEntry>());
    match placed.question {
        Question::Tree(relative) => {
            let tree = blob.bvh().map_err(|_| Refused::NO_SECTION)?;
            let stack = entries.get_mut(..tree.scratch_entries()).ok_or(Refused::MEMORY)?;
            let budget = Budget::EXACT.with_relative(relative);
            for place in places {
                let answer = timed(clock, || tree.closest_point(place, budget, stack));
                told(&closest(answer));
            }
            Ok(bytes(stack.len()))
        }
        Question::Sweep(relative) => {
            let hull = hull()?;
            let budget = Budget::EXACT.with_relative(relative);
            for place in places {
                let answer = timed(clock, || hull.closest_point(place, budget, entries));
                told(&closest(answer));
            }
            Ok(bytes(ENTRIES))
        }
        Question::KeptSweep(relative) => {
            let hull = hull()?;
            let budget = Budget::EXACT.with_relative(relative);
            let begin = placed.places.first().map(place).unwrap_or_default();
            let mut sweep = hull.sweep(begin, entries).map_err(|_| Refused::MEMORY)?;
            for place in places {
                let answer = timed(clock, || {
                    sweep.move_to(place)?;
                    sweep.closest_point(budget)
                });
                told(&closest(answer));
            }
            Ok(bytes(ENTRIES))
        }
        Question::Refine(radius, error) => {
            let hull = hull()?;
            for centre in places {
                let focus = Focus::Ball { centre, radius };
                let update = timed(clock, || refined.update(&hull, &focus, error, changes));
                told(&update.map_or_else(Answer::Refused, Answer::Refined));
            }
            Ok(size_of::<RefinedHull<'_, SPLITS>>())
        }
    }
}

fn place(bytes: &[u8; 12]) -> [f32; 3] {
    let mut place = [0.0; 3];
    for (to, word) in place.iter_mut().zip(bytes.as_chunks().0) {
        *to = f32::from_le_bytes(*word);
    }
    place
}
