//! One triangle of the surface after another, by rising distance.

use super::{QueueHolds, Sweep};
use crate::hull::format::Instance;
use crate::hull::front::Refinable;
use crate::hull::geometry::Geometry;
use crate::num::down_to_f32;
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry, Work};

impl<'a, G: Geometry<'a>> Sweep<'_, G> {
    /// The next triangle of the surface by rising distance, with its own interval. `None` after the
    /// last one. Once `distance.lower` exceeds d, every triangle within d was returned. After a
    /// motion or [`closest_point`](Self::closest_point) the next call gives the nearest one again.
    ///
    /// If the search ends early, `triangle` is `None` and no triangle that is left is nearer than
    /// `distance.lower`. Of the budget only `steps` matters. On a cut blob the triangles are those
    /// of the hull. Cost: that of a search up to the triangle's distance. Source: Guéziec 2000, 4.4.
    ///
    /// # Errors
    /// [`QueryError::Tolerance`]; [`QueryError::NoPose`] after an update that failed.
    #[inline(never)]
    pub fn next_triangle(&mut self, budget: Budget) -> Result<Option<ClosestPoint>, QueryError> {
        budget.check()?;
        self.front.model.check()?;
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
        let mut exact = 0;
        while let Some(entry) = self.front.queue.pop_heap() {
            let least = self.front.queue.dropped();
            if least < entry.key() || self.front.is_spent() {
                self.front.queue.push(entry);
                let ended = if least < entry.key() { Ended::Scratch } else { Ended::Steps };
                let mut known = self.nearest_from_here()?;
                known.limit_lower(f64::from(least.min(entry.key())));
                let answer =
                    known.answer(self.front.model.tables(), &self.frame, self.front.work, ended);
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
            alone.raise_lower(f64::from(entry.key()));
            alone.limit_lower(f64::from(key));
            let work = Work { exact, ..self.front.work };
            let tables = self.front.model.tables();
            return Some(Some(alone.answer(tables, &self.frame, work, self.ended())));
        }
        if self.front.queue.dropped().is_finite() {
            let mut known = self.nearest_from_here()?;
            known.limit_lower(f64::from(self.front.queue.dropped()));
            let tables = self.front.model.tables();
            let answer = known.answer(tables, &self.frame, self.front.work, Ended::Scratch);
            return Some(Some(ClosestPoint { triangle: None, ..answer }));
        }
        Some(None)
    }
}
