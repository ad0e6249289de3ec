//! Collapse of a binary tree into nodes of up to eight children, by dynamic programming.
//!
//! Let `C(v, s)` be the least summed weight of wide nodes when subtree `v` fills at most `s` slots
//! of a wide node above it. Then `C(leaf, s) = 0`, `C(v, 1) = weight(v) + share(v, 8)` with
//! `share(v, s) = min over k of C(left, k) + C(right, s - k)`, and `C(v, s) = min(C(v, 1), share(v,
//! s))`. Source: Ylitie, Karras and Laine, "Efficient incoherent ray traversal on GPUs through
//! compressed wide BVHs", 2017, section 3.1.

use super::sah::BinaryNode;

/// Children of a wide node at most.
const WIDTH: usize = 8;

/// `cost[s]`: least weight with at most `s` slots; entry 0 is never read.
type SlotCosts = [f32; WIDTH + 1];

/// Children of a node: inner nodes first, then leaves; 1 to 8 together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WideNode {
    /// Node indices, consecutive in a finished [`Topology`](super::order::Topology).
    pub inner: Vec<u32>,
    /// Item numbers.
    pub leaves: Vec<u32>,
}

impl WideNode {
    /// Inner nodes and leaves together.
    pub fn child_count(&self) -> usize {
        self.inner.len() + self.leaves.len()
    }
}

/// Wide nodes over a binary tree. In both trees node 0 is the root and children come after their
/// parents.
///
/// `node_weight` times the binary nodes' mean weight is added to each wide node's: the larger it
/// is, the fewer and fuller the nodes. Trees without extent (all weights 0) get the fewest nodes.
/// One item gives one node with one leaf; no items give no nodes. Cost: O(n).
pub(super) fn collapse(tree: &[BinaryNode], node_weight: f32) -> Vec<WideNode> {
    let Some(root) = tree.first() else { return Vec::new() };
    if root.is_leaf() {
        return vec![WideNode { inner: Vec::new(), leaves: vec![root.right_or_item] }];
    }
    let total: f64 = tree.iter().map(|node| f64::from(node.weight)).sum();
    let mean = (total / tree.len() as f64) as f32;
    let costs = slot_costs(tree, if mean > 0.0 { node_weight * mean } else { 1.0 });
    let mut wide = vec![WideNode::default()];
    let mut sources = vec![0u32];
    let mut next = 0;
    let mut open = Vec::with_capacity(WIDTH);
    while next < wide.len() {
        let source = &tree[sources[next] as usize];
        share_between(&costs, source, WIDTH, &mut open);
        while let Some((index, slots)) = open.pop() {
            let node = &tree[index as usize];
            let cost = &costs[index as usize];
            if node.is_leaf() {
                wide[next].leaves.push(node.right_or_item);
            } else if slots == 1 || cost[1] <= cost[slots] {
                let child = wide.len() as u32;
                wide[next].inner.push(child);
                wide.push(WideNode::default());
                sources.push(index);
            } else {
                share_between(&costs, node, slots, &mut open);
            }
        }
        next += 1;
    }
    wide
}

fn slot_costs(tree: &[BinaryNode], node_weight: f32) -> Vec<SlotCosts> {
    let mut costs = vec![[0.0; WIDTH + 1]; tree.len()];
    for (index, node) in tree.iter().enumerate().rev().filter(|(_, node)| !node.is_leaf()) {
        let (left, right) = (costs[node.left as usize], costs[node.right_or_item as usize]);
        let cost = &mut costs[index];
        let own = node.weight + node_weight + best_share(&left, &right, WIDTH).1;
        cost[1] = own;
        for (slots, least) in cost.iter_mut().enumerate().skip(2) {
            *least = own.min(best_share(&left, &right, slots).1);
        }
    }
    costs
}

/// How many of `slots` (at least 2) the left child takes at best, and the cost.
fn best_share(left: &SlotCosts, right: &SlotCosts, slots: usize) -> (usize, f32) {
    let mut best = (1, left[1] + right[slots - 1]);
    for taken in 2..slots {
        let cost = left[taken] + right[slots - taken];
        if cost < best.1 {
            best = (taken, cost);
        }
    }
    best
}

fn share_between(
    costs: &[SlotCosts],
    node: &BinaryNode,
    slots: usize,
    open: &mut Vec<(u32, usize)>,
) {
    let (left, right) = (node.left, node.right_or_item);
    let (taken, _) = best_share(&costs[left as usize], &costs[right as usize], slots);
    open.push((right, slots - taken));
    open.push((left, taken));
}

#[cfg(test)]
mod tests {
    use super::super::sah::binary_tree;
    use super::*;
    use glam::DVec3;

    fn grid(count: u32) -> Vec<(DVec3, DVec3)> {
        (0..count)
            .map(|i| {
                let low =
                    DVec3::new(f64::from(i % 32), f64::from(i / 32 % 32), f64::from(i / 1024));
                (low, low + DVec3::ONE)
            })
            .collect()
    }

    #[test]
    fn eight_items_make_one_full_node() {
        let wide = collapse(&binary_tree(&grid(8), 0.1), 0.0);
        assert_eq!(wide.len(), 1);
        assert_eq!(wide[0].leaves.len(), 8);
    }

    #[test]
    fn nine_items_make_two_nodes() {
        let wide = collapse(&binary_tree(&grid(9), 0.1), 0.0);
        assert_eq!(wide.len(), 2);
        assert_eq!(wide.iter().map(|node| node.leaves.len()).sum::<usize>(), 9);
    }

    #[test]
    fn nodes_are_well_filled() {
        let wide = collapse(&binary_tree(&grid(4000), 0.1), 0.0);
        let children: usize = wide.iter().map(WideNode::child_count).sum();
        assert!(
            children as f64 / wide.len() as f64 > 6.0,
            "{}",
            children as f64 / wide.len() as f64
        );
    }

    #[test]
    fn heavier_nodes_make_fewer_nodes() {
        let tree = binary_tree(&grid(4000), 0.1);
        assert!(collapse(&tree, 1.0).len() <= collapse(&tree, 0.0).len());
    }
}
