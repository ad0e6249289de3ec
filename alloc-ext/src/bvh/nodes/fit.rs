//! Frames and boxes of all nodes of a topology, bottom-up.

use super::boxes::{IDENTITY, NodeBoxes, axis_aligned, quantise};
use super::extremes::extreme_points;
use super::frame::{SEARCH_POINTS, best_quaternion};
use super::order::Topology;
use super::rotation::stored_rotation;
use super::subtree::Subtrees;
use crate::error::BuildError;
use crate::progress::Watch;
use glam::DVec3;

/// Boxes of every node, in the order of `topology.nodes`; lanes as in the node: inner children
/// first, then leaves. `leaves` are the items' points in grid units.
///
/// The frame is searched on extreme points that are passed up the tree, the boxes cover every point
/// of the subtree. Cost: O(nodes), on all threads.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub fn shared_frames(
    topology: &Topology,
    leaves: &[&[DVec3]],
    watch: Watch<'_>,
) -> Result<Vec<NodeBoxes>, BuildError> {
    let subtrees = Subtrees::new(topology, leaves);
    let mut extremes: Vec<Vec<DVec3>> = vec![Vec::new(); topology.nodes.len()];
    let mut boxes: Vec<Option<NodeBoxes>> = vec![None; topology.nodes.len()];
    let (mut done, all) = (0, topology.nodes.len() as f64);
    for level in levels_from_below(topology) {
        let part = watch.part(f64::from(done) / all, f64::from(done + level.len() as u32) / all);
        done += level.len() as u32;
        let fitted: Vec<(NodeBoxes, Vec<DVec3>)> = part.map(level.len(), |at| {
            let index = level[at];
            let node = &topology.nodes[index as usize];
            let of_leaves = node.leaves.iter().map(|&item| leaves[item as usize]);
            let of_leaves: Vec<Vec<DVec3>> =
                of_leaves.map(|points| extreme_points(points, SEARCH_POINTS)).collect();
            let of_inner = node.inner.iter().map(|&child| &extremes[child as usize]);
            let search: Vec<&[DVec3]> = of_inner.chain(&of_leaves).map(Vec::as_slice).collect();
            let children = subtrees.below(index, |child| &extremes[child as usize]);
            let boxes = quantise(stored_rotation(best_quaternion(&search)), &children);
            (boxes, extreme_points(&search.concat(), SEARCH_POINTS))
        })?;
        for (&index, (fitted, points)) in level.iter().zip(fitted) {
            boxes[index as usize] = Some(fitted);
            extremes[index as usize] = points;
            for &child in &topology.nodes[index as usize].inner {
                extremes[child as usize] = Vec::new();
            }
        }
    }
    Ok(boxes.into_iter().flatten().collect())
}

/// [`shared_frames`] without the search of a rotation, which takes most of the time. Answers are
/// the same, after a few more visits.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub fn unturned_frames(
    topology: &Topology,
    leaves: &[&[DVec3]],
    watch: Watch<'_>,
) -> Result<Vec<NodeBoxes>, BuildError> {
    let subtrees = Subtrees::new(topology, leaves);
    watch.map(topology.nodes.len(), |index| {
        quantise(IDENTITY, &subtrees.below(index as u32, |_| &[]))
    })
}

/// [`shared_frames`] without rotation: the boxes for segment queries.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub fn axis_aligned_boxes(
    topology: &Topology,
    leaves: &[&[DVec3]],
    watch: Watch<'_>,
) -> Result<Vec<NodeBoxes>, BuildError> {
    let subtrees = Subtrees::new(topology, leaves);
    watch.map(topology.nodes.len(), |index| axis_aligned(&subtrees.below(index as u32, |_| &[])))
}

/// Nodes by height. Nodes without inner children come first.
fn levels_from_below(topology: &Topology) -> Vec<Vec<u32>> {
    let mut heights = vec![0; topology.nodes.len()];
    let mut levels: Vec<Vec<u32>> = Vec::new();
    for (index, node) in topology.nodes.iter().enumerate().rev() {
        let below = node.inner.iter().map(|&child| heights[child as usize] + 1);
        let height = below.max().unwrap_or(0);
        heights[index] = height;
        levels.resize_with(levels.len().max(height + 1), Vec::new);
        levels[height].push(index as u32);
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::super::order::topology;
    use super::*;
    use crate::random::SplitMix;

    /// Small leaves on a sphere.
    fn leaves(count: usize, fractional: bool) -> Vec<Vec<DVec3>> {
        let mut noise = SplitMix::new(8);
        let mut leaf = || {
            let normal = noise.point(DVec3::ZERO, DVec3::ONE).normalize();
            let centre = DVec3::splat(32_000.0) + normal * 30_000.0;
            (0..8)
                .map(|_| noise.point(centre, DVec3::splat(2000.0)))
                .map(|p| if fractional { p } else { p.round() })
                .collect()
        };
        (0..count).map(|_| leaf()).collect()
    }

    fn bounds(leaf: &[DVec3]) -> (DVec3, DVec3) {
        (
            leaf.iter().copied().reduce(DVec3::min).unwrap(),
            leaf.iter().copied().reduce(DVec3::max).unwrap(),
        )
    }

    /// Checks every item against the boxes of all its ancestors.
    fn assert_covers_subtrees(topology: &Topology, leaves: &[&[DVec3]], boxes: &[NodeBoxes]) {
        assert_eq!(boxes.len(), topology.nodes.len());
        let mut items: Vec<Vec<u32>> = vec![Vec::new(); topology.nodes.len()];
        for (index, node) in topology.nodes.iter().enumerate().rev() {
            let inner: Vec<Vec<u32>> =
                node.inner.iter().map(|&c| std::mem::take(&mut items[c as usize])).collect();
            let lanes = inner.into_iter().chain(node.leaves.iter().map(|&item| vec![item]));
            let mut all = Vec::new();
            for (lane, below) in lanes.enumerate() {
                for &item in &below {
                    assert!(
                        leaves[item as usize].iter().all(|&point| boxes[index].covers(lane, point))
                    );
                }
                all.extend(below);
            }
            assert!(
                (node.child_count()..8)
                    .all(|lane| boxes[index].low[0][lane] == 255 && boxes[index].high[0][lane] == 0)
            );
            items[index] = all;
        }
        assert_eq!(items.first().map_or(0, Vec::len), leaves.len());
    }

    #[test]
    fn all_points_of_all_subtrees_are_covered() {
        for count in [0, 1, 2, 9, 400] {
            for fractional in [false, true] {
                let leaves = leaves(count, fractional);
                let slices: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
                let tree = topology(&slices.iter().map(|leaf| bounds(leaf)).collect::<Vec<_>>());
                for fit in [shared_frames, unturned_frames, axis_aligned_boxes] {
                    let boxes = fit(&tree, &slices, Watch::NONE).expect("nobody cancels");
                    assert_covers_subtrees(&tree, &slices, &boxes);
                }
            }
        }
    }

    #[test]
    fn axis_aligned_boxes_have_the_identity() {
        let leaves = leaves(50, false);
        let slices: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
        let tree = topology(&slices.iter().map(|leaf| bounds(leaf)).collect::<Vec<_>>());
        assert!(
            axis_aligned_boxes(&tree, &slices, Watch::NONE)
                .expect("nobody cancels")
                .iter()
                .all(|b| b.matrix == [[8192, 0, 0], [0, 8192, 0], [0, 0, 8192]])
        );
    }
}
