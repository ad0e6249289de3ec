//! Kinds, blocks and the loop over them.

use crate::ask::{self, Refused, Scratch, Subject};
use crate::fold::Fold;
use crate::place::Bounds;
use crate::rng::Rng;
use crate::{arith, place};

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
    /// Closest point along a path of small steps and few jumps, by a session.
    Session,
}

impl Kind {
    /// All kinds in the order in which they are run.
    pub const ALL: [Self; 16] = [
        Self::Arith,
        Self::Contents,
        Self::ClosestFar,
        Self::ClosestNear,
        Self::ClosestPath,
        Self::FirstHit,
        Self::AllHits,
        Self::OuterHits,
        Self::Stopped,
        Self::Within,
        Self::Nearest,
        Self::AllWithin,
        Self::Signed,
        Self::Facing,
        Self::AnyHit,
        Self::Session,
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
            Self::Session => "session",
        }
    }

    /// Whether such a blob can be asked this.
    #[must_use]
    pub const fn suits(self, subject: &Subject<'_>) -> bool {
        match self {
            Self::Arith
            | Self::Contents
            | Self::ClosestFar
            | Self::ClosestNear
            | Self::ClosestPath
            | Self::FirstHit
            | Self::AllHits => true,
            Self::OuterHits => matches!(subject, Subject::Hull(_)),
            Self::Stopped
            | Self::Within
            | Self::Nearest
            | Self::AllWithin
            | Self::Signed
            | Self::Facing
            | Self::AnyHit
            | Self::Session => matches!(subject, Subject::Tree(_)),
        }
    }

    const fn seed(self) -> u64 {
        0x6d65_7368_7377_6570 ^ ((self as u64) << 56)
    }
}

/// How much is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Blocks of each kind, one hash each.
    pub blocks: u32,
    /// Queries of a block.
    pub queries: u32,
}

impl Plan {
    /// What the host and all images run.
    pub const STANDARD: Self = Self { blocks: 16, queries: 32 };
}

/// Told when the core is called: what lies between the two is the core's alone, without placing the query and folding the answer.
pub trait Clock {
    /// The core is about to be called.
    fn query_begins(&mut self) {}
    /// The core has answered.
    fn query_ends(&mut self) {}
}

/// Nobody looks at the clock.
impl Clock for () {}

/// Told what happens, in this order: begins, then kind by kind: kind begins, (query begins, query ends) × queries, block, …, kind ends.
pub trait Recorder: Clock {
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
/// The core's refusal of the blob, or [`Refused::MEMORY`] if queries could end for want of scratch. Refused queries are answers: they are folded like any other.
pub fn run<'t>(
    blob: &'t [u8],
    plan: Plan,
    scratch: &mut Scratch<'t>,
    recorder: &mut impl Recorder,
) -> Result<(), Refused> {
    let subject = ask::open(blob)?;
    if !subject.memory_suffices() {
        return Err(Refused::MEMORY);
    }
    recorder.begins(subject.memory());
    let bounds = subject.bounds();
    for kind in Kind::ALL.into_iter().filter(|kind| kind.suits(&subject)) {
        recorder.kind_begins(kind);
        let mut queries = Queries { rng: Rng::new(kind.seed()), bounds, here: [0.0; 3] };
        queries.here = place::far_point(&mut queries.rng, &bounds);
        // The contents are the same each time they are asked for.
        let plan = if kind == Kind::Contents { Plan { blocks: 1, queries: 1 } } else { plan };
        for index in 0..plan.blocks {
            let mut fold = Fold::new();
            for _ in 0..plan.queries {
                queries.ask(kind, &subject, scratch, recorder, &mut fold);
            }
            recorder.block(kind, index, fold.finish());
        }
        recorder.kind_ends(kind);
    }
    Ok(())
}

/// Where the queries of a kind come from.
struct Queries {
    rng: Rng,
    bounds: Bounds,
    /// Where the path is.
    here: [f32; 3],
}

impl Queries {
    fn ask<'t>(
        &mut self,
        kind: Kind,
        subject: &Subject<'t>,
        scratch: &mut Scratch<'t>,
        clock: &mut impl Clock,
        fold: &mut Fold,
    ) {
        let Self { rng, bounds, here } = self;
        match (kind, subject) {
            (Kind::Arith, _) => {
                clock.query_begins();
                arith::chain(rng, fold);
                clock.query_ends();
            }
            (Kind::Contents, _) => subject.contents(fold),
            (Kind::ClosestFar, _) => {
                subject.closest(place::far_point(rng, bounds), scratch, clock, fold);
            }
            (Kind::ClosestNear, _) => {
                // The base is an answer: a wrong one shows in this block already, so its consequences mislead nobody.
                let base = subject.closest(place::far_point(rng, bounds), scratch, &mut (), fold);
                subject.closest(place::near_point(rng, bounds, base), scratch, clock, fold);
            }
            (Kind::ClosestPath, _) => {
                *here = place::path_point(rng, bounds, *here);
                subject.follow(*here, scratch, clock, fold);
            }
            (Kind::FirstHit, _) => subject.first_hit(place::segment(rng, bounds), scratch, clock, fold),
            (Kind::AllHits, _) => subject.all_hits(place::segment(rng, bounds), scratch, clock, fold),
            (Kind::OuterHits, Subject::Hull(model)) => {
                ask::hull::outer_hits(model, place::segment(rng, bounds), &mut scratch.hull, clock, fold);
            }
            (Kind::Facing, Subject::Tree(tree)) => {
                ask::tree::facing(tree, place::segment(rng, bounds), &mut scratch.tree, clock, fold);
            }
            (Kind::AnyHit, Subject::Tree(tree)) => {
                ask::tree::any_hit(tree, place::segment(rng, bounds), &mut scratch.tree, clock, fold);
            }
            (Kind::Session, Subject::Tree(tree)) => {
                let jumps = rng.next_u32() & 0x7F == 0;
                *here =
                    if jumps { place::far_point(rng, bounds) } else { place::path_point(rng, bounds, *here) };
                ask::tree::session(tree, *here, &mut scratch.tree, clock, fold);
            }
            (_, Subject::Tree(tree)) => {
                let (point, distance) = (place::far_point(rng, bounds), place::distance(rng, bounds));
                let scratch = &mut scratch.tree;
                match kind {
                    Kind::Stopped => ask::tree::stopped(tree, point, distance, scratch, clock, fold),
                    Kind::Within => ask::tree::is_within(tree, point, distance, scratch, clock, fold),
                    Kind::AllWithin => ask::tree::all_within(tree, point, distance, scratch, clock, fold),
                    Kind::Nearest => ask::tree::nearest(tree, point, scratch, clock, fold),
                    Kind::Signed => ask::tree::signed(tree, point, scratch, clock, fold),
                    _ => {}
                }
            }
            (_, Subject::Hull(_)) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Clock, Kind, Plan, Recorder, run};
    use crate::ask::{Refused, Scratch};

    struct Count(u32);

    impl Clock for Count {}

    impl Recorder for Count {
        fn block(&mut self, _kind: Kind, _index: u32, _hash: u64) {
            self.0 += 1;
        }
    }

    #[test]
    fn a_refused_blob_runs_nothing() {
        let mut count = Count(0);
        let plan = Plan { blocks: 3, queries: 5 };
        assert_eq!(
            run(b"not a blob at all, but long enough to be read", plan, &mut Scratch::new(), &mut count),
            Err(Refused(3))
        );
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
