//! Whether the zones of a fence allow a point, by the winding numbers of their polylines about it.
//!
//! *Winding number.* A ray runs from the point p along x. A segment that crosses it upwards counts
//! one, one that crosses it downwards takes one away. A segment holds its lower end and not its
//! upper one, so that a corner on the ray counts once. The sum is the winding number of a closed
//! polyline that does not touch p (Hormann & Agathos, *The point in polygon problem for arbitrary
//! polygons*, 2001).
//!
//! *Which segments cross.* The order of coordinates is that of integers: those of the grid, or the
//! bits of f32. So it is exact. A segment with both ends at or left of p does not cross the ray,
//! one with both ends right of p does. Of the others the turn from the segment to p decides, in f64
//! with a margin. There p lies in the segment's box, so its foot lies on the segment, and the turn
//! is the distance times the segment's length. So wherever the distance is proved to be above 0,
//! the turn is clear (`core/docs/rounding.md` §14).
//!
//! *Runs.* A run of points lies in a capsule, which is convex. If p is outside of the capsule, the
//! run can be moved onto the segment between its ends, without touching p and with its ends fixed.
//! So that segment crosses the ray as often as the run does. A run may hold the end of
//! one polyline, whole polylines, and the beginning of another. The two parts count as above. A
//! whole polyline in the capsule has winding number 0.
//!
//! *The walk.* Nodes lie in the order of a descent. So the walk goes through points and nodes side
//! by side, skips the nodes of a run that it replaces, and needs no memory.

use super::capsules::Capsules;
use crate::curve::format::{Curve, Node, Run, Zone};
use crate::num::tolerance::{CURVE_TURN, U64};
use crate::query::{Undecided, Work};
use glam::DVec3;

/// Runs of no more segments are walked segment by segment. A segment takes a read and a comparison
/// of integers, a capsule two points, some twenty products and a root.
const WALKED: u32 = 64;

/// The walk about one point.
pub(super) struct ZoneWalk<'a> {
    curve: &'a Curve<'a>,
    p: DVec3,
    /// The point's coordinates as integers in the order of the curve's.
    order: [i32; 2],
    /// The polyline that the walk is on, its first and last point, and its winding number so far.
    polyline: usize,
    ends: [u32; 2],
    winding: i32,
    /// Whether the point is in an inclusion zone, and in an exclusion zone.
    included: bool,
    excluded: bool,
    /// Whether rounding hides the sign of a turn: the point is on the curve.
    is_unclear: bool,
}

/// Whether the zones allow `p` (local frame). `None`: the curve is unchecked.
///
/// The answer is right if `p` is not on the stored curve.
pub(super) fn is_allowed(
    curve: &Curve<'_>,
    p: DVec3,
    steps: u32,
    work: &mut Work,
) -> Option<Result<bool, Undecided>> {
    let (mut included, mut excluded) = (false, false);
    let [min, max] = [curve.bounds.min, curve.bounds.max].map(|corner| corner.as_dvec3());
    let is_in_box = p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
    // Outside of the box all winding numbers are 0.
    if is_in_box {
        let mut walk = ZoneWalk {
            curve,
            p,
            order: [curve.order_of(p.x, 0), curve.order_of(p.y, 1)],
            polyline: 0,
            ends: curve.ends(0)?,
            winding: 0,
            included,
            excluded,
            is_unclear: false,
        };
        if !walk.through(steps, work)? {
            return Some(Err(Undecided::Steps));
        }
        if walk.is_unclear {
            return Some(Err(Undecided::OnSurface));
        }
        (included, excluded) = (walk.included, walk.excluded);
    }
    let has_inclusion =
        || (0..curve.polyline_count()).any(|k| curve.zone(k) == Some(Zone::Inclusion));
    Some(Ok(!excluded && (included || !has_inclusion())))
}

impl ZoneWalk<'_> {
    /// Walks through all points. `Some(false)`: the steps did not suffice.
    fn through(&mut self, steps: u32, work: &mut Work) -> Option<bool> {
        let capsules = Capsules::new(self.curve, self.p);
        let end = self.curve.header.points.checked_sub(1)?;
        let (mut at, mut next) = (0, 0);
        while at < end {
            let node = self.curve.node(next).filter(|node| node.first == at);
            let Some(Node { first, last, radius }) = node else {
                // A segment that is a child of the last node.
                self.walk(at, at + 1, work)?;
                at += 1;
                continue;
            };
            if work.opened >= steps {
                return Some(false);
            }
            work.opened += 1;
            let segments = last.checked_sub(first).filter(|&segments| segments > 1)?;
            if segments <= WALKED {
                self.walk(first, last, work)?;
            } else {
                work.bounds += 1;
                if !capsules.is_outside(&Run { item: next, first, last, radius })? {
                    next += 1;
                    continue;
                }
                self.leap(first, last, work)?;
            }
            at = last;
            // A run has a node for each point between its ends.
            next = next.checked_add(segments - 1)?;
        }
        self.finish();
        Some(true)
    }

    /// Counts the segments between two points one by one.
    fn walk(&mut self, mut from: u32, to: u32, work: &mut Work) -> Option<()> {
        loop {
            let [_, last] = self.ends;
            let stop = to.min(last);
            let mut low = self.is_low(from)?;
            for point in from..stop {
                let next = self.is_low(point + 1)?;
                if low != next {
                    self.cross([point, point + 1], low, work)?;
                }
                low = next;
            }
            if to <= last {
                return Some(());
            }
            // Beyond the gap.
            self.finish();
            self.polyline += 1;
            self.ends = self.curve.ends(self.polyline)?;
            from = last + 1;
        }
    }

    /// Counts the segments that stand for a run whose capsule does not hold the point.
    fn leap(&mut self, from: u32, to: u32, work: &mut Work) -> Option<()> {
        let [_, last] = self.ends;
        if to <= last {
            return self.segment(from, to, work);
        }
        self.segment(from, last, work)?;
        self.finish();
        self.polyline = self.curve.polyline_of(to)?;
        self.ends = self.curve.ends(self.polyline)?;
        let [first, _] = self.ends;
        self.segment(first, to, work)
    }

    fn segment(&mut self, from: u32, to: u32, work: &mut Work) -> Option<()> {
        let low = self.is_low(from)?;
        if low == self.is_low(to)? { Some(()) } else { self.cross([from, to], low, work) }
    }

    /// Whether a point is not above the ray.
    #[inline(always)]
    fn is_low(&self, point: u32) -> Option<bool> {
        let [_, y] = self.order;
        Some(self.curve.order(point, 1)? <= y)
    }

    /// Counts a segment whose ends are on either side of the ray's line.
    fn cross(&mut self, ends: [u32; 2], is_upward: bool, work: &mut Work) -> Option<()> {
        let [x, _] = self.order;
        let [a, b] = ends;
        let right = [self.curve.order(a, 0)? > x, self.curve.order(b, 0)? > x];
        let is_crossed = match right {
            [false, false] => false,
            [true, true] => true,
            _ => {
                work.exact += 1;
                let [a, b] = ends.map(|end| self.curve.point(end));
                let (a, b) = (a?.as_dvec3(), b?.as_dvec3());
                let (ab, ap) = (b - a, self.p - a);
                let (left, right) = (ab.x * ap.y, ab.y * ap.x);
                let turn = left - right;
                self.is_unclear |= turn.abs() <= CURVE_TURN * U64 * (left.abs() + right.abs());
                (turn > 0.0) == is_upward
            }
        };
        if is_crossed {
            self.winding = self.winding.wrapping_add(if is_upward { 1 } else { -1 });
        }
        Some(())
    }

    /// Ends a polyline.
    fn finish(&mut self) {
        if self.winding != 0 {
            match self.curve.zone(self.polyline as u32) {
                Some(Zone::Exclusion) => self.excluded = true,
                _ => self.included = true,
            }
        }
        self.winding = 0;
    }
}
