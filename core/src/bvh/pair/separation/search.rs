//! The descent of two trees, in the grid of the first.

use super::between_boxes::between_boxes;
use super::direction::Direction;
use super::goal::{Candidates, Goal, TrianglesAt, Wanted, square_up};
use super::grid_pose::GridPose;
use super::leaf_hulls::{LeafHull, LeafVisit, visit};
use super::node_boxes::{Children, Reach, open};
use super::pending::Pending;
use crate::bvh::pair::models::most_pairs;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::num::lesser;
use crate::num::tolerance::U32;
use crate::query::{ScratchEntry, Work};

/// What is proved of two models.
pub(crate) enum Separation {
    /// Lower bound of their distance, above the distance asked about. Input units of the first.
    Apart(f32),
    /// These triangles are certainly within the distance asked about.
    Near(TrianglesAt),
    /// No verdict: f32 does not tell, or steps or memory ended.
    Undecided,
}

/// Whether two models are within a distance. `asked` is the distance, and how far above it a lower
/// bound is wanted: both in input units of the first model.
#[inline(never)]
pub(crate) fn separation(
    pose: &GridPose<'_>,
    asked: [f32; 2],
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> Separation {
    let mut goal = Goal::threshold(pose, asked);
    let end = descend(pose, &mut goal, steps, scratch, work);
    let Wanted::Near(threshold) = &goal.wanted else { return Separation::Undecided };
    match (threshold.near, end) {
        (Some(place), Some(_)) => Separation::Near(place),
        (None, Some(())) if !threshold.is_undecided => {
            // Every pair that was left out is farther than this.
            let [a, _] = pose.trees;
            let lower = (goal.far - pose.error) * (1.0 - 4.0 * U32);
            Separation::Apart(a.units().lower(lower))
        }
        _ => Separation::Undecided,
    }
}

/// Pairs of triangles. If `are_all`, every pair that may be the nearest is among them.
pub(crate) struct NearestTriangles<'s> {
    pub(crate) candidates: Candidates<'s>,
    pub(crate) are_all: bool,
}

/// The pairs of triangles that may be the nearest ones, as far as f32 tells. Three quarters of
/// `scratch` hold pairs of nodes that wait, one quarter holds the result.
#[inline(never)]
pub(crate) fn nearest_triangles<'s>(
    pose: &GridPose<'_>,
    steps: u32,
    scratch: &'s mut [ScratchEntry],
    work: &mut Work,
) -> Option<NearestTriangles<'s>> {
    let (waiting, kept) = scratch.split_at_mut_checked(scratch.len() / 4 * 3)?;
    let mut goal = Goal::nearest(pose, kept);
    let end = descend(pose, &mut goal, steps, waiting, work);
    let far_sq = goal.limits.far_sq;
    let Wanted::Nearest(nearest) = goal.wanted else { return None };
    let (mut candidates, is_cut) = (nearest.candidates, nearest.is_cut);
    candidates.drop_beyond(far_sq);
    let are_all = end.is_some() && !is_cut && !candidates.is_short;
    Some(NearestTriangles { candidates, are_all })
}

/// Visits every pair of leaves that may matter to the goal, until the goal is reached. `None` if
/// steps or memory ended first, or a tree is unchecked.
#[inline(never)]
fn descend(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> Option<()> {
    let [a, b] = pose.trees;
    let steps = lesser(steps, work.opened.saturating_add(most_pairs(a, b)));
    let mut direction = between_boxes(pose)?;
    let mut pending = Pending::new(scratch);
    let mut hulls = [LeafHull::NONE; 2];
    let mut children = [Children::of(a, 0)?, Children::of(b, 0)?];
    loop {
        let length = goal.far + pose.box_error;
        let reach = Reach { length: length * (1.0 + 16.0 * U32), square: square_up(length) };
        if let [Some(i), Some(j)] = [children[0].leaf(), children[1].leaf()] {
            let [first, second] = &mut hulls;
            first.set(pose, 0, TriangleAt::new(children[0].node, i, 0))?;
            second.set(pose, 1, TriangleAt::new(children[1].node, j, 0))?;
            let LeafVisit { goes_on, way } = visit([first, second], direction.way, goal, work)?;
            if !goes_on {
                return Some(());
            }
            if let Some(turned) = way.and_then(Direction::of) {
                direction = turned;
            }
        } else {
            if work.opened >= steps {
                return None;
            }
            work.opened += 1;
            open(pose, &children, &direction, &reach, &mut pending, work)?;
        }
        let length = goal.far + pose.box_error;
        let Some(([node_a, node_b], [i, j])) = pending.next(square_up(length)) else {
            return Some(());
        };
        children = [Children::below(a, node_a, i)?, Children::below(b, node_b, j)?];
    }
}
