//! Kinds, blocks and the loop over them.

use crate::ask::{self, Refused, Scratch};
use crate::fold::Fold;
use crate::rng::Rng;
use crate::{arith, place};

/// What a block asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The target's own arithmetic.
    Arith,
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
    /// What the blob says of itself.
    Contents,
}

impl Kind {
    /// All kinds in the order in which they are run.
    pub const ALL: [Self; 8] = [
        Self::Arith,
        Self::Contents,
        Self::ClosestFar,
        Self::ClosestNear,
        Self::ClosestPath,
        Self::FirstHit,
        Self::AllHits,
        Self::OuterHits,
    ];

    /// The name in reports: one word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arith => "arith",
            Self::ClosestFar => "closest_far",
            Self::ClosestNear => "closest_near",
            Self::ClosestPath => "closest_path",
            Self::FirstHit => "first_hit",
            Self::AllHits => "all_hits",
            Self::OuterHits => "outer_hits",
            Self::Contents => "contents",
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

/// Told what happens, in this order: kind begins, (query begins, query ends) × queries, block, …, kind ends.
///
/// Only the core's call lies between `query_begins` and `query_ends`; placing the query does not.
pub trait Recorder {
    /// The first query of `kind` is about to be placed.
    fn kind_begins(&mut self, _kind: Kind) {}
    /// The core is about to be called.
    fn query_begins(&mut self) {}
    /// The core has answered.
    fn query_ends(&mut self) {}
    /// A block is done; `hash` covers all its answers.
    fn block(&mut self, kind: Kind, index: u32, hash: u64);
    /// The last block of `kind` was recorded.
    fn kind_ends(&mut self, _kind: Kind) {}
}

/// Opens the blob and runs all kinds.
///
/// # Errors
/// The core's refusal of the blob, or [`Refused::MEMORY`] if queries could end for want of scratch. Refused queries are answers: they are folded like any other.
pub fn run(
    blob: &[u8],
    plan: Plan,
    scratch: &mut Scratch,
    recorder: &mut impl Recorder,
) -> Result<(), Refused> {
    let subject = ask::open(blob)?;
    if !ask::memory_suffices(&subject) {
        return Err(Refused::MEMORY);
    }
    let bounds = ask::bounds(&subject);
    for kind in Kind::ALL {
        recorder.kind_begins(kind);
        let mut rng = Rng::new(kind.seed());
        let mut here = place::far_point(&mut rng, &bounds);
        // The contents are the same each time they are asked for.
        let plan = if kind == Kind::Contents { Plan { blocks: 1, queries: 1 } } else { plan };
        for index in 0..plan.blocks {
            let mut fold = Fold::new();
            for _ in 0..plan.queries {
                match kind {
                    Kind::Arith => {
                        timed(recorder, || arith::chain(&mut rng, &mut fold));
                    }
                    Kind::ClosestFar => {
                        let point = place::far_point(&mut rng, &bounds);
                        timed(recorder, || ask::closest(&subject, point, scratch, &mut fold));
                    }
                    Kind::ClosestNear => {
                        // The base is an answer: a wrong one shows in this block already, so its consequences mislead nobody.
                        let far = place::far_point(&mut rng, &bounds);
                        let base = ask::closest(&subject, far, scratch, &mut fold);
                        let point = place::near_point(&mut rng, &bounds, base);
                        timed(recorder, || ask::closest(&subject, point, scratch, &mut fold));
                    }
                    Kind::ClosestPath => {
                        here = place::path_point(&mut rng, &bounds, here);
                        timed(recorder, || ask::closest(&subject, here, scratch, &mut fold));
                    }
                    Kind::FirstHit => {
                        let (a, b) = place::segment(&mut rng, &bounds);
                        timed(recorder, || ask::first_hit(&subject, a, b, scratch, &mut fold));
                    }
                    Kind::AllHits => {
                        let (a, b) = place::segment(&mut rng, &bounds);
                        timed(recorder, || ask::all_hits(&subject, a, b, scratch, &mut fold));
                    }
                    Kind::OuterHits => {
                        let (a, b) = place::segment(&mut rng, &bounds);
                        timed(recorder, || ask::outer_hits(&subject, a, b, scratch, &mut fold));
                    }
                    Kind::Contents => {
                        timed(recorder, || ask::contents(&subject, &mut fold));
                    }
                }
            }
            recorder.block(kind, index, fold.finish());
        }
        recorder.kind_ends(kind);
    }
    Ok(())
}

fn timed<T>(recorder: &mut impl Recorder, call: impl FnOnce() -> T) -> T {
    recorder.query_begins();
    let answer = call();
    recorder.query_ends();
    answer
}

#[cfg(test)]
mod tests {
    use super::{Kind, Plan, Recorder, run};
    use crate::ask::{Refused, Scratch};

    struct Count(u32);

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
