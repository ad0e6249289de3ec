//! Questions to the box tree.

pub use meshsweep_core::Tree;
use meshsweep_core::query::tree::{
    AnyHit, Facing, Hint, Near, SegmentEntry, Session, Side, TreeEntry, Verdict, all_hits as core_all_hits,
    all_within as core_all_within, any_hit as core_any_hit, closest_point, closest_point_from,
    first_hit as core_first_hit, is_within as core_is_within, nearest as core_nearest, signed_distance,
};
use meshsweep_core::query::{Hit, Stop};

use super::{Refused, Subject, timed};
use crate::fold::Fold;
use crate::place::{Bounds, Placer};
use crate::{Clock, Kind};

/// Entries of each stack.
const STACK: usize = 64;

/// What the queries need beside the tree.
#[derive(Debug)]
pub struct Scratch<'t> {
    stack: [TreeEntry; STACK],
    segments: [SegmentEntry; STACK],
    hits: [Hit; 8],
    near: [Near; 8],
    hint: Hint,
    session: Session<'t>,
}

impl Scratch<'_> {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            stack: [TreeEntry::EMPTY; STACK],
            segments: [SegmentEntry::EMPTY; STACK],
            hits: [Hit::EMPTY; 8],
            near: [Near::EMPTY; 8],
            hint: Hint::NONE,
            session: Session::new(),
        }
    }
}

impl Default for Scratch<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Tree<'t> {
    type Scratch = Scratch<'t>;

    fn open(bytes: &'t [u8]) -> Result<Self, Refused> {
        open(bytes)
    }

    fn bounds(&self) -> Bounds {
        bounds(self)
    }

    fn memory_suffices(&self) -> bool {
        self.header().stack_entries as usize <= STACK
    }

    /// The opened tree, and the entries that it asks for.
    fn memory(&self) -> usize {
        let entries = self.header().stack_entries as usize;
        size_of::<Tree<'_>>() + entries.saturating_mul(size_of::<TreeEntry>())
    }

    fn suits(kind: Kind) -> bool {
        kind != Kind::OuterHits
    }

    fn ask(
        &self,
        kind: Kind,
        place: &mut Placer,
        scratch: &mut Scratch<'t>,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        match kind {
            Kind::Arith | Kind::OuterHits => {}
            Kind::Contents => contents(self, fold),
            Kind::ClosestFar => {
                closest(self, place.far(), scratch, clock, fold);
            }
            Kind::ClosestNear => {
                // The base is an answer: a wrong one shows in this block already, so its consequences mislead nobody.
                let base = closest(self, place.far(), scratch, &mut (), fold);
                closest(self, place.near(base), scratch, clock, fold);
            }
            Kind::ClosestPath => follow(self, place.step(), scratch, clock, fold),
            Kind::Session => session(self, place.step_or_jump(), scratch, clock, fold),
            Kind::Stopped => stopped(self, place.far(), place.distance(), scratch, clock, fold),
            Kind::Within => is_within(self, place.far(), place.distance(), scratch, clock, fold),
            Kind::AllWithin => all_within(self, place.far(), place.distance(), scratch, clock, fold),
            Kind::Nearest => nearest(self, place.far(), scratch, clock, fold),
            Kind::Signed => signed(self, place.far(), scratch, clock, fold),
            Kind::FirstHit => first_hit(self, place.segment(), scratch, clock, fold),
            Kind::Facing => facing(self, place.segment(), scratch, clock, fold),
            Kind::AnyHit => any_hit(self, place.segment(), scratch, clock, fold),
            Kind::AllHits => all_hits(self, place.segment(), scratch, clock, fold),
        }
    }
}

/// Opens the tree of a blob.
///
/// # Errors
/// The core's refusal.
pub fn open(bytes: &[u8]) -> Result<Tree<'_>, Refused> {
    Tree::open(bytes).map_err(Refused::of)
}

/// The surface's box in input units: products of a small integer and a power of two, the same everywhere.
#[must_use]
pub fn bounds(tree: &Tree<'_>) -> Bounds {
    let header = tree.header();
    let unit = power_of_two(tree.scale_exponent() + header.grid_exponent);
    [header.low, header.high].map(|[x, y, z]| {
        let [ox, oy, oz] = header.grid_origin;
        [(x, ox), (y, oy), (z, oz)].map(|(x, origin)| (i32::from(x).wrapping_add(origin)) as f32 * unit)
    })
}

fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent.clamp(-126, 127)) as u32) << 23)
}

/// Nodes with their boxes, leaves with their triangles.
pub fn contents(tree: &Tree<'_>, fold: &mut Fold) {
    let header = tree.header();
    for word in [header.nodes, header.leaves, header.vertices, header.triangles, header.stack_entries] {
        fold.word(word);
    }
    fold.f32(header.surface_error);
    fold.f32(header.reach);
    let mut leaf = 0;
    for node in 0..header.nodes {
        let boxes = tree.boxes(node).into_iter().flatten();
        for &byte in tree.frame(node).into_iter().flatten().chain(boxes) {
            fold.byte(byte);
        }
        let Some(links) = tree.links(node) else { continue };
        for lane in 0..links.count {
            let child = links.child(lane);
            fold.word(child.at);
            fold.byte(child.tag.0);
            let Some(patch) = tree.leaf(node, lane) else { continue };
            let first = links.triangle(lane);
            for triangle in 0..child.tag.triangles() {
                for corner in patch.corners(triangle) {
                    fold.point(corner.to_array());
                }
                super::number(fold, tree.source(first.wrapping_add(triangle as u32)));
            }
            for byte in tree.cone(leaf).into_iter().flatten() {
                fold.byte(byte);
            }
            leaf += 1;
        }
    }
}

/// Closest point; returns the witness.
pub fn closest(
    tree: &Tree<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) -> [f32; 3] {
    match timed(clock, || closest_point(tree, point, &Stop::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            super::closest_point(fold, &answer);
            answer.point
        }
        Err(error) => {
            super::refusal(fold, error);
            point
        }
    }
}

/// Closest point, from where the last one was found.
pub fn follow(
    tree: &Tree<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, hint, .. } = scratch;
    match timed(clock, || closest_point_from(tree, point, &Stop::EXACT, stack, hint)) {
        Ok(answer) => super::closest_point(fold, &answer),
        Err(error) => super::refusal(fold, error),
    }
}

/// Closest point, by a session that remembers what the last answers ruled out.
pub fn session<'t>(
    tree: &Tree<'t>,
    point: [f32; 3],
    scratch: &mut Scratch<'t>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, session, .. } = scratch;
    match timed(clock, || session.closest_point(tree, point, &Stop::EXACT, stack)) {
        Ok(answer) => {
            super::closest_point(fold, &answer.closest);
            fold.f32(answer.safe_radius);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// Closest point with a tolerance of a tenth, with one of `distance`, and with three nodes to open.
pub fn stopped(
    tree: &Tree<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let stops = [
        Stop { relative: 0.1, ..Stop::EXACT },
        Stop { absolute: distance, ..Stop::EXACT },
        Stop { steps: 3, ..Stop::EXACT },
    ];
    for stop in &stops {
        match timed(clock, || closest_point(tree, point, stop, &mut scratch.stack)) {
            Ok(answer) => super::closest_point(fold, &answer),
            Err(error) => super::refusal(fold, error),
        }
    }
}

/// Whether the surface is within a distance.
pub fn is_within(
    tree: &Tree<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || core_is_within(tree, point, distance, &Stop::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            let [kind, triangle] = match answer.verdict {
                Verdict::Yes { triangle } => [1, triangle],
                Verdict::No => [2, 0],
                Verdict::Unknown => [3, 0],
            };
            fold.word(kind);
            fold.word(triangle);
            super::how(fold, answer.work, answer.ended);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// The eight closest triangles.
pub fn nearest(
    tree: &Tree<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, near, .. } = scratch;
    match timed(clock, || core_nearest(tree, point, &Stop::EXACT, near, stack)) {
        Ok(answer) => {
            found(fold, near.get(..answer.stored).unwrap_or_default());
            fold.f32(answer.rest_lower);
            super::how(fold, answer.work, answer.ended);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// All triangles within a distance, as far as eight places hold them.
pub fn all_within(
    tree: &Tree<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { stack, near, .. } = scratch;
    match timed(clock, || core_all_within(tree, point, distance, &Stop::EXACT, near, stack)) {
        Ok(answer) => {
            found(fold, near.get(..answer.stored).unwrap_or_default());
            fold.word(answer.certain as u32);
            fold.word(answer.dropped);
            super::how(fold, answer.work, answer.ended);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// Distance with the sign of the side.
pub fn signed(
    tree: &Tree<'_>,
    point: [f32; 3],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || signed_distance(tree, point, &Stop::EXACT, &mut scratch.stack)) {
        Ok(answer) => {
            fold.f32(answer.lower);
            fold.f32(answer.upper);
            fold.word(match answer.side {
                Side::Outside => 1,
                Side::Inside => 2,
                Side::Undefined => 3,
            });
            super::closest_point(fold, &answer.closest);
        }
        Err(error) => super::refusal(fold, error),
    }
}

/// First point of the segment from `a` to `b` on the surface.
pub fn first_hit(
    tree: &Tree<'_>,
    ends: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    hit_of(tree, ends, Facing::Both, scratch, clock, fold);
}

/// First point of the segment from `a` to `b` on a triangle's front, then on a back.
pub fn facing(
    tree: &Tree<'_>,
    ends: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    for facing in [Facing::Front, Facing::Back] {
        hit_of(tree, ends, facing, scratch, clock, fold);
    }
}

fn hit_of(
    tree: &Tree<'_>,
    [a, b]: [[f32; 3]; 2],
    facing: Facing,
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || core_first_hit(tree, a, b, &facing, &mut scratch.segments)) {
        Ok(answer) => super::segment_hit(fold, &answer),
        Err(error) => super::refusal(fold, error),
    }
}

/// Whether the segment from `a` to `b` meets the surface.
pub fn any_hit(
    tree: &Tree<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    match timed(clock, || core_any_hit(tree, a, b, &Facing::Both, &mut scratch.segments)) {
        Ok(answer) => fold.word(match answer {
            AnyHit::Hit => 1,
            AnyHit::Clear => 2,
            AnyHit::Unknown => 3,
        }),
        Err(error) => super::refusal(fold, error),
    }
}

/// Every point of the segment from `a` to `b` on the surface.
pub fn all_hits(
    tree: &Tree<'_>,
    [a, b]: [[f32; 3]; 2],
    scratch: &mut Scratch<'_>,
    clock: &mut impl Clock,
    fold: &mut Fold,
) {
    let Scratch { segments, hits, .. } = scratch;
    match timed(clock, || core_all_hits(tree, a, b, &Facing::Both, hits, segments)) {
        Ok(answer) => {
            super::hits(fold, hits.get(..answer.stored).unwrap_or_default());
            fold.word(answer.dropped);
            super::how(fold, answer.work, answer.ended);
        }
        Err(error) => super::refusal(fold, error),
    }
}

fn found(fold: &mut Fold, triangles: &[Near]) {
    for near in triangles {
        fold.f32(near.lower);
        fold.f32(near.upper);
        fold.point(near.point);
        fold.word(near.triangle);
    }
}
