//! The static tree of boxes behind all searches of the builder: eight boxes a node, in single
//! precision. It passes over what a search cannot need. The searches test the items that are left.
//!
//! Its frame has its origin in the middle of all boxes and half their longest side as unit. So
//! every number in it is at most 1, and the bounds of rounding are numbers: see [`SLACK`].

use super::bounds::{Bounds, Plane};
use super::disks::Disks;
use super::lane_corners::{Cut, LaneCorners};
use super::order::{Placed, WIDTH, ranges};
use arrayvec::ArrayVec;
use glam::DVec3;
use rayon::prelude::*;
use wide::f32x8;

/// Distance in the tree's frame by which a box may lie below a plane, or off another box, and still
/// count as reaching it.
///
/// Coordinates of at most 1 are rounded to 2^-25, and so are extents and the plane's normal. The
/// three products and their sums add less than eight such steps of numbers below 3. All is less
/// than 40 · 2^-25 = 1.2e-6.
const SLACK: f64 = 2e-6;

/// An item among the entries of a node.
const ITEM: u32 = 1 << 31;

/// A leaf with corners among the entries of a node. Without this and [`ITEM`], an entry is the
/// number of a node.
const LEAF: u32 = 1 << 30;

/// Eight boxes by middle and half extent, and the entries in them.
#[derive(Clone, Debug)]
struct Node {
    middle: [[f32; WIDTH]; 3],
    half: [[f32; WIDTH]; 3],
    entry: [u32; WIDTH],
    /// Where the disks of its nodes are; [`NONE`] without disks.
    disks: u32,
}

/// No disks are known.
const NONE: u32 = u32::MAX;

const EMPTY: Node =
    Node { middle: [[0.0; WIDTH]; 3], half: [[-1e30; WIDTH]; 3], entry: [0; WIDTH], disks: NONE };

/// Most items with a disk. Larger parts of a surface are curved.
const MOST_IN_A_DISK: usize = 4096;

/// A static tree of boxes, or of items with so many corners. Items keep their numbers.
#[derive(Clone, Debug)]
pub(crate) struct StaticTree<const CORNERS: usize = 3> {
    nodes: Vec<Node>,
    leaves: Vec<LaneCorners<CORNERS>>,
    disks: Vec<Disks>,
    origin: DVec3,
    /// Units of the tree's frame in one of the mesh.
    scale: f64,
}

/// A box and planes that an item's box has to reach.
#[derive(Clone, Debug)]
pub(crate) struct Probe {
    cuts: ArrayVec<Cut, MOST_CUTS>,
    middle: [f32; 3],
    half: [f32; 3],
}

/// Most planes of a probe: those of the two sides of a triangle and of the walls on its edges.
const MOST_CUTS: usize = 5;

/// Nodes that have everything in some bounds below them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frontier(Vec<u32>);

impl Frontier {
    /// The root: everything.
    pub fn whole() -> Self {
        Self(vec![0])
    }
}

/// Nodes of a frontier, about.
const FRONTIER: usize = 6;

/// Seven entries wait at each of the eleven depths that 2^31 items have.
const DEPTH: usize = 96;

/// Least items of a node whose subtrees grow in parallel.
const LEAST_PARALLEL: usize = 1 << 14;

/// Puts a subtree's root in place of node `root`, and what is below it at the end.
fn adopt(subtree: Vec<Node>, root: usize, nodes: &mut Vec<Node>) {
    // Node 1 of the subtree comes to the end.
    let by = nodes.len() as u32 - 1;
    let mut moved = subtree.into_iter().map(|mut node| {
        let lanes = node.entry.iter_mut().zip(&node.half[0]);
        for (entry, _) in lanes.filter(|(entry, half)| **entry & ITEM == 0 && **half >= 0.0) {
            *entry += by;
        }
        node
    });
    nodes[root] = moved.next().expect("a subtree has a root");
    nodes.extend(moved);
}

impl StaticTree {
    /// Of items with these boxes. Cost: n log n, on all threads; the tree is the same on any number
    /// of them.
    pub fn new(boxes: &[Bounds]) -> Self {
        Self::of_boxes(boxes)
    }
}

impl<const CORNERS: usize> StaticTree<CORNERS> {
    fn of_boxes(boxes: &[Bounds]) -> Self {
        let all = boxes.iter().fold(Bounds::EMPTY, |all, &b| all.join(b));
        let extent = (all.high - all.low).max_element();
        let unit = if extent > 0.0 && extent.is_finite() { 0.5 * extent } else { 1.0 };
        let origin = if boxes.is_empty() { DVec3::ZERO } else { (all.low + all.high) * 0.5 };
        let mut tree = Self {
            nodes: vec![EMPTY],
            leaves: Vec::new(),
            disks: Vec::new(),
            origin,
            scale: 1.0 / unit,
        };
        let mut nodes = std::mem::take(&mut tree.nodes);
        tree.grow(boxes, &mut Placed::all(boxes), 0, &mut nodes);
        tree.nodes = nodes;
        tree
    }

    /// Fills node `at` with items and adds those below it: its children, then all below the last
    /// child, and so on up to the first. The box of all items.
    fn grow(
        &self,
        boxes: &[Bounds],
        items: &mut [Placed],
        at: usize,
        nodes: &mut Vec<Node>,
    ) -> Bounds {
        let is_large = items.len() >= LEAST_PARALLEL;
        let ranges = ranges(items);
        let mut below: ArrayVec<(usize, (usize, usize)), WIDTH> = ArrayVec::new();
        for (lane, &(from, to)) in ranges.iter().enumerate() {
            nodes[at].entry[lane] = if to - from == 1 {
                items[from].item | ITEM
            } else {
                nodes.push(EMPTY);
                below.push((lane, (from, to)));
                nodes.len() as u32 - 1
            };
        }
        let mut bounds = [Bounds::EMPTY; WIDTH];
        for (lane, &(from, to)) in ranges.iter().enumerate() {
            if to - from == 1 {
                bounds[lane] = boxes[items[from].item as usize];
            }
        }
        below.reverse();
        if is_large {
            let grown = self.grow_apart(boxes, items, &below);
            for ((lane, _), (bounds_of, subtree)) in below.into_iter().zip(grown) {
                bounds[lane] = bounds_of;
                let root = nodes[at].entry[lane] as usize;
                adopt(subtree, root, nodes);
            }
        } else {
            for (lane, (from, to)) in below {
                let root = nodes[at].entry[lane] as usize;
                bounds[lane] = self.grow(boxes, &mut items[from..to], root, nodes);
            }
        }
        for (lane, bounds) in bounds[..ranges.len()].iter().enumerate() {
            let (middle, half) = self.local(bounds);
            for axis in 0..3 {
                nodes[at].middle[axis][lane] = middle[axis];
                nodes[at].half[axis][lane] = half[axis];
            }
        }
        bounds.iter().fold(Bounds::EMPTY, |all, &b| all.join(b))
    }

    /// Subtrees of parts of items, on all threads.
    fn grow_apart(
        &self,
        boxes: &[Bounds],
        items: &mut [Placed],
        parts: &[(usize, (usize, usize))],
    ) -> Vec<(Bounds, Vec<Node>)> {
        let mut order: Vec<usize> = (0..parts.len()).collect();
        order.sort_unstable_by_key(|&part| parts[part].1);
        let mut slices = Vec::with_capacity(parts.len());
        let (mut rest, mut start) = (items, 0);
        for part in order {
            let (from, to) = parts[part].1;
            let (_, after) = rest.split_at_mut(from - start);
            let (slice, after) = after.split_at_mut(to - from);
            slices.push((part, slice));
            (rest, start) = (after, to);
        }
        slices.sort_unstable_by_key(|&(part, _)| part);
        let grown = slices.into_par_iter().with_max_len(1).map(|(_, items)| {
            let mut nodes = vec![EMPTY];
            let bounds = self.grow(boxes, items, 0, &mut nodes);
            (bounds, nodes)
        });
        grown.collect()
    }

    /// Of triangles or points. Planes then pass over items by their corners, and not only by their
    /// boxes.
    pub fn of_corners(items: &[[DVec3; CORNERS]]) -> Self {
        let boxes: Vec<Bounds> = items.iter().map(|corners| Bounds::of(corners)).collect();
        let mut tree = Self::of_boxes(&boxes);
        let (origin, scale) = (tree.origin, tree.scale);
        // What stands for each node among the entries.
        let mut names: Vec<u32> = (0..tree.nodes.len() as u32).collect();
        for (name, node) in names.iter_mut().zip(&tree.nodes).skip(1) {
            let is_item = |lane: usize| node.entry[lane] & ITEM != 0;
            if !(0..WIDTH).all(|lane| is_item(lane) || node.half[0][lane] < 0.0) {
                continue;
            }
            let mut leaf = LaneCorners::new(*name, node.entry);
            for lane in (0..WIDTH).filter(|&lane| is_item(lane)) {
                let corners = items[(node.entry[lane] ^ ITEM) as usize];
                leaf.set(lane, corners.map(|p| ((p - origin) * scale).as_vec3()));
            }
            *name = LEAF | tree.leaves.len() as u32;
            tree.leaves.push(leaf);
        }
        for entry in tree.nodes.iter_mut().flat_map(|node| &mut node.entry) {
            if *entry & ITEM == 0 {
                *entry = names[*entry as usize];
            }
        }
        tree
    }

    /// With disks about its nodes. `normal` is that of an item, and `corners` gives points that
    /// hold an item between them. Cost: n log n.
    pub fn with_disks(
        mut self,
        normal: impl Fn(usize) -> DVec3,
        corners: impl Fn(usize, &mut Vec<DVec3>),
    ) -> Self {
        let (mut open, mut items, mut points) = (Vec::new(), Vec::new(), Vec::new());
        for index in 0..self.nodes.len() {
            let mut disks = None;
            for lane in 0..WIDTH {
                let node = &self.nodes[index];
                let entry = node.entry[lane];
                if entry & ITEM != 0 || node.half[0][lane] < 0.0 {
                    continue;
                }
                let middle = DVec3::from(node.middle.map(|axis| f64::from(axis[lane])));
                self.items_below(entry, &mut open, &mut items);
                if items.len() > MOST_IN_A_DISK {
                    continue;
                }
                points.clear();
                items.iter().for_each(|&item| corners(item, &mut points));
                points.iter_mut().for_each(|p| *p = (*p - self.origin) * self.scale);
                let normal = items.iter().map(|&item| normal(item)).sum();
                disks.get_or_insert_with(Disks::default).set(lane, middle, normal, &points);
            }
            if let Some(disks) = disks {
                self.nodes[index].disks = self.disks.len() as u32;
                self.disks.push(disks);
            }
        }
        self
    }

    /// Numbers the items anew, as they lie in the tree, and returns their old numbers. Searches
    /// visit them as before.
    pub fn renumber(&mut self) -> Vec<u32> {
        let mut old = Vec::new();
        let entries = self.nodes.iter_mut().flat_map(|node| &mut node.entry);
        for entry in entries.filter(|entry| **entry & ITEM != 0) {
            old.push(*entry ^ ITEM);
            *entry = (old.len() - 1) as u32 | ITEM;
        }
        for leaf in &mut self.leaves {
            leaf.entry = self.nodes[leaf.node as usize].entry;
        }
        old
    }

    /// The items below an entry that is no item, but no more than those of a disk and a node's.
    fn items_below(&self, entry: u32, open: &mut Vec<u32>, items: &mut Vec<usize>) {
        open.clear();
        items.clear();
        open.push(entry);
        while let Some(entry) = open.pop().filter(|_| items.len() <= MOST_IN_A_DISK) {
            let node = self.node(entry);
            for lane in (0..WIDTH).filter(|&lane| node.half[0][lane] >= 0.0) {
                match node.entry[lane] {
                    item if item & ITEM != 0 => items.push((item ^ ITEM) as usize),
                    below => open.push(below),
                }
            }
        }
    }

    /// Middle and half extent in the tree's frame.
    fn local(&self, bounds: &Bounds) -> ([f32; 3], [f32; 3]) {
        // Beyond 4 it is beyond everything.
        let local = |p: DVec3| {
            ((p - self.origin) * self.scale).clamp(DVec3::splat(-4.0), DVec3::splat(4.0))
        };
        let (low, high) = (local(bounds.low), local(bounds.high));
        (((low + high) * 0.5).as_vec3().to_array(), ((high - low) * 0.5).as_vec3().to_array())
    }

    fn in_mesh_frame(&self, node: &Node, lane: usize) -> Bounds {
        let of = |axes: &[[f32; WIDTH]; 3]| DVec3::from(axes.map(|axis| f64::from(axis[lane])));
        let (middle, half) = (of(&node.middle), of(&node.half) + SLACK);
        Bounds {
            low: self.origin + (middle - half) / self.scale,
            high: self.origin + (middle + half) / self.scale,
        }
    }

    /// A probe of a box and at most [`MOST_CUTS`] planes, whose normals are unit vectors.
    pub fn probe(&self, bounds: &Bounds, planes: &[Plane]) -> Probe {
        let (middle, half) = self.local(bounds);
        let half = half.map(|h| h + SLACK as f32);
        Probe { cuts: planes.iter().map(|plane| self.cut(plane)).collect(), middle, half }
    }

    fn cut(&self, plane: &Plane) -> Cut {
        let normal = plane.normal.as_vec3().to_array();
        let offset = (plane.offset - plane.normal.dot(self.origin)) * self.scale - SLACK;
        Cut { normal, along: normal.map(f32::abs), offset: offset as f32 }
    }

    /// Puts a plane into a probe, in place of its first.
    pub fn raise(&self, probe: &mut Probe, plane: &Plane) {
        let cut = self.cut(plane);
        match probe.cuts.first_mut() {
            Some(first) => *first = cut,
            None => probe.cuts.push(cut),
        }
    }

    /// The node of an entry that is no item.
    fn node(&self, entry: u32) -> &Node {
        let node =
            if entry & LEAF == 0 { entry } else { self.leaves[(entry ^ LEAF) as usize].node };
        &self.nodes[node as usize]
    }

    /// The lanes of a node or leaf that a probe reaches, one bit each, and its entries.
    #[inline]
    fn reached(&self, probe: &Probe, entry: u32) -> (u32, &[u32; WIDTH]) {
        if entry & LEAF == 0 {
            let node = &self.nodes[entry as usize];
            (probe.hits(node, &probe.cuts, self.disks.get(node.disks as usize)), &node.entry)
        } else {
            let leaf = &self.leaves[(entry ^ LEAF) as usize];
            (leaf.reached(&probe.cuts, probe.middle, probe.half), &leaf.entry)
        }
    }

    /// Some nodes that hold every item whose box meets `bounds`. Many searches in these bounds may
    /// begin there.
    pub fn frontier(&self, bounds: &Bounds, frontier: &mut Frontier) {
        let probe = self.probe(bounds, &[]);
        let open = &mut frontier.0;
        open.clear();
        open.push(0);
        let mut next = 0;
        while let Some(&index) = open.get(next) {
            let node = self.node(index);
            let hits = probe.hits(node, &[], None);
            let mut inner: ArrayVec<u32, WIDTH> = ArrayVec::new();
            let mut has_items = false;
            for lane in (0..WIDTH).filter(|lane| hits >> lane & 1 != 0) {
                has_items |= node.entry[lane] & ITEM != 0;
                inner.push(node.entry[lane]);
            }
            if has_items || open.len() + inner.len() > FRONTIER {
                next += 1;
            } else {
                open.swap_remove(next);
                open.extend(inner);
            }
        }
    }

    /// Calls `item` with the items below nodes whose boxes pass, until it returns false; whether it
    /// never did. `lanes` gives the lanes of a node or leaf that pass, one bit each, and its
    /// entries. `state` belongs to both.
    #[inline]
    fn visit<'t, S>(
        &'t self,
        near: &[u32],
        state: &mut S,
        lanes: impl Fn(&S, u32) -> (u32, &'t [u32; WIDTH]),
        mut item: impl FnMut(&mut S, usize) -> bool,
    ) -> bool {
        let mut stack = [0u32; DEPTH];
        for &root in near {
            stack[0] = root;
            let mut height = 1;
            while height > 0 {
                height -= 1;
                let (mut lanes, entries) = lanes(state, stack[height]);
                while lanes != 0 {
                    let entry = entries[lanes.trailing_zeros() as usize];
                    lanes &= lanes - 1;
                    if entry & ITEM == 0 {
                        stack[height] = entry;
                        height += 1;
                    } else if !item(state, (entry ^ ITEM) as usize) {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Calls `visit` with every item whose box meets `bounds`, and perhaps with others that are
    /// next to it, until it returns false; whether it never did.
    pub fn visit_meeting(&self, bounds: &Bounds, visit: impl FnMut(usize) -> bool) -> bool {
        self.visit_reached(bounds, &[], visit)
    }

    /// As [`visit_meeting`](Self::visit_meeting), with the items whose boxes also reach planes.
    pub fn visit_reached(
        &self,
        bounds: &Bounds,
        planes: &[Plane],
        mut visit: impl FnMut(usize) -> bool,
    ) -> bool {
        let mut probe = self.probe(bounds, planes);
        let lanes = |probe: &Probe, entry| self.reached(probe, entry);
        self.visit(&[0], &mut probe, lanes, |_, item| visit(item))
    }

    /// Calls `visit` with every item whose box, and whose ancestors' boxes, pass `keep`, and
    /// perhaps with others, until it returns false; whether it never did. `keep` sees boxes in the
    /// mesh's frame, larger by rounding.
    #[inline]
    pub fn visit_kept(
        &self,
        near: &Frontier,
        keep: impl Fn(&Bounds) -> bool,
        mut visit: impl FnMut(usize) -> bool,
    ) -> bool {
        let lanes = |_: &(), entry: u32| {
            let node = self.node(entry);
            let lanes = (0..WIDTH).fold(0, |lanes, lane| {
                let passes = node.half[0][lane] >= 0.0 && keep(&self.in_mesh_frame(node, lane));
                lanes | u32::from(passes) << lane
            });
            (lanes, &node.entry)
        };
        self.visit(&near.0, &mut (), lanes, |(), item| visit(item))
    }

    /// Calls `visit` with every item below a frontier whose box a probe reaches. The plane that it
    /// returns is [raised](Self::raise) in the probe.
    #[inline]
    pub fn visit_raising(
        &self,
        near: &Frontier,
        mut probe: Probe,
        mut visit: impl FnMut(usize) -> Option<Plane>,
    ) {
        let lanes = |probe: &Probe, entry| self.reached(probe, entry);
        self.visit(&near.0, &mut probe, lanes, |probe, item| {
            if let Some(plane) = visit(item) {
                self.raise(probe, &plane);
            }
            true
        });
    }

    /// The item of the least squared distance, as `distance_sq` gives it, and that square; the
    /// least number of equals. `None` without items.
    ///
    /// `distance_sq` must not be below the squared distance from `p` to the item's box.
    pub fn nearest(
        &self,
        p: DVec3,
        mut distance_sq: impl FnMut(usize) -> f64,
    ) -> Option<(usize, f64)> {
        let local = (p - self.origin) * self.scale;
        // Factor by which no rounding exceeds a bound.
        let to_mesh = (1.0 - 1e-12) / (self.scale * self.scale);
        let mut best: Option<(usize, f64)> = None;
        let least = |best: &Option<(usize, f64)>| best.map_or(f64::INFINITY, |(_, least)| least);
        let mut stack: ArrayVec<(u32, f64), DEPTH> = ArrayVec::new();
        stack.push((0, 0.0));
        while let Some((entry, bound)) = stack.pop() {
            if bound > least(&best) {
                continue;
            }
            if entry & ITEM != 0 {
                let item = (entry ^ ITEM) as usize;
                let found = distance_sq(item);
                let is_better = |&(other, least): &(usize, f64)| {
                    found < least || (found == least && item < other)
                };
                if best.as_ref().is_none_or(is_better) && found < f64::INFINITY {
                    best = Some((item, found));
                }
                continue;
            }
            let node = self.node(entry);
            let mut near: ArrayVec<(u32, f64), WIDTH> = ArrayVec::new();
            let bounds = node.distances_sq(local);
            for lane in (0..WIDTH).filter(|&lane| node.half[0][lane] >= 0.0) {
                let bound = bounds[lane] * to_mesh;
                if bound <= least(&best) {
                    near.push((node.entry[lane], bound));
                }
            }
            // The nearest is looked at first.
            near.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(b.0.cmp(&a.0)));
            stack.extend(near);
        }
        best
    }
}

impl Node {
    /// For each lane the square of a distance, in the tree's frame, that no point of its box is
    /// nearer than.
    fn distances_sq(&self, p: DVec3) -> [f64; WIDTH] {
        let mut sum = [0.0; WIDTH];
        for (axis, p) in p.to_array().into_iter().enumerate() {
            for (lane, sum) in sum.iter_mut().enumerate() {
                let off = (f64::from(self.middle[axis][lane]) - p).abs()
                    - f64::from(self.half[axis][lane])
                    - SLACK;
                let off = if off > 0.0 { off } else { 0.0 };
                *sum += off * off;
            }
        }
        sum
    }
}

impl Probe {
    /// The lanes whose boxes meet the probe's box and reach planes, one bit each.
    #[inline]
    fn hits(&self, node: &Node, cuts: &[Cut], disks: Option<&Disks>) -> u32 {
        let middle = node.middle.map(f32x8::from);
        let half = node.half.map(f32x8::from);
        let [x, y, z] = [0, 1, 2].map(|axis| {
            (middle[axis] - f32x8::splat(self.middle[axis])).abs()
                - half[axis]
                - f32x8::splat(self.half[axis])
        });
        let mut out = x.fast_max(y).fast_max(z);
        // On the first plane, which is the one next to the surface.
        let mut at_first = f32x8::ZERO;
        for (number, cut) in cuts.iter().enumerate() {
            let [x, y, z] = cut.normal.map(f32x8::splat);
            let [along_x, along_y, along_z] = cut.along.map(f32x8::splat);
            let at_middle = x * middle[0] + y * middle[1] + z * middle[2];
            let reach = at_middle + along_x * half[0] + along_y * half[1] + along_z * half[2];
            out = out.fast_max(f32x8::splat(cut.offset) - reach);
            if number == 0 {
                at_first = at_middle;
            }
        }
        let lanes = out.simd_le(f32x8::ZERO).to_bitmask();
        // Disks lie elsewhere in memory. They are read if a box is left.
        let (Some(disks), Some(cut), true) = (disks, cuts.first(), lanes != 0) else {
            return lanes;
        };
        lanes & disks.reach(cut, at_first).simd_ge(f32x8::splat(cut.offset)).to_bitmask()
    }
}

#[cfg(test)]
mod tests;
