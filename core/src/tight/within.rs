//! Whether a part is within a distance, by its hull.

use super::closest_point::upper_end;
use super::crossings::{has_side, is_outside};
use super::side::{is_box_beyond, is_outside_box, seen_from};
use crate::num::sum_down;
use crate::query::{Budget, Decided, Ended, QueryError, ScratchEntry, Undecided, Verdict, Work};
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
    /// Cost: if the hull's box is farther, that of the distance from a box. If the hull is farther,
    /// that of its tree's `within`, and inside the hull's box also of a ray through the hull. Else
    /// also that of its tree's `within` for the distance less the hull's slack, and if that does
    /// not decide, of its tree's closest point.
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
        let answer = |verdict, work| Ok(Decided { verdict, witness: None, work });
        if is_box_beyond(tree, point, distance) {
            budget.check_about(distance, scratch)?;
            return answer(Verdict::No, Work::default());
        }
        let near = tree.within(point, distance, budget, scratch)?;
        let mut work = near.work;
        if near.is_clear() && is_outside_box(tree, point) {
            return answer(Verdict::No, work);
        }
        if near.is_clear() && has_side(tree, distance) {
            let is_outside = is_outside(tree, point).ok_or(QueryError::Unchecked)?;
            let inside = Verdict::Undecided(Undecided::Resolution);
            return answer(if is_outside { Verdict::No } else { inside }, work);
        }
        // A face so near has the mesh within its slack: the closest point would say `Yes` as well.
        // If the slack is more than half of the distance, that is rare.
        let (slack, inner) = (self.record().slack, sum_down(distance, -self.record().slack));
        if near.verdict == Verdict::Yes && inner >= slack {
            let near = tree.within(point, inner, after(budget, work), scratch)?;
            work = work.and(near.work);
            if near.verdict == Verdict::Yes {
                return answer(Verdict::Yes, work);
            }
        }
        let (closest, is_outside) = if near.is_clear() {
            seen_from(tree, point, after(budget, work).steps, scratch)?
        } else {
            let budget = Budget::EXACT.with_steps(after(budget, work).steps);
            (tree.closest_point(point, budget, scratch)?, false)
        };
        work = work.and(closest.work);
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

/// The budget less some work.
#[inline(always)]
fn after(budget: Budget, work: Work) -> Budget {
    match budget.steps {
        u32::MAX => budget,
        steps => budget.with_steps(steps.saturating_sub(work.opened)),
    }
}
