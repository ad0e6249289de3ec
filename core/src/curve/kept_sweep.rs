//! A search of a curve that is kept between questions: interrupted and continued, or moved with its
//! point (Guéziec 2000, 3.2 and 3.3).
//!
//! A key is a lower bound plus the path of the point until then. If the point moves by δ, no part
//! of the curve comes nearer by more than δ. So no key changes when the point moves, and nothing is
//! sorted again. A run is bounded anew when it is the first of the queue.
//!
//! *Invariant.* Between two calls every segment of the curve is in the queue, or in a run that is
//! in the queue, or in one that was dropped: `SweepQueue::dropped` is the least such key.

use super::capsules::{Capsules, Item};
use super::closest_point::{CurveClosest, Nearest};
use super::descent::{Descended, SegmentVisitor, segment};
use crate::curve::format::Curve;
use crate::num::down_to_f32;
use crate::num::tolerance::{CURVE_FAR, SUMMED, SWEEP_MOTION};
use crate::query::{Budget, Ended, QueryError, ScratchEntry, SweepQueue, Work, bound_of, key_of};
use glam::DVec3;

/// A search about one point that may move. It lives in the caller's scratch.
#[derive(Debug)]
pub struct CurveSweep<'m, 'a> {
    curve: Curve<'a>,
    queue: SweepQueue<'m>,
    /// Local frame.
    p: DVec3,
    /// The motion of the point since the search began, rounded up.
    moved: f64,
    /// The nearest segment of the last answer, by the number of its first point.
    best: Option<u32>,
    /// Whether the queue holds a search that may go on.
    is_begun: bool,
    /// Whether this search was begun anew because its queue had overflowed. It is not begun a
    /// second time before an answer, so that calls with few steps come to an end.
    is_second: bool,
}

impl<'a> Curve<'a> {
    /// With this many scratch entries no answer of a [`CurveSweep`] ends for lack of memory: one
    /// for each segment, and one for each gap between polylines.
    pub fn sweep_entries(&self) -> usize {
        (self.header.points as usize).saturating_sub(1).max(1)
    }

    /// A search about `point` (input units) that keeps its state in `scratch` from one question to
    /// the next.
    ///
    /// `scratch`: with [`sweep_entries`](Curve::sweep_entries) no answer ends for lack of memory.
    /// With fewer the search begins anew where its queue has overflowed. If it overflows again, the
    /// answer still holds and ends with [`Ended::Scratch`]. Beside a smooth path a few dozen
    /// entries suffice.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Curve, Ended, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/fence.msw"));
    /// let (fence, mut scratch) = (Curve::open(bytes)?, Scratch::<128>::new());
    /// let mut sweep = fence.sweep([50.0, -2.0, 0.0], &mut scratch)?;
    /// let mut near = sweep.closest_point(Budget::EXACT.with_steps(3))?;
    /// while near.ended == Ended::Steps {
    ///     near = sweep.closest_point(Budget::EXACT.with_steps(3))?;
    /// }
    /// sweep.move_to([50.0, -2.1, 0.0])?;
    /// assert!(sweep.closest_point(Budget::EXACT)?.distance.lower > 2.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::NoScratch`].
    pub fn sweep<'m>(
        &self,
        point: [f32; 3],
        scratch: &'m mut [ScratchEntry],
    ) -> Result<CurveSweep<'m, 'a>, QueryError> {
        let p = self.frame.local(point)?;
        if scratch.is_empty() {
            return Err(QueryError::NoScratch);
        }
        let queue = SweepQueue::best_first(scratch);
        Ok(CurveSweep {
            curve: *self,
            queue,
            p,
            moved: 0.0,
            best: None,
            is_begun: false,
            is_second: false,
        })
    }
}

impl CurveSweep<'_, '_> {
    /// Moves the point (input units). Cost: constant.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`].
    pub fn move_to(&mut self, point: [f32; 3]) -> Result<(), QueryError> {
        let p = self.curve.frame.local(point)?;
        self.moved = (self.moved + self.p.distance(p)) * SUMMED;
        self.p = p;
        // A distance beyond f64 is infinite.
        self.is_begun &= self.moved <= SWEEP_MOTION;
        self.is_second = false;
        Ok(())
    }

    /// Closest point of the curve: the same segment, point and distance as
    /// [`Curve::closest_point`] gives.
    ///
    /// After [`Ended::Steps`] or [`Ended::Tolerance`] another call goes on where this one stopped,
    /// with the point as it is now. `safe_motion` holds, and after a motion it may be less than
    /// that of a fresh search.
    ///
    /// Cost: while the point moves by less than `safe_motion`, one segment in f64 and no run. Else
    /// that of the runs that the motion brings nearer than the nearest segment. Source: Guéziec
    /// 2000, 3.2 and 3.3.
    ///
    /// # Errors
    /// [`QueryError::Tolerance`].
    #[inline(never)]
    pub fn closest_point(&mut self, budget: Budget) -> Result<CurveClosest, QueryError> {
        budget.check()?;
        self.nearest(&budget).ok_or(QueryError::Unchecked)
    }

    /// `None`: the curve is unchecked.
    fn nearest(&mut self, budget: &Budget) -> Option<CurveClosest> {
        let curve = self.curve;
        let capsules = Capsules::new(&curve, self.p);
        let mut work = Work::default();
        let tolerances = [budget.relative, budget.absolute];
        if self.p.abs().max_element() > CURVE_FAR {
            let none = Nearest::new(&curve.frame, tolerances);
            return none.answer(&capsules, true, work, Ended::Exact);
        }
        loop {
            let is_new = !self.is_begun;
            if is_new {
                self.begin();
            }
            let mut search = Nearest::new(&curve.frame, tolerances);
            if let Some(best) = self.best {
                search.take(&segment(&capsules, best, &mut work)??);
            }
            let how = self.run(&capsules, budget.steps, &mut work, &mut search)?;
            self.best = search.number();
            let ended = search.ended(&how);
            // A run that was dropped may be the nearest, so the search begins once more.
            let may_repeat = !is_new && !self.is_second && work.opened < budget.steps;
            if ended == Ended::Scratch && may_repeat {
                (self.is_begun, self.is_second) = (false, true);
                continue;
            }
            self.is_second &= ended == Ended::Steps;
            return search.answer(&capsules, false, work, ended);
        }
    }

    fn begin(&mut self) {
        self.queue.clear();
        self.queue.push(Capsules::ROOT);
        (self.moved, self.is_begun) = (0.0, true);
    }

    /// Looks at runs until none that waits may be nearer than the nearest segment. `None`: the
    /// curve is unchecked.
    fn run(
        &mut self,
        capsules: &Capsules<'_>,
        steps: u32,
        work: &mut Work,
        search: &mut Nearest,
    ) -> Option<Descended> {
        let known = search.number();
        let mut is_spent = false;
        while let Some(entry) = self.queue.pop_heap() {
            let lower = self.lower(entry.key());
            if search.is_done(lower) {
                search.leave(lower);
                self.queue.push(entry);
                break;
            }
            if self.moved > 0.0 {
                let key = key_of(f64::from(capsules.lower(entry.node())?), self.moved);
                // Compares the stored key, which is rounded down. With the unrounded bound the
                // entry could return for ever.
                if search.is_beyond(self.lower(key)) {
                    self.queue.push(ScratchEntry::new(key.max(entry.key()), entry.node()));
                    continue;
                }
            }
            match capsules.item(entry) {
                // It was the first to be looked at.
                Item::Segment(number) if Some(number) == known => self.queue.set_aside(entry),
                Item::Segment(number) => {
                    // A gap is no part of the curve, and leaves for ever.
                    if let Some(at) = segment(capsules, number, work)? {
                        search.take(&at);
                        let key = key_of(at.near.lower, self.moved).max(entry.key());
                        self.queue.set_aside(ScratchEntry::new(key, entry.node()));
                    }
                }
                Item::Node(_) if work.opened >= steps => {
                    search.leave(lower);
                    self.queue.push(entry);
                    is_spent = true;
                    break;
                }
                Item::Node(node) => {
                    for child in capsules.open(node, work)? {
                        // A part is not nearer than the whole.
                        let key = key_of(f64::from(child.key()), self.moved).max(entry.key());
                        self.queue.push(ScratchEntry::new(key, child.node()));
                    }
                }
            }
        }
        self.queue.take_back();
        let dropped = self.lower(self.queue.dropped());
        if is_spent {
            search.leave(dropped);
            return Some(Descended::Steps);
        }
        Some(Descended::Dropped(dropped))
    }

    /// A key as a bound from where the point is now.
    fn lower(&self, key: f32) -> f32 {
        down_to_f32(bound_of(key, self.moved))
    }
}
