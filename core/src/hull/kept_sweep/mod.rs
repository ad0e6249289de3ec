//! A sweep that is kept between questions: interrupted and continued, moved with its point or with
//! a mesh that deforms (Guéziec 2000, 3.3, 5.1, 5.2, 5.3), or asked for one triangle after another.
//!
//! Each triangle stands for the same part of the mesh, wherever the mesh is. If the point and every
//! point of the mesh together move by δ, no part comes nearer by more than δ. So a key outlasts a
//! motion of the point and of the mesh alike, and nothing is sorted again. A triangle is bounded
//! anew when it is the first of the queue.
//!
//! | file | owns |
//! | --- | --- |
//! | `motion` | how much nearer a motion of the point may bring a part of the mesh |
//! | `deformed` | sweeps of a mesh at key frames, or moved freely |
//! | `enqueue` | triangles on their way into the queue, with keys that outlast a motion |
//! | `closest_point` | the closest point, and where a search goes on |
//! | `safe_motion` | how far the point may move before another triangle may be the nearest |
//! | `next_triangle` | one triangle after another |
//!
//! Words for triangles. Pruned and dropped ones have left the queue: they are lost, and the least
//! key of the lost ones bounds every answer from below. Those aside leave it until the search ends.
//!
//! | word | the triangle |
//! | --- | --- |
//! | pruned | was beyond the limit when it was found; `pruned` is the least such key |
//! | dropped | did not fit the queue; `SweepQueue::dropped` is the least such key |
//! | lost | was pruned or dropped |
//! | aside | was looked at in this search, and returns to the queue at its end |
//! | near | is one of the few that may be the nearest while the motion is safe |

mod closest_point;
mod deformed;
mod enqueue;
mod motion;
mod next_triangle;
mod safe_motion;

use crate::hull::format::{Hull, Instance};
use crate::hull::front::Front;
use crate::hull::geometry::{Geometry, frame};
use crate::hull::nearest::Nearest;
use crate::num::tolerance::{SUMMED, SWEEP_KEPT, SWEEP_LEAST, SWEEP_MOTION};
use crate::query::{Ended, Frame, QueryError, ScratchEntry};
use enqueue::Enqueuer;
use glam::DVec3;
use motion::Ball;
use safe_motion::SafeMotion;

/// A sweep about one point that may move. It lives in the caller's scratch.
///
/// `G` is the mesh that it asks: a [`Hull`] at rest ([`Hull::sweep`]), a mesh at a key frame
/// ([`FrameHull::sweep`](crate::FrameHull::sweep)), or one that moves freely
/// ([`MovedHull::sweep`](crate::MovedHull::sweep)). Of a part that moves as a whole, carry the
/// point into the part's frame by [`Pose::to_model`](crate::Pose::to_model).
#[derive(Debug)]
pub struct Sweep<'m, G> {
    front: Front<'m, G>,
    frame: Frame,
    p: DVec3,
    /// The ball that holds the mesh.
    ball: Ball,
    /// The motion of the point and of the mesh so far, rounded up.
    moved: f64,
    /// The least key of the pruned triangles.
    pruned: f32,
    /// The nearest triangle of the last answer.
    best: Option<Instance>,
    /// The motion between the last two answers.
    step: f64,
    /// A closest point was asked for since the last motion.
    is_answered: bool,
    /// Part of the hulls' size by which kept triangles may be farther than the nearest one: at most
    /// [`SWEEP_KEPT`], and less where the queue overflows.
    kept: f64,
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
    /// it held 2,048. With fewer entries the queue keeps less beyond the nearest triangle, so the
    /// search begins anew more often. With too few for the triangles that may be nearest, an answer
    /// still holds, ends with [`Ended::Scratch`], and takes longer than a fresh one.
    /// [`Hull::scratch_entries`] are too few to keep a queue.
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
    ) -> Result<Sweep<'m, Hull<'a>>, QueryError> {
        Sweep::about(*self, point, scratch)
    }
}

impl<'a, 'm, G: Geometry<'a>> Sweep<'m, G> {
    fn about(
        hull: G,
        point: [f32; 3],
        scratch: &'m mut [ScratchEntry],
    ) -> Result<Self, QueryError> {
        if !hull.tables().has_hull() {
            return Err(QueryError::NO_HULL);
        }
        hull.check()?;
        let frame = frame(&hull);
        let p = frame.local(point)?;
        if scratch.is_empty() {
            return Err(QueryError::NoScratch);
        }
        Ok(Sweep {
            ball: Ball::around(&hull.vertex_box()),
            front: Front::best_first(hull, scratch),
            frame,
            p,
            moved: 0.0,
            pruned: f32::INFINITY,
            best: None,
            step: 0.0,
            is_answered: false,
            kept: SWEEP_KEPT,
            safe: SafeMotion::NONE,
            holds: QueueHolds::Nothing,
        })
    }

    /// The mesh as it is now, for other questions.
    pub fn hull(&self) -> &G {
        &self.front.model
    }

    /// Gives the mesh back.
    pub fn into_hull(self) -> G {
        self.front.model
    }

    /// Moves the point (input units). Cost: constant.
    ///
    /// For a part that moves, carry the point into the part's frame. Where that turns the point
    /// about the part, far from it, bounds are charged as far as a vertex turns about the middle of
    /// the part, and not the arc of the point (Guéziec 2000, 5.2).
    ///
    /// # Errors
    /// [`QueryError::NotFinite`].
    pub fn move_to(&mut self, point: [f32; 3]) -> Result<(), QueryError> {
        let p = self.frame.local(point)?;
        let motion = self.ball.approach(self.p, p);
        self.p = p;
        self.charge(motion);
        Ok(())
    }

    /// No part of the mesh came nearer by more than `motion`, local frame.
    fn charge(&mut self, motion: f64) {
        self.step = if self.is_answered { motion } else { self.step + motion };
        self.is_answered = false;
        self.moved = (self.moved + motion) * SUMMED;
        if self.holds == QueueHolds::Rest || self.moved.is_nan() || self.moved > SWEEP_MOTION {
            self.holds = QueueHolds::Nothing;
        }
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
        if self.front.queue.dropped() < f32::INFINITY {
            self.kept = SWEEP_LEAST.max(0.25 * self.kept);
        } else if !self.front.queue.is_quarter_full() {
            self.kept = SWEEP_KEPT.min(2.0 * self.kept);
        }
        self.front.queue.clear();
        self.moved = 0.0;
        self.pruned = f32::INFINITY;
        self.safe.until = -1.0;
        self.holds = QueueHolds::Near;
    }

    /// Triangles farther than the nearest by more than this are pruned.
    fn margin(&self) -> f64 {
        let hull = self.front.model.vertex_box();
        self.kept * f64::from((hull.max - hull.min).length())
    }

    /// How a complete search ends.
    fn ended(&self) -> Ended {
        if self.front.model.tables().is_cut() { Ended::Resolution } else { Ended::Exact }
    }
}
