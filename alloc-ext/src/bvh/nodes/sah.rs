//! The binary tree behind the wide one: top-down, by the surface area heuristic, over items that
//! are sorted once per axis.
//!
//! Every node is split where `cost(left) · items(left) + cost(right) · items(right)` is least among
//! all positions on the three axes (a full sweep, no bins). The orders of the three axes are kept
//! sorted by stable partition, so a level costs O(items). Source: Wald and Havran, "On building
//! fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006; the measure is adapted to
//! distance queries, see [`BoxMeasure`].

use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// No child: marks leaves of the binary tree.
const NO_CHILD: u32 = u32::MAX;

/// Chance that a query visits an axis-aligned box: half its surface plus `extent_weight` times its
/// summed extents.
///
/// By Steiner's formula the volume of a box that grows by `d` on all sides is `V + S d + π L d² +
/// …` with the surface `S` and the summed extents `L`; points within `d` of a surface-like set of
/// boxes are what closest-point searches open. The volume term is left out: axis-aligned volume
/// says nothing of a slanted leaf, whose node will get an oriented frame.
#[derive(Clone, Copy)]
pub(super) struct BoxMeasure {
    /// Weight of the summed extents, grid units.
    pub extent_weight: f32,
}

impl BoxMeasure {
    #[inline(always)]
    pub(super) fn of(self, bounds: &Bounds) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| bounds.high[k] - bounds.low[k]);
        x * y + y * z + z * x + self.extent_weight * (x + y + z)
    }
}

/// Axis-aligned box of an item or a run of items, grid units. f32 is enough: it only steers the
/// topology.
#[derive(Clone, Copy)]
pub(in crate::bvh) struct Bounds {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl Bounds {
    /// Those of a box, rounded.
    pub(in crate::bvh) fn of((low, high): (DVec3, DVec3)) -> Self {
        Self { low: low.as_vec3().to_array(), high: high.as_vec3().to_array() }
    }

    pub(super) const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    #[inline(always)]
    pub(super) fn include(&mut self, other: &Self) {
        for k in 0..3 {
            // Plain comparisons compile to one instruction each; `f32::min` also orders NaN, which
            // cannot occur here.
            self.low[k] = if other.low[k] < self.low[k] { other.low[k] } else { self.low[k] };
            self.high[k] = if other.high[k] > self.high[k] { other.high[k] } else { self.high[k] };
        }
    }
}

/// Node of the binary tree: an inner node with two children, or a leaf with one item.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinaryNode {
    /// First child, or [`NO_CHILD`].
    pub left: u32,
    /// Second child; of a leaf: its item.
    pub right_or_item: u32,
    /// [`BoxMeasure`] of the node's box, relative to the root's.
    pub weight: f32,
}

impl BinaryNode {
    /// Whether the node holds one item and no children.
    pub(super) fn is_leaf(&self) -> bool {
        self.left == NO_CHILD
    }
}

/// Run of items that has to become a subtree, with memory for its sweeps.
struct Run<'a> {
    /// Its items by the centre on each axis.
    orders: [&'a mut [u32]; 3],
    partition_scratch: &'a mut [u32],
    suffix_cost: &'a mut [f32],
    depth: u32,
}

/// Best position to cut a run: on `axis`, before item number `position` of that axis's order.
struct Split {
    axis: usize,
    position: usize,
    cost: f32,
}

/// Items and how they are weighed.
struct Items {
    bounds: Vec<Bounds>,
    measure: BoxMeasure,
    /// Weight of a node whose measure is 1.
    scale: f32,
    depth_limit: u32,
    /// Whether an item goes to the left part of the run being divided. Atomic, because runs of
    /// other threads write other items.
    goes_left: Vec<AtomicBool>,
}

/// Least items of a run whose two subtrees are built in parallel.
const MIN_PARALLEL_ITEMS: usize = 1 << 12;

/// Binary tree over `bounds` with one item per leaf; node 0 is the root and children come after
/// their parent. No node is deeper than `2 log2(n) + 16`: where the heuristic would go deeper, runs
/// are halved.
///
/// `extent_weight` is the weight of the summed extents relative to the diagonal of all items. Empty
/// input gives no nodes. Cost: O(n log n), on all threads; the tree is the same on any number of
/// them.
pub(super) fn binary_tree(bounds: &[(DVec3, DVec3)], extent_weight: f32) -> Vec<BinaryNode> {
    if bounds.is_empty() {
        return Vec::new();
    }
    let rounded = bounds.iter().map(|&of| Bounds::of(of)).collect();
    let mut items = Items::new(rounded, extent_weight);
    let [x, y, z] = &mut items.orders();
    let root_weight = items.weigh(x);
    items.scale = if root_weight > 0.0 { 1.0 / root_weight } else { 1.0 };
    let mut nodes = Vec::with_capacity(bounds.len() * 2 - 1);
    nodes.push(BinaryNode {
        left: NO_CHILD,
        right_or_item: x[0],
        weight: root_weight * items.scale,
    });
    let run = Run {
        orders: [x, y, z],
        partition_scratch: &mut vec![0; bounds.len()],
        suffix_cost: &mut vec![0.0; bounds.len()],
        depth: 0,
    };
    items.grow(run, 0, &mut nodes);
    nodes
}

/// The runs of at most `most` items at which the descent of [`binary_tree`] first arrives, from
/// first to last. None is empty.
pub(in crate::bvh) fn runs(bounds: Vec<Bounds>, extent_weight: f32, most: usize) -> Vec<Vec<u32>> {
    if bounds.is_empty() {
        return Vec::new();
    }
    let items = Items::new(bounds, extent_weight);
    let count = items.bounds.len();
    let [x, y, z] = &mut items.orders();
    let run = Run {
        orders: [x, y, z],
        partition_scratch: &mut vec![0; count],
        suffix_cost: &mut vec![0.0; count],
        depth: 0,
    };
    let mut runs = Vec::new();
    items.gather(run, most.max(1), &mut runs);
    runs
}

impl Items {
    fn new(bounds: Vec<Bounds>, extent_weight: f32) -> Self {
        let mut all = Bounds::EMPTY;
        bounds.iter().for_each(|b| all.include(b));
        let diagonal = (0..3)
            .map(|k| (all.high[k] - all.low[k]) * (all.high[k] - all.low[k]))
            .sum::<f32>()
            .sqrt();
        Self {
            measure: BoxMeasure { extent_weight: extent_weight * diagonal },
            scale: 1.0,
            depth_limit: 2 * bounds.len().ilog2() + 16,
            goes_left: bounds.iter().map(|_| AtomicBool::new(false)).collect(),
            bounds,
        }
    }

    /// The items by the centre on each axis.
    fn orders(&self) -> [Vec<u32>; 3] {
        let mut orders = [0, 1, 2].map(|_| Vec::new());
        orders.par_iter_mut().enumerate().for_each(|(axis, order)| *order = self.order(axis));
        orders
    }

    /// The items by the centre on an axis, equal ones by number.
    fn order(&self, axis: usize) -> Vec<u32> {
        let centre = |of: &Bounds| of.low[axis] + of.high[axis];
        let mut keyed: Vec<(f32, u32)> = self.bounds.iter().map(centre).zip(0..).collect();
        keyed.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        keyed.into_iter().map(|(_, item)| item).collect()
    }

    fn weigh(&self, items: &[u32]) -> f32 {
        let mut all = Bounds::EMPTY;
        items.iter().for_each(|&item| all.include(&self.bounds[item as usize]));
        self.measure.of(&all) * self.scale
    }

    /// Adds the descendants of node `at`, which holds a run: its children, then all below the
    /// second, then all below the first.
    fn grow(&self, run: Run<'_>, at: usize, nodes: &mut Vec<BinaryNode>) {
        let count = run.orders[0].len();
        if count == 1 {
            nodes[at].right_or_item = run.orders[0][0];
            return;
        }
        let halves = self.divide(run);
        let left = nodes.len();
        nodes[at].left = left as u32;
        nodes[at].right_or_item = left as u32 + 1;
        nodes.extend(halves.each_ref().map(|half| BinaryNode {
            left: NO_CHILD,
            right_or_item: 0,
            weight: self.weigh(half.orders[0]),
        }));
        let [first, second] = halves;
        if count < MIN_PARALLEL_ITEMS {
            self.grow(second, left + 1, nodes);
            self.grow(first, left, nodes);
            return;
        }
        // Subtrees of their own, whose roots are the two children.
        let grown = |run: Run<'_>, root: BinaryNode| {
            let mut nodes = Vec::with_capacity(2 * run.orders[0].len() - 1);
            nodes.push(root);
            self.grow(run, 0, &mut nodes);
            nodes
        };
        let roots = [nodes[left], nodes[left + 1]];
        let (second, first) = rayon::join(|| grown(second, roots[1]), || grown(first, roots[0]));
        for (root, subtree) in [(left + 1, second), (left, first)] {
            // Node 1 of the subtree comes to the end.
            let by = nodes.len() as u32 - 1;
            let mut moved = subtree.iter().map(|node| match node.is_leaf() {
                true => *node,
                false => BinaryNode {
                    left: node.left + by,
                    right_or_item: node.right_or_item + by,
                    ..*node
                },
            });
            nodes[root] = moved.next().expect("a subtree has a root");
            nodes.extend(moved);
        }
    }

    /// Adds the runs of at most `most` items that a run is divided into.
    fn gather(&self, run: Run<'_>, most: usize, runs: &mut Vec<Vec<u32>>) {
        let count = run.orders[0].len();
        if count <= most {
            runs.push(run.orders[0].to_vec());
            return;
        }
        let [first, second] = self.divide(run);
        if count < MIN_PARALLEL_ITEMS {
            self.gather(first, most, runs);
            self.gather(second, most, runs);
            return;
        }
        let mut others = Vec::new();
        rayon::join(|| self.gather(first, most, runs), || self.gather(second, most, &mut others));
        runs.append(&mut others);
    }

    /// Splits a run in two; the orders of both parts stay sorted.
    fn divide<'a>(&self, run: Run<'a>) -> [Run<'a>; 2] {
        let Run { orders, partition_scratch, suffix_cost, depth } = run;
        let count = orders[0].len();
        let must_halve = depth + count.ilog2() + 1 >= self.depth_limit;
        let mut best = Split { axis: 0, position: count / 2, cost: f32::INFINITY };
        for (axis, order) in orders.iter().enumerate() {
            self.sweep(axis, order, suffix_cost, must_halve, &mut best);
        }
        for (rank, &item) in orders[best.axis].iter().enumerate() {
            self.goes_left[item as usize].store(rank < best.position, Ordering::Relaxed);
        }
        for axis in (0..3).filter(|&axis| axis != best.axis) {
            let order = &mut *orders[axis];
            let (mut left_count, mut right_count) = (0, 0);
            // Both writes happen each time, only the counters differ: no branch to mispredict.
            for rank in 0..count {
                let item = order[rank];
                let left = self.goes_left[item as usize].load(Ordering::Relaxed);
                order[left_count] = item;
                partition_scratch[right_count] = item;
                left_count += usize::from(left);
                right_count += usize::from(!left);
            }
            order[left_count..].copy_from_slice(&partition_scratch[..right_count]);
        }
        let [x, y, z] = orders.map(|order| order.split_at_mut(best.position));
        let (partition_scratch, suffix_cost) = (
            partition_scratch.split_at_mut(best.position),
            suffix_cost.split_at_mut(best.position),
        );
        let depth = depth + 1;
        [
            Run {
                orders: [x.0, y.0, z.0],
                partition_scratch: partition_scratch.0,
                suffix_cost: suffix_cost.0,
                depth,
            },
            Run {
                orders: [x.1, y.1, z.1],
                partition_scratch: partition_scratch.1,
                suffix_cost: suffix_cost.1,
                depth,
            },
        ]
    }

    /// Improves `best` by the cuts on one axis: all, or only the one in the middle.
    fn sweep(
        &self,
        axis: usize,
        order: &[u32],
        suffix_cost: &mut [f32],
        only_middle: bool,
        best: &mut Split,
    ) {
        let count = order.len();
        let mut run = Bounds::EMPTY;
        for position in (1..count).rev() {
            run.include(&self.bounds[order[position] as usize]);
            suffix_cost[position] = self.measure.of(&run) * (count - position) as f32;
        }
        let mut run = Bounds::EMPTY;
        for position in 1..count {
            run.include(&self.bounds[order[position - 1] as usize]);
            if only_middle && position != count / 2 {
                continue;
            }
            let cost = self.measure.of(&run) * position as f32 + suffix_cost[position];
            // Equal costs (equal or degenerate items) go to the cut nearest the middle, so that
            // such trees are balanced.
            let closer = || position.abs_diff(count / 2) < best.position.abs_diff(count / 2);
            if cost < best.cost || (cost == best.cost && closer()) {
                *best = Split { axis, position, cost };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(nodes: &[BinaryNode]) -> usize {
        let mut depths = vec![0; nodes.len()];
        for (index, node) in nodes.iter().enumerate().filter(|(_, node)| !node.is_leaf()) {
            assert!(node.left as usize > index && node.right_or_item as usize > index);
            depths[node.left as usize] = depths[index] + 1;
            depths[node.right_or_item as usize] = depths[index] + 1;
        }
        depths.into_iter().max().unwrap_or(0)
    }

    fn assert_holds_each_item_once(nodes: &[BinaryNode], count: usize) {
        let mut items: Vec<u32> =
            nodes.iter().filter(|n| n.is_leaf()).map(|n| n.right_or_item).collect();
        items.sort_unstable();
        assert_eq!(items, (0..count as u32).collect::<Vec<_>>());
    }

    #[test]
    fn equal_items_make_a_balanced_tree() {
        let nodes = binary_tree(&vec![(DVec3::ONE, DVec3::ONE); 4096], 0.1);
        assert_holds_each_item_once(&nodes, 4096);
        assert_eq!(depth(&nodes), 12);
    }

    #[test]
    fn growing_items_do_not_make_a_chain() {
        let bounds: Vec<_> = (0..60)
            .map(|i| (DVec3::splat(2f64.powi(i) * 1e-13), DVec3::splat(2f64.powi(i) * 1.1e-13)))
            .collect();
        let nodes = binary_tree(&bounds, 0.1);
        assert_holds_each_item_once(&nodes, 60);
        assert!(depth(&nodes) <= 2 * 5 + 16);
    }

    #[test]
    fn separate_clusters_are_separated_first() {
        let bounds: Vec<_> = (0..10)
            .map(|i| {
                let low = DVec3::new(
                    f64::from(i) + if i < 3 { 0.0 } else { 1000.0 },
                    f64::from(i % 3),
                    0.0,
                );
                (low, low + DVec3::ONE)
            })
            .collect();
        let nodes = binary_tree(&bounds, 0.0);
        let mut left_items = Vec::new();
        let mut open = vec![nodes[0].left];
        while let Some(index) = open.pop() {
            let node = nodes[index as usize];
            if node.is_leaf() {
                left_items.push(node.right_or_item);
            } else {
                open.extend([node.left, node.right_or_item]);
            }
        }
        left_items.sort_unstable();
        assert_eq!(left_items, [0, 1, 2]);
    }
}
