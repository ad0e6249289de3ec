//! Questions about two models.

use meshsweep_core::{Budget, Bvh, Pose, ScratchEntry};

use crate::answer::{OverlapC, PairContactC, PairDistanceC};
use crate::error::Error;
use crate::memory::{In, Out, PairStorage};
use crate::question::{BudgetC, MotionC, PoseC};
use crate::tree::{Model, ask};

/// Two models, the pose of the second one in the frame of the first, and what all questions take.
struct Asked {
    models: [In<Model>; 2],
    pose: In<PoseC>,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
}

impl Asked {
    fn ask<T>(
        self,
        question: impl FnOnce([&Bvh<'static>; 2], Pose, Budget, &mut [ScratchEntry]) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let [model, other] = &self.models;
        let models = [model.view()?, other.view()?];
        let pose = self.pose.get_or(PoseC::IDENTITY)?.pose();
        ask(self.budget, self.scratch, self.scratch_count, |budget, scratch| {
            question(models, pose, budget, scratch)
        })
    }
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_overlap(
    model: In<Model>,
    other: In<Model>,
    pose: In<PoseC>,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<OverlapC>,
) -> i32 {
    let asked = Asked { models: [model, other], pose, budget, scratch, scratch_count };
    answer.answer(|| {
        asked.ask(|[model, other], pose, budget, scratch| {
            Ok(model.overlap(other, pose, budget, scratch)?.into())
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_distance(
    model: In<Model>,
    other: In<Model>,
    pose: In<PoseC>,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<PairDistanceC>,
) -> i32 {
    let asked = Asked { models: [model, other], pose, budget, scratch, scratch_count };
    answer.answer(|| {
        asked.ask(|[model, other], pose, budget, scratch| {
            Ok(model.distance_to(other, pose, budget, scratch)?.into())
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_within_of(
    model: In<Model>,
    other: In<Model>,
    pose: In<PoseC>,
    distance: f32,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<OverlapC>,
) -> i32 {
    let asked = Asked { models: [model, other], pose, budget, scratch, scratch_count };
    answer.answer(|| {
        asked.ask(|[model, other], pose, budget, scratch| {
            Ok(model.within_of(other, pose, distance, budget, scratch)?.into())
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_coherent_pair_distance(
    mut pair: Out<PairStorage>,
    model: In<Model>,
    other: In<Model>,
    pose: In<PoseC>,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<PairDistanceC>,
) -> i32 {
    let asked = Asked { models: [model, other], pose, budget, scratch, scratch_count };
    answer.answer(|| {
        let kept = pair.kept()?;
        asked.ask(|[model, other], pose, budget, scratch| {
            Ok(kept.distance(model, other, pose, budget, scratch)?.into())
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_coherent_pair_within(
    mut pair: Out<PairStorage>,
    model: In<Model>,
    other: In<Model>,
    pose: In<PoseC>,
    distance: f32,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<OverlapC>,
) -> i32 {
    let asked = Asked { models: [model, other], pose, budget, scratch, scratch_count };
    answer.answer(|| {
        let kept = pair.kept()?;
        asked.ask(|[model, other], pose, budget, scratch| {
            Ok(kept.within(model, other, pose, distance, budget, scratch)?.into())
        })
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_first_contact_of(
    model: In<Model>,
    other: In<Model>,
    motion: In<MotionC>,
    keep: f32,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<PairContactC>,
) -> i32 {
    answer.answer(|| {
        let (model, other, motion) = (model.view()?, other.view()?, motion.get()?.motion()?);
        ask(budget, scratch, scratch_count, |budget, scratch| {
            Ok(model.first_contact_of(other, &motion, keep, budget, scratch)?.into())
        })
    })
}
