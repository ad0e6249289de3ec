//! Frames and boxes of all nodes of a topology, bottom-up.

use super::boxes::{NodeBoxes, axis_aligned, quantise};
use super::extremes::extreme_points;
use super::frame::{SEARCH_POINTS, best_quaternion};
use super::order::Topology;
use super::rotation::stored_rotation;
use glam::DVec3;

/// All leaves' points, laid out so that every subtree is one contiguous run.
struct SubtreePoints {
    points: Vec<DVec3>,
    /// Run of each node's subtree.
    runs: Vec<(usize, usize)>,
    /// Run of each item.
    item_runs: Vec<(usize, usize)>,
}

impl SubtreePoints {
    fn new(topology: &Topology, leaves: &[&[DVec3]]) -> Self {
        let mut points = Vec::with_capacity(leaves.iter().map(|leaf| leaf.len()).sum());
        let mut runs = vec![(0, 0); topology.nodes.len()];
        let mut item_runs = vec![(0, 0); leaves.len()];
        let mut open: Vec<u32> = if topology.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(index) = open.pop() {
            let node = &topology.nodes[index as usize];
            runs[index as usize].0 = points.len();
            for &item in &node.leaves {
                let start = points.len();
                points.extend_from_slice(leaves[item as usize]);
                item_runs[item as usize] = (start, points.len());
            }
            open.extend(node.inner.iter().rev());
            runs[index as usize].1 = points.len();
        }
        // Nodes were visited depth-first, so a subtree ends where its last descendant's own leaves
        // end; children come after parents.
        for index in (0..topology.nodes.len()).rev() {
            if let Some(&last) = topology.nodes[index].inner.last() {
                runs[index].1 = runs[last as usize].1;
            }
        }
        Self { points, runs, item_runs }
    }

    fn children(&self, topology: &Topology, index: usize) -> Vec<&[DVec3]> {
        let node = &topology.nodes[index];
        let runs = node.inner.iter().map(|&child| self.runs[child as usize]);
        runs.chain(node.leaves.iter().map(|&item| self.item_runs[item as usize]))
            .map(|(start, end)| &self.points[start..end])
            .collect()
    }
}

/// Boxes of every node, in the order of `topology.nodes`; lanes as in the node: inner children
/// first, then leaves. `leaves` are the items' points in grid units.
///
/// The frame is searched on extreme points that are passed up the tree, the boxes cover every point
/// of the subtree. Cost: O(points · depth) for the boxes, O(nodes) for the frames.
pub fn shared_frames(topology: &Topology, leaves: &[&[DVec3]]) -> Vec<NodeBoxes> {
    let subtrees = SubtreePoints::new(topology, leaves);
    let mut extremes: Vec<Vec<DVec3>> = vec![Vec::new(); topology.nodes.len()];
    let mut boxes = Vec::with_capacity(topology.nodes.len());
    for (index, node) in topology.nodes.iter().enumerate().rev() {
        let children = subtrees.children(topology, index);
        let mut reduced: Vec<Vec<DVec3>> =
            node.inner.iter().map(|&child| std::mem::take(&mut extremes[child as usize])).collect();
        reduced.extend(
            children[node.inner.len()..].iter().map(|points| extreme_points(points, SEARCH_POINTS)),
        );
        let search: Vec<&[DVec3]> = reduced.iter().map(Vec::as_slice).collect();
        boxes.push(quantise(stored_rotation(best_quaternion(&search)), &children));
        extremes[index] = extreme_points(&reduced.concat(), SEARCH_POINTS);
    }
    boxes.reverse();
    boxes
}

/// [`shared_frames`] without rotation: the boxes for segment queries.
pub fn axis_aligned_boxes(topology: &Topology, leaves: &[&[DVec3]]) -> Vec<NodeBoxes> {
    let subtrees = SubtreePoints::new(topology, leaves);
    (0..topology.nodes.len())
        .map(|index| axis_aligned(&subtrees.children(topology, index)))
        .collect()
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
                assert_covers_subtrees(&tree, &slices, &shared_frames(&tree, &slices));
                assert_covers_subtrees(&tree, &slices, &axis_aligned_boxes(&tree, &slices));
            }
        }
    }

    #[test]
    fn axis_aligned_boxes_have_the_identity() {
        let leaves = leaves(50, false);
        let slices: Vec<&[DVec3]> = leaves.iter().map(Vec::as_slice).collect();
        let tree = topology(&slices.iter().map(|leaf| bounds(leaf)).collect::<Vec<_>>());
        assert!(
            axis_aligned_boxes(&tree, &slices)
                .iter()
                .all(|b| b.matrix == [[8192, 0, 0], [0, 8192, 0], [0, 0, 8192]])
        );
    }
}
