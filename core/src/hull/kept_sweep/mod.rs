//! A sweep that is kept between questions: interrupted and continued, moved with its point
//! (Guéziec 2000, 3.3, 5.1, 5.2), or asked for one triangle after another.
//!
//! | file | owns |
//! | --- | --- |
//! | `enqueue` | triangles on their way into the queue, with keys that outlast a motion |
//! | `closest_point` | the closest point, and where a search goes on |
//! | `safe_motion` | how far the point may move before another triangle may be the nearest |
//! | `next_triangle` | one triangle after another |
//!
//! Words for triangles. The first two kinds are not in the queue. They lower `lost`, the least
//! bound of what an answer cannot see.
//!
//! | word | the triangle |
//! | --- | --- |
//! | pruned | was beyond the limit when it was found; `pruned` is the least such key |
//! | dropped | did not fit the queue; `SweepQueue::dropped` is the least such key |
//! | lost | was pruned or dropped |
//! | aside | was looked at in this search, and returns to the queue at its end |
//! | near | is one of the few that may be the nearest while the motion is safe |

mod closest_point;
mod enqueue;
mod next_triangle;
mod safe_motion;

use crate::hull::format::{Hull, Instance};
use crate::hull::front::Front;
use crate::hull::nearest::Nearest;
use crate::num::tolerance::{SUMMED, SWEEP_KEPT, SWEEP_MOTION};
use crate::query::{Ended, Frame, QueryError, ScratchEntry};
use enqueue::Enqueuer;
use glam::DVec3;
use safe_motion::SafeMotion;

/// A sweep about one point that may move. It lives in the caller's scratch.
#[derive(Debug)]
pub struct Sweep<'a, 'm> {
    front: Front<'m, Hull<'a>>,
    frame: Frame,
    p: DVec3,
    /// The motion so far, rounded up.
    moved: f64,
    /// The least key of the pruned triangles.
    pruned: f32,
    /// The nearest triangle of the last answer.
    best: Option<Instance>,
    /// The last motion.
    step: f64,
    safe: SafeMotion,
    holds: QueueHolds,
}

/// The triangles that the queue holds.
///
/// What it holds after a call. Beyond `HULL_FAR` `closest_point` changes nothing.
///
/// | before | `closest_point` | `next_triangle` | `move_to` |
/// | --- | --- | --- | --- |
/// | `Nothing` | `Near` | `Rest` | `Nothing` |
/// | `Near` | `Near` | `Rest` | `Near`, after a long path `Nothing` |
/// | `Rest` | `Near` | `Rest` | `Nothing` |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum QueueHolds {
    Nothing,
    /// All that may be nearest, and some that are a little farther.
    Near,
    /// All but those that were given out.
    Rest,
}

impl<'a> Hull<'a> {
    /// A sweep about `point` (input units) that keeps its state in `scratch` from one question to
    /// the next.
    ///
    /// `scratch`: with [`Hull::sweep_entries`] no answer ends for lack of memory. That many are in
    /// use only where all of the surface is nearly equally far, as at the centre of a sphere. On a
    /// scanned part of 20,088 triangles the queue held 1,024 near the part. At a hundred diagonals
    /// it held 2,048. With too few entries an answer still holds, ends with [`Ended::Scratch`], and
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
            safe: SafeMotion::NONE,
            holds: QueueHolds::Nothing,
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
        if self.holds == QueueHolds::Rest || self.moved.is_nan() || self.moved > SWEEP_MOTION {
            self.holds = QueueHolds::Nothing;
        }
        Ok(())
    }

    /// No triangle is known yet from where the point is now.
    fn nearest_from_here(&self) -> Option<Nearest> {
        Nearest::new(&self.front.model, self.p)
    }

    fn enqueuer(&self, parent: f32) -> Option<Enqueuer> {
        Some(Enqueuer {
            nearest: self.nearest_from_here()?,
            parent,
            moved: self.moved,
            pruned: f32::INFINITY,
            next: None,
            dives: false,
        })
    }

    /// Empties the queue, and forgets the path, what was pruned and the safe motion. `best` stays:
    /// it gives the first limit.
    fn restart(&mut self) {
        self.front.queue.clear();
        self.moved = 0.0;
        self.pruned = f32::INFINITY;
        self.safe.until = -1.0;
        self.holds = QueueHolds::Near;
    }

    /// Triangles farther than the nearest by more than this are pruned.
    fn margin(&self) -> f64 {
        let hull = self.front.model.hull_box();
        SWEEP_KEPT * f64::from((hull.max - hull.min).length())
    }

    /// How a complete search ends.
    fn ended(&self) -> Ended {
        if self.front.model.is_cut() { Ended::Resolution } else { Ended::Exact }
    }
}
