//! Whether a part is within a distance, by its hull.

use super::closest_point::upper_end;
use super::side::is_outside_box;
use crate::query::{Budget, Decided, Ended, QueryError, ScratchEntry, Side, Undecided, Verdict};
use crate::tight::format::TightHull;

impl TightHull<'_> {
    /// Whether the part inside the hull is at most `distance` from `point`, both in input units.
    ///
    /// The answer is `No` only outside the hull, so that it holds for a solid part with its inside.
    /// Within the hull, and nearer to it than its slack, the answer is `Yes` or undecided. If it is
    /// undecided for [`Resolution`](Undecided::Resolution), a tighter hull may decide. For
    /// collision avoidance, treat undecided as `Yes`. There is no witness. `budget` and `scratch`
    /// as for [`Bvh::within`](crate::Bvh::within).
    ///
    /// Cost: if the hull is farther, that of its tree's `within`, and inside the hull's box also of
    /// its signed distance. Else that of its tree's closest point too.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Scratch, TightHulls};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/hulls.msw"));
    /// let (hulls, mut scratch) = (TightHulls::open(bytes)?, Scratch::<64>::new());
    /// let hull = hulls.finest().expect("a blob has at least one hull");
    /// let near = hull.within([300.0, 0.0, 0.0], 5.0, Budget::EXACT, &mut scratch)?;
    /// assert!(near.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Bvh::within`](crate::Bvh::within).
    #[inline(never)]
    pub fn within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        let tree = self.bvh();
        let near = tree.within(point, distance, budget, scratch)?;
        let answer = |verdict, work| Ok(Decided { verdict, witness: None, work });
        if near.is_clear() && is_outside_box(tree, point) {
            return answer(Verdict::No, near.work);
        }
        // A side needs the closest point itself.
        let budget = Budget::EXACT.with_steps(budget.steps);
        let (closest, is_outside) = if near.is_clear() {
            let signed = tree.signed_distance(point, budget, scratch)?;
            (signed.closest, signed.side == Side::Outside)
        } else {
            (tree.closest_point(point, budget, scratch)?, false)
        };
        let work = near.work.and(closest.work);
        if is_outside {
            return answer(Verdict::No, work);
        }
        if upper_end(self, &closest) <= distance {
            return answer(Verdict::Yes, work);
        }
        let why = match closest.ended {
            ended @ (Ended::Steps | Ended::Scratch) => ended.undecided(),
            _ => Undecided::Resolution,
        };
        answer(Verdict::Undecided(why), work)
    }
}
