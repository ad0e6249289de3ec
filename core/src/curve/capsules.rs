//! The capsules of a hierarchy as one query point sees them.
//!
//! A run's capsule is the segment between its ends, swept by a radius. Distance to a segment is a
//! convex function. So a capsule that holds the run's points holds its segments.

use crate::curve::format::{Curve, Node, Run};
use crate::geom::{CapsulePoint, PointSegment, point_segment};
use crate::num::down_to_f32;
use crate::num::tolerance::{F32_BOUNDS, U64};
use crate::query::{ScratchEntry, Work, before};
use glam::DVec3;

/// A query point, prepared.
pub(crate) struct Capsules<'a> {
    pub(crate) curve: &'a Curve<'a>,
    /// Local frame.
    pub(crate) p: DVec3,
    near: CapsulePoint,
    /// Beyond [`F32_BOUNDS`]: bounds in f64.
    distant: bool,
}

/// What an entry of the queue stands for.
pub(crate) enum Item {
    Node(u32),
    /// The number of its first point.
    Segment(u32),
}

impl<'a> Capsules<'a> {
    // A call keeps `distant` in memory. A comparison in f64 is dear on boards, and a compiler that
    // sees it computes it anew for each run.
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    pub(crate) fn new(curve: &'a Curve<'a>, p: DVec3) -> Self {
        // In f32's normal range the conversion is exact; below, it costs less than
        // `tolerance::CAPSULE_UNDERFLOW`.
        let near = CapsulePoint::new(p.as_vec3(), &curve.bounds);
        Capsules { curve, p, near, distant: p.abs().max_element() > F32_BOUNDS }
    }

    /// The run of all points.
    pub(crate) const ROOT: ScratchEntry = ScratchEntry::new(0.0, 0);

    pub(crate) fn item(&self, entry: ScratchEntry) -> Item {
        let nodes = self.curve.header.nodes();
        match entry.node().checked_sub(nodes) {
            Some(segment) => Item::Segment(segment),
            None => Item::Node(entry.node()),
        }
    }

    /// A node's children with their bounds, the nearer one first. `None`: the curve is unchecked.
    #[inline(always)]
    pub(crate) fn open(&self, node: u32, work: &mut Work) -> Option<[ScratchEntry; 2]> {
        work.opened += 1;
        work.bounds += 2;
        let [left, right] = self.curve.children(node)?;
        let (left, right) = (self.bounded(&left)?, self.bounded(&right)?);
        Some(if before(&right, &left) { [right, left] } else { [left, right] })
    }

    /// A run with the lower bound of the distance to it.
    #[inline(always)]
    fn bounded(&self, run: &Run) -> Option<ScratchEntry> {
        let (a, b) = (self.curve.point(run.first)?, self.curve.point(run.last)?);
        let key = if self.distant {
            let lower = point_segment(self.p, a.as_dvec3(), b.as_dvec3()).lower;
            down_to_f32((lower - f64::from(run.radius) * (1.0 + U64)).max(0.0))
        } else {
            self.near.lower(a, b, run.radius)
        };
        Some(ScratchEntry::new(key, run.item))
    }

    /// The lower bound of a node or a segment that an entry of the queue stands for. `None`: the
    /// curve is unchecked.
    pub(crate) fn lower(&self, item: u32) -> Option<f32> {
        let run = match self.item(ScratchEntry::new(0.0, item)) {
            Item::Segment(first) => Run { item, first, last: first.checked_add(1)?, radius: 0.0 },
            Item::Node(node) => {
                let Node { first, last, radius } = self.curve.node(node)?;
                Run { item, first, last, radius }
            }
        };
        self.bounded(&run).map(|entry| entry.key())
    }

    /// Whether the point is certainly outside of a run's capsule.
    pub(crate) fn is_outside(&self, run: &Run) -> Option<bool> {
        self.bounded(run).map(|entry| entry.key() > 0.0)
    }

    /// The distance of a segment, and its closest point.
    pub(crate) fn distance(&self, segment: u32, work: &mut Work) -> Option<(PointSegment, DVec3)> {
        work.exact += 1;
        let [a, b] = [segment, segment.checked_add(1)?].map(|index| self.curve.point(index));
        let (a, b) = (a?.as_dvec3(), b?.as_dvec3());
        let near = point_segment(self.p, a, b);
        let point = if near.t < 1.0 { a + (b - a) * near.t } else { b };
        Some((near, point))
    }
}
