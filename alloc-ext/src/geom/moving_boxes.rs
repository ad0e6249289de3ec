//! Boxes of a surface under collapse: a binary tree that keeps its shape while its boxes change.

use super::bounds::Bounds;
use super::order::spatial_order;
use glam::{DVec3, Vec3};

/// A box in single precision. Rounding never changes the order of two numbers, so boxes that meet
/// still do.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rounded {
    low: Vec3,
    high: Vec3,
}

impl Rounded {
    const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    fn of(Bounds { low, high }: &Bounds) -> Self {
        let rounded = |p: &DVec3| p.as_vec3();
        Self { low: rounded(low), high: rounded(high) }
    }

    fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Boxes by number. They may change, but which boxes are near each other is told by those of the
/// beginning.
#[derive(Clone, Debug)]
pub(crate) struct MovingBoxes {
    /// Node `n` has the nodes `2 n` and `2 n + 1` below it. The second half are the leaves.
    nodes: Vec<Rounded>,
    /// Leaf of each box, and number of the box of each leaf.
    leaf: Vec<u32>,
    item: Vec<u32>,
}

/// Nodes that wait at each of 32 depths.
const DEPTH: usize = 33;

impl MovingBoxes {
    /// Cost: n log n.
    pub fn new(boxes: &[Bounds]) -> Self {
        let leaves = boxes.len().next_power_of_two();
        let mut tree = Self {
            nodes: vec![Rounded::EMPTY; 2 * leaves],
            leaf: vec![0; boxes.len()],
            item: vec![0; leaves],
        };
        for (at, &item) in spatial_order(boxes).iter().enumerate() {
            // Empty leaves lie everywhere, so that halves in space are halves of the tree.
            let leaf = at * leaves / boxes.len();
            tree.leaf[item as usize] = leaf as u32;
            tree.item[leaf] = item;
            tree.nodes[leaves + leaf] = Rounded::of(&boxes[item as usize]);
        }
        for node in (1..leaves).rev() {
            tree.nodes[node] = tree.nodes[2 * node].join(tree.nodes[2 * node + 1]);
        }
        tree
    }

    /// Changes a box; [`Bounds::EMPTY`] meets none.
    pub fn set(&mut self, item: u32, bounds: &Bounds) {
        let mut node = self.item.len() + self.leaf[item as usize] as usize;
        self.nodes[node] = Rounded::of(bounds);
        while node > 1 {
            node /= 2;
            let joined = self.nodes[2 * node].join(self.nodes[2 * node + 1]);
            if std::mem::replace(&mut self.nodes[node], joined) == joined {
                break;
            }
        }
    }

    /// Calls `visit` with every box that meets `bounds`, and perhaps with others that are next to
    /// it, until it returns false; whether it never did.
    pub fn visit_meeting(&self, bounds: &Bounds, mut visit: impl FnMut(u32) -> bool) -> bool {
        let bounds = Rounded::of(bounds);
        let mut stack = [1; DEPTH];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let node = stack[height];
            if !self.nodes[node].meets(&bounds) {
                continue;
            }
            if let Some(leaf) = node.checked_sub(self.item.len()) {
                if !visit(self.item[leaf]) {
                    return false;
                }
            } else {
                stack[height] = 2 * node + 1;
                stack[height + 1] = 2 * node;
                height += 2;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;

    #[test]
    fn every_box_that_meets_is_visited_once_wherever_boxes_have_moved() {
        let mut dice = SplitMix::new(7);
        let mut any = |size: f64| {
            let low = dice.point(DVec3::ZERO, DVec3::splat(10.0));
            Bounds { low, high: low + dice.point(DVec3::ZERO, DVec3::splat(size)) }
        };
        for count in [0, 1, 2, 5, 300] {
            let mut boxes: Vec<Bounds> = (0..count).map(|_| any(1.0)).collect();
            let mut tree = MovingBoxes::new(&boxes);
            for round in 0..count {
                let moved = if round % 3 == 0 { Bounds::EMPTY } else { any(3.0) };
                tree.set(round as u32, &moved);
                boxes[round] = moved;
                let of = any(4.0);
                let mut visits = vec![0; count];
                tree.visit_meeting(&of, |i| {
                    visits[i as usize] += 1;
                    true
                });
                for (visits, b) in visits.iter().zip(&boxes) {
                    assert!(*visits == 1 || *visits == 0 && !b.meets(&of));
                }
            }
        }
    }
}
