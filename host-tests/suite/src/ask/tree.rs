//! Questions to the box tree.

mod distance;
mod meeting;
mod sight;

pub use meshsweep_core::Bvh;
use meshsweep_core::TriangleHit;
use meshsweep_core::{Blob, CoherentQuery, Hint, Neighbor, ScratchEntry, TrianglePair};

use super::{Asked, Refused, Subject};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::{Bounds, Place};

pub use distance::{
    all_within, closest, coherent, follow, is_within, nearest, precise, signed, stopped,
};
pub use meeting::{all_overlaps, overlap, pose};
pub use sight::{all_hits, any_hit, cull, facing, first_hit, ray};

/// Entries of the stack.
const STACK: usize = 64;

/// What the queries need beside the tree.
#[derive(Debug)]
pub struct Scratch<'t> {
    stack: [ScratchEntry; STACK],
    hits: [TriangleHit; 8],
    near: [Neighbor; 8],
    hint: Hint,
    coherent: CoherentQuery<'t>,
    facing: [u32; 64],
    pairs: [ScratchEntry; Bvh::OVERLAP_ENTRIES],
    meeting: [TrianglePair; 8],
}

impl Scratch<'_> {
    /// Scratch that no query has used.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            stack: [ScratchEntry::EMPTY; STACK],
            hits: [TriangleHit::EMPTY; 8],
            near: [Neighbor::EMPTY; 8],
            hint: Hint::NONE,
            coherent: CoherentQuery::new(),
            facing: [0; 64],
            pairs: [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES],
            meeting: [TrianglePair::EMPTY; 8],
        }
    }
}

impl Default for Scratch<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'t> Subject<'t> for Bvh<'t> {
    const ASKS_TRIBOXES_OF_POINTS: bool = true;

    type Scratch = Scratch<'t>;

    opened_here! { 't }

    fn memory_suffices(&self) -> bool {
        self.scratch_entries() <= STACK
    }

    /// The opened tree, and the entries that it asks for.
    fn memory(&self) -> usize {
        let entries = self.scratch_entries();
        size_of::<Bvh<'_>>() + entries.saturating_mul(size_of::<ScratchEntry>())
    }

    asks! { Scratch<'t>, |self, place, scratch, to|
        Arith => ();
        Contents => contents(self, to.fold);
        ClosestFar => {
            closest(self, place.far(), scratch, to);
        };
        ClosestNear => {
            // The base is an answer: a wrong one shows in this block already, so its
            // consequences mislead nobody.
            let base = closest(self, place.far(), scratch, &mut Asked::new((), to.fold));
            closest(self, place.near(base), scratch, to);
        };
        ClosestPath => follow(self, place.step(), scratch, to);
        ClosestPrecise => {
            let base = closest(self, place.far(), scratch, &mut Asked::new((), to.fold));
            precise(self, place.near(base), scratch, to);
        };
        CoherentQuery => coherent(self, place.step_or_jump(), scratch, to);
        Stopped => stopped(self, place.far(), place.distance(), scratch, to);
        Within => is_within(self, place.far(), place.distance(), scratch, to);
        AllWithin => all_within(self, place.far(), place.distance(), scratch, to);
        Nearest => nearest(self, place.far(), scratch, to);
        Signed => signed(self, place.far(), scratch, to);
        FirstHit => first_hit(self, place.segment(), scratch, to);
        Facing => facing(self, place.segment(), scratch, to);
        AnyHit => any_hit(self, place.segment(), scratch, to);
        AllHits => all_hits(self, place.segment(), scratch, to);
        Ray => ray(self, place.segment(), scratch, to);
        Cull => cull(self, place.far(), scratch, to);
        Overlap => overlap(self, pose(place.motion()), scratch, to);
        AllOverlaps => all_overlaps(self, pose(place.motion()), scratch, to);
    }
}

/// Opens the tree of a blob.
///
/// # Errors
/// The core's refusal.
#[inline(never)]
pub fn open(bytes: &[u8]) -> Result<Bvh<'_>, Refused> {
    Bvh::open(bytes).map_err(Refused::of)
}

/// Opens without a check of the records.
///
/// # Errors
/// The core's refusal.
pub fn trusted(bytes: &[u8]) -> Result<Bvh<'_>, Refused> {
    Blob::checksum(bytes).map_err(Refused::of)?;
    Bvh::open_trusted(bytes).map_err(Refused::of)
}

/// The surface's box in input units: products of a small integer and a power of two, the same
/// everywhere.
#[must_use]
pub fn bounds(tree: &Bvh<'_>) -> Bounds {
    let header = tree.header();
    let unit = power_of_two(tree.scale_exponent() + header.grid_exponent);
    [header.low, header.high].map(|[x, y, z]| {
        let [ox, oy, oz] = header.grid_origin;
        [(x, ox), (y, oy), (z, oz)]
            .map(|(x, origin)| (i32::from(x).wrapping_add(origin)) as f32 * unit)
    })
}

fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent.clamp(-126, 127)) as u32) << 23)
}

/// Nodes with their boxes, leaves with their triangles.
pub fn contents(tree: &Bvh<'_>, fold: &mut Fold) {
    let header = tree.header();
    for word in
        [header.nodes, header.leaves, header.vertices, header.triangles, header.stack_entries]
    {
        fold.word(word);
    }
    fold.f32(header.surface_error);
    fold.f32(header.star_radius);
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
            fold.byte(child.shape.0);
            let Some(fans) = tree.leaf(node, lane) else { continue };
            let first = links.triangle(lane);
            for triangle in 0..child.shape.triangles() {
                for corner in fans.corners(triangle) {
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
