//! Where a convex solid that moves first meets the surface.

use super::box_keys::{ByTime, bound_of, key_limit};
use super::leaf_search::{LeafTriangles, Place};
use super::placed::{PlacedSolid, dot};
use super::solid_distance::number;
use crate::bvh::descent::{Descent, LeafVisit, LeafVisitor, descend};
use crate::bvh::format::Bvh;
use crate::geom::convex_gap;
use crate::num::tolerance::{ADVANCE_KEPT, U64};
use crate::num::{down_to_f32, greater, up_to_f32};
use crate::query::{Budget, Ended, FirstHit, Hit, Interval, QueryError, ScratchEntry, Solid, Work};

impl Bvh<'_> {
    /// Where a solid that moves first meets the surface: each corner goes along a straight line
    /// from its place in `from` to its place in `to`, all at a steady pace. The radius is the
    /// greater one of the two.
    ///
    /// The answer is that of a [first hit](Bvh::first_hit), with the part of the motion as its
    /// parameter, from 0 to 1. No point of the solid lies on the input mesh before `t.lower`, at no
    /// time between, however short. If [`is_clear`](FirstHit::is_clear), none does during the whole
    /// motion: that is proved. If `hit` is there and `ended` is [`Ended::Exact`], the solid
    /// certainly meets the mesh by `t.upper`. The point of the hit is on the mesh, near the place
    /// where it stops the solid. To keep a distance, add it to the radius.
    ///
    /// Corners that all move by the same way are a translation. Others turn and stretch the solid:
    /// to follow a rotation by an angle φ, divide it, and add r·φ²/8 to the radius, r the distance
    /// of the farthest corner from the axis.
    ///
    /// `scratch`: [`scratch_entries`](Bvh::scratch_entries) make overflow impossible. With fewer,
    /// or with few steps, `t.lower` is earlier, and [`Ended::Scratch`] or [`Ended::Steps`] says so.
    /// Tolerances are ignored. Lengths and coordinates are in input units, in the mesh's frame.
    ///
    /// A solid that starts within the surface error of the mesh has a `t.lower` of 0. A solid
    /// without radius is not proved to meet a mesh that it only touches: `ended` is then
    /// [`Ended::Resolution`], and `t.upper` is 1.
    ///
    /// Cost: the nodes that the solid passes before it is stopped. Each triangle that it may reach
    /// takes one to three distances in f64, and some ten if it stops the solid.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch, Solid};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// // A spindle of radius 4 moves 300 to the side, 500 above the part.
    /// let spindle = [[-150.0, 0.0, 500.0], [-150.0, 0.0, 600.0]];
    /// let moved = [[150.0, 0.0, 500.0], [150.0, 0.0, 600.0]];
    /// let (from, to) = (Solid::new(&spindle, 4.0)?, Solid::new(&moved, 4.0)?);
    /// assert!(part.first_contact(&from, &to, Budget::EXACT, &mut scratch)?.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: conservative advancement along directions, after van den Bergen, *Ray Casting
    /// against General Convex Objects with Application to Continuous Collision Detection* (2004).
    ///
    /// # Errors
    /// [`QueryError::Corners`] if `to` has not as many corners as `from`; else those of
    /// [`solid_distance`](Bvh::solid_distance).
    pub fn first_contact(
        &self,
        from: &Solid<'_>,
        to: &Solid<'_>,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        budget.check_with(scratch)?;
        let placed = PlacedSolid::new(self, from, Some(to))?;
        let reach = (placed.radius + placed.lengths.error) + placed.rounding;
        let mut work = Work::default();
        let query = ByTime::new(&placed, reach);
        let mut earliest = Earliest { placed: &placed, reach, until: 1.0, stop: None, measured: 0 };
        let descent = descend(self, &query, budget.steps, scratch, &mut earliest, &mut work)?;
        work.exact = earliest.measured;
        let Earliest { until, stop, .. } = earliest;
        let mut lower = if stop.is_some() { down_to_f32(until) } else { f32::INFINITY };
        let mut ended = descent.ended();
        if let Descent::Truncated { least, .. } = descent {
            let reached = bound_of(least);
            lower = if reached < lower { reached } else { lower };
        }
        let Some(stop) = stop else {
            let upper = f32::INFINITY;
            return Ok(FirstHit { t: Interval::new(lower, upper), hit: None, work, ended });
        };
        let met = placed.meeting_time(&stop);
        if met.is_none() && ended == Ended::Exact {
            ended = Ended::Resolution;
        }
        let triangle = Some(number(self, stop.place)?);
        let hit = Hit { t: down_to_f32(until), point: placed.place(stop.point), triangle };
        let upper = met.map_or(1.0, |t| up_to_f32(t).min(1.0));
        Ok(FirstHit { t: Interval::new(lower, upper), hit: Some(hit), work, ended })
    }
}

/// A triangle that may stop the solid.
#[derive(Clone, Copy)]
struct Stop {
    place: Place,
    corners: [[f64; 3]; 3],
    /// The time up to which the solid is clear of it.
    t: f64,
    /// On the triangle, next to the solid at that time.
    point: [f64; 3],
    /// How fast the solid comes nearer there: stored units in a unit of time.
    pace: f64,
}

/// Distances of a triangle on the way to it. The search for its time converges faster than by
/// halves, so few need them all.
const MOST_ADVANCES: usize = 64;

impl PlacedSolid {
    /// The time up to which the solid is certainly farther than `reach` from a triangle, if that is
    /// before `until`.
    ///
    /// Along a direction that parts the two, a gap shrinks by no more than the fastest corner's
    /// pace. So it bounds the time until it is closed.
    fn advanced(
        &self,
        corners: &[[f64; 3]; 3],
        reach: f64,
        until: f64,
        measured: &mut u32,
    ) -> Option<(f64, [f64; 3], f64)> {
        let mut t = 0.0;
        let mut pace = 0.0;
        for _ in 0..MOST_ADVANCES {
            *measured = measured.saturating_add(1);
            let at = self.corners_at(t);
            let gap = convex_gap(at.get(..self.count()).unwrap_or(&[]), corners);
            let [_, point] = gap.points;
            let length = libm::sqrt(dot(gap.way, gap.way));
            if !(gap.lower > reach && length > 0.0) {
                return Some((t, point, pace));
            }
            let way = gap.way.map(|x| x / length);
            let speed = self.speed_along(way);
            // The pace of a corner is a sum of products of its way.
            pace = speed + self.quickest() * (8.0 * U64);
            if pace <= 0.0 {
                return None;
            }
            let next = t + (gap.lower - reach) / pace * ADVANCE_KEPT;
            if next > until {
                return None;
            }
            // Too near for another step.
            if next <= t {
                return Some((t, point, pace));
            }
            t = next;
        }
        let at = self.corners_at(t);
        let gap = convex_gap(at.get(..self.count()).unwrap_or(&[]), corners);
        Some((t, gap.points[1], pace))
    }

    /// A time up to which the solid certainly met the triangle, a little after it may have.
    fn meeting_time(&self, stop: &Stop) -> Option<f64> {
        let error = self.lengths.error + self.rounding;
        // Deep enough for the errors of the surface and of rounding.
        let size =
            stop.corners.iter().flatten().fold(self.radius, |most, x| greater(most, x.abs()));
        let deep = 4.0 * error + size * (1024.0 * U64);
        let later = stop.t + if stop.pace > 0.0 { deep / stop.pace } else { 0.0 };
        [later, stop.t + 16.0 * (later - stop.t), 1.0].into_iter().find(|&t| {
            t <= 1.0 && {
                let at = self.corners_at(t);
                let gap = convex_gap(at.get(..self.count()).unwrap_or(&[]), &stop.corners);
                gap.upper + error <= self.radius || gap.depth > error
            }
        })
    }
}

/// The visitor that wants the first triangle to stop the solid.
struct Earliest<'a> {
    placed: &'a PlacedSolid,
    reach: f64,
    /// The solid is looked at up to this time.
    until: f64,
    stop: Option<Stop>,
    measured: u32,
}

impl LeafVisitor for Earliest<'_> {
    #[inline(always)]
    fn limit(&self) -> u32 {
        key_limit(up_to_f32(self.until))
    }

    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let mut triangles = LeafTriangles::new(self.placed, visit);
        while let Some((place, corners)) = triangles.next(self.reach) {
            let Self { placed, reach, until, measured, .. } = self;
            if let Some((t, point, pace)) = placed.advanced(&corners, *reach, *until, measured) {
                // Of equal times the first one found counts.
                if t < self.until || self.stop.is_none() {
                    self.until = t;
                    self.stop = Some(Stop { place, corners, t, point, pace });
                }
            }
        }
        // Nothing is earlier than the start.
        Some(self.until > 0.0 || self.stop.is_none())
    }
}
