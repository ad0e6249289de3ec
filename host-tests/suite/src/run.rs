//! Kinds, blocks and the loop over them.

use crate::arith;
use crate::ask::{Refused, Subject, tribox};
use crate::fold::Fold;
use crate::place::Placer;

/// What a block asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The target's own arithmetic.
    Arith,
    /// What the blob says of itself.
    Contents,
    /// Closest point from the doubled box.
    ClosestFar,
    /// Closest point from near the surface.
    ClosestNear,
    /// Closest point along a path of small steps.
    ClosestPath,
    /// First hit of a segment through the doubled box.
    FirstHit,
    /// All hits of such a segment.
    AllHits,
    /// Such a segment on the refined hull.
    OuterHits,
    /// Closest point with tolerances and with too few steps.
    Stopped,
    /// Whether the surface is within a distance.
    Within,
    /// The closest triangles.
    Nearest,
    /// All triangles within a distance.
    AllWithin,
    /// Distance with a sign.
    Signed,
    /// First hit of a segment on fronts, and on backs.
    Facing,
    /// Whether a segment meets the surface.
    AnyHit,
    /// Closest point along a path of small steps and few jumps, by a coherent query.
    CoherentQuery,
    /// Closest points of eight points from the doubled box.
    Batch,
    /// Triangles that may face an eye.
    Cull,
    /// Whether the surface meets its moved copy.
    Overlap,
    /// All pairs of triangles that do.
    AllOverlaps,
    /// The tribox of eight points.
    TriboxBounds,
    /// The boundary of a tribox.
    TriboxFaces,
    /// Whether two triboxes overlap.
    TriboxOverlap,
    /// Whether two boxes do, for comparison.
    BoxOverlap,
    /// All else that triboxes answer.
    TriboxRest,
    /// Whether a tribox hierarchy is apart from a moved copy.
    TriboxesApart,
    /// Which of its leaves may meet those of the copy.
    TriboxesCandidates,
    /// A lower bound of the distance from the doubled box.
    TriboxesDistance,
    /// Where a segment first enters a leaf.
    TriboxesClip,
    /// The hull refined for a focus that moves.
    Refine,
    /// A sweep that is moved, interrupted, and asked for more triangles.
    Sweep,
    /// Closest point of the model under a pose.
    Posed,
    /// Closest point between two key frames.
    Frame,
    /// An update of a moved hull.
    Update,
    /// Closest point of a moved hull.
    Moved,
    /// How far the surface is from its moved copy.
    PairDistance,
    /// How far a capsule is from the surface.
    Solid,
    /// Where a capsule that moves first meets the surface.
    Contact,
    /// How often the surface encloses a point.
    Winding,
    /// Which two of three moved copies are nearest.
    Scene,
    /// How far the surface is from its copy, which moves in small steps.
    CoherentPair,
    /// How deep the solid is in its moved copy.
    Penetration,
    /// Closest point in f64 from near the surface.
    ClosestPrecise,
}

impl Kind {
    /// All kinds in the order in which they are run.
    pub const ALL: [Self; 43] = [
        Self::Arith,
        Self::Contents,
        Self::ClosestFar,
        Self::ClosestNear,
        Self::ClosestPath,
        Self::FirstHit,
        Self::AllHits,
        Self::OuterHits,
        Self::Refine,
        Self::Sweep,
        Self::Posed,
        Self::Stopped,
        Self::Within,
        Self::Nearest,
        Self::AllWithin,
        Self::Signed,
        Self::Facing,
        Self::AnyHit,
        Self::CoherentQuery,
        Self::Batch,
        Self::Cull,
        Self::Overlap,
        Self::AllOverlaps,
        Self::PairDistance,
        Self::Solid,
        Self::Contact,
        Self::Winding,
        Self::Scene,
        Self::CoherentPair,
        Self::Penetration,
        Self::TriboxBounds,
        Self::TriboxFaces,
        Self::TriboxOverlap,
        Self::BoxOverlap,
        Self::TriboxRest,
        Self::TriboxesApart,
        Self::TriboxesCandidates,
        Self::TriboxesDistance,
        Self::TriboxesClip,
        Self::Frame,
        Self::Update,
        Self::Moved,
        Self::ClosestPrecise,
    ];

    /// The name in reports: one word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arith => "arith",
            Self::Contents => "contents",
            Self::ClosestFar => "closest_far",
            Self::ClosestNear => "closest_near",
            Self::ClosestPath => "closest_path",
            Self::ClosestPrecise => "closest_precise",
            Self::FirstHit => "first_hit",
            Self::AllHits => "all_hits",
            Self::OuterHits => "outer_hits",
            Self::Stopped => "stopped",
            Self::Within => "within",
            Self::Nearest => "nearest",
            Self::AllWithin => "all_within",
            Self::Signed => "signed",
            Self::Facing => "facing",
            Self::AnyHit => "any_hit",
            Self::CoherentQuery => "coherent_query",
            Self::Batch => "batch_of_8",
            Self::Cull => "cull",
            Self::Overlap => "overlap",
            Self::AllOverlaps => "all_overlaps",
            Self::PairDistance => "pair_distance",
            Self::Solid => "solid",
            Self::Contact => "first_contact",
            Self::Winding => "winding",
            Self::Scene => "scene",
            Self::CoherentPair => "coherent_pair",
            Self::Penetration => "penetration",
            Self::TriboxBounds => "tribox_bounds",
            Self::TriboxFaces => "tribox_faces",
            Self::TriboxOverlap => "tribox_overlap",
            Self::BoxOverlap => "box_overlap",
            Self::TriboxRest => "tribox_rest",
            Self::TriboxesApart => "triboxes_apart",
            Self::TriboxesCandidates => "triboxes_candidates",
            Self::TriboxesDistance => "triboxes_distance",
            Self::TriboxesClip => "triboxes_clip",
            Self::Refine => "refine",
            Self::Sweep => "sweep",
            Self::Posed => "posed",
            Self::Frame => "frame",
            Self::Update => "update",
            Self::Moved => "moved",
        }
    }

    /// Whether it is about triboxes: no blob is asked.
    const fn is_tribox(self) -> bool {
        matches!(
            self,
            Self::TriboxBounds
                | Self::TriboxFaces
                | Self::TriboxOverlap
                | Self::BoxOverlap
                | Self::TriboxRest
        )
    }

    /// Whether it is about a blob's triboxes.
    #[must_use]
    pub const fn is_triboxes(self) -> bool {
        matches!(
            self,
            Self::TriboxesApart
                | Self::TriboxesCandidates
                | Self::TriboxesDistance
                | Self::TriboxesClip
        )
    }

    /// Whether it is about a hull that deforms.
    #[must_use]
    pub const fn is_deform(self) -> bool {
        matches!(self, Self::Frame | Self::Update | Self::Moved)
    }

    /// Whether the documents' tables hold its instructions on the boards.
    #[must_use]
    pub const fn is_tabled(self) -> bool {
        matches!(
            self,
            Self::ClosestFar
                | Self::ClosestNear
                | Self::FirstHit
                | Self::OuterHits
                | Self::Within
                | Self::Signed
        )
    }

    const fn seed(self) -> u64 {
        0x6d65_7368_7377_6570 ^ ((self as u64) << 56)
    }
}

/// How much is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Blocks of each kind that is [tabled](Kind::is_tabled), one hash each.
    pub tabled_blocks: u32,
    /// Blocks of each other kind.
    pub blocks: u32,
    /// Queries of a block.
    pub queries: u32,
}

impl Plan {
    /// What the host runs. An image runs as many of these blocks as its host asks for.
    pub const STANDARD: Self = Self { tabled_blocks: 16, blocks: 16, queries: 32 };
}

/// Told when the core is called: what lies between the two is the core's alone, without placing the
/// query and folding the answer.
pub trait Clock {
    /// The core is about to be called.
    fn query_begins(&mut self) {}
    /// The core has answered.
    fn query_ends(&mut self) {}
}

/// Nobody looks at the clock.
impl Clock for () {}

impl<C: Clock> Clock for &mut C {
    fn query_begins(&mut self) {
        C::query_begins(self);
    }

    fn query_ends(&mut self) {
        C::query_ends(self);
    }
}

/// Told what happens, in this order: opening begins, begins, then kind by kind: kind begins,
/// (query begins, query ends) × queries, block, …, kind ends.
pub trait Recorder: Clock {
    /// The blob is about to be opened.
    fn opening_begins(&mut self) {}
    /// The blob was opened; queries need so many bytes of RAM beside the stack.
    fn begins(&mut self, _memory: usize) {}
    /// The first query of `kind` is about to be placed.
    fn kind_begins(&mut self, _kind: Kind) {}
    /// A block is done; `hash` covers all its answers.
    fn block(&mut self, kind: Kind, index: u32, hash: u64);
    /// The last block of `kind` was recorded.
    fn kind_ends(&mut self, _kind: Kind) {}
}

/// Opens the blob and runs all kinds that suit it.
///
/// # Errors
/// The core's refusal of the blob, or [`Refused::MEMORY`] if queries could end for want of scratch.
/// Refused queries are answers: they are folded like any other.
pub fn run<'t, S: Subject<'t>>(
    blob: &'t [u8],
    plan: Plan,
    scratch: &mut S::Scratch,
    recorder: &mut impl Recorder,
) -> Result<(), Refused> {
    recorder.opening_begins();
    let subject = S::open(blob)?;
    if !subject.memory_suffices() {
        return Err(Refused::MEMORY);
    }
    recorder.begins(subject.memory());
    let bounds = subject.bounds();
    for kind in Kind::ALL.into_iter().filter(|kind| S::suits(*kind)) {
        recorder.kind_begins(kind);
        let mut placer = Placer::new(kind.seed(), bounds);
        let (blocks, queries) = match kind {
            // The contents are the same each time they are asked for.
            Kind::Contents => (1, 1),
            kind if kind.is_tabled() => (plan.tabled_blocks, plan.queries),
            _ => (plan.blocks, plan.queries),
        };
        for index in 0..blocks {
            let mut fold = Fold::new();
            for _ in 0..queries {
                if kind == Kind::Arith {
                    recorder.query_begins();
                    arith::chain(&mut placer.rng, &mut fold);
                    recorder.query_ends();
                } else if S::ASKS_TRIBOXES_OF_POINTS && kind.is_tribox() {
                    tribox::ask(kind, &mut placer, recorder, &mut fold);
                } else {
                    subject.ask(kind, &mut placer, scratch, recorder, &mut fold);
                }
            }
            recorder.block(kind, index, fold.finish());
        }
        recorder.kind_ends(kind);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Clock, Kind, Plan, Recorder, run};
    use crate::ask::{Refused, hull, tree};

    struct Count(u32);

    impl Clock for Count {}

    impl Recorder for Count {
        fn block(&mut self, _kind: Kind, _index: u32, _hash: u64) {
            self.0 += 1;
        }
    }

    #[test]
    fn a_refused_blob_runs_nothing() {
        const BYTES: &[u8] = b"not a blob at all, but long enough to be read";
        let mut count = Count(0);
        let plan = Plan { tabled_blocks: 3, blocks: 3, queries: 5 };
        let (mut hull, mut tree) = (hull::Scratch::new(), tree::Scratch::new());
        assert_eq!(run::<hull::Model<'_>>(BYTES, plan, &mut hull, &mut count), Err(Refused(3)));
        assert_eq!(run::<tree::Bvh<'_>>(BYTES, plan, &mut tree, &mut count), Err(Refused(3)));
        assert_eq!(count.0, 0);
    }

    #[test]
    fn kinds_have_names_and_seeds_of_their_own() {
        for (index, a) in Kind::ALL.into_iter().enumerate() {
            for b in Kind::ALL.into_iter().skip(index + 1) {
                assert_ne!(a.name(), b.name());
                assert_ne!(a.seed(), b.seed());
            }
        }
    }
}
