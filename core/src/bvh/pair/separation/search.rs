//! The descent of two trees, in the grid of the first.

use super::between_boxes::between_boxes;
use super::by_heights::visit_by_heights;
use super::goal::{Candidates, Goal, NearestPair, TrianglesAt, Wanted, square_up};
use super::grid_pose::GridPose;
use super::leaf_hulls::{HullVisit, LeafHull, visit_leaves_at};
use super::node_boxes::{PairLimit, WantedChildren, is_below, push_children};
use super::pending::Pending;
use crate::bvh::pair::direction::{Direction, ShortDirection};
use crate::bvh::pair::models::most_pairs;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{columns, turned};
use crate::num::tolerance::U32;
use crate::num::{Real, float, lesser};
use crate::query::{ScratchEntry, Work};
use glam::Vec3;

/// What a search starts with, and leaves to the next one of the same two models. Every start gives
/// a true answer. The triangles named, the lower bound, and where steps end depend on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SearchStart {
    /// The direction that is tried first, rounded. Zero: the one between the boxes.
    direction: [i8; 3],
    /// The leaves that are visited first: of the triangles that were near.
    near: TrianglesAt,
}

impl SearchStart {
    /// Nothing is known.
    pub(crate) const NONE: SearchStart =
        SearchStart { direction: [0; 3], near: [TriangleAt::NONE; 2] };
}

/// What is proved of two models.
pub(crate) enum PairVerdict {
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
    start: &mut SearchStart,
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> PairVerdict {
    let mut goal = Goal::threshold(pose, asked);
    let end = descend(pose, &mut goal, start, steps, scratch, work);
    let Wanted::Near(threshold) = &goal.wanted else { return PairVerdict::Undecided };
    start.near = threshold.near.unwrap_or([TriangleAt::NONE; 2]);
    match (threshold.near, end) {
        (Some(place), Some(_)) => PairVerdict::Near(place),
        (None, Some(())) if !threshold.is_undecided => {
            // Every pair that was left out is farther than this.
            let [a, _] = pose.trees;
            let lower = (goal.far - pose.error) * (1.0 - 4.0 * U32);
            PairVerdict::Apart(a.units().lower(lower))
        }
        _ => PairVerdict::Undecided,
    }
}

/// Pairs of leaves. If `are_all`, every pair of triangles that may be the nearest is in them.
pub(crate) struct NearestLeaves<'s> {
    /// Two triangles that are nearest, as far as f32 tells.
    pub(crate) best: TrianglesAt,
    pub(crate) candidates: Candidates<'s>,
    pub(crate) are_all: bool,
}

/// The leaves that may have the nearest triangles, as far as f32 tells. Three quarters of
/// `scratch` hold pairs of nodes that wait, one quarter holds the result.
#[inline(never)]
pub(crate) fn nearest_leaves<'s>(
    pose: &GridPose<'_>,
    scratch: &'s mut [ScratchEntry],
    work: &mut Work,
) -> Option<NearestLeaves<'s>> {
    let (waiting, kept) = scratch.split_at_mut_checked(scratch.len() / 4 * 3)?;
    let mut goal = Goal::nearest(pose, kept);
    let mut direction = between_boxes(pose)?;
    let is_done = visit_by_heights(pose, &mut goal, &mut direction, waiting, work);
    let end = if is_done {
        Some(())
    } else {
        goal.forget();
        let start = (&mut direction, [TriangleAt::NONE; 2]);
        visit_leaves(pose, &mut goal, start, u32::MAX, waiting, work)
    };
    let far_sq = goal.limits.far_sq;
    let Wanted::Nearest(nearest) = goal.wanted else { return None };
    let NearestPair { best, mut candidates, is_touching, .. } = nearest;
    candidates.drop_beyond(far_sq);
    let are_all = end.is_some() && !is_touching && !candidates.is_truncated;
    (best[0] != TriangleAt::NONE).then_some(NearestLeaves { best, candidates, are_all })
}

/// Runs [`visit_leaves`] from the direction and the leaves of `start`, and writes the last
/// direction back.
#[inline(never)]
fn descend(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    start: &mut SearchStart,
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> Option<()> {
    let [x, y, z] = start.direction.map(|x| float(i32::from(x)));
    let mut direction = match Direction::of(Vec3::new(x, y, z)) {
        Some(direction) => direction,
        None => between_boxes(pose)?,
    };
    let end = visit_leaves(pose, goal, (&mut direction, start.near), steps, scratch, work);
    // Components are below 2: times 63 they fit an i8.
    start.direction = direction.vector.to_array().map(|x| (x * 63.0) as i8);
    end
}

/// Visits every pair of leaves that may matter to the goal, until the goal is reached. `None` if
/// steps or memory ended first, or a tree is unchecked.
#[inline(never)]
fn visit_leaves(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    (direction, [first_a, first_b]): (&mut Direction, TrianglesAt),
    steps: u32,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> Option<()> {
    let [a, b] = pose.trees;
    let steps = lesser(steps, work.opened.saturating_add(most_pairs(a, b)));
    let mut pending = Pending::new(scratch);
    let mut hulls = [LeafHull::none(), LeafHull::none()];
    let roots = || Some([WantedChildren::of(a, 0)?, WantedChildren::of(b, 0)?]);
    let mut are_roots_next = first_a != TriangleAt::NONE;
    let mut children = if are_roots_next {
        [WantedChildren::leaf_of(first_a), WantedChildren::leaf_of(first_b)]
    } else {
        roots()?
    };
    // Tops along the direction, if it was turned since pairs were pushed.
    let mut tops: Option<LeafTops> = None;
    loop {
        let limit = PairLimit::of(pose, goal.far);
        if let [Some(i), Some(j)] = [children[0].leaf(), children[1].leaf()] {
            let places =
                [TriangleAt::new(children[0].node, i, 0), TriangleAt::new(children[1].node, j, 0)];
            let is_beyond = match &mut tops {
                Some(tops) => tops.are_beyond(pose, places, &limit, direction)?,
                None => false,
            };
            if !is_beyond {
                let visit =
                    visit_leaves_at(pose, goal, &mut hulls, places, direction.vector, work)?;
                let HullVisit { goes_on, direction: next } = visit;
                if !goes_on {
                    return Some(());
                }
                if let Some(turned) = next.and_then(Direction::of) {
                    *direction = turned;
                    // A pair that is beyond ends its visit at once, and changes nothing. So where
                    // code is to be small the question is not asked.
                    tops = if cfg!(meshsweep_small) {
                        None
                    } else {
                        LeafTops::of(pose, turned.vector)
                    };
                }
            }
        } else {
            tops = None;
            if work.opened >= steps {
                return None;
            }
            work.opened += 1;
            push_children(pose, &children, direction, &limit, &mut pending, work)?;
        }
        if are_roots_next {
            (children, are_roots_next) = (roots()?, false);
            continue;
        }
        let length = goal.far + pose.box_error;
        let Some(([node_a, node_b], [i, j])) = pending.next(square_up(length)) else {
            return Some(());
        };
        children = [WantedChildren::below(a, node_a, i)?, WantedChildren::below(b, node_b, j)?];
    }
}

/// The tops of two leaves along the direction.
struct LeafTops {
    short: [ShortDirection; 2],
    /// The last leaf of each model, and its top.
    kept: [(TriangleAt, f32); 2],
}

impl LeafTops {
    #[inline(always)]
    fn of(pose: &GridPose<'_>, direction: Vec3) -> Option<LeafTops> {
        let back = -turned(&columns(&pose.rows), direction);
        let short = [ShortDirection::of(direction)?, ShortDirection::of(back)?];
        Some(LeafTops { short, kept: [(TriangleAt::NONE, 0.0); 2] })
    }

    /// Whether two leaves are beyond the limit along the direction. `None` if a tree is unchecked.
    #[inline(never)]
    fn are_beyond(
        &mut self,
        pose: &GridPose<'_>,
        places: TrianglesAt,
        limit: &PairLimit,
        direction: &Direction,
    ) -> Option<bool> {
        #[allow(clippy::needless_range_loop, reason = "of either model, in four arrays")]
        for k in 0..2 {
            let (of, top) = &mut self.kept[k];
            if *of != places[k] {
                (*of, *top) = (places[k], self.short[k].top(&places[k].leaf(pose.trees[k])?)?);
            }
        }
        let [(_, top_a), (_, top_b)] = self.kept;
        let least_top_a = limit.least_sum_of_tops(pose, direction) - top_b;
        Some(is_below(top_a, Real(least_top_a)))
    }
}
