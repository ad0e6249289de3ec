//! Closest point of a curve by the priority process of Guéziec 2000, 3.2, and how far the query may
//! move (3.3).

use super::capsules::{Capsules, Item};
use crate::curve::format::{Curve, CurveSegment};
use crate::num::tolerance::{CURVE_FAR, REPORTED, U64};
use crate::num::{down_to_f32, up_to_f32};
use crate::query::{
    Budget, Ended, Frame, Interval, QueryError, ScratchEntry, SweepQueue, Taken, Work,
};
use glam::DVec3;

/// Closest point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct CurveClosest {
    /// The distance to the input curve, input units.
    pub distance: Interval,
    /// A point of the curve at most `distance.upper` away, rounded to f32.
    pub point: [f32; 3],
    /// The segment that holds `point`. Of equidistant segments the first in the file.
    pub segment: CurveSegment,
    /// Where `point` lies on the segment: 0 at its start, 1 at its end.
    pub t: f32,
    /// Of every point that is less than this away from the query, `segment` is the closest one of
    /// the input curve. Input units. 0 if that is not known, as next to a corner.
    pub safe_motion: f32,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl Curve<'_> {
    /// Closest point of the curve to `point` (input units), with an interval that contains the
    /// distance to the input curve.
    ///
    /// `scratch`: [`scratch_entries`](Curve::scratch_entries) make overflow impossible. More let
    /// the search go best first, which opens fewer nodes. With fewer the interval still holds, and
    /// the answer may say [`Ended::Scratch`]. A point on the curve has a lower bound of 0. Segments
    /// without length are points. Farther than 2^24 times the curve's size from the origin, the
    /// curve's box gives the interval, and the segment is the first.
    ///
    /// Cost: a few dozen nodes and segments next to a smooth path of thousands of segments. The
    /// worst case is all of them, at the centre of a circle. Where time is bounded, set
    /// [`Budget::with_steps`]. Source: Guéziec 2000, 3.
    ///
    /// ```
    /// use meshsweep_core::{Blob, Budget, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/fence.msw"));
    /// let (fence, mut scratch) = (Blob::open(bytes)?.curve()?, Scratch::<64>::new());
    /// let near = fence.closest_point([50.0, -2.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower <= near.distance.upper && near.segment.polyline == 0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<CurveClosest, QueryError> {
        budget.check_with(scratch)?;
        let Budget { relative, absolute, steps } = budget;
        let p = self.frame.local(point)?;
        closest_point(self, p, [relative, absolute], steps, scratch)
    }
}

/// The closest point to a point of the local frame.
///
/// Takes the tolerances as numbers, not a budget, so that a program with constant tolerances links
/// no code for others.
pub(super) fn closest_point(
    curve: &Curve<'_>,
    p: DVec3,
    [relative, absolute]: [f32; 2],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<CurveClosest, QueryError> {
    let frame = curve.frame;
    let mut search = SegmentSearch::new(curve, p);
    let is_far = p.abs().max_element() > CURVE_FAR;
    let ended = if is_far {
        Some(Ended::Exact)
    } else {
        let queue = SweepQueue::new(scratch, curve.scratch_entries());
        let tolerances = [f64::from(relative), frame.length(absolute)];
        search.run(queue, relative > 0.0 || absolute > 0.0, tolerances, steps)
    };
    let ended = ended.ok_or(QueryError::Unchecked)?;
    search.answer(&frame, is_far, ended).ok_or(QueryError::Unchecked)
}

/// Beyond all distances, local frame: there is nothing else.
const FARTHEST: f64 = f64::MAX / 1e3;

/// The closest segment so far.
#[derive(Clone, Copy)]
struct Best {
    distance_sq: f64,
    lower: f64,
    upper: f64,
    /// The number of its first point.
    number: u32,
    segment: CurveSegment,
    point: DVec3,
    t: f64,
}

/// State of one query. Lengths are in the local frame.
struct SegmentSearch<'a> {
    capsules: Capsules<'a>,
    /// Not below the distance; f64 for the answer, f32 rounded up for pruning.
    upper: f64,
    upper_f32: f32,
    /// Least lower bound of all evaluated segments.
    lower: f64,
    /// The same without the best one.
    others: f64,
    /// Least bound of all runs that were left. In f32, because f64 is slow on a Cortex-M.
    left: f32,
    best: Option<Best>,
    work: Work,
}

impl<'a> SegmentSearch<'a> {
    fn new(curve: &'a Curve<'a>, p: DVec3) -> Self {
        SegmentSearch {
            capsules: Capsules::new(curve, p),
            upper: f64::INFINITY,
            upper_f32: f32::INFINITY,
            lower: f64::INFINITY,
            others: f64::INFINITY,
            left: f32::INFINITY,
            best: None,
            work: Work::default(),
        }
    }

    /// `None`: the curve is unchecked.
    fn run(
        &mut self,
        mut queue: SweepQueue<'_>,
        tolerant: bool,
        [relative, absolute]: [f64; 2],
        steps: u32,
    ) -> Option<Ended> {
        let surface_error = self.capsules.curve.frame.surface_error();
        let mut next = Some(Capsules::ROOT);
        while let Some(Taken { entry, least }) = queue.take(next.take(), self.best.is_none()) {
            let is_done = entry.key() > self.upper_f32
                || (tolerant && {
                    // The reported interval: with the stored curve's error, and rounded to f32
                    // outward.
                    let key = f64::from(entry.key());
                    let low = (key.min(self.lower) - surface_error) * (1.0 - REPORTED);
                    let high = (self.upper + surface_error) * (1.0 + REPORTED);
                    high <= low * (1.0 + relative) || high - low <= absolute
                });
            if is_done {
                self.leave(entry.key());
                if least {
                    break;
                }
                continue;
            }
            match self.capsules.item(entry) {
                Item::Segment(segment) => self.evaluate(segment)?,
                Item::Node(_) if self.work.opened >= steps => {
                    self.leave(entry.key());
                    self.leave(queue.lower());
                    return Some(Ended::Steps);
                }
                Item::Node(node) => {
                    let [near, far] = self.capsules.open(node, &mut self.work)?;
                    queue.begin_children(2);
                    if far.key() > self.upper_f32 {
                        self.leave(far.key());
                    } else {
                        queue.push(far);
                    }
                    next = Some(near);
                }
            }
        }
        self.leave(queue.dropped());
        Some(if f64::from(queue.dropped()) <= self.upper {
            Ended::Scratch
        } else if f64::from(self.left) <= self.upper {
            Ended::Tolerance
        } else {
            Ended::Exact
        })
    }

    /// Runs with this bound or a greater one are not looked at.
    #[inline(always)]
    fn leave(&mut self, key: f32) {
        if key < self.left {
            self.left = key;
        }
    }

    fn evaluate(&mut self, number: u32) -> Option<()> {
        // A gap is no part of the curve.
        let Some(segment) = self.capsules.curve.segment_at(number) else { return Some(()) };
        let (near, point) = self.capsules.distance(number, &mut self.work)?;
        self.lower = self.lower.min(near.lower);
        if near.upper < self.upper {
            self.upper = near.upper;
            self.upper_f32 = up_to_f32(near.upper);
        }
        let (distance_sq, lower, upper, t) = (near.distance_sq, near.lower, near.upper, near.t);
        let nearer = self.best.is_none_or(|best| {
            distance_sq < best.distance_sq
                || (distance_sq == best.distance_sq && number < best.number)
        });
        if nearer {
            let before =
                self.best.replace(Best { distance_sq, lower, upper, number, segment, point, t });
            self.others = before.map_or(self.others, |before| self.others.min(before.lower));
        } else {
            self.others = self.others.min(lower);
        }
        Some(())
    }

    fn answer(mut self, frame: &Frame, is_far: bool, ended: Ended) -> Option<CurveClosest> {
        if self.best.is_none() {
            // Stopped before any segment was reached, or far away: the first one is as good.
            if is_far {
                self.leave(0.0);
            }
            self.evaluate(0)?;
        }
        let best = self.best?;
        let left = f64::from(self.left);
        let (mut lower, mut upper) = (self.lower.min(left).min(self.upper), self.upper);
        if is_far {
            (lower, upper) = self.capsules.curve.bounds.distance_range(self.capsules.p);
        }
        // Both distances may be off by the error of the stored curve, and both change by motion.
        let (others, error) = (self.others.min(left).min(FARTHEST), frame.surface_error());
        let gap = 0.5 * (others - best.upper) - error - 8.0 * U64 * (others + error);
        let safe_motion = down_to_f32(frame.input_length(gap).clamp(0.0, f64::from(f32::MAX)));
        Some(CurveClosest {
            distance: Interval::new(frame.lower(lower), frame.upper(upper)),
            point: frame.point(best.point),
            segment: best.segment,
            t: best.t as f32,
            safe_motion,
            work: self.work,
            ended,
        })
    }
}
