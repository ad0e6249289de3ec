//! Whether a curve is within a distance.

use super::capsules::{Capsules, Item};
use crate::curve::format::{Curve, CurveSegment};
use crate::num::tolerance::{CURVE_FAR, U64};
use crate::num::up_to_f32;
use crate::query::{
    Budget, Decided, Ended, QueryError, ScratchEntry, SweepQueue, Taken, Undecided, Verdict,
    Witness, Work,
};

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
    mut queue: SweepQueue<'_>,
    distance: f32,
    steps: u32,
    work: &mut Work,
) -> Option<(Verdict, Option<CurveSegment>)> {
    let Capsules { curve, .. } = capsules;
    // Whatever has a greater bound is certainly farther.
    let limit = (curve.frame.length(distance) + curve.frame.surface_error()) * (1.0 + 4.0 * U64);
    let limit = up_to_f32(limit);
    let mut found = Witness::NONE;
    let mut next = Some(Capsules::ROOT);
    while let Some(Taken { entry, least }) = queue.take(next.take(), false) {
        if entry.key() > limit {
            if least {
                break;
            }
            continue;
        }
        match capsules.item(entry) {
            Item::Segment(number) => {
                let Some(segment) = curve.segment_at(number) else { continue };
                let (near, _) = capsules.distance(number, work)?;
                if curve.frame.upper(near.upper) <= distance {
                    found.met = Some(segment);
                    break;
                }
                if curve.frame.lower(near.lower) <= distance {
                    found.may = Some(segment);
                }
            }
            Item::Node(_) if work.opened >= steps => return Some(found.proof(Some(Ended::Steps))),
            Item::Node(node) => {
                let [near, far] = capsules.open(node, work)?;
                queue.begin_children(2);
                if far.key() <= limit {
                    queue.push(far);
                }
                next = Some(near);
            }
        }
    }
    Some(found.proof((queue.dropped() <= limit).then_some(Ended::Scratch)))
}
