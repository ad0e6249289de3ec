//! Models at their places.

use meshsweep_core::{PlacedModel, Scene, ScratchEntry, Verdict};

use crate::answer::{ModelsC, NO_MODEL, WorkC, verdict};
use crate::error::Error;
use crate::memory::{AnyBits, In, Out};
use crate::question::{BudgetC, PoseC};
use crate::tree::{Model, ask};

/// `msw_placed`.
#[repr(C)]
#[derive(Clone, Copy)]
#[allow(missing_docs, missing_debug_implementations, reason = "meshsweep.h says it")]
pub struct PlacedC {
    pub model: In<Model>,
    pub pose: PoseC,
}

// SAFETY: a pointer, which `In` checks before it is used, and floats.
unsafe impl AnyBits for PlacedC {}

impl PlacedC {
    fn placed(&self) -> Result<PlacedModel<'static>, Error> {
        Ok(PlacedModel::new(*self.model.view()?, self.pose.pose()?)?)
    }
}

/// See `meshsweep.h`.
///
/// A [`Scene`] takes opened models in a row. So each pair is a scene of two, on the stack, and no
/// memory of the caller is needed.
#[unsafe(no_mangle)]
pub extern "C" fn msw_models_within(
    models: In<PlacedC>,
    model_count: usize,
    distance: f32,
    skipped: In<[u32; 2]>,
    skipped_count: usize,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<ModelsC>,
) -> i32 {
    answer.answer(|| {
        let (models, skipped) = (models.slice(model_count)?, skipped.slice(skipped_count)?);
        ask(budget, scratch, scratch_count, |budget, scratch| {
            let all = |_: usize, _: usize| true;
            // Refuses what no pair would refuse if there is none.
            Scene::new(&[]).within(distance, all, budget, scratch)?;
            for model in models {
                model.placed()?;
            }
            let (mut work, mut undecided) = (WorkC::default(), None);
            for (a, one) in models.iter().enumerate() {
                for (b, other) in models.iter().enumerate().skip(a + 1) {
                    let pair = [a as u32, b as u32];
                    if skipped.iter().any(|&[a, b]| [a, b] == pair || [b, a] == pair) {
                        continue;
                    }
                    let budget = budget.with_steps(budget.steps.saturating_sub(work.opened));
                    let two = [one.placed()?, other.placed()?];
                    let found = Scene::new(&two).within(distance, all, budget, scratch)?;
                    work = work.and(found.work.into());
                    let (code, reason) = verdict(found.verdict);
                    let answer = ModelsC { verdict: code, reason, models: pair, work };
                    match found.verdict {
                        Verdict::No => {}
                        Verdict::Yes => return Ok(answer),
                        _ => undecided = undecided.or(Some(answer)),
                    }
                }
            }
            let (code, reason) = verdict(Verdict::No);
            let clear = ModelsC { verdict: code, reason, models: [NO_MODEL; 2], work };
            Ok(ModelsC { work, ..undecided.unwrap_or(clear) })
        })
    })
}
