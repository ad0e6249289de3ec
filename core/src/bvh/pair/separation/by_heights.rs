//! The nearest leaves by their heights along one direction, one tree at a time.
//!
//! A high leaf of each model along a direction gives a pair, and the pair gives the next direction.
//! Along the direction of the nearest pair few leaves of either model stick out, most often: each
//! of these is looked at with each of the other model. Else the descent of both trees follows,
//! which begins with what was found. `core/docs/rounding.md` §26, *One tree at a time*.

use super::goal::{Goal, square_up};
use super::grid_pose::GridPose;
use super::leaf_hulls::{HullVisit, LeafHull, visit_leaves_at};
use super::node_boxes::{NodeBoxes, PairLimit, bits, first_box, is_above, is_below, second_box};
use crate::bvh::pair::direction::{Direction, IntDirection};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::format::layout::MAX_TREE_DEPTH;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{columns, turned};
use crate::num::{Real, dot, greater, lesser};
use crate::query::{ScratchEntry, Work};
use glam::Vec3;

/// Most directions that are tried before leaves are listed. Each costs a walk down both trees and a
/// look at two leaves. Only which of several equally near triangles is named depends on this
/// number.
const MOST_ROUNDS: u32 = 3;

/// Most pairs of listed leaves that are compared one by one. More pairs are left to the descent,
/// which drops many at once by the boxes of nodes.
const MOST_PAIRS: usize = 512;

/// Most leaves that are listed of a model. If there are more, the descent follows, and the list was
/// in vain. On an arm lists of up to 100 leaves cost more than they saved.
const MOST_LEAVES: usize = 48;

/// Most nodes of a model that are opened for a list. Of a model whose leaves are equally high, such
/// as a plate seen across its edge, all would be.
const MOST_NODES: u32 = 128;

/// The heights of one model along a direction, in its own grid.
struct ModelHeights<'a> {
    tree: &'a Bvh<'a>,
    origin: Vec3,
    direction: Vec3,
    integers: IntDirection,
}

impl<'a> ModelHeights<'a> {
    fn of_both_models(pose: &GridPose<'a>, direction: Vec3) -> Option<[ModelHeights<'a>; 2]> {
        let ([a, b], [origin_a, origin_b]) = (pose.trees, pose.origins);
        // From the second model to the first, in the frame of the second grid.
        let back = -turned(&columns(&pose.rows), direction);
        let (first, second) = (IntDirection::of(direction)?, IntDirection::of(back)?);
        Some([
            ModelHeights { tree: a, origin: origin_a, direction, integers: first },
            ModelHeights { tree: b, origin: origin_b, direction: back, integers: second },
        ])
    }

    /// A high leaf, and an upper bound of its height. The highest child of each node is followed.
    #[inline(never)]
    fn high_leaf(&self, work: &mut Work) -> Option<(TriangleAt, f32)> {
        let mut node = 0;
        for _ in 0..MAX_TREE_DEPTH {
            work.opened += 1;
            let links = self.tree.links(node)?;
            let wanted = links.mask();
            let tops =
                NodeBoxes::of(self.tree, node, self.origin)?.tops(self.direction, 0.0, wanted);
            let mut best = 0;
            for i in bits(wanted) {
                best = if Real(tops[i]) > Real(tops[best & 7]) { i } else { best };
            }
            let index = best as u32;
            if index >= links.inner {
                let top = self.integers.top(&self.tree.leaf(node, index)?)?;
                return Some((TriangleAt::new(node, index, 0), lesser(top, tops[best & 7])));
            }
            node = links.first_node.wrapping_add(index);
        }
        None
    }

    /// Lists the leaves that are at least as high as `floor`, with upper bounds of their heights;
    /// if `only_highest`, the highest one alone. Returns their number, and the last floor. `None`
    /// if they are many, memory ends, or the tree is unchecked.
    #[inline(never)]
    fn leaves(
        &self,
        mut floor: f32,
        only_highest: bool,
        memory: &mut [ScratchEntry],
        work: &mut Work,
    ) -> Option<(usize, f32)> {
        let (mut listed, mut waiting) = (0, memory.len());
        let mut node = 0;
        for _ in 0..lesser(self.tree.most_steps(), MOST_NODES) {
            work.opened += 1;
            let links = self.tree.links(node)?;
            let wanted = links.mask();
            let tops =
                NodeBoxes::of(self.tree, node, self.origin)?.tops(self.direction, 0.0, wanted);
            let begun = waiting;
            for i in bits(wanted) {
                let top = tops[i];
                // A leaf that is as high as the highest one does not raise the floor.
                if is_below(top, Real(floor)) || only_highest && Real(top) <= Real(floor) {
                    continue;
                }
                let index = i as u32;
                if index < links.inner {
                    waiting = waiting.checked_sub(1).filter(|&waiting| waiting >= listed)?;
                    let child = links.first_node.wrapping_add(index);
                    *memory.get_mut(waiting)? = ScratchEntry::new(top, child);
                    continue;
                }
                let top = lesser(top, self.integers.top(&self.tree.leaf(node, index)?)?);
                if is_below(top, Real(floor)) {
                    continue;
                }
                if only_highest {
                    (floor, listed) = (top, 0);
                }
                if listed >= waiting || listed >= MOST_LEAVES {
                    return None;
                }
                let place = TriangleAt::new(node, index, 0);
                *memory.get_mut(listed)? = ScratchEntry::new(top, place.word());
                listed += 1;
            }
            // The highest child comes next.
            if let Some([next, others @ ..]) = memory.get_mut(waiting..begun) {
                for other in others {
                    if Real(other.key()) > Real(next.key()) {
                        core::mem::swap(other, next);
                    }
                }
            }
            node = loop {
                let Some(next) = memory.get(waiting) else { return Some((listed, floor)) };
                waiting += 1;
                let is_low = only_highest && Real(next.key()) <= Real(floor);
                if !is_low && !is_below(next.key(), Real(floor)) {
                    break next.node();
                }
            };
        }
        None
    }
}

/// Gives the goal the pairs of leaves that may matter to it. Returns whether every pair that may
/// matter was given. If not, the descent of both trees follows: the limit may have fallen, and
/// `direction` is a good start.
pub(super) fn visit_by_heights(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    direction: &mut Direction,
    scratch: &mut [ScratchEntry],
    work: &mut Work,
) -> bool {
    let mut hulls = [LeafHull::none(), LeafHull::none()];
    match turn_to_nearest_pair(pose, goal, &mut hulls, direction, work) {
        Some(Turned::ToNearPair) => {}
        Some(Turned::ToAnswer) => return true,
        None => return false,
    }
    let Some(lists) = list_leaves(pose, goal, direction, scratch, work) else { return false };
    visit_listed_pairs(pose, goal, &mut hulls, direction, lists, work).is_some()
}

/// What a turn of the direction led to.
enum Turned {
    /// A near pair of leaves. The search goes on.
    ToNearPair,
    /// All that the goal wants.
    ToAnswer,
}

/// Turns `direction` to that of a near pair of leaves. `None` if the models overlap along a
/// direction, or a tree is unchecked.
#[inline(always)]
fn turn_to_nearest_pair(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    hulls: &mut [LeafHull; 2],
    direction: &mut Direction,
    work: &mut Work,
) -> Option<Turned> {
    let mut last = [TriangleAt::NONE; 2];
    let mut along = *direction;
    let mut far = goal.far;
    for _ in 0..MOST_ROUNDS {
        let [first, second] = ModelHeights::of_both_models(pose, direction.vector)?;
        let ((a, top_a), (b, top_b)) = (first.high_leaf(work)?, second.high_leaf(work)?);
        // Models that overlap along the direction have many leaves that stick out.
        if is_above(Real(top_a) + Real(top_b), dot(pose.shift, direction.vector)) {
            return None;
        }
        if last == [a, b] {
            break;
        }
        last = [a, b];
        let HullVisit { goes_on, direction: next } =
            visit_leaves_at(pose, goal, hulls, last, direction.vector, work)?;
        if !goes_on {
            return Some(Turned::ToAnswer);
        }
        let Some(turned) = next.and_then(Direction::of) else { break };
        *direction = turned;
        if goal.far < far {
            (far, along) = (goal.far, turned);
        }
    }
    *direction = along;
    Some(Turned::ToNearPair)
}

/// Lists the leaves of each model that may be within the limit along `along`. `None` if they are
/// many, the models overlap along it, memory ends, or a tree is unchecked.
#[inline(always)]
fn list_leaves<'s>(
    pose: &GridPose<'_>,
    goal: &Goal<'_>,
    along: &Direction,
    scratch: &'s mut [ScratchEntry],
    work: &mut Work,
) -> Option<[&'s [ScratchEntry]; 2]> {
    let [first, second] = ModelHeights::of_both_models(pose, along.vector)?;
    let ((_, top_a), (_, floor)) = (first.high_leaf(work)?, second.high_leaf(work)?);
    let (_, top_b) = second.leaves(floor, true, scratch, work)?;
    let least_sum = least_sum_of_tops(pose, goal, along);
    if is_above(Real(top_a) + Real(top_b), dot(pose.shift, along.vector)) {
        return None;
    }
    let (count_a, _) = first.leaves(least_sum - top_b, false, scratch, work)?;
    let (list_a, rest) = scratch.split_at_mut_checked(count_a)?;
    let top_a = list_a.iter().fold(f32::MIN, |top, entry| greater(Real(top), Real(entry.key())).0);
    let (count_b, _) = second.leaves(least_sum - top_a, false, rest, work)?;
    if count_a.saturating_mul(count_b) > MOST_PAIRS {
        return None;
    }
    Some([list_a, rest.get(..count_b)?])
}

/// Gives the goal the pairs of listed leaves that may be within the limit. `None` if a tree is
/// unchecked. Not inlined, so that its frame is not on the stack during the descent that may
/// follow.
#[inline(never)]
fn visit_listed_pairs(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    hulls: &mut [LeafHull; 2],
    along: &Direction,
    [list_a, list_b]: [&[ScratchEntry]; 2],
    work: &mut Work,
) -> Option<()> {
    goal.forget();
    let mut start = along.vector;
    for second in list_b {
        let b = TriangleAt::of_word(second.node());
        let mut moved = None;
        for first in list_a {
            let least_top = Real(least_sum_of_tops(pose, goal, along) - second.key());
            if is_below(first.key(), least_top) {
                continue;
            }
            let a = TriangleAt::of_word(first.node());
            if moved.is_none() {
                moved = Some(second_box(pose, b)?);
            }
            let key = first_box(pose, a)?.key(moved.as_ref()?);
            if is_above(Real(key), square_up(goal.far + pose.box_error)) {
                continue;
            }
            let HullVisit { goes_on, direction: next } =
                visit_leaves_at(pose, goal, hulls, [a, b], start, work)?;
            if !goes_on {
                return Some(());
            }
            start = next.unwrap_or(start);
        }
    }
    Some(())
}

/// If the tops of two leaves along a direction add up to less than this, they are beyond the limit.
fn least_sum_of_tops(pose: &GridPose<'_>, goal: &Goal<'_>, direction: &Direction) -> f32 {
    PairLimit::of(pose, goal.far).least_sum_of_tops(pose, direction)
}
