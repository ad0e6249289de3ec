//! Blocks and the loop over them.

use crate::arith;
use crate::ask::{Refused, Subject, tribox};
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::Placer;

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

/// Told what happens, in this order: opening begins, begins, then kind by kind: kind begins,
/// (query begins, query ends) × queries, block, …, kind ends.
pub trait Recorder: Observer {
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

/// Whether the kind is asked of this subject: triboxes of points need no blob.
fn suits<'t, S: Subject<'t>>(kind: Kind) -> bool {
    S::suits(kind) || S::ASKS_TRIBOXES_OF_POINTS && kind.is_tribox()
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
    for kind in Kind::ALL.into_iter().filter(|kind| suits::<S>(*kind)) {
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
                    arith::chain(placer.rng(), &mut fold);
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
    use super::{Kind, Plan, Recorder, run};
    use crate::Observer;
    use crate::ask::{Refused, hull, tree};

    struct Count(u32);

    impl Observer for Count {}

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
}
