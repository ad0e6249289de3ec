//! Questions that take a budget and scratch, one a row.

use meshsweep_core::{Budget, Pose, ScratchEntry};

use crate::error::Error;
use crate::memory::{In, Out, Storage, View};
use crate::question::{BudgetC, PoseC};

/// Reads budget and scratch, and asks.
pub(crate) fn ask<T>(
    budget: In<BudgetC>,
    mut scratch: Out<ScratchEntry>,
    scratch_count: usize,
    question: impl FnOnce(Budget, &mut [ScratchEntry]) -> Result<T, Error>,
) -> Result<T, Error> {
    let budget = budget.get_or(BudgetC::EXACT)?.budget();
    question(budget, scratch.slice(scratch_count)?)
}

/// Reads two models and the pose of the second one in the frame of the first.
pub(crate) fn posed<T: View, const WORDS: usize>(
    [model, other]: [&In<Storage<T, WORDS>>; 2],
    pose: In<PoseC>,
) -> Result<([&T; 2], Pose), Error> {
    Ok(([model.view()?, other.view()?], pose.get_or(PoseC::IDENTITY)?.pose()))
}

/// Functions of the header. A row has the arguments that come before budget, scratch and answer,
/// how they are read, in the order in which they are refused, and the question to the core.
macro_rules! questions {
    ($($name:ident($($argument:ident: $of:ty),*) -> $answer:ty {
        let $read:pat = $reads:expr;
        |$budget:ident, $scratch:ident| $asks:expr
    })*) => {$(
        /// See `meshsweep.h`.
        #[unsafe(no_mangle)]
        #[allow(unused_mut, reason = "only what is kept between calls is written")]
        pub extern "C" fn $name(
            $(mut $argument: $of,)*
            budget: $crate::memory::In<$crate::question::BudgetC>,
            scratch: $crate::memory::Out<meshsweep_core::ScratchEntry>,
            scratch_count: usize,
            answer: $crate::memory::Out<$answer>,
        ) -> i32 {
            answer.answer(|| {
                let $read = $reads;
                $crate::ask::ask(budget, scratch, scratch_count, |$budget, $scratch| {
                    Ok($asks?.into())
                })
            })
        }
    )*};
}
pub(crate) use questions;
