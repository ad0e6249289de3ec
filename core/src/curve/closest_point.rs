//! Closest point of a curve by the priority process of Guéziec 2000, 3.2, and how far the query may
//! move (3.3).

use super::capsules::Capsules;
use super::descent::{Descended, SegmentVisitor, Visited, descend, segment};
use crate::curve::format::{Curve, CurveSegment};
use crate::num::tolerance::{CURVE_FAR, REPORTED, U64};
use crate::num::{Real, down_to_f32, up_to_f32};
use crate::query::{Budget, Ended, Frame, Interval, QueryError, ScratchEntry, SweepQueue, Work};
use core::ops::ControlFlow;
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
    let capsules = Capsules::new(curve, p);
    let mut work = Work::default();
    let mut search = Nearest::new(&curve.frame, [relative, absolute]);
    let is_far = p.abs().max_element() > CURVE_FAR;
    let ended = if is_far {
        Some(Ended::Exact)
    } else {
        let queue = SweepQueue::new(scratch, curve.scratch_entries());
        search.run(&capsules, queue, steps, &mut work)
    };
    let ended = ended.ok_or(QueryError::Unchecked)?;
    search.answer(&capsules, is_far, work, ended).ok_or(QueryError::Unchecked)
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

/// What a search for the closest segment knows. Lengths are in the local frame.
pub(super) struct Nearest {
    surface_error: f64,
    is_tolerant: bool,
    /// 1 plus the relative one, and the absolute one.
    tolerances: [f64; 2],
    /// The reported upper end, if there is a tolerance: with the stored curve's error, and rounded
    /// to f32 outward.
    reported: f64,
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
}

impl SegmentVisitor for Nearest {
    #[inline(always)]
    fn is_beyond(&self, lower: f32) -> bool {
        Real(lower) > Real(self.upper_f32)
    }

    /// The first segment gives the first limit.
    #[inline(always)]
    fn dives(&self) -> bool {
        self.best.is_none()
    }

    #[inline(always)]
    fn leave(&mut self, lower: f32) {
        if Real(lower) < Real(self.left) {
            self.left = lower;
        }
    }

    #[inline(always)]
    fn visit(&mut self, at: &Visited) -> Option<ControlFlow<()>> {
        self.take(at);
        Some(ControlFlow::Continue(()))
    }
}

impl Nearest {
    /// Nothing is known. Tolerances are relative, and absolute in input units.
    #[inline(always)]
    pub(super) fn new(frame: &Frame, [relative, absolute]: [f32; 2]) -> Self {
        Nearest {
            surface_error: frame.surface_error(),
            is_tolerant: relative > 0.0 || absolute > 0.0,
            tolerances: [1.0 + f64::from(relative), frame.length(absolute)],
            reported: f64::INFINITY,
            upper: f64::INFINITY,
            upper_f32: f32::INFINITY,
            lower: f64::INFINITY,
            others: f64::INFINITY,
            left: f32::INFINITY,
            best: None,
        }
    }

    /// Whether the tolerance is met if nothing is nearer than `lower`.
    // Inlined, it is computed on boards before it is known whether there is a tolerance.
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(super) fn is_near_enough(&self, [relative, absolute]: [f64; 2], lower: f32) -> bool {
        let low = (f64::from(lower).min(self.lower) - self.surface_error) * (1.0 - REPORTED);
        self.reported <= low * relative || self.reported - low <= absolute
    }

    /// How the search ended. `None`: the curve is unchecked.
    // A function of its own, because its loop needs all registers of a board.
    #[inline(never)]
    fn run(
        &mut self,
        capsules: &Capsules<'_>,
        queue: SweepQueue<'_>,
        steps: u32,
        work: &mut Work,
    ) -> Option<Ended> {
        let (is_tolerant, tolerances) = (self.is_tolerant, self.tolerances);
        let how = descend(capsules, queue, steps, work, self, |search, lower| {
            is_tolerant && search.is_near_enough(tolerances, lower)
        })?;
        Some(self.ended(&how))
    }

    /// Whether no segment with this lower bound is needed any more.
    pub(super) fn is_done(&self, lower: f32) -> bool {
        self.is_beyond(lower) || (self.is_tolerant && self.is_near_enough(self.tolerances, lower))
    }

    /// The number of the first point of the closest segment so far.
    pub(super) fn number(&self) -> Option<u32> {
        self.best.map(|best| best.number)
    }

    /// Takes a segment that was not taken before.
    // A call, whose arguments are f64, is dearer on boards than the code.
    #[inline(always)]
    pub(super) fn take(&mut self, at: &Visited) {
        let Visited { number, segment, near, point } = at;
        self.lower = self.lower.min(near.lower);
        if near.upper < self.upper {
            self.upper = near.upper;
            self.upper_f32 = up_to_f32(near.upper);
            if self.is_tolerant {
                self.reported = (self.upper + self.surface_error) * (1.0 + REPORTED);
            }
        }
        let nearer = self.best.is_none_or(|best| {
            near.distance_sq < best.distance_sq
                || (near.distance_sq == best.distance_sq && *number < best.number)
        });
        if nearer {
            let (distance_sq, lower, upper, t) = (near.distance_sq, near.lower, near.upper, near.t);
            let (number, segment, point) = (*number, *segment, *point);
            let before =
                self.best.replace(Best { distance_sq, lower, upper, number, segment, point, t });
            self.others = before.map_or(self.others, |before| self.others.min(before.lower));
        } else {
            self.others = self.others.min(near.lower);
        }
    }

    pub(super) fn ended(&mut self, how: &Descended) -> Ended {
        let Descended::Dropped(dropped) = *how else { return Ended::Steps };
        self.leave(dropped);
        if f64::from(dropped) <= self.upper {
            Ended::Scratch
        } else if f64::from(self.left) <= self.upper {
            Ended::Tolerance
        } else {
            Ended::Exact
        }
    }

    pub(super) fn answer(
        mut self,
        capsules: &Capsules<'_>,
        is_far: bool,
        mut work: Work,
        ended: Ended,
    ) -> Option<CurveClosest> {
        let Capsules { curve, p, .. } = capsules;
        let frame = &curve.frame;
        if self.best.is_none() {
            // Stopped before any segment was reached, or far away: the first one is as good.
            if is_far {
                self.leave(0.0);
            }
            self.take(&segment(capsules, 0, &mut work)??);
        }
        let best = self.best?;
        let left = f64::from(self.left);
        let (mut lower, mut upper) = (self.lower.min(left).min(self.upper), self.upper);
        if is_far {
            (lower, upper) = curve.bounds.distance_range(*p);
        }
        // Both distances may be off by the error of the stored curve, and both change by motion.
        let (others, error) = (self.others.min(left).min(FARTHEST), self.surface_error);
        let gap = 0.5 * (others - best.upper) - error - 8.0 * U64 * (others + error);
        let safe_motion = down_to_f32(frame.input_length(gap).clamp(0.0, f64::from(f32::MAX)));
        Some(CurveClosest {
            distance: Interval::new(frame.lower(lower), frame.upper(upper)),
            point: frame.point(best.point),
            segment: best.segment,
            t: best.t as f32,
            safe_motion,
            work,
            ended,
        })
    }
}
