//! The descent that all questions about the distance of a point share: the interval queue of
//! Guéziec 2000, 3.2.

use super::capsules::{Capsules, Item};
use crate::curve::format::CurveSegment;
use crate::geom::PointSegment;
use crate::query::{SweepQueue, Taken, Work};
use core::ops::ControlFlow;
use glam::DVec3;

/// A segment with its distance from the query point, local frame.
pub(super) struct Visited {
    /// The number of its first point.
    pub(super) number: u32,
    pub(super) segment: CurveSegment,
    pub(super) near: PointSegment,
    /// Its closest point.
    pub(super) point: DVec3,
}

/// What a question does with the segments that a descent reaches.
pub(super) trait SegmentVisitor {
    /// Whether no segment with this lower bound is wanted.
    fn is_beyond(&self, lower: f32) -> bool;

    /// Whether the nearest child comes next, whatever waits.
    #[inline(always)]
    fn dives(&self) -> bool {
        false
    }

    /// Runs with this lower bound or a greater one are not looked at.
    fn leave(&mut self, lower: f32);

    /// Takes a segment. `Break` ends the descent. `None`: the curve is unchecked.
    fn visit(&mut self, at: &Visited) -> Option<ControlFlow<()>>;
}

/// How a descent ended.
pub(super) enum Descended {
    /// All was looked at that is wanted, but runs that did not fit the queue: their least bound.
    /// Infinite if all did.
    Dropped(f32),
    /// The steps were used up. All that is left was passed to [`SegmentVisitor::leave`].
    Steps,
}

/// A segment with its distance. `None`: the curve is unchecked. `Some(None)`: it is a gap, which is
/// no part of the curve.
#[inline(always)]
pub(super) fn segment(
    capsules: &Capsules<'_>,
    number: u32,
    work: &mut Work,
) -> Option<Option<Visited>> {
    let Some(segment) = capsules.curve.segment_at(number) else { return Some(None) };
    let (near, point) = capsules.distance(number, work)?;
    Some(Some(Visited { number, segment, near, point }))
}

/// Shows a visitor the segments that it may want, in an order that lowers its limit soon. At most
/// `steps` nodes are opened. `None`: the curve is unchecked.
///
/// `is_near_enough` says of the least bound that waits whether a tolerance ends the search. It is
/// no method, so that what it captures may stay in registers.
#[inline(always)]
pub(super) fn descend<V: SegmentVisitor>(
    capsules: &Capsules<'_>,
    mut queue: SweepQueue<'_>,
    steps: u32,
    work: &mut Work,
    visitor: &mut V,
    is_near_enough: impl Fn(&V, f32) -> bool,
) -> Option<Descended> {
    let mut next = Some(Capsules::ROOT);
    while let Some(Taken { entry, least }) = queue.take(next.take(), visitor.dives()) {
        if visitor.is_beyond(entry.key()) || is_near_enough(visitor, entry.key()) {
            visitor.leave(entry.key());
            if least {
                break;
            }
            continue;
        }
        match capsules.item(entry) {
            Item::Segment(number) => {
                if let Some(at) = segment(capsules, number, work)?
                    && visitor.visit(&at)?.is_break()
                {
                    break;
                }
            }
            Item::Node(_) if work.opened >= steps => {
                visitor.leave(entry.key());
                visitor.leave(queue.lower());
                return Some(Descended::Steps);
            }
            Item::Node(node) => {
                let [near, far] = capsules.open(node, work)?;
                queue.begin_children(2);
                if visitor.is_beyond(far.key()) {
                    visitor.leave(far.key());
                } else {
                    queue.push(far);
                }
                next = Some(near);
            }
        }
    }
    Some(Descended::Dropped(queue.dropped()))
}
