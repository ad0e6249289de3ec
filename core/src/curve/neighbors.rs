//! The nearest segments, and all segments within a distance.

use super::capsules::Capsules;
use super::descent::{Descended, SegmentVisitor, Visited, descend, segment};
use crate::curve::format::{Curve, CurveSegment};
use crate::num::tolerance::{CURVE_FAR, U64};
use crate::num::{Real, down_to_f32, up_to_f32};
use crate::query::{
    AllWithin, Budget, Ended, Interval, KNearest, QueryError, ScratchEntry, SweepQueue, Work,
    insert_at,
};
use core::ops::ControlFlow;

/// A place for a segment near a point: eight words of the caller's memory. While a search runs,
/// they hold what decides the order. After it they hold the answer.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CurveNeighbor {
    words: [u32; 8],
}

impl CurveNeighbor {
    /// Any value, for filling arrays.
    pub const EMPTY: CurveNeighbor = CurveNeighbor::of(
        Interval::new(0.0, f32::INFINITY),
        [0.0; 3],
        CurveSegment { polyline: u32::MAX, segment: u32::MAX },
        0.0,
    );

    const fn of(
        Interval { lower, upper }: Interval,
        [x, y, z]: [f32; 3],
        CurveSegment { polyline, segment }: CurveSegment,
        t: f32,
    ) -> CurveNeighbor {
        let point = [x.to_bits(), y.to_bits(), z.to_bits()];
        let (lower, upper, t) = (lower.to_bits(), upper.to_bits(), t.to_bits());
        let words = [lower, upper, point[0], point[1], point[2], polyline, segment, t];
        CurveNeighbor { words }
    }

    /// The distance to the input's segment, input units.
    pub fn distance(&self) -> Interval {
        let [lower, upper, ..] = self.words.map(f32::from_bits);
        Interval { lower, upper }
    }

    /// A point of the segment as stored, at most `distance().upper` away but for its rounding to
    /// f32.
    pub fn point(&self) -> [f32; 3] {
        let [_, _, x, y, z, ..] = self.words.map(f32::from_bits);
        [x, y, z]
    }

    /// The segment.
    pub fn segment(&self) -> CurveSegment {
        let [.., polyline, segment, _] = self.words;
        CurveSegment { polyline, segment }
    }

    /// Where [`point`](Self::point) lies on the segment: 0 at its start, 1 at its end.
    pub fn t(&self) -> f32 {
        let [.., t] = self.words;
        f32::from_bits(t)
    }
}

impl core::fmt::Debug for CurveNeighbor {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("CurveNeighbor")
            .field("distance", &self.distance())
            .field("point", &self.point())
            .field("segment", &self.segment())
            .field("t", &self.t())
            .finish()
    }
}

/// A segment as a search holds it in the words of a slot. Lengths are in the local frame.
#[derive(Clone, Copy)]
struct Held {
    /// Squared, as computed: the order.
    distance_sq: f64,
    lower: f32,
    upper: f32,
    /// The number of its first point.
    number: u32,
}

impl Held {
    fn of(slot: &CurveNeighbor) -> Held {
        let [low, high, lower, upper, number, ..] = slot.words;
        Held {
            distance_sq: f64::from_bits(u64::from(high) << 32 | u64::from(low)),
            lower: f32::from_bits(lower),
            upper: f32::from_bits(upper),
            number,
        }
    }

    fn slot(self) -> CurveNeighbor {
        let bits = self.distance_sq.to_bits();
        let (low, high) = (bits as u32, (bits >> 32) as u32);
        let (lower, upper) = (self.lower.to_bits(), self.upper.to_bits());
        CurveNeighbor { words: [low, high, lower, upper, self.number, 0, 0, 0] }
    }

    /// Whether it comes before another: nearer, or as near and earlier in the file.
    fn is_before(&self, other: &Held) -> bool {
        self.distance_sq < other.distance_sq
            || (self.distance_sq == other.distance_sq && self.number < other.number)
    }
}

impl Curve<'_> {
    /// The `out.len()` segments nearest to `point` (input units), by rising distance, into `out`.
    ///
    /// The order is that of the computed distances, then that of the file. It is the same in every
    /// run. Computed distances carry rounding and the surface error. So of two segments whose
    /// intervals overlap, the farther one may come first. Segments without length count like
    /// others. Of segments that share a corner both are near it.
    ///
    /// If `out` is longer than the curve, all segments are stored. If it is empty, nothing is
    /// looked at. After an error its contents are undefined. `scratch` as for
    /// [`closest_point`](Curve::closest_point). Of the budget only `steps` matters. Farther than
    /// 2^24 times the curve's size from the origin all segments are alike: the first of the file are
    /// given, each with the interval of the curve's box.
    ///
    /// Cost: that of the closest point, a distance in f64 for each segment near the last one, and
    /// one more for each that is stored. `out` is kept in order: a segment that enters moves those
    /// that are farther. Source: Guéziec 2000, 3.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Curve, CurveNeighbor, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/fence.msw"));
    /// let (fence, mut scratch) = (Curve::open(bytes)?, Scratch::<64>::new());
    /// let mut out = [CurveNeighbor::EMPTY; 4];
    /// let found = fence.nearest([50.0, -2.0, 0.0], &mut out, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(found.stored, 4);
    /// assert!(out[0].distance().upper <= out[3].distance().upper);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`closest_point`](Curve::closest_point).
    #[inline(never)]
    pub fn nearest(
        &self,
        point: [f32; 3],
        out: &mut [CurveNeighbor],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<KNearest, QueryError> {
        budget.check_with(scratch)?;
        let p = self.frame.local(point)?;
        let mut work = Work::default();
        if out.is_empty() {
            return Ok(KNearest { stored: 0, rest_lower: 0.0, work, ended: Ended::Exact });
        }
        let all = self.segment_count() as usize;
        let capsules = Capsules::new(self, p);
        if p.abs().max_element() > CURVE_FAR {
            let (stored, of_box) = self.first_segments(&capsules, out);
            let rest_lower = if stored == all { f32::INFINITY } else { of_box.lower };
            return Ok(KNearest { stored, rest_lower, work, ended: Ended::Exact });
        }
        let queue = SweepQueue::new(scratch, self.scratch_entries());
        let mut search = Search::new(self, out, [f32::INFINITY; 2], true);
        let cut = search.run(&capsules, queue, budget.steps, &mut work);
        let cut = cut.ok_or(QueryError::Unchecked)?;
        let (rest, ended) = (search.rest, cut.unwrap_or(Ended::Exact));
        let stored = search.finish(&capsules, &mut work).ok_or(QueryError::Unchecked)?;
        let rest_lower =
            if stored == all { f32::INFINITY } else { self.frame.lower(f64::from(rest)) };
        Ok(KNearest { stored, rest_lower, work, ended })
    }

    /// All segments of the input curve that are, or may be, at most `distance` from `point` (both
    /// in input units), into `out`, by rising distance.
    ///
    /// Order, ties, segments without length and far points as for [`nearest`](Curve::nearest). With
    /// an empty `out`, [`AllWithin::dropped`] is the number of segments. After an error the
    /// contents of `out` are undefined. `scratch` as for [`closest_point`](Curve::closest_point).
    /// Of the budget only `steps` matters.
    ///
    /// Cost: linear in everything within the distance, dropped segments too; a segment that enters
    /// `out` moves those that are farther. Source: Guéziec 2000, 3.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Curve, CurveNeighbor, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/fence.msw"));
    /// let (fence, mut scratch) = (Curve::open(bytes)?, Scratch::<64>::new());
    /// let mut out = [CurveNeighbor::EMPTY; 16];
    /// let tip = [50.0, -2.0, 0.0];
    /// let found = fence.all_within(tip, 5.0, &mut out, Budget::EXACT, &mut scratch)?;
    /// assert!(out[..found.certain].iter().all(|near| near.distance().upper <= 5.0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`within`](Curve::within).
    #[inline(never)]
    pub fn all_within(
        &self,
        point: [f32; 3],
        distance: f32,
        out: &mut [CurveNeighbor],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllWithin, QueryError> {
        budget.check_about(distance, scratch)?;
        let p = self.frame.local(point)?;
        let mut work = Work::default();
        let capsules = Capsules::new(self, p);
        if p.abs().max_element() > CURVE_FAR {
            let (mut stored, of_box) = self.first_segments(&capsules, out);
            let mut dropped = self.segment_count().saturating_sub(stored as u32);
            if of_box.lower > distance {
                (stored, dropped) = (0, 0);
            }
            let certain = if of_box.upper <= distance { stored } else { 0 };
            return Ok(AllWithin { stored, certain, dropped, work, ended: Ended::Exact });
        }
        // Whatever has a greater bound is certainly farther.
        let limit = (self.frame.length(distance) + self.frame.surface_error()) * (1.0 + 4.0 * U64);
        let queue = SweepQueue::new(scratch, self.scratch_entries());
        let mut search = Search::new(self, &mut *out, [distance, up_to_f32(limit)], false);
        let cut = search.run(&capsules, queue, budget.steps, &mut work);
        let cut = cut.ok_or(QueryError::Unchecked)?;
        let (dropped, ended) = (search.dropped, cut.unwrap_or(Ended::Exact));
        let stored = search.finish(&capsules, &mut work).ok_or(QueryError::Unchecked)?;
        let is_certain = |near: &&CurveNeighbor| near.distance().upper <= distance;
        let certain = out.iter().take(stored).take_while(is_certain).count();
        Ok(AllWithin { stored, certain, dropped, work, ended })
    }

    /// Stores the first segments of the file, each with the interval of the curve's box. Returns
    /// their number, and the interval.
    fn first_segments(
        &self,
        capsules: &Capsules<'_>,
        out: &mut [CurveNeighbor],
    ) -> (usize, Interval) {
        let (near, far) = self.bounds.distance_range(capsules.p);
        let distance = Interval::new(self.frame.lower(near), self.frame.upper(far));
        let places = 0..self.header.points.saturating_sub(1);
        let segments = places.filter_map(|place| Some((self.segment_at(place)?, place)));
        let mut stored = 0;
        for (slot, (segment, place)) in out.iter_mut().zip(segments) {
            let start = self.point(place).map_or([0.0; 3], |a| self.frame.point(a.as_dvec3()));
            *slot = CurveNeighbor::of(distance, start, segment, 0.0);
            stored += 1;
        }
        (stored, distance)
    }
}

/// The nearest segments so far, in the caller's slice, in order.
struct Search<'s, 'o> {
    curve: &'s Curve<'s>,
    slots: &'o mut [CurveNeighbor],
    stored: usize,
    dropped: u32,
    /// What is certainly farther is not wanted, input units.
    distance: f32,
    /// The same for bounds in the local frame: what has a greater one is not looked at.
    limit: f32,
    /// Whether the last stored one is the limit once the slice is full.
    narrows: bool,
    /// Least lower bound of what is not stored, local frame.
    rest: f32,
}

impl SegmentVisitor for Search<'_, '_> {
    #[inline(always)]
    fn is_beyond(&self, lower: f32) -> bool {
        Real(lower) > Real(self.limit)
    }

    #[inline(always)]
    fn leave(&mut self, lower: f32) {
        self.rest = self.rest.min(lower);
    }

    /// Stores a segment in its place. The last one leaves if there is no room.
    fn visit(&mut self, at: &Visited) -> Option<ControlFlow<()>> {
        let (number, near) = (at.number, &at.near);
        let (lower, upper) = (down_to_f32(near.lower), up_to_f32(near.upper));
        let of_input = self.curve.frame.lower(near.lower);
        if lower > self.limit || of_input > self.distance {
            self.leave(lower);
            return Some(ControlFlow::Continue(()));
        }
        let held = Held { distance_sq: near.distance_sq, lower, upper, number };
        let stored = self.slots.get(..self.stored)?;
        let at = stored.partition_point(|other| Held::of(other).is_before(&held));
        if self.stored == self.slots.len() {
            let last = self.slots.get(at..).and_then(<[_]>::last);
            self.leave(last.map_or(lower, |last| Held::of(last).lower));
            self.dropped = self.dropped.saturating_add(1);
        }
        self.stored = insert_at(self.slots, self.stored, at, held.slot());
        if self.narrows && self.stored == self.slots.len() {
            self.limit = self.limit.min(Held::of(self.slots.last()?).upper);
        }
        Some(ControlFlow::Continue(()))
    }
}

impl<'s, 'o> Search<'s, 'o> {
    fn new(
        curve: &'s Curve<'s>,
        slots: &'o mut [CurveNeighbor],
        [distance, limit]: [f32; 2],
        narrows: bool,
    ) -> Self {
        let rest = f32::INFINITY;
        Search { curve, slots, stored: 0, dropped: 0, distance, limit, narrows, rest }
    }

    /// Looks at all segments within the limit. `None`: the curve is unchecked. `Some(None)`:
    /// nothing is missed.
    fn run(
        &mut self,
        capsules: &Capsules<'_>,
        queue: SweepQueue<'_>,
        steps: u32,
        work: &mut Work,
    ) -> Option<Option<Ended>> {
        let dropped = match descend(capsules, queue, steps, work, self, |_, _| false)? {
            Descended::Steps => return Some(Some(Ended::Steps)),
            Descended::Dropped(dropped) => dropped,
        };
        self.leave(dropped);
        // Both may be infinite.
        Some((dropped < f32::INFINITY && dropped <= self.limit).then_some(Ended::Scratch))
    }

    /// Writes the answers in the places of what was held. Returns their number. `None`: the curve
    /// is unchecked.
    fn finish(self, capsules: &Capsules<'_>, work: &mut Work) -> Option<usize> {
        let frame = &self.curve.frame;
        // Squares rise. The ends of the intervals may not.
        let mut farthest = 0f32;
        for slot in self.slots.iter_mut().take(self.stored) {
            let Visited { segment, near, point, .. } =
                segment(capsules, Held::of(slot).number, work)??;
            farthest = farthest.max(frame.upper(near.upper));
            let distance = Interval::new(frame.lower(near.lower), farthest);
            *slot = CurveNeighbor::of(distance, frame.point(point), segment, near.t as f32);
        }
        Some(self.stored)
    }
}
