//! One triangle of the surface after another, by rising distance.

use super::{QueueHolds, Sweep};
use crate::hull::format::Instance;
use crate::hull::front::Refinable;
use crate::num::down_to_f32;
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry, Work};

impl Sweep<'_, '_> {
    /// The next triangle of the surface by rising distance, with its own interval. `None` after the
    /// last one. [`move_to`](Self::move_to) and [`closest_point`](Self::closest_point) begin anew.
    ///
    /// If the search ends early, `triangle` is `None` and no triangle that is left is nearer than
    /// `distance.lower`. Of the budget only `steps` matters. On a cut blob the triangles are those
    /// of the hull.
    ///
    /// # Errors
    /// [`QueryError::Tolerance`].
    #[inline(never)]
    pub fn next_triangle(&mut self, budget: Budget) -> Result<Option<ClosestPoint>, QueryError> {
        budget.check()?;
        self.next(&budget).ok_or(QueryError::Unchecked)
    }

    fn next(&mut self, budget: &Budget) -> Option<Option<ClosestPoint>> {
        self.front.allow(budget.steps);
        let begins = self.holds != QueueHolds::Rest;
        if begins {
            self.restart();
            self.holds = QueueHolds::Rest;
            self.best = None;
        }
        let mut enqueuer = self.enqueuer(0.0)?;
        if begins {
            self.front.begin(&mut enqueuer)?;
        }
        let model = self.front.model;
        let mut exact = 0;
        while let Some(entry) = self.front.queue.pop_heap() {
            let least = self.front.queue.dropped();
            if least < entry.key() || self.front.is_spent() {
                self.front.queue.push(entry);
                let ended = if least < entry.key() { Ended::Scratch } else { Ended::Steps };
                let mut known = self.nearest_from_here()?;
                known.lower_to(f64::from(least.min(entry.key())));
                let answer = known.answer(&model, &self.frame, self.front.work, ended);
                return Some(Some(ClosestPoint { triangle: None, ..answer }));
            }
            let candidate = self.front.look(Instance(entry.node()))?;
            if candidate.refinable == Refinable::BySplit {
                enqueuer.parent = entry.key();
                self.front.open(candidate.instance, &mut enqueuer)?;
                continue;
            }
            let mut alone = self.nearest_from_here()?;
            exact += 1;
            let lower = alone.evaluate(&candidate).max(f64::from(entry.key()));
            let key = down_to_f32(lower);
            if key > entry.key() && key > self.front.queue.lower() {
                self.front.queue.push(ScratchEntry::new(key, entry.node()));
                continue;
            }
            // Keys are f32. The answer takes them, so that distances rise.
            alone.raise_to(f64::from(entry.key()));
            alone.lower_to(f64::from(key));
            let work = Work { exact, ..self.front.work };
            return Some(Some(alone.answer(&model, &self.frame, work, self.ended())));
        }
        if self.front.queue.dropped().is_finite() {
            let mut known = self.nearest_from_here()?;
            known.lower_to(f64::from(self.front.queue.dropped()));
            let answer = known.answer(&model, &self.frame, self.front.work, Ended::Scratch);
            return Some(Some(ClosestPoint { triangle: None, ..answer }));
        }
        Some(None)
    }
}
