//! The hierarchy of capsules over the points of a curve (Ramer 1972; Guéziec 2000, 3.1).

use crate::progress::Watch;
use glam::DVec3;
use meshsweep_core::internal::curve::format::layout::MAX_CURVE_DEPTH;
use meshsweep_core::internal::geom::point_segment;
use meshsweep_core::internal::num::Radius16;

/// A run of points and the radius of its capsule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    pub first: usize,
    pub last: usize,
    pub radius: Radius16,
}

/// The larger part of a split has at most this part of the segments: 3 of 4.
const SMALLER_PART: usize = 4;

/// Points that are looked at between two calls of progress.
const POINTS: usize = 10_000;

/// Nodes in the order of a descent, left before right, and the longest way down.
///
/// Ramer splits a run at the point that is farthest from the segment between its ends. If that
/// leaves less than a fourth of the segments on one side, the nearest split that does not is
/// taken: the bound holds for any split. Cost: points times depth.
///
/// If the watch asks to end, nodes are missing.
pub(super) fn nodes(points: &[DVec3], watch: Watch<'_>) -> (Vec<Node>, u32) {
    let mut nodes = Vec::with_capacity(points.len().saturating_sub(2));
    let (mut deepest, mut looked) = (0, 0);
    let mut waiting = vec![(0, points.len() - 1, 1)];
    while let Some((first, last, depth)) = waiting.pop() {
        if last - first < 2 {
            continue;
        }
        looked += last - first;
        if looked > POINTS {
            looked = 0;
            if !watch.goes_on(nodes.len() as f64 / points.len() as f64) {
                break;
            }
        }
        let (mut farthest, mut radius) = ((-1.0, first + 1), 0f64);
        for (index, &point) in points.iter().enumerate().take(last).skip(first + 1) {
            let near = point_segment(point, points[first], points[last]);
            radius = radius.max(near.upper);
            if near.distance_sq > farthest.0 {
                farthest = (near.distance_sq, index);
            }
        }
        let segments = last - first;
        let least = (segments / SMALLER_PART).max(1);
        let mut split = farthest.1.clamp(first + least, last - least);
        // By halves the rest of the way down always suffices.
        let room = 1usize << (MAX_CURVE_DEPTH - depth).min(32);
        if (split - first).max(last - split) > room {
            split = first + segments / 2;
        }
        nodes.push(Node { first, last, radius: Radius16::round_up(radius) });
        deepest = deepest.max(depth);
        waiting.extend([(split, last, depth + 1), (first, split, depth + 1)]);
    }
    (nodes, deepest as u32)
}
