//! Questions to the tribox hierarchy of a blob.

pub use meshsweep_core::Triboxes;
use meshsweep_core::{Budget, NodePair, Pose, ScratchEntry, TriboxBound};

use super::tree::pose;
use super::{Asked, Refused, Subject, how, number};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Ends, Place, Point};

/// Entries of the stack of pairs: more than twice most splits above a node of the suite's blobs.
const STACK: usize = 64;

/// What the queries need beside the triboxes.
#[derive(Debug)]
pub struct Scratch {
    stack: [ScratchEntry; STACK],
    found: [NodePair; 16],
}

impl Scratch {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self { stack: [ScratchEntry::EMPTY; STACK], found: [NodePair::EMPTY; 16] }
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Triboxes<'t> {
    type Scratch = Scratch;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.separation_entries(self) <= STACK && self.scratch_entries() <= STACK
    }

    /// The opened hierarchy, and the pairs that two of them ask for.
    fn memory(&self) -> usize {
        size_of::<Triboxes<'_>>()
            + self.separation_entries(self).saturating_mul(size_of::<ScratchEntry>())
    }

    asks! { Scratch, |self, place, scratch, to|
        Arith => ();
        Contents => contents(self, to.fold);
        TriboxesApart => reject(self, pose(place.motion()), scratch, to);
        TriboxesCandidates => candidates(self, pose(place.motion()), scratch, to);
        TriboxesWithin => {
            let (pose, distance) = (pose(place.motion()), place.distance());
            within(self, pose, distance, scratch, to)
        };
        TriboxesDistance => nearest(self, place.far(), scratch, to);
        TriboxesClip => first(self, place.segment(), scratch, to);
    }
}

/// Opens the triboxes of a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<Triboxes<'_>, Refused> {
    Triboxes::open(bytes).map_err(Refused::of)
}

/// The root's box.
#[must_use]
pub fn bounds(triboxes: &Triboxes<'_>) -> Bounds {
    let corner = |[x, y, z, ..]: [f32; 9]| [x, y, z];
    triboxes.node(0).map_or([[0.0; 3]; 2], |root| [corner(root.low), corner(root.high)])
}

/// Nodes, levels, and the leaves of each.
pub fn contents(triboxes: &Triboxes<'_>, fold: &mut Fold) {
    for word in [triboxes.node_count(), triboxes.level_count(), triboxes.depth()] {
        fold.word(word);
    }
    fold.word(u32::from(triboxes.is_solid()));
    for node in 0..triboxes.node_count() {
        number(fold, triboxes.parent(node));
        triboxes.error(node).into_iter().for_each(|error| fold.f32(error));
        triboxes.children(node).into_iter().flatten().for_each(|child| fold.word(child));
    }
    for level in triboxes.levels() {
        [level.distance, level.error, level.void_ratio].into_iter().for_each(|x| fold.f32(x));
        for (node, tribox) in triboxes.coarser(level.triboxes).leaves() {
            fold.word(node);
            tribox.low.iter().chain(&tribox.high).for_each(|&x| fold.f32(x));
            tribox.boundary().vertices.iter().for_each(|&vertex| fold.point(vertex));
        }
    }
}

fn pairs(fold: &mut Fold, pairs: &[NodePair]) {
    pairs.iter().for_each(|pair| fold.word(u32::from(pair.a) << 16 | u32::from(pair.b)));
}

/// Whether the model is apart from a copy of it that was moved.
#[inline(never)]
pub fn reject(all: &Triboxes<'_>, pose: Pose, s: &mut Scratch, to: &mut Asked<'_, impl Observer>) {
    to.answer(
        || all.separation(all, pose, Budget::EXACT, &mut s.stack),
        |fold, answer| {
            pairs(fold, answer.may_meet.as_slice());
            how(fold, answer.ended);
        },
    );
}

/// Whether it is farther than a distance from that copy.
#[inline(never)]
pub fn within(
    all: &Triboxes<'_>,
    pose: Pose,
    distance: f32,
    s: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    to.answer(
        || all.within_of(all, pose, distance, Budget::EXACT, &mut s.stack),
        |fold, answer| {
            pairs(fold, answer.may_meet.as_slice());
            how(fold, answer.ended);
        },
    );
}

/// Where it may meet that copy; more pairs than there are places for.
#[inline(never)]
pub fn candidates(
    all: &Triboxes<'_>,
    pose: Pose,
    scratch: &mut Scratch,
    to: &mut Asked<'_, impl Observer>,
) {
    let Scratch { stack, found } = scratch;
    let call = || all.candidates(all, pose, found, Budget::EXACT, stack);
    if let Some(answer) = to.answer(call, |_, _| ()) {
        pairs(to.fold, found.get(..answer.stored).unwrap_or_default());
        to.fold.word(answer.dropped);
        how(to.fold, answer.ended);
    }
}

pub(super) fn bound(fold: &mut Fold, answer: &TriboxBound) {
    fold.f32(answer.lower);
    number(fold, answer.node);
    how(fold, answer.ended);
}

/// A lower bound of a distance.
#[inline(never)]
pub fn nearest(all: &Triboxes<'_>, p: Point, s: &mut Scratch, to: &mut Asked<'_, impl Observer>) {
    to.answer(|| all.distance(p, Budget::EXACT, &mut s.stack), bound);
}

/// Where a segment first enters.
#[inline(never)]
pub fn first(all: &Triboxes<'_>, [a, b]: Ends, s: &mut Scratch, to: &mut Asked<'_, impl Observer>) {
    to.answer(|| all.clip(a, b, Budget::EXACT, &mut s.stack), bound);
}
