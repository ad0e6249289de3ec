//! Answers of yes or no with what proves them, and the one way from what a search found to them.

use super::answer::Ended;
use super::verdict::{Undecided, Verdict};
use super::work::Work;

/// The answer to a question of yes or no: whether something meets a surface, or is within a
/// distance of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Decided<W> {
    /// `Yes` and `No` are proved for the input. Undecided for
    /// [`Resolution`](Undecided::Resolution): the stored surface and rounding cannot tell.
    pub verdict: Verdict,
    /// With `Yes` what proves it; with an undecided verdict what may, where the question says so.
    /// The question says what a witness is.
    pub witness: Option<W>,
    /// The work of the search.
    pub work: Work,
}

impl<W> Decided<W> {
    /// A `No` without work.
    pub(crate) const CLEAR: Self =
        Decided { verdict: Verdict::No, witness: None, work: Work::NONE };

    /// Whether `No` is proved: nothing meets, nothing is within the distance.
    pub fn is_clear(&self) -> bool {
        self.verdict == Verdict::No
    }
}

/// What a search for a `Yes` has found so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Witness<P> {
    /// The place that proves it.
    pub(crate) met: Option<P>,
    /// A place that may prove it.
    pub(crate) may: Option<P>,
}

impl<P> Witness<P> {
    pub(crate) const NONE: Witness<P> = Witness { met: None, may: None };

    /// The verdict after a search that may have been `cut`, and its witness. A place that was
    /// missed may be nearer than one that may prove it, so a search that was cut has no witness.
    #[inline(always)]
    pub(crate) fn answer(self, cut: Option<Ended>) -> (Verdict, Option<P>) {
        match (self.met, cut, self.may) {
            (Some(place), _, _) => (Verdict::Yes, Some(place)),
            (None, Some(why), _) => (Verdict::Undecided(why.undecided()), None),
            (None, None, Some(place)) => (Verdict::Undecided(Undecided::Resolution), Some(place)),
            (None, None, None) => (Verdict::No, None),
        }
    }

    /// The same, with a witness of `Yes` alone.
    #[inline(always)]
    pub(crate) fn proof(self, cut: Option<Ended>) -> (Verdict, Option<P>) {
        let (verdict, place) = self.answer(cut);
        (verdict, place.filter(|_| verdict == Verdict::Yes))
    }
}
