//! A sweep that is kept between questions: interrupted and continued, moved with its point
//! (Guéziec 2000, 3.3, 5.1, 5.2), or asked for one triangle after another.
//!
//! A key in the queue is a lower bound of the distance, plus the path of the point until then. The
//! key less the path until now is a lower bound at any later time. So no key is changed when the
//! point moves. A triangle is bounded anew when it comes to the top.

use super::closest_point::Nearest;
use super::sweep::{Candidate, Fate, Front, Visit};
use crate::hull::format::{Hull, Instance};
use crate::num::down_to_f32;
use crate::num::tolerance::{HULL_FAR, SUMMED, SWEEP_KEPT, SWEEP_MOTION};
use crate::query::{
    Budget, ClosestPoint, Ended, Frame, QueryError, ScratchEntry, SweepQueue, Work,
};
use glam::DVec3;

/// A sweep about one point that may move. It lives in the caller's scratch.
#[derive(Debug)]
pub struct Sweep<'a, 'm> {
    front: Front<'m, Hull<'a>>,
    frame: Frame,
    p: DVec3,
    /// The motion so far, rounded up.
    moved: f64,
    /// Triangles that are not in the queue have no lesser key.
    pruned: f32,
    /// The nearest triangle of the last answer.
    best: Option<Instance>,
    /// The last motion.
    step: f64,
    safe: Safe,
    holds: Holds,
}

/// While the point moves less than `motion`, the nearest triangle is one of `near` (Guéziec 2000,
/// 3.3). The paper keeps one triangle. Triangles that share the closest vertex have no gap between
/// them, so several are kept.
#[derive(Debug)]
struct Safe {
    motion: f64,
    near: heapless::Vec<Instance, SAFE_TRIANGLES>,
    /// Answers that do not search for a safe motion, because an earlier search failed.
    pause: u8,
}

impl Safe {
    const NONE: Safe = Safe { motion: -1.0, near: heapless::Vec::new(), pause: 0 };
}

/// Triangles that may be nearest within the safe motion: about the star of a vertex.
const SAFE_TRIANGLES: usize = 12;
/// A search goes on until the safe motion is this many of the last step, while the triangles fit.
const SAFE_STEPS: f64 = 4.0;
/// After a search that found too many triangles, so many answers search no farther than they must.
const SAFE_PAUSE: u8 = 8;

/// The triangles that the queue holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Holds {
    Nothing,
    /// All that may be nearest, and some that are a little farther.
    Near,
    /// All but those that were given out.
    Rest,
}

/// Puts triangles into the queue.
struct Keep {
    nearest: Nearest,
    /// The bound of the triangle that was replaced. Its children are not nearer.
    parent: f32,
    moved: f64,
    pruned: f32,
    /// The nearest of those that were just found, while no triangle of the surface is known.
    next: Option<ScratchEntry>,
    dives: bool,
}

impl Visit for Keep {
    fn visit(&mut self, found: &[Candidate], queue: &mut SweepQueue<'_>) {
        for (bound, candidate) in self.nearest.bounds(found).into_iter().zip(found) {
            if bound == f32::INFINITY {
                self.pruned = self.pruned.min(stored(self.nearest.limit(), self.moved));
                continue;
            }
            let key = stored(f64::from(bound.max(self.parent)), self.moved);
            let entry = ScratchEntry::new(key, candidate.instance.0);
            match &mut self.next {
                Some(near) if entry.key() < near.key() => {
                    queue.push(core::mem::replace(near, entry));
                }
                None if self.dives => self.next = Some(entry),
                _ => queue.push(entry),
            }
        }
    }
}

/// A bound as a key.
fn stored(bound: f64, moved: f64) -> f32 {
    down_to_f32((bound + moved) * (2.0 - SUMMED))
}

/// A key as a bound.
fn bound_of(key: f32, moved: f64) -> f64 {
    (f64::from(key) - moved).max(0.0)
}

impl<'a> Hull<'a> {
    /// A sweep about `point` (input units) that keeps its state in `scratch` from one question to
    /// the next.
    ///
    /// `scratch`: with [`Hull::sweep_entries`] no answer ends for lack of memory. That many are in
    /// use only where all of the surface is nearly equally far, as at the centre of a sphere. Of
    /// 20,088 triangles of a scanned part 1,024 waited near the part, and 2,048 at a hundred
    /// diagonals. With too few entries an answer still holds, ends with [`Ended::Scratch`], and
    /// takes longer than a fresh one. [`Hull::scratch_entries`] are too few to keep a queue.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Ended, Hull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<512>::new());
    /// let mut sweep = part.sweep([300.0, 0.0, 0.0], &mut scratch)?;
    /// let mut near = sweep.closest_point(Budget::EXACT.with_steps(20))?;
    /// while near.ended == Ended::Steps {
    ///     near = sweep.closest_point(Budget::EXACT.with_steps(20))?;
    /// }
    /// sweep.move_to([300.0, 0.1, 0.0])?;
    /// assert!(sweep.closest_point(Budget::EXACT)?.distance.lower > 0.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::NoScratch`].
    pub fn sweep<'m>(
        &self,
        point: [f32; 3],
        scratch: &'m mut [ScratchEntry],
    ) -> Result<Sweep<'a, 'm>, QueryError> {
        if !self.has_hull() {
            return Err(QueryError::NO_HULL);
        }
        let frame = Frame::of(self.header());
        let p = frame.local(point)?;
        if scratch.is_empty() {
            return Err(QueryError::NoScratch);
        }
        Ok(Sweep {
            front: Front::best_first(self, scratch),
            frame,
            p,
            moved: 0.0,
            pruned: f32::INFINITY,
            best: None,
            step: 0.0,
            safe: Safe::NONE,
            holds: Holds::Nothing,
        })
    }
}

impl Sweep<'_, '_> {
    /// Moves the point (input units). Cost: constant.
    ///
    /// For a part that moves, carry the point into the part's frame.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`].
    pub fn move_to(&mut self, point: [f32; 3]) -> Result<(), QueryError> {
        let p = self.frame.local(point)?;
        self.step = p.distance(self.p);
        self.moved = (self.moved + self.step) * SUMMED;
        self.p = p;
        if self.holds == Holds::Rest || self.moved.is_nan() || self.moved > SWEEP_MOTION {
            self.holds = Holds::Nothing;
        }
        Ok(())
    }

    /// Closest point of the surface: the same triangle as [`Hull::closest_point`] names.
    ///
    /// After [`Ended::Steps`] or [`Ended::Tolerance`] another call goes on where this one stopped.
    /// While the point has moved less than half the gap between the nearest few triangles and the
    /// others, the answer takes constant time: these few triangles. `work.opened` is 0 then.
    ///
    /// # Errors
    /// [`QueryError::Tolerance`].
    #[inline(never)]
    pub fn closest_point(&mut self, budget: Budget) -> Result<ClosestPoint, QueryError> {
        budget.check()?;
        self.nearest(&budget).ok_or(QueryError::Unchecked)
    }

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

    fn nearest(&mut self, budget: &Budget) -> Option<ClosestPoint> {
        self.front.allow(budget.steps);
        if self.p.abs().max_element() > HULL_FAR {
            let mut far = self.point()?;
            far.settle_by_box(&self.front.model)?;
            let ended = if self.front.model.is_cut() { Ended::Resolution } else { Ended::Exact };
            return Some(far.answer(&self.front.model, &self.frame, Work::NONE, ended));
        }
        let mut is_new = self.holds != Holds::Near;
        let mut evaluated = 0;
        loop {
            let mut keep = self.keep(0.0)?;
            let is_safe = !is_new && self.moved <= self.safe.motion;
            if let Some(best) = self.best {
                keep.nearest.evaluate(&self.front.look(best)?);
            }
            if is_safe {
                self.settle_near(&mut keep)?;
            }
            keep.dives = self.best.is_none();
            let ended = if is_safe {
                self.ended()
            } else {
                if is_new {
                    self.restart();
                    keep.moved = 0.0;
                    keep.limit_to(self.margin());
                    self.front.begin(&mut keep)?;
                }
                self.run(&mut keep, budget)?
            };
            let lost = bound_of(keep.pruned.min(self.pruned), self.moved)
                .min(bound_of(self.front.queue.dropped(), self.moved));
            self.pruned = self.pruned.min(keep.pruned);
            self.best = keep.nearest.instance();
            // An entry that was lost may be the nearest, so the search starts once more.
            if lost < keep.nearest.upper() && !is_new {
                is_new = true;
                evaluated = keep.nearest.work(Work::NONE).exact;
                continue;
            }
            let ended = if lost < keep.nearest.upper() { Ended::Scratch } else { ended };
            keep.nearest.lower_to(lost);
            let mut work = keep.nearest.work(self.front.work);
            work.exact = work.exact.saturating_add(evaluated);
            keep.nearest.settle_unreached(&self.front.model)?;
            return Some(keep.nearest.answer(&self.front.model, &self.frame, work, ended));
        }
    }

    /// Refines until no triangle that waits may be nearer than the best one.
    fn run(&mut self, keep: &mut Keep, budget: &Budget) -> Option<Ended> {
        let error = f64::from(self.front.model.header().surface_error);
        let (relative, absolute) = (f64::from(budget.relative), self.frame.length(budget.absolute));
        let margin = self.margin();
        let mut ended = self.ended();
        let mut others = f64::INFINITY;
        // Twice the motion, for the nearest triangle may go away and another one come nearer.
        let mut wider = (2.0 * SAFE_STEPS * self.step).min(margin);
        if self.safe.pause > 0 {
            self.safe.pause -= 1;
            wider = 0.0;
        }
        self.safe.motion = -1.0;
        while let Some(entry) = keep.next.take().or_else(|| self.front.queue.pop_heap()) {
            let bound = bound_of(entry.key(), self.moved);
            if self.front.queue.aside().len() > SAFE_TRIANGLES && wider > 0.0 {
                wider = 0.0;
                self.safe.pause = SAFE_PAUSE;
            }
            let is_beaten = bound > keep.nearest.upper();
            if bound > keep.nearest.upper() + wider || (is_beaten && self.front.is_spent()) {
                others = bound;
                self.front.queue.push(entry);
                break;
            }
            let is_near_enough = !is_beaten
                && (relative > 0.0 || absolute > 0.0)
                && keep.nearest.is_within([relative, absolute], bound, error);
            if is_near_enough || self.front.is_spent() {
                ended = if is_near_enough { Ended::Tolerance } else { Ended::Steps };
                let waiting = bound_of(self.front.queue.lower(), self.moved);
                keep.nearest.lower_to(bound.min(waiting));
                self.front.queue.push(entry);
                break;
            }
            let instance = Instance(entry.node());
            let candidate = self.front.look(instance)?;
            keep.limit_to(margin);
            if candidate.fate != Fate::Splits {
                let near = keep.least(&candidate);
                let lower = if near > keep.nearest.upper() {
                    near
                } else {
                    keep.dives = false;
                    keep.nearest.evaluate(&candidate)
                };
                let key = stored(lower.max(bound), self.moved);
                self.front.queue.set_aside(ScratchEntry::new(key, instance.0));
                continue;
            }
            if self.moved > 0.0 {
                let key = stored(keep.least(&candidate), self.moved);
                // Compares the stored key, which is rounded down. With the unrounded bound the
                // entry could return for ever.
                if bound_of(key, self.moved) > keep.nearest.upper() + wider {
                    self.front.queue.push(ScratchEntry::new(key.max(entry.key()), instance.0));
                    continue;
                }
            }
            keep.parent = down_to_f32(bound);
            self.front.open(instance, keep)?;
        }
        if let Some(entry) = keep.next.take() {
            self.front.queue.push(entry);
        }
        let lost = keep.pruned.min(self.pruned).min(self.front.queue.dropped());
        others = others.min(bound_of(lost, self.moved));
        if ended == self.ended() {
            self.find_safe_motion(keep.nearest.upper(), others);
        }
        self.front.queue.take_back();
        Some(ended)
    }

    /// Evaluates the near triangles that f32 cannot rule out. On a Cortex-M f64 is slow.
    fn settle_near(&self, keep: &mut Keep) -> Option<()> {
        let margin = self.margin();
        for &instance in &self.safe.near {
            let candidate = self.front.look(instance)?;
            keep.limit_to(margin);
            if Some(instance) != self.best && keep.least(&candidate) <= keep.nearest.upper() {
                keep.nearest.evaluate(&candidate);
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
            self.safe.motion = self.moved + 0.5 * gap * (2.0 - SUMMED);
        }
    }

    fn next(&mut self, budget: &Budget) -> Option<Option<ClosestPoint>> {
        self.front.allow(budget.steps);
        let begins = self.holds != Holds::Rest;
        if begins {
            self.restart();
            self.holds = Holds::Rest;
            self.best = None;
        }
        let mut keep = self.keep(0.0)?;
        if begins {
            self.front.begin(&mut keep)?;
        }
        let model = self.front.model;
        let mut exact = 0;
        while let Some(entry) = self.front.queue.pop_heap() {
            let least = self.front.queue.dropped();
            if least < entry.key() || self.front.is_spent() {
                self.front.queue.push(entry);
                let ended = if least < entry.key() { Ended::Scratch } else { Ended::Steps };
                let mut known = self.point()?;
                known.lower_to(f64::from(least.min(entry.key())));
                let answer = known.answer(&model, &self.frame, self.front.work, ended);
                return Some(Some(ClosestPoint { triangle: None, ..answer }));
            }
            let candidate = self.front.look(Instance(entry.node()))?;
            if candidate.fate == Fate::Splits {
                keep.parent = entry.key();
                self.front.open(candidate.instance, &mut keep)?;
                continue;
            }
            let mut alone = self.point()?;
            exact += 1;
            let lower = alone.evaluate(&candidate).max(f64::from(entry.key()));
            let key = down_to_f32(lower);
            if key > entry.key() && key > self.front.queue.lower() {
                self.front.queue.push(ScratchEntry::new(key, entry.node()));
                continue;
            }
            // In f32, as the keys, so that distances rise.
            alone.raise_to(f64::from(entry.key()));
            alone.lower_to(f64::from(key));
            let work = Work { exact, ..self.front.work };
            return Some(Some(alone.answer(&model, &self.frame, work, self.ended())));
        }
        if self.front.queue.dropped().is_finite() {
            let mut known = self.point()?;
            known.lower_to(f64::from(self.front.queue.dropped()));
            let answer = known.answer(&model, &self.frame, self.front.work, Ended::Scratch);
            return Some(Some(ClosestPoint { triangle: None, ..answer }));
        }
        Some(None)
    }

    fn point(&self) -> Option<Nearest> {
        Nearest::new(&self.front.model, self.p)
    }

    fn keep(&self, parent: f32) -> Option<Keep> {
        Some(Keep {
            nearest: self.point()?,
            parent,
            moved: self.moved,
            pruned: f32::INFINITY,
            next: None,
            dives: false,
        })
    }

    /// An empty queue.
    fn restart(&mut self) {
        self.front.queue.clear();
        self.moved = 0.0;
        self.pruned = f32::INFINITY;
        self.safe.motion = -1.0;
        self.holds = Holds::Near;
    }

    fn margin(&self) -> f64 {
        let hull = self.front.model.hull_box();
        SWEEP_KEPT * f64::from((hull.max - hull.min).length())
    }

    /// How a complete search ends.
    fn ended(&self) -> Ended {
        if self.front.model.is_cut() { Ended::Resolution } else { Ended::Exact }
    }
}

impl Keep {
    /// A lower bound of a triangle's distance, at most the limit.
    fn least(&self, candidate: &Candidate) -> f64 {
        let [bound, ..] = self.nearest.bounds(core::slice::from_ref(candidate));
        f64::from(bound).min(self.nearest.limit())
    }

    /// Triangles farther than the nearest by more than this are not kept.
    fn limit_to(&mut self, margin: f64) {
        self.nearest.set_limit(self.nearest.upper() + margin);
    }
}
