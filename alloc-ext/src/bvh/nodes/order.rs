//! The wide tree's topology and the order in which its nodes and leaves are stored.

use super::collapse::{WideNode, collapse};
use super::sah::binary_tree;
use glam::DVec3;

// These values were chosen by counting the nodes and leaves that closest-point searches visit on
// scanned and CAD meshes. Visits change by about 2 % from `EXTENT_WEIGHT` 0.005 to 0.1 and from
// `NODE_WEIGHT` 0 to 0.4.

/// Weight of a box's summed extents beside its half surface, relative to the diagonal of all items.
pub const EXTENT_WEIGHT: f32 = 0.02;

/// Cost of a wide node beside the chance of its visit, relative to the mean over the binary tree:
/// the larger, the fewer and fuller the nodes.
const NODE_WEIGHT: f32 = 0.2;

/// Shape of the box tree. Node 0 is the root; the inner children of a node have consecutive
/// indices, greater than its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// All nodes, families of siblings depth-first.
    pub nodes: Vec<WideNode>,
    /// Items in the order of their leaves: node by node, within a node as in [`WideNode::leaves`].
    pub leaf_order: Vec<u32>,
    /// The most entries on the stack of a depth-first traversal that pushes all children of a node
    /// but one: the maximum over all root-to-node paths of the sum of (children − 1). The blob's
    /// `stack_entries` is this plus eight.
    pub waiting_entries: usize,
    /// Nodes on the longest path from the root; 0 for an empty tree.
    pub depth: usize,
}

/// Builds the topology over items with axis-aligned boxes `(low, high)` in grid units (finite,
/// `low <= high`).
///
/// Equal, flat and point-like boxes are fine: depth stays O(log n) for any input. No items give no
/// nodes; one item gives a root with one leaf. Deterministic. Cost: O(n log n).
pub fn topology(bounds: &[(DVec3, DVec3)]) -> Topology {
    arrange(&collapse(&binary_tree(bounds, EXTENT_WEIGHT), NODE_WEIGHT))
}

/// Renumbers nodes so that siblings are neighbours and subtrees stay together: after a family come
/// the families of its first member, then of its second, and so on. A descent then stays within a
/// shrinking stretch of memory.
fn arrange(nodes: &[WideNode]) -> Topology {
    let mut renumbered = Vec::with_capacity(nodes.len());
    let mut families: Vec<&[u32]> = if nodes.is_empty() { Vec::new() } else { vec![&[0]] };
    let mut new_idx = vec![0u32; nodes.len()];
    let mut old_idx = Vec::with_capacity(nodes.len());
    while let Some(family) = families.pop() {
        for &old in family {
            new_idx[old as usize] = old_idx.len() as u32;
            old_idx.push(old);
        }
        families.extend(
            family
                .iter()
                .rev()
                .map(|&old| nodes[old as usize].inner.as_slice())
                .filter(|f| !f.is_empty()),
        );
    }
    for &old in &old_idx {
        let node = &nodes[old as usize];
        renumbered.push(WideNode {
            inner: node.inner.iter().map(|&child| new_idx[child as usize]).collect(),
            leaves: node.leaves.clone(),
        });
    }
    let leaf_order = renumbered.iter().flat_map(|node| node.leaves.iter().copied()).collect();
    let (waiting_entries, depth) = path_maxima(&renumbered);
    Topology { nodes: renumbered, leaf_order, waiting_entries, depth }
}

/// Waiting entries and nodes on the worst root-to-node path.
fn path_maxima(nodes: &[WideNode]) -> (usize, usize) {
    let mut entries = vec![0; nodes.len()];
    let mut depths = vec![1; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        entries[index] += node.child_count() - 1;
        for &child in &node.inner {
            entries[child as usize] = entries[index];
            depths[child as usize] = depths[index] + 1;
        }
    }
    (entries.into_iter().max().unwrap_or(0), depths.into_iter().max().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_valid(topology: &Topology, items: usize) {
        let mut expected_leaves = Vec::new();
        let mut parents = vec![0; topology.nodes.len()];
        for (index, node) in topology.nodes.iter().enumerate() {
            assert!((1..=8).contains(&node.child_count()));
            for (rank, &child) in node.inner.iter().enumerate() {
                assert!(child as usize > index);
                assert_eq!(child, node.inner[0] + rank as u32);
                parents[child as usize] += 1;
            }
            expected_leaves.extend_from_slice(&node.leaves);
        }
        assert!(parents.iter().skip(1).all(|&count| count == 1));
        assert_eq!(topology.leaf_order, expected_leaves);
        let mut sorted = expected_leaves;
        sorted.sort_unstable();
        assert_eq!(sorted, (0..items as u32).collect::<Vec<_>>());
        assert_eq!(topology.waiting_entries, deepest_stack(&topology.nodes));
    }

    /// Plays the traversal: all children but one are pushed, whichever is followed.
    fn deepest_stack(nodes: &[WideNode]) -> usize {
        let mut deepest = 0;
        let mut open = if nodes.is_empty() { vec![] } else { vec![(0u32, 0usize)] };
        while let Some((index, held)) = open.pop() {
            let node = &nodes[index as usize];
            let held = held + node.child_count() - 1;
            deepest = deepest.max(held);
            open.extend(node.inner.iter().map(|&child| (child, held)));
        }
        deepest
    }

    fn scattered(count: u32) -> Vec<(DVec3, DVec3)> {
        (0..count)
            .map(|i| {
                let coordinate = |factor: u32| f64::from(i.wrapping_mul(factor) >> 16);
                let low = DVec3::new(
                    coordinate(2_654_435_769),
                    coordinate(2_246_822_519),
                    coordinate(3_266_489_917),
                );
                (low, low + DVec3::splat(500.0))
            })
            .collect()
    }

    #[test]
    fn every_size_keeps_the_invariants() {
        for count in (0..70).chain([500, 3000]) {
            assert_valid(&topology(&scattered(count)), count as usize);
        }
    }

    #[test]
    fn one_item_is_a_root_with_one_leaf() {
        let tree = topology(&scattered(1));
        assert_eq!(tree.nodes, [WideNode { inner: vec![], leaves: vec![0] }]);
        assert_eq!((tree.waiting_entries, tree.depth), (0, 1));
    }

    #[test]
    fn equal_items_stay_shallow() {
        let tree = topology(&vec![(DVec3::ZERO, DVec3::ZERO); 100_000]);
        assert_valid(&tree, 100_000);
        assert!(tree.depth <= 9, "{}", tree.depth);
    }

    #[test]
    fn collinear_items_stay_shallow() {
        let bounds: Vec<_> =
            (0..100_000).map(|i| (DVec3::X * f64::from(i), DVec3::X * f64::from(i + 1))).collect();
        let tree = topology(&bounds);
        assert_valid(&tree, 100_000);
        assert!(tree.depth <= 9, "{}", tree.depth);
    }

    #[test]
    fn nested_items_stay_shallow() {
        let bounds: Vec<_> = (1..20_000)
            .map(|i| (DVec3::splat(-f64::from(i)), DVec3::splat(f64::from(i * i % 60_000))))
            .collect();
        let tree = topology(&bounds);
        assert_valid(&tree, 19_999);
        assert!(tree.depth <= 44, "{}", tree.depth);
    }

    #[test]
    fn descendants_follow_their_family() {
        let tree = topology(&scattered(3000));
        let mut last = vec![0u32; tree.nodes.len()];
        for index in (0..tree.nodes.len()).rev() {
            last[index] = tree.nodes[index]
                .inner
                .iter()
                .map(|&c| last[c as usize])
                .max()
                .unwrap_or(index as u32);
        }
        // Below a family, the subtrees of its members do not interleave.
        for node in tree.nodes.iter().filter(|node| node.inner.len() > 1) {
            for pair in node.inner.windows(2) {
                let first_below = tree.nodes[pair[1] as usize].inner.first();
                assert!(
                    first_below.is_none_or(|&first| tree.nodes[pair[0] as usize].inner.is_empty()
                        || last[pair[0] as usize] < first)
                );
            }
        }
    }
}
