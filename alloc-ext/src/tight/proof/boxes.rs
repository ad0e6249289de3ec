//! A static tree of boxes, for local queries on what does not move.

use crate::mesh::Enclosure;
use glam::{DVec3, Vec3};

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl Bounds {
    pub const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    pub fn of(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &p| bounds.with(p))
    }

    /// Of a closed part.
    pub fn around(part: &Enclosure) -> Self {
        let [low, high] = [part.low, part.high].map(|p| Vec3::from(p).as_dvec3());
        Self { low, high }
    }

    pub fn with(self, p: DVec3) -> Self {
        Self { low: self.low.min(p), high: self.high.max(p) }
    }

    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Larger by a distance on all sides, up to rounding.
    pub fn grown(self, distance: f64) -> Self {
        Self { low: self.low - distance, high: self.high + distance }
    }

    pub fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    /// Square of a distance that no point of the box is nearer than, up to rounding.
    pub fn distance_sq(&self, p: DVec3) -> f64 {
        (self.low - p).max(p - self.high).max(DVec3::ZERO).length_squared()
    }

    /// Largest `normal · p` over the box.
    pub fn support(&self, normal: DVec3) -> f64 {
        let pick = |n: f64, low: f64, high: f64| n * if n > 0.0 { high } else { low };
        pick(normal.x, self.low.x, self.high.x)
            + pick(normal.y, self.low.y, self.high.y)
            + pick(normal.z, self.low.z, self.high.z)
    }
}

#[derive(Clone, Debug)]
struct Node {
    bounds: Bounds,
    /// Left child, the right one being next to it; or the first item of a leaf.
    first: u32,
    /// Items of a leaf; 0 for a node with children.
    count: u32,
}

/// A binary tree, halved at the median of the longest axis.
#[derive(Clone, Debug)]
pub(crate) struct BoxTree {
    nodes: Vec<Node>,
}

/// Items of a leaf: where testing one more box costs what testing them does.
const LEAF: usize = 4;

/// A tree of 2^32 items, halved each time, is no deeper; one entry waits at each depth.
const DEPTH: usize = 40;

impl BoxTree {
    /// The tree, and the order that it wants its items in.
    pub fn new(boxes: &[Bounds]) -> (Self, Vec<u32>) {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![Node { bounds: Bounds::EMPTY, first: 0, count: 0 }];
        let mut open = vec![(0usize, 0usize, boxes.len())];
        while let Some((node, from, to)) = open.pop() {
            let items = &mut order[from..to];
            let bounds = items.iter().fold(Bounds::EMPTY, |all, &i| all.join(boxes[i as usize]));
            nodes[node].bounds = bounds;
            if items.len() <= LEAF {
                (nodes[node].first, nodes[node].count) = (from as u32, items.len() as u32);
                continue;
            }
            let centre = |i: u32| boxes[i as usize].low + boxes[i as usize].high;
            let spread = items.iter().fold(Bounds::EMPTY, |all, &i| all.with(centre(i)));
            let extent = spread.high - spread.low;
            let axis = if extent.x >= extent.y && extent.x >= extent.z {
                0
            } else if extent.y >= extent.z {
                1
            } else {
                2
            };
            let middle = items.len() / 2;
            items.select_nth_unstable_by(middle, |&i, &j| {
                centre(i)[axis].total_cmp(&centre(j)[axis]).then(i.cmp(&j))
            });
            let left = nodes.len();
            nodes[node].first = left as u32;
            let empty = Node { bounds: Bounds::EMPTY, first: 0, count: 0 };
            nodes.extend([empty.clone(), empty]);
            open.push((left + 1, from + middle, to));
            open.push((left, from, from + middle));
        }
        (Self { nodes }, order)
    }

    /// Calls `visit` with every item (by its place in the tree's order) of every leaf whose box and
    /// whose ancestors' boxes pass `keep`, until it returns false.
    #[inline]
    pub fn visit(&self, keep: impl Fn(&Bounds) -> bool, mut visit: impl FnMut(usize) -> bool) {
        let mut stack = [0u32; DEPTH];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let node = &self.nodes[stack[height] as usize];
            if !keep(&node.bounds) {
                continue;
            }
            if node.count > 0 {
                for item in node.first..node.first + node.count {
                    if !visit(item as usize) {
                        return;
                    }
                }
            } else if node.first > 0 {
                stack[height] = node.first + 1;
                stack[height + 1] = node.first;
                height += 2;
            }
        }
    }

    /// The item with the least distance, which `distance_sq` gives, and that square; `None` without
    /// items.
    pub fn nearest(
        &self,
        p: DVec3,
        mut distance_sq: impl FnMut(usize) -> f64,
    ) -> Option<(usize, f64)> {
        let mut best = None;
        let mut least = f64::INFINITY;
        let mut stack = [(0u32, 0f64); DEPTH];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (index, bound) = stack[height];
            if bound >= least {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for item in node.first..node.first + node.count {
                    let found = distance_sq(item as usize);
                    if found < least {
                        (least, best) = (found, Some(item as usize));
                    }
                }
            } else if node.first > 0 {
                let children = [node.first, node.first + 1]
                    .map(|child| (child, self.nodes[child as usize].bounds.distance_sq(p)));
                let [near, far] = if children[0].1 <= children[1].1 {
                    children
                } else {
                    [children[1], children[0]]
                };
                stack[height] = far;
                stack[height + 1] = near;
                height += 2;
            }
        }
        best.map(|item| (item, least))
    }
}
