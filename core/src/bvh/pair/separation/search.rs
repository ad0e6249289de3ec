//! The descent of two trees, in the grid of the first.

use super::between_boxes::between_boxes;
use super::direction::Direction;
use super::grid_pose::GridPose;
use super::leaf_hulls::{LeafHull, LeafLimits, visit};
use super::node_boxes::{Children, Reach, open};
use super::pending::Pending;
use crate::bvh::pair::models::most_pairs;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::GapLimits;
use crate::num::tolerance::{GAP_SLACK, LEAST_NEAR, SQUARED_SLACK, U32};
use crate::num::{lesser, sqrt_approx};
use crate::query::{ScratchEntry, Work};

/// What is proved of two models.
pub(crate) enum Separation {
    /// They are farther apart than this, input units of the first.
    Apart(f32),
    /// These triangles are near.
    Near([TriangleAt; 2]),
    /// f32 does not tell, or steps or memory ended.
    Open,
}

/// A distance asked about, in units of the first grid.
struct Threshold {
    /// What is farther than this, as computed, is certainly farther than asked about.
    clear: f32,
    /// The same with the length to look beyond.
    far: f32,
    /// Points that are at most so near, as computed, certainly are. Negative: none.
    near_sq: f32,
}

/// A square of a length, rounded up.
fn square_up(length: f32) -> f32 {
    length * length * GAP_SLACK
}

impl Threshold {
    fn new(pose: &GridPose<'_>, [distance, more]: [f32; 2]) -> Threshold {
        let [a, _] = pose.trees;
        let (distance, more) = (a.units().inward(distance), a.units().inward(more));
        let up = 1.0 + 4.0 * U32;
        let near = (distance - pose.error) * (1.0 - 4.0 * U32);
        Threshold {
            clear: (distance + pose.error) * up,
            far: (distance + more + pose.error) * up,
            near_sq: if near > LEAST_NEAR { near * near * SQUARED_SLACK } else { -1.0 },
        }
    }

    fn limits(&self) -> LeafLimits {
        let (far_sq, near_sq) = (square_up(self.far), self.near_sq);
        LeafLimits { gap: GapLimits { far_sq, near_sq }, clear_sq: square_up(self.clear) }
    }
}

/// Whether two models are within a distance, input units of the first one. Farther ones are told to
/// be so by up to `more`.
#[inline(never)]
pub(crate) fn separation(
    pose: &GridPose<'_>,
    asked: [f32; 2],
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> Separation {
    descend(pose, Threshold::new(pose, asked), steps, scratch, work).unwrap_or(Separation::Open)
}

#[inline(always)]
fn descend(
    pose: &GridPose<'_>,
    mut threshold: Threshold,
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> Option<Separation> {
    let [a, b] = pose.trees;
    let steps = lesser(steps, work.opened.saturating_add(most_pairs(a, b)));
    let mut direction = between_boxes(pose)?;
    let mut pending = Pending::new(scratch);
    let mut hulls = [LeafHull::NONE; 2];
    let mut limits = threshold.limits();
    let reach = |threshold: &Threshold| {
        let length = threshold.far + pose.box_error;
        Reach { length: length * (1.0 + 16.0 * U32), square: square_up(length) }
    };
    let mut within = reach(&threshold);
    let mut is_undecided = false;
    let mut children = [Children::of(a, 0)?, Children::of(b, 0)?];
    loop {
        if let [Some(i), Some(j)] = [children[0].leaf(), children[1].leaf()] {
            let [first, second] = &mut hulls;
            first.set(pose, 0, TriangleAt::new(children[0].node, i, 0))?;
            second.set(pose, 1, TriangleAt::new(children[1].node, j, 0))?;
            let found = visit([first, second], direction.way, &limits, work)?;
            if let Some(near) = found.near {
                return Some(Separation::Near(near));
            }
            if let Some(turned) = found.way.and_then(Direction::of) {
                direction = turned;
            }
            if found.between_sq <= limits.clear_sq {
                is_undecided = true;
                if limits.gap.near_sq < 0.0 {
                    return Some(Separation::Open);
                }
            } else if found.between_sq < limits.gap.far_sq {
                let far = sqrt_approx(found.between_sq) * (1.0 - 8.0 * U32);
                threshold.far = crate::num::greater(threshold.clear, far);
                limits = threshold.limits();
                within = reach(&threshold);
            }
        } else {
            if work.opened >= steps {
                return None;
            }
            work.opened += 1;
            open(pose, &children, &direction, &within, &mut pending, work)?;
        }
        let Some(([node_a, node_b], [i, j])) = pending.next(within.square) else { break };
        children = [Children::below(a, node_a, i)?, Children::below(b, node_b, j)?];
    }
    if is_undecided {
        return Some(Separation::Open);
    }
    // What was left out is farther than this.
    let lower = (threshold.far - pose.error) * (1.0 - 4.0 * U32);
    Some(Separation::Apart(a.units().lower(lower)))
}
