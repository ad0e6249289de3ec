//! Triboxes.

use meshsweep_core::{NodePair, ScratchEntry, Triboxes};

use crate::answer::{ApartC, CandidatesC, NodePairC, TriboxBoundC};
use crate::ask::{ask, posed, questions};
use crate::error::Error;
use crate::memory::{In, Out, Storage, View};
use crate::question::{BudgetC, PoseC};

/// Words of `msw_triboxes`.
pub const TRIBOXES_WORDS: usize = if cfg!(target_pointer_width = "64") { 16 } else { 20 };

/// `msw_triboxes`.
pub type TriboxesStorage = Storage<Triboxes<'static>, TRIBOXES_WORDS>;

impl View for Triboxes<'static> {
    const TAG: usize = 0x6d73_7707;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_triboxes(
    triboxes: Out<TriboxesStorage>,
    bytes: In<u8>,
    count: usize,
) -> i32 {
    triboxes.open(|| Ok(Triboxes::open(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_triboxes_scratch_entries(
    triboxes: In<TriboxesStorage>,
    other: In<TriboxesStorage>,
) -> u32 {
    let views = triboxes.view().and_then(|one| other.view().map(|other| (one, other)));
    views.map_or(0, |(one, other)| {
        let alone = one.scratch_entries().max(other.scratch_entries());
        one.separation_entries(other).max(alone) as u32
    })
}

questions! {
    msw_triboxes_apart(
        triboxes: In<TriboxesStorage>, other: In<TriboxesStorage>, pose: In<PoseC>
    ) -> ApartC {
        let ([triboxes, other], pose) = posed([&triboxes, &other], pose)?;
        |budget, scratch| triboxes.separation(other, pose, budget, scratch)
    }
    msw_triboxes_within(
        triboxes: In<TriboxesStorage>, other: In<TriboxesStorage>, pose: In<PoseC>, distance: f32
    ) -> ApartC {
        let ([triboxes, other], pose) = posed([&triboxes, &other], pose)?;
        |budget, scratch| triboxes.within_of(other, pose, distance, budget, scratch)
    }
    msw_triboxes_distance(triboxes: In<TriboxesStorage>, point: In<[f32; 3]>) -> TriboxBoundC {
        let (triboxes, point) = (triboxes.view()?, point.get()?);
        |budget, scratch| triboxes.distance(point, budget, scratch)
    }
    msw_triboxes_clip(
        triboxes: In<TriboxesStorage>, a: In<[f32; 3]>, b: In<[f32; 3]>
    ) -> TriboxBoundC {
        let (triboxes, a, b) = (triboxes.view()?, a.get()?, b.get()?);
        |budget, scratch| triboxes.clip(a, b, budget, scratch)
    }
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_triboxes_candidates(
    triboxes: In<TriboxesStorage>,
    other: In<TriboxesStorage>,
    pose: In<PoseC>,
    mut pairs: Out<NodePairC>,
    pair_count: usize,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<CandidatesC>,
) -> i32 {
    answer.answer(|| {
        let ([triboxes, other], pose) = posed([&triboxes, &other], pose)?;
        // The search keeps its pairs where the answers will be.
        let mut held = pairs.held::<NodePair>();
        let found = ask(budget, scratch, scratch_count, |budget, scratch| {
            let held = held.slice(pair_count)?;
            Ok(triboxes.candidates(other, pose, held, budget, scratch)?)
        })?;
        for index in 0..found.stored {
            let pair = held.slice(pair_count)?.get(index).copied();
            pairs.set(pair_count, index, pair.ok_or(Error::Internal)?.into())?;
        }
        Ok(found.into())
    })
}
