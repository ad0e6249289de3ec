//! An observer of the suite's calls, which may change the terms of a query.

use meshsweep_core::{Budget, QueryError, ScratchEntry, Work};

/// Sees each call, and may change its terms. The time between the two calls `query_begins` and
/// `query_ends` is the core's alone, without placing the query and folding the answer.
///
/// [`Asked`](crate::ask::Asked) passes terms and answers on. A method that an observer does not
/// override leaves no code in an image.
pub trait Observer {
    /// The core is about to be called.
    fn query_begins(&mut self) {}

    /// The core has answered.
    fn query_ends(&mut self) {}

    /// The budget and the scratch of the next query to a box tree, from those that the suite has
    /// for it. Called before the query begins.
    #[inline(always)]
    fn terms<'s>(
        &mut self,
        budget: Budget,
        scratch: &'s mut [ScratchEntry],
    ) -> (Budget, &'s mut [ScratchEntry]) {
        (budget, scratch)
    }

    /// The work of an answer, or why there is none. Called after the query ended.
    #[inline(always)]
    fn answered(&mut self, _answer: Result<Work, QueryError>) {}
}

/// Observes nothing.
impl Observer for () {}

impl<C: Observer> Observer for &mut C {
    fn query_begins(&mut self) {
        C::query_begins(self);
    }

    fn query_ends(&mut self) {
        C::query_ends(self);
    }

    #[inline(always)]
    fn terms<'s>(
        &mut self,
        budget: Budget,
        scratch: &'s mut [ScratchEntry],
    ) -> (Budget, &'s mut [ScratchEntry]) {
        C::terms(self, budget, scratch)
    }

    #[inline(always)]
    fn answered(&mut self, answer: Result<Work, QueryError>) {
        C::answered(self, answer);
    }
}
