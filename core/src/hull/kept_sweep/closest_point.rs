//! The closest point of a sweep that is kept.

use super::enqueue::Enqueuer;
use super::safe_motion::{SAFE_PAUSE, SAFE_STEPS, SAFE_TRIANGLES};
use super::{QueueHolds, Sweep};
use crate::hull::format::Instance;
use crate::hull::front::Refinable;
use crate::hull::geometry::Geometry;
use crate::num::down_to_f32;
use crate::num::tolerance::{HULL_FAR, SUMMED, SWEEP_LEAST};
use crate::query::{Budget, ClosestPoint, Ended, QueryError, ScratchEntry, Work, bound_of, key_of};

impl<'a, G: Geometry<'a>> Sweep<'_, G> {
    /// Closest point of the surface: the same triangle as
    /// [`Hull::closest_point`](crate::Hull::closest_point) names, of the mesh as it is now.
    ///
    /// After [`Ended::Steps`] or [`Ended::Tolerance`] another call goes on where this one stopped.
    /// Half of the distance by which all other triangles are farther than the nearest few is a safe
    /// motion. Farther than 2^40 times the model's size from it, the model's box gives the interval.
    ///
    /// Cost: constant while the motion is safe, at most twelve triangles, and `work.opened` is 0.
    /// Else that of a search. Source: Guéziec 2000, 3.3 and 5.1.
    ///
    /// # Errors
    /// [`QueryError::Tolerance`]; [`QueryError::NoPose`] after an update that failed.
    #[inline(never)]
    pub fn closest_point(&mut self, budget: Budget) -> Result<ClosestPoint, QueryError> {
        budget.check()?;
        self.front.model.check()?;
        self.is_answered = true;
        self.nearest(&budget).ok_or(QueryError::Unchecked)
    }

    fn nearest(&mut self, budget: &Budget) -> Option<ClosestPoint> {
        self.front.allow(budget.steps);
        if self.p.abs().max_element() > HULL_FAR {
            let mut far = self.nearest_from_here()?;
            far.settle_by_box(&self.front.model)?;
            let ended = self.ended();
            let tables = self.front.model.tables();
            return Some(far.answer(tables, &self.frame, Work::NONE, ended));
        }
        let mut is_new = self.holds != QueueHolds::Near;
        let mut evaluated = 0;
        loop {
            let mut enqueuer = self.enqueuer(0.0)?;
            let is_safe = !is_new && self.moved <= self.safe.until;
            if let Some(best) = self.best {
                enqueuer.nearest.evaluate(&self.front.look(best)?);
            }
            if is_safe {
                self.settle_near(&mut enqueuer)?;
            }
            enqueuer.dives = self.best.is_none();
            let ended = if is_safe {
                self.ended()
            } else {
                if is_new {
                    self.restart();
                    enqueuer.moved = 0.0;
                    enqueuer.limit_to(self.margin());
                    self.front.begin(&mut enqueuer)?;
                }
                self.run(&mut enqueuer, budget)?
            };
            let lost = bound_of(enqueuer.pruned.min(self.pruned), self.moved)
                .min(bound_of(self.front.queue.dropped(), self.moved));
            self.pruned = self.pruned.min(enqueuer.pruned);
            self.best = enqueuer.nearest.instance();
            // An entry that was lost may be the nearest, so the search starts once more, while steps
            // are left. It does so while the queue overflows and may keep less.
            let may_shrink = self.front.queue.dropped() < f32::INFINITY && self.kept > SWEEP_LEAST;
            let goes_on = (!is_new || may_shrink) && self.front.work.opened < budget.steps;
            if lost < enqueuer.nearest.upper() && goes_on {
                is_new = true;
                self.front.allow_anew(budget.steps);
                evaluated = enqueuer.nearest.work(Work::NONE).exact.saturating_add(evaluated);
                continue;
            }
            let ended =
                if lost < enqueuer.nearest.upper() { self.cut_short(budget) } else { ended };
            enqueuer.nearest.limit_lower(lost);
            let mut work = enqueuer.nearest.work(self.front.work);
            work.exact = work.exact.saturating_add(evaluated);
            enqueuer.nearest.settle_unreached(&self.front.model)?;
            let tables = self.front.model.tables();
            return Some(enqueuer.nearest.answer(tables, &self.frame, work, ended));
        }
    }

    /// How a search ends that lost triangles which may be the nearest, and does not begin anew. If
    /// all of them were pruned, before a motion, the next call begins anew.
    #[cold]
    fn cut_short(&self, budget: &Budget) -> Ended {
        let has_dropped = self.front.queue.dropped() < f32::INFINITY;
        let is_spent = self.front.work.opened >= budget.steps;
        if is_spent && !has_dropped { Ended::Steps } else { Ended::Scratch }
    }

    /// Refines until no triangle that waits may be nearer than the best one.
    fn run(&mut self, enqueuer: &mut Enqueuer, budget: &Budget) -> Option<Ended> {
        let error = self.front.model.surface_error();
        let (relative, absolute) = (f64::from(budget.relative), self.frame.length(budget.absolute));
        let margin = self.margin();
        let mut ended = self.ended();
        // The least bound of the triangles that the search did not look at.
        let mut others = f64::INFINITY;
        // Twice the safe motion that is wanted, which is `SAFE_STEPS` steps: the nearest triangle
        // may go away and another one come nearer.
        let mut wider = (2.0 * SAFE_STEPS * self.step).min(margin);
        if self.safe.pause > 0 {
            self.safe.pause -= 1;
            wider = 0.0;
        }
        self.safe.until = -1.0;
        while let Some(entry) = enqueuer.next.take().or_else(|| self.front.queue.pop_heap()) {
            let bound = bound_of(entry.key(), self.moved);
            if self.front.queue.aside().len() > SAFE_TRIANGLES && wider > 0.0 {
                wider = 0.0;
                self.safe.pause = SAFE_PAUSE;
            }
            let is_beaten = bound > enqueuer.nearest.upper();
            if bound > enqueuer.nearest.upper() + wider || (is_beaten && self.front.is_spent()) {
                others = bound;
                self.front.queue.push(entry);
                break;
            }
            let is_near_enough = !is_beaten
                && (relative > 0.0 || absolute > 0.0)
                && enqueuer.nearest.is_within([relative, absolute], bound, error);
            if is_near_enough || self.front.is_spent() {
                ended = if is_near_enough { Ended::Tolerance } else { Ended::Steps };
                let waiting = bound_of(self.front.queue.lower(), self.moved);
                enqueuer.nearest.limit_lower(bound.min(waiting));
                self.front.queue.push(entry);
                break;
            }
            let instance = Instance(entry.node());
            let candidate = self.front.look(instance)?;
            enqueuer.limit_to(margin);
            if candidate.refinable != Refinable::BySplit {
                let least = enqueuer.least(&candidate);
                let lower = if least > enqueuer.nearest.upper() {
                    least
                } else {
                    enqueuer.dives = false;
                    enqueuer.nearest.evaluate(&candidate)
                };
                let key = key_of(lower.max(bound), self.moved);
                self.front.queue.set_aside(ScratchEntry::new(key, instance.0));
                continue;
            }
            if self.moved > 0.0 {
                let key = key_of(enqueuer.least(&candidate), self.moved);
                // Compares the stored key, which is rounded down. With the unrounded bound the
                // entry could return for ever.
                if bound_of(key, self.moved) > enqueuer.nearest.upper() + wider {
                    self.front.queue.push(ScratchEntry::new(key.max(entry.key()), instance.0));
                    continue;
                }
            }
            enqueuer.parent = down_to_f32(bound);
            self.front.open(instance, enqueuer)?;
        }
        if let Some(entry) = enqueuer.next.take() {
            self.front.queue.push(entry);
        }
        let lost_key = enqueuer.pruned.min(self.pruned).min(self.front.queue.dropped());
        others = others.min(bound_of(lost_key, self.moved));
        if ended == self.ended() {
            self.find_safe_motion(enqueuer.nearest.upper(), others);
        }
        self.front.queue.take_back();
        Some(ended)
    }

    /// Evaluates the near triangles that f32 cannot rule out. On a Cortex-M f64 is slow.
    fn settle_near(&self, enqueuer: &mut Enqueuer) -> Option<()> {
        let margin = self.margin();
        for &instance in &self.safe.near {
            let candidate = self.front.look(instance)?;
            enqueuer.limit_to(margin);
            if Some(instance) != self.best && enqueuer.least(&candidate) <= enqueuer.nearest.upper()
            {
                enqueuer.nearest.evaluate(&candidate);
            }
        }
        Some(())
    }

    /// The motion up to which one of the triangles that were set aside stays the nearest. Nothing
    /// else is nearer than `others`.
    fn find_safe_motion(&mut self, upper: f64, mut others: f64) {
        self.safe.near.clear();
        let bound = |entry: &ScratchEntry| bound_of(entry.key(), self.moved);
        // Half way to the nearest other triangle. Entries below it stay near.
        let threshold = upper + 0.5 * (others - upper);
        for entry in self.front.queue.aside() {
            if bound(entry) > threshold || self.safe.near.push(Instance(entry.node())).is_err() {
                others = others.min(bound(entry));
            }
        }
        // The gap is a difference of numbers with a rounding each.
        let gap = others * (2.0 - SUMMED) - upper * SUMMED;
        if gap > 0.0 {
            self.safe.until = self.moved + 0.5 * gap * (2.0 - SUMMED);
        }
    }
}
