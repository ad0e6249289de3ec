//! Lower bounds from triboxes: of a point's distance, and of the parameter at which a segment may
//! first meet a model.

use super::bounds::{Tribox, TriboxError};
use super::turned::Turn;
use crate::num::greater;
use crate::query::{Budget, Ended, QueryError, ScratchEntry, Work};
use crate::tribox::format::Triboxes;

/// A lower bound from a union of triboxes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct TriboxBound {
    /// No point of the mesh, or of a solid's inside, is nearer than this (input units) or at a
    /// lesser parameter of the segment. Infinite if no point is on the segment.
    pub lower: f32,
    /// The node with this bound. `None` if `lower` is infinite.
    pub node: Option<u32>,
    /// The work of the search: triboxes tested, nodes opened.
    pub work: Work,
    /// [`Ended::Scratch`] or [`Ended::Steps`]: the bound may be less than that of the leaves.
    pub ended: Ended,
}

impl Triboxes<'_> {
    /// With this many scratch entries neither [`distance`](Triboxes::distance) nor
    /// [`clip`](Triboxes::clip) ends for lack of memory.
    pub fn scratch_entries(&self) -> usize {
        self.depth() as usize + 2
    }

    /// A lower bound of the distance of `point` and the mesh, input units: the distance to the leaf
    /// that is nearest by [`Tribox::distance`]. 0 in a leaf.
    ///
    /// Of the budget only `steps` matters. Cost: about a thousand instructions of a Cortex-M4F a
    /// tribox tested.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Scratch, Triboxes};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/torus.msw"));
    /// let (part, mut scratch) = (Triboxes::open(bytes)?, Scratch::<64>::new());
    /// let bound = part.distance([300.0, 0.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert!(bound.lower > 100.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`] and [`QueryError::OutOfDomain`] (beyond [`Tribox::DOMAIN`]) of the
    /// point; [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn distance(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<TriboxBound, QueryError> {
        budget.check_with(scratch)?;
        Tribox::of_point(point)?;
        let Some(turn) = Turn::of(self) else {
            return least(self, budget.steps, scratch, |tribox| Some(tribox.distance(point)));
        };
        let (place, error) = turn.place(point);
        let mut answer = least(self, budget.steps, scratch, |tribox| Some(tribox.distance(place)))?;
        answer.lower = turn.shorter(answer.lower, error);
        Ok(answer)
    }

    /// Parameter before which the segment from `a` (0) to `b` (1) is clear of the mesh: where it
    /// first enters a leaf, by [`Tribox::clip`].
    ///
    /// Scratch, budget and cost as for [`distance`](Triboxes::distance). A segment of no length is
    /// at 0 or nowhere.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Scratch, Triboxes};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/torus.msw"));
    /// let (part, mut scratch) = (Triboxes::open(bytes)?, Scratch::<64>::new());
    /// let (a, b) = ([300.0, 0.0, 0.0], [400.0, 0.0, 0.0]);
    /// let bound = part.clip(a, b, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(bound.lower, f32::INFINITY);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`distance`](Triboxes::distance), of both ends.
    #[inline(never)]
    pub fn clip(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<TriboxBound, QueryError> {
        budget.check_with(scratch)?;
        Tribox::of_point(a)?;
        Tribox::of_point(b)?;
        let Some(turn) = Turn::of(self) else {
            return least(self, budget.steps, scratch, |tribox| {
                tribox.clip(a, b).map(|(enter, _)| enter)
            });
        };
        let ((a, of_a), (b, of_b)) = (turn.place(a), turn.place(b));
        let error = greater(of_a, of_b);
        least(self, budget.steps, scratch, |tribox| tribox.enter(a, b, error))
    }
}

impl From<TriboxError> for QueryError {
    fn from(error: TriboxError) -> Self {
        match error {
            TriboxError::NotFinite => QueryError::NotFinite,
            TriboxError::OutOfDomain => QueryError::OutOfDomain,
        }
    }
}

/// The least bound of a leaf, nearer children first.
fn least(
    triboxes: &Triboxes<'_>,
    steps: u32,
    stack: &mut [ScratchEntry],
    bound: impl Fn(&Tribox) -> Option<f32>,
) -> Result<TriboxBound, QueryError> {
    let mut answer = TriboxBound {
        lower: f32::INFINITY,
        node: None,
        work: Work::default(),
        ended: Ended::Exact,
    };
    let enter = |node: u32, above: f32, work: &mut Work| {
        work.bounds += 1;
        let tribox = triboxes.node(node).ok_or(QueryError::Unchecked)?;
        let here = bound(&tribox).unwrap_or(f32::INFINITY);
        // Rounding may have given the parent more, and the child is a part of it.
        let lower = greater(above, here);
        Ok::<ScratchEntry, QueryError>(ScratchEntry::new(lower, node))
    };
    let root = enter(0, 0.0, &mut answer.work)?;
    *stack.first_mut().ok_or(QueryError::NoScratch)? = root;
    let mut waiting = 1usize;
    while let Some(top) = waiting.checked_sub(1) {
        let entry = *stack.get(top).ok_or(QueryError::Unchecked)?;
        waiting = top;
        if entry.key() >= answer.lower {
            continue;
        }
        let children = triboxes.children(entry.node());
        let free = stack.get_mut(top..).and_then(|rest| rest.first_chunk_mut::<2>());
        match (children, free) {
            (Some([first, second]), Some(free)) if answer.work.opened < steps => {
                answer.work.opened += 1;
                let first = enter(first, entry.key(), &mut answer.work)?;
                let second = enter(second, entry.key(), &mut answer.work)?;
                *free = if first.key() < second.key() { [second, first] } else { [first, second] };
                waiting = top + 2;
            }
            (children, free) => {
                (answer.lower, answer.node) = (entry.key(), Some(entry.node()));
                if children.is_some() {
                    answer.ended = if free.is_some() { Ended::Steps } else { Ended::Scratch };
                }
            }
        }
    }
    Ok(answer)
}
