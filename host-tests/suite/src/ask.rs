//! The core's entry points as the suite asks them. The only file of the suite and the firmware that names the core's API.
//!
//! Each question folds *all* the bits of its answer, its work counters and its refusal among them. Nothing here formats or
//! indexes: the proof image links these functions, and they may not bring a panic of their own.

use meshsweep_core::blob::Header;
use meshsweep_core::query::{
    Ended, Hit, QueryError, Search, Stop, Work, all_hits as core_all_hits, closest_point,
    first_hit as core_first_hit, outer_hits as core_outer_hits,
};
use meshsweep_core::refine::{Face, Front, hull_faces};
use meshsweep_core::{Model, OpenError, QueueEntry};

use crate::{fold::Fold, place::Bounds};

/// Entries of the queue.
const QUEUE: usize = 256;

/// Words of each bit set of the front: 2,048 splits.
const FRONT_WORDS: usize = 64;

/// What the queries need beside the model, 4 KiB in all: it must fit in the smallest part's RAM beside the stack.
#[derive(Debug)]
pub struct Scratch {
    queue: [QueueEntry; QUEUE],
    hits: [Hit; 16],
    performed: [u32; FRONT_WORDS],
    swept: [u32; FRONT_WORDS],
    candidates: [Face; 64],
}

impl Scratch {
    /// Scratch that no query has used. `const`, so that it can be static.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            queue: [QueueEntry::EMPTY; QUEUE],
            hits: [Hit::EMPTY; 16],
            performed: [0; FRONT_WORDS],
            swept: [0; FRONT_WORDS],
            candidates: [Face::EMPTY; 64],
        }
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

/// A blob that was opened.
pub type Subject<'a> = Model<'a>;

/// Why a blob was not opened, as the number of the core's error, or why it was not asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused(pub u32);

impl Refused {
    /// The suite's memory is too short for the model's capacities.
    pub const MEMORY: Self = Self(100);
}

/// Opens a blob.
///
/// # Errors
/// The core's refusal.
pub fn open(bytes: &[u8]) -> Result<Subject<'_>, Refused> {
    Model::open(bytes).map_err(|error| {
        Refused(match error {
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
            OpenError::MissingSection { .. } => 11,
            OpenError::Record { .. } => 12,
        })
    })
}

/// The surface's box in input units, which the queries are placed around.
#[must_use]
pub fn bounds(subject: &Subject<'_>) -> Bounds {
    let Header { surface_box, .. } = *subject.header();
    // A power of two: exact unless the box leaves f32's normal range, and then rounded alike everywhere.
    let scale = subject.scale();
    [surface_box.min, surface_box.max].map(|corner| corner.as_dvec3().to_array().map(|x| (x * scale) as f32))
}

/// Whether no query on this model can end early for want of [`Scratch`]: else blocks of such answers would prove little.
#[must_use]
pub fn memory_suffices(subject: &Subject<'_>) -> bool {
    let needed = subject.capacities();
    needed.queue <= QUEUE && needed.front_words <= FRONT_WORDS
}

/// What the blob says of itself: sections, levels and the faces of every hull.
pub fn contents(subject: &Subject<'_>, fold: &mut Fold) {
    for section in subject.sections() {
        fold.word(section.kind as u32);
        fold.word(section.crc);
    }
    for level in subject.levels() {
        fold.word(level.faces);
        fold.f32(level.hull_to_surface);
        for face in hull_faces(subject, &level) {
            fold.f32(face.radius);
            for corner in face.corners {
                if let Some(position) = subject.position(corner) {
                    fold.point(position.to_array());
                }
            }
        }
    }
}

/// Closest point; returns the witness, which near queries start from.
pub fn closest(subject: &Subject<'_>, point: [f32; 3], scratch: &mut Scratch, fold: &mut Fold) -> [f32; 3] {
    match closest_point(subject, point, &Stop::EXACT, &mut scratch.queue) {
        Ok(answer) => {
            fold.f32(answer.lower);
            fold.f32(answer.upper);
            fold.point(answer.point);
            number(fold, answer.triangle);
            how(fold, answer.work, answer.ended);
            answer.point
        }
        Err(error) => {
            refusal(fold, error);
            point
        }
    }
}

/// First point of the segment from `a` to `b` on the surface.
pub fn first_hit(subject: &Subject<'_>, a: [f32; 3], b: [f32; 3], scratch: &mut Scratch, fold: &mut Fold) {
    match core_first_hit(subject, a, b, &Stop::EXACT, &mut scratch.queue) {
        Ok(answer) => {
            fold.f32(answer.lower);
            fold.f32(answer.upper);
            hits(fold, answer.hit.as_slice());
            how(fold, answer.work, answer.ended);
        }
        Err(error) => refusal(fold, error),
    }
}

/// Every point of the segment from `a` to `b` on the surface.
pub fn all_hits(subject: &Subject<'_>, a: [f32; 3], b: [f32; 3], scratch: &mut Scratch, fold: &mut Fold) {
    match core_all_hits(subject, a, b, &mut scratch.queue, &mut scratch.hits) {
        Ok(answer) => {
            hits(fold, scratch.hits.get(..answer.stored).unwrap_or_default());
            fold.word(answer.dropped);
            how(fold, answer.work, answer.ended);
        }
        Err(error) => refusal(fold, error),
    }
}

/// The hits of the segment from `a` to `b` that the refined hull finds from outside.
pub fn outer_hits(subject: &Subject<'_>, a: [f32; 3], b: [f32; 3], scratch: &mut Scratch, fold: &mut Fold) {
    for search in [Search::First, Search::Outer] {
        let Scratch { hits: found, performed, swept, candidates, .. } = &mut *scratch;
        let mut front = Front::new(performed, swept, candidates);
        match core_outer_hits(subject, a, b, search, &mut front, found) {
            Ok(answer) => {
                fold.f32(answer.lower);
                fold.f32(answer.upper);
                hits(fold, found.get(..answer.stored).unwrap_or_default());
                fold.word(answer.dropped);
                fold.word(u32::from(answer.starts_inside));
                how(fold, answer.work, answer.ended);
            }
            Err(error) => refusal(fold, error),
        }
    }
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
