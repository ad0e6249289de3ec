//! Where a convex solid that moves first meets the surface.

use super::box_keys::{ByTime, bound_of, key_limit};
use super::leaf_search::LeafTriangles;
use super::placed_solid::PlacedSolid;
use crate::bvh::segment::leaf::Facing;
use crate::bvh::tree::descent::{Descent, LeafVisit, LeafVisitor, descend};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::tolerance::{ADVANCE_KEPT, U64};
use crate::num::{down_to_f32, greater, up_to_f32};
use crate::query::{Budget, Ended, FirstHit, Hit, Interval, QueryError, ScratchEntry, Solid, Work};

impl Bvh<'_> {
    /// Where a solid that moves first meets the surface: each corner goes along a straight line
    /// from its place in `from` to its place in `to`, all at a steady pace. The radius is the
    /// greater one of the two.
    ///
    /// The answer is that of a [first hit](Bvh::first_hit), with the part of the motion as its
    /// parameter, from 0 to 1. Before `t.lower` no point of the solid touches the input mesh, at
    /// any instant. If [`is_clear`](FirstHit::is_clear), none does during the whole motion: that is
    /// proved. If `ended` is [`Ended::Exact`] and `hit` is there, the solid certainly meets the
    /// mesh by `t.upper`. The point of the hit is on the triangle that may stop the solid, next to
    /// the solid at `t.lower`. To keep a distance, add it to the radius. The motion of a point
    /// without radius is a segment, and has its first hit.
    ///
    /// Corners that all move by the same way are a translation. Others turn and stretch the solid:
    /// to follow a rotation, split it into pieces of an angle φ, and add r·φ²/8 to the radius of
    /// each, r the distance of the farthest corner from the axis.
    ///
    /// `scratch`: [`scratch_entries`](Bvh::scratch_entries) make overflow impossible. With fewer,
    /// or with few steps, `t.lower` is earlier, and [`Ended::Scratch`] or [`Ended::Steps`] says so.
    /// Tolerances are ignored. Lengths and coordinates are in input units, in the mesh's frame.
    ///
    /// Only the surface counts: a motion inside of a closed mesh may be clear. If `from` equals
    /// `to`, the answer is a contact at 0, or clear. A solid that starts within the surface error
    /// of the mesh has a `t.lower` of 0. Where no contact with the triangle that may stop the solid
    /// first is proved, `ended` is [`Ended::Resolution`], and `t.upper` is 1. That happens where
    /// the solid only touches the mesh. It also happens to solids without radius that are flat, or
    /// that pass the edge of a triangle: a small radius decides.
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
    /// assert!(part.solid_first_contact(&from, &to, Budget::EXACT, &mut scratch)?.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: conservative advancement along directions, after van den Bergen, *Ray Casting
    /// against General Convex Objects with Application to Continuous Collision Detection* (2004).
    ///
    /// # Errors
    /// [`QueryError::Corners`] if `to` has not as many corners as `from`; else those of
    /// [`solid_distance`](Bvh::solid_distance).
    #[inline(never)]
    pub fn solid_first_contact(
        &self,
        from: &Solid<'_>,
        to: &Solid<'_>,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        budget.check_with(scratch)?;
        // A point goes along a segment, and a triangle that it passes through is a proved hit.
        if let ([start], [end]) = (from.corners(), to.corners())
            && from.radius() <= 0.0
            && to.radius() <= 0.0
        {
            return self.first_hit(*start, *end, Facing::Both, budget, scratch);
        }
        let mut placed = PlacedSolid::NONE;
        placed.set(self, from, Some(to))?;
        let kept_distance = (placed.radius + placed.lengths.error) + placed.rounding;
        let mut work = Work::default();
        let query = ByTime::new(&placed, kept_distance);
        let mut earliest =
            Earliest { placed: &placed, kept_distance, until: 1.0, stop: None, measured: 0 };
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
        let triangle = Some(stop.triangle.source(self).ok_or(QueryError::Unchecked)?);
        let hit =
            Hit { t: down_to_f32(until), point: placed.to_input(stop.advance.point), triangle };
        let upper = met.map_or(1.0, |t| up_to_f32(t).min(1.0));
        Ok(FirstHit { t: Interval::new(lower, upper), hit: Some(hit), work, ended })
    }
}

/// A triangle that may stop the solid.
#[derive(Clone, Copy)]
struct Stop {
    triangle: TriangleAt,
    corners: [[f64; 3]; 3],
    advance: Advance,
}

/// How far a solid goes on before one triangle may stop it.
#[derive(Clone, Copy)]
struct Advance {
    /// Before this time the solid is certainly farther than `kept_distance`.
    t: f64,
    /// On the triangle, next to the solid at that time.
    point: [f64; 3],
    /// Upper bound of the closing speed along the last direction, stored units for the motion. 0 if
    /// there was none.
    speed: f64,
}

/// Most distances computed for one triangle. The steps shrink faster than by halves, so it rarely
/// takes ten.
const MOST_ADVANCES: usize = 64;

impl PlacedSolid {
    /// How far the solid goes on before a triangle may stop it. `None` if that is later than
    /// `until`.
    ///
    /// The gap along a separating direction shrinks at most at the speed of the fastest corner. The
    /// gap over this speed is a time in which nothing can happen.
    fn advance_to(
        &self,
        corners: &[[f64; 3]; 3],
        kept_distance: f64,
        until: f64,
        measured: &mut u32,
    ) -> Option<Advance> {
        let (mut t, mut speed) = (0.0, 0.0);
        let mut point = [0.0; 3];
        for _ in 0..MOST_ADVANCES {
            *measured = measured.saturating_add(1);
            let gap = self.gap_at(t, corners);
            [_, point] = gap.points;
            let is_apart = gap.lower > kept_distance;
            if !is_apart {
                break;
            }
            speed = self.speed_along(gap.direction) + self.speed_rounding;
            if speed <= 0.0 {
                return None;
            }
            let next = t + (gap.lower - kept_distance) / speed * ADVANCE_KEPT;
            if next > until {
                return None;
            }
            // Too near for another step.
            if next <= t {
                break;
            }
            t = next;
        }
        Some(Advance { t, point, speed })
    }

    /// The first of some times, from the one at which the triangle may stop the solid to the end,
    /// at which the solid certainly meets it.
    fn meeting_time(&self, stop: &Stop) -> Option<f64> {
        let Advance { t, speed, .. } = stop.advance;
        let error = self.lengths.error + self.rounding;
        let largest = stop.corners.iter().flatten().fold(self.radius, |x, y| greater(x, y.abs()));
        // Deep enough for the errors of the surface and of rounding.
        let deep = 4.0 * error + largest * (1024.0 * U64);
        let mut ahead = if speed > 0.0 { deep / speed } else { 0.0 };
        let meets = |t: f64| {
            let gap = self.gap_at(t, &stop.corners);
            gap.upper + error <= self.radius || gap.depth > error
        };
        let mut at = t;
        while at < 1.0 {
            if meets(at) {
                return Some(at);
            }
            if ahead <= 0.0 {
                break;
            }
            at = t + ahead;
            ahead *= LATER;
        }
        meets(1.0).then_some(1.0)
    }
}

/// Ratio of the times ahead at which a contact is looked for.
const LATER: f64 = 8.0;

/// The visitor that wants the first triangle to stop the solid.
struct Earliest<'a> {
    placed: &'a PlacedSolid,
    kept_distance: f64,
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
        while let Some((triangle, corners)) = triangles.next(self.kept_distance) {
            let Self { placed, kept_distance, until, measured, .. } = self;
            if let Some(advance) = placed.advance_to(&corners, *kept_distance, *until, measured) {
                // Of equal times the first one found counts.
                if advance.t < self.until || self.stop.is_none() {
                    self.until = advance.t;
                    self.stop = Some(Stop { triangle, corners, advance });
                }
            }
        }
        // Nothing is earlier than the start.
        Some(self.until > 0.0 || self.stop.is_none())
    }
}
