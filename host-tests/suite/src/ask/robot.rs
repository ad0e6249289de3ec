//! An arm that guards itself: models at their places, tick after tick, and pairs of them.
//!
//! The host lays blobs, poses and pairs as bytes that a board finds in its memory. A tick asks as a
//! customer would: is each pair of links, and each pair of a link and what stands around, farther
//! than a distance of its own?

use core::mem::size_of;

use meshsweep_core::{
    Budget, Bvh, CoherentScene, Decided, KeptPair, PairDistance, PlacedModel, Pose, QueryError,
    Scratch, Verdict,
};

use super::{Refused, refusal, timed, tree};
use crate::fold::Fold;
use crate::observer::Observer;

/// Seven links, a table and a machine.
pub const MODELS: usize = 9;

/// How near two links may be.
const LINKS: f32 = 0.02;

/// How near a link may be to the table or the machine.
const WORLD: f32 = 0.05;

/// The pairs that must stay apart, and how far.
pub const PAIRS: [(usize, usize, f32); 21] = [
    (0, 3, LINKS),
    (0, 4, LINKS),
    (0, 5, LINKS),
    (0, 6, LINKS),
    (1, 3, LINKS),
    (1, 4, LINKS),
    (1, 5, LINKS),
    (1, 6, LINKS),
    (2, 4, LINKS),
    (2, 5, LINKS),
    (2, 6, LINKS),
    (3, 6, LINKS),
    (2, 8, WORLD),
    (3, 7, WORLD),
    (3, 8, WORLD),
    (4, 7, WORLD),
    (4, 8, WORLD),
    (5, 7, WORLD),
    (5, 8, WORLD),
    (6, 7, WORLD),
    (6, 8, WORLD),
];

/// The same, as the scene takes them.
const KEPT: [KeptPair; PAIRS.len()] = {
    let mut kept = [KeptPair { models: [0; 2], distance: 0.0 }; PAIRS.len()];
    let mut at = 0;
    while at < PAIRS.len() {
        let (a, b, distance) = PAIRS[at];
        kept[at] = KeptPair { models: [a as u16, b as u16], distance };
        at += 1;
    }
    kept
};

/// Models that move; the others stand still during a run.
const MOVING: usize = 7;

/// An arm that remembers.
type Guard<'t> = CoherentScene<'t, MODELS, { PAIRS.len() }>;

/// A row of poses: whether a run of ticks begins, and a pose a model.
const ROW: usize = 4 + MODELS * POSE;
const POSE: usize = 48;

/// A question, two models, a distance, and the pose of the second model in the first's frame.
const QUESTION: usize = 16 + POSE;

/// Lengths of the blobs, rows and questions; then nothing.
const HEADER: usize = 64;

/// Blobs begin at multiples of it, as a linker script would align a section for one.
const ALIGN: usize = 16;

/// The poses of all models at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The tick before is not this one's past.
    pub begins: bool,
    /// From each model's frame to the world.
    pub poses: [Pose; MODELS],
}

/// A question about a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// [`Bvh::within_of`].
    Within,
    /// [`Bvh::distance_to`].
    Distance,
}

/// A pair that is asked about alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The question.
    pub question: Question,
    /// Two models, by their numbers.
    pub models: [usize; 2],
    /// A distance, for [`Question::Within`].
    pub distance: f32,
    /// From the second model's frame to the first's.
    pub pose: Pose,
}

/// Blobs, rows and pairs.
#[derive(Clone, Copy, Debug)]
pub struct Laid<'t> {
    trees: [Bvh<'t>; MODELS],
    rows: &'t [[u8; ROW]],
    pairs: &'t [[u8; QUESTION]],
}

fn word(bytes: &[u8], index: usize) -> Option<u32> {
    bytes.as_chunks().0.get(index).map(|word| u32::from_le_bytes(*word))
}

fn pose(bytes: &[u8], from: usize) -> Option<Pose> {
    let mut pose = Pose::IDENTITY;
    let rows = pose.rotation.iter_mut().chain([&mut pose.translation]);
    for (index, to) in rows.flatten().enumerate() {
        *to = f32::from_bits(word(bytes, from.wrapping_add(index))?);
    }
    Some(pose)
}

impl<'t> Laid<'t> {
    /// Reads what the host wrote, and opens the blobs; what follows is no part of it.
    ///
    /// # Errors
    /// The core's refusal of a blob, or bytes that end early.
    pub fn read(bytes: &'t [u8]) -> Result<(Self, usize), Refused> {
        let ends = Refused(1);
        let (header, mut rest) = bytes.split_first_chunk::<HEADER>().ok_or(ends)?;
        let mut blobs: [&[u8]; MODELS] = [&[]; MODELS];
        for (index, blob) in blobs.iter_mut().enumerate() {
            let length = word(header, index).ok_or(ends)? as usize;
            let (here, after) =
                rest.split_at_checked(length.next_multiple_of(ALIGN)).ok_or(ends)?;
            *blob = here.get(..length).ok_or(ends)?;
            rest = after;
        }
        let [a, b, c, d, e, f, g, h, i] = blobs.map(tree::open);
        let trees = [a?, b?, c?, d?, e?, f?, g?, h?, i?];
        let count = |index| word(header, index).map(|count| count as usize).ok_or(ends);
        let (rows, pairs) = (count(MODELS)?, count(MODELS + 1)?);
        let (rows, rest) = rest.split_at_checked(rows.saturating_mul(ROW)).ok_or(ends)?;
        let (pairs, rest) = rest.split_at_checked(pairs.saturating_mul(QUESTION)).ok_or(ends)?;
        let laid = Self { trees, rows: rows.as_chunks().0, pairs: pairs.as_chunks().0 };
        Ok((laid, bytes.len().saturating_sub(rest.len())))
    }

    fn rows(&self) -> impl Iterator<Item = Row> {
        let identity = [Pose::IDENTITY; MODELS];
        self.rows.iter().map(move |bytes| {
            let mut row = Row { begins: word(bytes, 0) == Some(1), poses: identity };
            for (index, to) in row.poses.iter_mut().enumerate() {
                *to = pose(bytes, 1 + index * (POSE / 4)).unwrap_or(Pose::IDENTITY);
            }
            row
        })
    }

    fn pairs(&self) -> impl Iterator<Item = Pair> {
        self.pairs.iter().filter_map(|bytes| {
            let kind = word(bytes, 0)?;
            Some(Pair {
                question: if kind == 0 { Question::Within } else { Question::Distance },
                models: [word(bytes, 1)? as usize, word(bytes, 2)? as usize],
                distance: f32::from_bits(word(bytes, 3)?),
                pose: pose(bytes, 4)?,
            })
        })
    }
}

/// The bytes that [`Laid::read`] reads, one part after the other.
pub fn lay(blobs: [&[u8]; MODELS], rows: &[Row], pairs: &[Pair], mut part: impl FnMut(&[u8])) {
    let mut header = [0; HEADER];
    let counts = [rows.len(), pairs.len()];
    let lengths = blobs.iter().map(|blob| blob.len()).chain(counts);
    for (to, length) in header.as_chunks_mut::<4>().0.iter_mut().zip(lengths) {
        *to = (length as u32).to_le_bytes();
    }
    part(&header);
    for blob in blobs {
        part(blob);
        let padding = blob.len().next_multiple_of(ALIGN).saturating_sub(blob.len());
        part([0; ALIGN].get(..padding).unwrap_or_default());
    }
    let words = |pose: &Pose, part: &mut dyn FnMut(&[u8])| {
        for x in pose.rotation.iter().chain([&pose.translation]).flatten() {
            part(&x.to_le_bytes());
        }
    };
    for Row { begins, poses } in rows {
        part(&u32::from(*begins).to_le_bytes());
        poses.iter().for_each(|pose| words(pose, &mut part));
    }
    for Pair { question, models: [a, b], distance, pose } in pairs {
        part(&u32::from(*question == Question::Distance).to_le_bytes());
        part(&(*a as u32).to_le_bytes());
        part(&(*b as u32).to_le_bytes());
        part(&distance.to_le_bytes());
        words(pose, &mut part);
    }
}

/// What the questions need beside the blobs.
#[derive(Debug)]
pub struct Memory {
    scratch: Scratch<{ Bvh::DISTANCE_ENTRIES }>,
}

impl Memory {
    /// Memory that no question has used.
    #[must_use]
    pub const fn new() -> Self {
        Self { scratch: Scratch::new() }
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

/// The answer about a pair.
#[derive(Clone, Copy, Debug)]
pub enum Answer {
    /// Whether it is within the distance.
    Within(Decided<[u32; 2]>),
    /// How far it is.
    Distance(PairDistance),
    /// A refusal.
    Refused(QueryError),
}

impl Answer {
    /// Folds the bits of the answer.
    pub fn told(&self, fold: &mut Fold) {
        match self {
            Self::Within(answer) => fold.word(number(answer.verdict)),
            Self::Distance(answer) => {
                fold.f32(answer.distance.lower);
                fold.f32(answer.distance.upper);
                answer.points.into_iter().for_each(|point| fold.point(point));
                answer.triangles.into_iter().for_each(|triangle| fold.word(triangle));
            }
            Self::Refused(error) => refusal(fold, *error),
        }
    }
}

const fn number(verdict: Verdict) -> u32 {
    match verdict {
        Verdict::No => 0,
        Verdict::Yes => 1,
        _ => 2,
    }
}

/// Folds the bits of a tick's verdict.
pub fn told(fold: &mut Fold, verdict: &Result<Verdict, QueryError>) {
    match verdict {
        Ok(verdict) => fold.word(number(*verdict)),
        Err(error) => refusal(fold, *error),
    }
}

/// Guards all rows: whether any pair is too near. Returns the bytes of RAM that it needs beside the
/// stack.
pub fn ticks(
    laid: &Laid<'_>,
    memory: &mut Memory,
    observer: &mut impl Observer,
    mut told: impl FnMut(&Result<Verdict, QueryError>),
) -> usize {
    let Ok(mut guard) = guard(&laid.trees) else { return 0 };
    for row in laid.rows() {
        if row.begins {
            // Not a part of a tick: what stands around, and what was remembered.
            guard.reset();
            let still = row.poses.iter().enumerate().skip(MOVING);
            still.for_each(|(model, pose)| _ = guard.move_to(model, *pose));
        }
        let verdict = timed(observer, || tick(&mut guard, &row.poses, &mut memory.scratch));
        told(&verdict);
    }
    size_of::<Guard<'_>>().saturating_add(size_of::<Memory>())
}

/// Guards one row: all that an image needs of the core which guards an arm.
pub fn guard_once(laid: &Laid<'_>, row: &Row, memory: &mut Memory, fold: &mut Fold) {
    let tick = |mut guard| tick(&mut guard, &row.poses, &mut memory.scratch);
    told(fold, &guard(&laid.trees).and_then(tick));
}

#[inline(never)]
fn guard<'t>(trees: &[Bvh<'t>; MODELS]) -> Result<Guard<'t>, QueryError> {
    let [a, b, c, d, e, f, g, h, i] = trees.map(|tree| PlacedModel::new(tree, Pose::IDENTITY));
    CoherentScene::new([a?, b?, c?, d?, e?, f?, g?, h?, i?], KEPT)
}

/// One tick.
#[inline(never)]
fn tick(
    guard: &mut Guard<'_>,
    poses: &[Pose; MODELS],
    scratch: &mut Scratch<{ Bvh::DISTANCE_ENTRIES }>,
) -> Result<Verdict, QueryError> {
    for (model, pose) in poses.iter().enumerate().take(MOVING) {
        guard.move_to(model, *pose)?;
    }
    Ok(guard.within(Budget::EXACT, scratch)?.verdict)
}

/// Asks about all pairs. Returns the bytes of RAM that it needs beside the stack.
pub fn pairs(
    laid: &Laid<'_>,
    memory: &mut Memory,
    observer: &mut impl Observer,
    mut told: impl FnMut(&Answer),
) -> usize {
    let scratch = &mut memory.scratch;
    for pair in laid.pairs() {
        let [a, b] = pair.models.map(|model| laid.trees.get(model));
        let (Some(a), Some(b)) = (a, b) else { continue };
        told(&match pair.question {
            Question::Within => timed(observer, || within(a, b, &pair, scratch))
                .map_or_else(Answer::Refused, Answer::Within),
            Question::Distance => timed(observer, || distance(a, b, &pair, scratch))
                .map_or_else(Answer::Refused, Answer::Distance),
        });
    }
    size_of::<Memory>()
}

#[inline(never)]
fn within(
    a: &Bvh<'_>,
    b: &Bvh<'_>,
    pair: &Pair,
    scratch: &mut Scratch<{ Bvh::DISTANCE_ENTRIES }>,
) -> Result<Decided<[u32; 2]>, QueryError> {
    a.within_of(b, pair.pose, pair.distance, Budget::EXACT, scratch)
}

#[inline(never)]
fn distance(
    a: &Bvh<'_>,
    b: &Bvh<'_>,
    pair: &Pair,
    scratch: &mut Scratch<{ Bvh::DISTANCE_ENTRIES }>,
) -> Result<PairDistance, QueryError> {
    a.distance_to(b, pair.pose, Budget::EXACT, scratch)
}
