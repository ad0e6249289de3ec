//! A tree of boxes eight wide, in single precision, for the searches of a placement: those lose
//! nothing but time by what they look at for nothing, and there are a hundred of them for each move
//! that is made.
//!
//! Its frame has its origin in the middle of all boxes and half their longest side as unit, so that
//! every number in it is at most 1 and the bounds of rounding are numbers: see [`SLACK`].

use crate::tight::proof::boxes::Bounds;
use crate::tight::proof::region::Plane;
use arrayvec::ArrayVec;
use glam::DVec3;

/// Boxes of a node, and lanes that are compared at once.
const WIDTH: usize = 8;

/// What a box may stand below a plane, or off another box, and still counts as reaching it.
///
/// Coordinates of at most 1 are rounded to 2^-25, extents and the plane's normal as well, and the
/// three products and their sums add less than eight such steps of numbers below 3: all is less
/// than 40 · 2^-25 = 1.2e-6.
const SLACK: f64 = 2e-6;

/// An item among the entries of a node; without it, the number of a node.
const ITEM: u32 = 1 << 31;

/// Eight boxes by middle and half extent, and what is in them.
#[derive(Clone, Debug)]
struct Node {
    middle: [[f32; WIDTH]; 3],
    half: [[f32; WIDTH]; 3],
    entry: [u32; WIDTH],
}

const EMPTY: Node =
    Node { middle: [[0.0; WIDTH]; 3], half: [[-1e30; WIDTH]; 3], entry: [0; WIDTH] };

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct CellTree {
    nodes: Vec<Node>,
    origin: DVec3,
    /// Units of the tree's frame in one of the mesh.
    scale: f64,
}

/// A plane in the tree's frame.
#[derive(Clone, Copy, Debug)]
struct Cut {
    normal: [f32; 3],
    along: [f32; 3],
    offset: f32,
}

/// Planes and a box, which what is looked for reaches.
#[derive(Clone, Debug)]
pub(crate) struct Probe {
    cuts: ArrayVec<Cut, 5>,
    fixed: usize,
    middle: [f32; 3],
    half: [f32; 3],
}

/// Nodes below which everything in some bounds is.
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

/// Seven entries wait at each of the eleven depths that 2^32 items have.
const DEPTH: usize = 96;

impl CellTree {
    /// Of items with these boxes.
    pub fn new(boxes: &[Bounds]) -> Self {
        let all = boxes.iter().fold(Bounds::EMPTY, |all, &b| all.join(b));
        let extent = (all.high - all.low).max_element();
        let unit = if extent > 0.0 && extent.is_finite() { 0.5 * extent } else { 1.0 };
        let origin = if boxes.is_empty() { DVec3::ZERO } else { (all.low + all.high) * 0.5 };
        let mut tree = Self { nodes: vec![EMPTY], origin, scale: 1.0 / unit };
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut open = vec![(0usize, 0usize, boxes.len())];
        while let Some((node, from, to)) = open.pop() {
            for (lane, (from, to)) in parts(&mut order, boxes, from, to).into_iter().enumerate() {
                let bounds = order[from..to]
                    .iter()
                    .fold(Bounds::EMPTY, |all, &i| all.join(boxes[i as usize]));
                let entry = if to - from == 1 {
                    order[from] | ITEM
                } else {
                    tree.nodes.push(EMPTY);
                    open.push((tree.nodes.len() - 1, from, to));
                    tree.nodes.len() as u32 - 1
                };
                let (middle, half) = tree.local(&bounds);
                let node = &mut tree.nodes[node];
                node.entry[lane] = entry;
                for axis in 0..3 {
                    node.middle[axis][lane] = middle[axis];
                    node.half[axis][lane] = half[axis];
                }
            }
        }
        tree
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

    /// A probe of a box and planes.
    pub fn probe(&self, bounds: &Bounds, planes: &[Plane]) -> Probe {
        let (middle, half) = self.local(bounds);
        let half = half.map(|h| h + SLACK as f32);
        let mut cuts: ArrayVec<Cut, 5> = planes.iter().map(|plane| self.cut(plane)).collect();
        let fixed = cuts.len();
        cuts.truncate(4);
        Probe { cuts, fixed, middle, half }
    }

    fn cut(&self, plane: &Plane) -> Cut {
        let normal = plane.normal.as_vec3().to_array();
        let offset = (plane.offset - plane.normal.dot(self.origin)) * self.scale - SLACK;
        Cut { normal, along: normal.map(f32::abs), offset: offset as f32 }
    }

    /// Adds to a probe the plane that is wanted to be reached from now on, in place of the last one
    /// that was added.
    pub fn raise(&self, probe: &mut Probe, plane: &Plane) {
        probe.cuts.truncate(probe.fixed);
        probe.cuts.push(self.cut(plane));
    }

    /// Some nodes that hold every item whose box meets `bounds`: where many searches in these
    /// bounds begin.
    pub fn frontier(&self, bounds: &Bounds, frontier: &mut Frontier) {
        let probe = self.probe(bounds, &[]);
        let open = &mut frontier.0;
        open.clear();
        open.push(0);
        let mut next = 0;
        while let Some(&index) = open.get(next) {
            let node = &self.nodes[index as usize];
            let hits = probe.hits(node);
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

    /// Calls `visit` with every item below a frontier whose box passes `keep`, in the mesh's frame,
    /// and perhaps others.
    pub fn visit_kept(
        &self,
        near: &Frontier,
        keep: impl Fn(&Bounds) -> bool,
        mut visit: impl FnMut(usize),
    ) {
        let mut stack = near.0.clone();
        while let Some(node) = stack.pop() {
            let node = &self.nodes[node as usize];
            for lane in 0..WIDTH {
                if node.half[0][lane] < 0.0 || !keep(&self.in_mesh_frame(node, lane)) {
                    continue;
                }
                let entry = node.entry[lane];
                if entry & ITEM == 0 { stack.push(entry) } else { visit((entry ^ ITEM) as usize) }
            }
        }
    }

    fn in_mesh_frame(&self, node: &Node, lane: usize) -> Bounds {
        let of = |axes: &[[f32; WIDTH]; 3]| DVec3::from(axes.map(|axis| f64::from(axis[lane])));
        let (middle, half) = (of(&node.middle), of(&node.half) + SLACK);
        Bounds {
            low: self.origin + (middle - half) / self.scale,
            high: self.origin + (middle + half) / self.scale,
        }
    }

    /// Calls `visit` with every item below a frontier whose box a probe reaches; what it returns is
    /// raised in the probe.
    #[inline]
    pub fn visit(
        &self,
        near: &Frontier,
        mut probe: Probe,
        mut visit: impl FnMut(usize) -> Option<Plane>,
    ) {
        let mut stack = [0u32; DEPTH];
        for &root in &near.0 {
            stack[0] = root;
            let mut height = 1;
            while height > 0 {
                height -= 1;
                let node = &self.nodes[stack[height] as usize];
                let mut hits = probe.hits(node);
                while hits != 0 {
                    let entry = node.entry[hits.trailing_zeros() as usize];
                    hits &= hits - 1;
                    if entry & ITEM == 0 {
                        stack[height] = entry;
                        height += 1;
                    } else if let Some(plane) = visit((entry ^ ITEM) as usize) {
                        self.raise(&mut probe, &plane);
                    }
                }
            }
        }
    }
}

impl Probe {
    /// The lanes whose boxes are reached, one bit each.
    #[inline]
    fn hits(&self, node: &Node) -> u32 {
        let mut out = [f32::NEG_INFINITY; WIDTH];
        for (k, out) in out.iter_mut().enumerate() {
            let off = |axis: usize| {
                (node.middle[axis][k] - self.middle[axis]).abs()
                    - node.half[axis][k]
                    - self.half[axis]
            };
            let (x, y, z) = (off(0), off(1), off(2));
            let xy = if x > y { x } else { y };
            *out = if xy > z { xy } else { z };
        }
        for cut in &self.cuts {
            for (k, out) in out.iter_mut().enumerate() {
                let reach = cut.normal[0] * node.middle[0][k]
                    + cut.normal[1] * node.middle[1][k]
                    + cut.normal[2] * node.middle[2][k]
                    + cut.along[0] * node.half[0][k]
                    + cut.along[1] * node.half[1][k]
                    + cut.along[2] * node.half[2][k];
                let below = cut.offset - reach;
                *out = if *out > below { *out } else { below };
            }
        }
        let mut hits = 0;
        for (k, out) in out.iter().enumerate() {
            hits |= u32::from(*out <= 0.0) << k;
        }
        hits
    }
}

/// Ranges of up to eight parts of a range, ordered by halving at the median of the longest axis,
/// again and again.
fn parts(
    order: &mut [u32],
    boxes: &[Bounds],
    from: usize,
    to: usize,
) -> ArrayVec<(usize, usize), WIDTH> {
    let mut ranges: ArrayVec<(usize, usize), WIDTH> = ArrayVec::new();
    if from < to {
        ranges.push((from, to));
    }
    // Parts of full nodes, so that few lanes are empty.
    let mut full = 1;
    while full * WIDTH < to - from {
        full *= WIDTH;
    }
    while ranges.len() < WIDTH {
        let widest = (0..ranges.len()).max_by_key(|&i| ranges[i].1 - ranges[i].0);
        let Some(i) = widest.filter(|&i| ranges[i].1 - ranges[i].0 > full) else { break };
        let (from, to) = ranges[i];
        let items = &mut order[from..to];
        let centre = |i: u32| boxes[i as usize].low + boxes[i as usize].high;
        let spread = items.iter().fold(Bounds::EMPTY, |all, &i| all.with(centre(i)));
        let extent = (spread.high - spread.low).to_array();
        let axis =
            (0..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best });
        let parts = items.len().div_ceil(full);
        let middle = parts / 2 * full;
        items.select_nth_unstable_by(middle, |&i, &j| {
            centre(i)[axis].total_cmp(&centre(j)[axis]).then(i.cmp(&j))
        });
        ranges[i] = (from, from + middle);
        ranges.push((from + middle, to));
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tight::moves::kick::SplitMix;

    fn point(dice: &mut SplitMix) -> DVec3 {
        DVec3::new(dice.roll(), dice.roll(), dice.roll()).as_vec3().as_dvec3()
    }

    /// Boxes of all sizes, some of them points, moved and scaled.
    fn boxes(dice: &mut SplitMix, count: usize, scale: f64, shift: DVec3) -> Vec<Bounds> {
        let mut all = Vec::new();
        for i in 0..count {
            let low = point(dice);
            let high = if i % 3 == 0 { low } else { low + point(dice) * 0.1 };
            all.push(Bounds { low: low * scale + shift, high: high * scale + shift });
        }
        all
    }

    #[test]
    fn every_box_that_is_reached_is_visited_once_from_the_root_and_from_a_frontier() {
        let mut dice = SplitMix::new(3);
        for (count, scale, shift) in [
            (0, 1.0, 0.0),
            (1, 1.0, 0.0),
            (8, 1e-30, 0.0),
            (9, 1e30, 0.0),
            (65, 1.0, 1e6),
            (700, 40.0, -3.0),
        ] {
            let shift = DVec3::splat(shift);
            let boxes = boxes(&mut dice, count, scale, shift);
            let tree = CellTree::new(&boxes);
            for _ in 0..200 {
                let low = point(&mut dice);
                let of = Bounds {
                    low: low * scale + shift,
                    high: (low + point(&mut dice) * 0.5) * scale + shift,
                };
                let through = point(&mut dice) * scale + shift;
                let normal = (point(&mut dice) - 0.5).normalize();
                let plane = Plane { normal, offset: normal.dot(through) };
                let mut near = Frontier::default();
                tree.frontier(&of, &mut near);
                for near in [near, Frontier::whole()] {
                    let mut visits = vec![0; count];
                    tree.visit(&near, tree.probe(&of, &[plane]), |i| {
                        visits[i] += 1;
                        None
                    });
                    for (b, visits) in boxes.iter().zip(visits) {
                        let wanted = b.meets(&of) && b.support(normal) >= plane.offset;
                        assert!(
                            visits == 1 || (visits == 0 && !wanted),
                            "{visits} visits, {wanted}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_below_a_raised_plane_is_passed_over() {
        let mut dice = SplitMix::new(4);
        let boxes = boxes(&mut dice, 5_000, 1.0, DVec3::ZERO);
        let tree = CellTree::new(&boxes);
        let all = Bounds { low: DVec3::splat(-1.0), high: DVec3::splat(2.0) };
        let (mut visits, mut highest) = (0, f64::NEG_INFINITY);
        tree.visit(&Frontier::whole(), tree.probe(&all, &[]), |i| {
            visits += 1;
            let top = boxes[i].high.z;
            (top > highest).then(|| {
                highest = top;
                Plane { normal: DVec3::Z, offset: top }
            })
        });
        assert_eq!(highest, boxes.iter().map(|b| b.high.z).fold(0.0, f64::max));
        assert!(visits < boxes.len() / 2, "{visits}");
    }
}
