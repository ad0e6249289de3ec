//! Whether a curve is within a distance.

use super::capsules::Capsules;
use super::descent::{Descended, SegmentVisitor, Visited, descend};
use crate::curve::format::{Curve, CurveSegment};
use crate::num::tolerance::{CURVE_FAR, U64};
use crate::num::{Real, up_to_f32};
use crate::query::{
    Budget, Decided, Ended, Frame, QueryError, ScratchEntry, SweepQueue, Undecided, Verdict,
    Witness, Work,
};
use core::ops::ControlFlow;

impl Curve<'_> {
    /// Whether the input curve is at most `distance` from `point`, both in input units.
    ///
    /// It ends as soon as one segment is certainly near enough. The witness of a `Yes` is this
    /// segment. It is not always the closest one. The verdict is undecided for
    /// [`Resolution`](Undecided::Resolution) if the difference from the distance asked about is
    /// within the surface error and rounding. A distance of 0 asks whether the
    /// point touches the curve: the answer is `No` or, as rounding cannot prove a contact,
    /// undecided. `scratch` as for [`closest_point`](Curve::closest_point). A shorter one may leave
    /// the question undecided; it never makes the answer wrong. Of the budget only `steps` matters.
    ///
    /// Cost: less than that of the closest point. If all of the curve is far away, one node.
    /// Source: Guéziec 2000, 3.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Curve, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/fence.msw"));
    /// let (fence, mut scratch) = (Curve::open(bytes)?, Scratch::<64>::new());
    /// let near = fence.within([50.0, -900.0, 0.0], 5.0, Budget::EXACT, &mut scratch)?;
    /// assert!(near.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::Tolerance`] also for a distance that is negative,
    /// NaN or infinite; [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<CurveSegment>, QueryError> {
        budget.check_about(distance, scratch)?;
        let p = self.frame.local(point)?;
        let mut work = Work::default();
        let (verdict, witness) = if p.abs().max_element() > CURVE_FAR {
            let (near, far) = self.bounds.distance_range(p);
            let verdict = if self.frame.upper(far) <= distance {
                Verdict::Yes
            } else if self.frame.lower(near) > distance {
                Verdict::No
            } else {
                Verdict::Undecided(Undecided::Resolution)
            };
            let first = self.segment_at(0).filter(|_| verdict == Verdict::Yes);
            (verdict, first)
        } else {
            let queue = SweepQueue::new(scratch, self.scratch_entries());
            let capsules = Capsules::new(self, p);
            within(&capsules, queue, distance, budget.steps, &mut work)
                .ok_or(QueryError::Unchecked)?
        };
        Ok(Decided { verdict, witness, work })
    }
}

/// `None`: the curve is unchecked.
fn within(
    capsules: &Capsules<'_>,
    queue: SweepQueue<'_>,
    distance: f32,
    steps: u32,
    work: &mut Work,
) -> Option<(Verdict, Option<CurveSegment>)> {
    let frame = &capsules.curve.frame;
    // Whatever has a greater bound is certainly farther.
    let limit = (frame.length(distance) + frame.surface_error()) * (1.0 + 4.0 * U64);
    let mut search = AnyWithin { frame, distance, limit: up_to_f32(limit), found: Witness::NONE };
    let cut = match descend(capsules, queue, steps, work, &mut search, |_, _| false)? {
        Descended::Steps => Some(Ended::Steps),
        Descended::Dropped(dropped) => (dropped <= search.limit).then_some(Ended::Scratch),
    };
    Some(search.found.proof(cut))
}

/// Looks for one segment that is certainly near enough.
struct AnyWithin<'a> {
    frame: &'a Frame,
    /// Input units.
    distance: f32,
    /// What has a greater bound in the local frame is certainly farther.
    limit: f32,
    found: Witness<CurveSegment>,
}

impl SegmentVisitor for AnyWithin<'_> {
    #[inline(always)]
    fn is_beyond(&self, lower: f32) -> bool {
        Real(lower) > Real(self.limit)
    }

    #[inline(always)]
    fn leave(&mut self, _: f32) {}

    #[inline(always)]
    fn visit(&mut self, at: &Visited) -> Option<ControlFlow<()>> {
        if self.frame.upper(at.near.upper) <= self.distance {
            self.found.met = Some(at.segment);
            return Some(ControlFlow::Break(()));
        }
        if self.frame.lower(at.near.lower) <= self.distance {
            self.found.may = Some(at.segment);
        }
        Some(ControlFlow::Continue(()))
    }
}
