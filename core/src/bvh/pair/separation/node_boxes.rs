//! The boxes of two nodes' children: along the direction, and along the axes of the first grid.

use super::goal::square_up;
use super::grid_pose::GridPose;
use super::pending::Pending;
use crate::bvh::pair::direction::{Direction, ShortDirection};
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::format::layout::boxes;
use crate::bvh::tree::node::WIDE;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::geom::{Rows, columns, turned};
use crate::num::tolerance::U32;
use crate::num::{Real, SOFT_FLOAT, above_zero, difference, dot, each, float, greater, lesser};
use crate::query::Work;
use glam::Vec3;

/// Children of a node that are looked at.
#[derive(Clone, Copy)]
pub(crate) struct WantedChildren {
    pub(crate) node: u32,
    /// A bit for each.
    wanted: u32,
    /// Those from this number on are leaves.
    inner: u32,
    /// It is a leaf alone.
    is_leaf: bool,
}

impl WantedChildren {
    /// All of a node.
    #[inline(always)]
    pub(crate) fn of(tree: &Bvh<'_>, node: u32) -> Option<WantedChildren> {
        let links = tree.links(node)?;
        Some(WantedChildren { node, wanted: links.mask(), inner: links.inner, is_leaf: false })
    }

    /// Child number `index` of a node: the child's children, or itself if it is a leaf.
    #[inline(always)]
    pub(crate) fn below(tree: &Bvh<'_>, node: u32, index: u32) -> Option<WantedChildren> {
        let links = tree.links(node)?;
        if index < links.inner {
            return WantedChildren::of(tree, links.first_node.wrapping_add(index));
        }
        Some(WantedChildren { node, wanted: 1 << (index & 7), inner: 0, is_leaf: true })
    }

    /// The leaf of a triangle, alone.
    #[inline(always)]
    pub(crate) fn leaf_of(place: TriangleAt) -> WantedChildren {
        WantedChildren { node: place.node(), wanted: 1 << place.child(), inner: 0, is_leaf: true }
    }

    /// The leaf, if it is one alone.
    #[inline(always)]
    pub(crate) fn leaf(&self) -> Option<u32> {
        self.is_leaf.then(|| self.wanted.trailing_zeros())
    }

    #[inline(always)]
    fn leaves(&self) -> u32 {
        self.wanted & u32::MAX << (self.inner & 15)
    }
}

/// A node's boxes, grid units from the grid's origin.
pub(super) struct NodeBoxes<'a> {
    /// Low and high planes of each axis.
    rows: &'a [[u8; WIDTH]; 6],
    /// Where byte 0 lies.
    start: Vec3,
    step: Vec3,
}

impl<'a> NodeBoxes<'a> {
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(super) fn of(tree: &Bvh<'a>, node: u32, origin: Vec3) -> Option<NodeBoxes<'a>> {
        let record = tree.boxes(node)?;
        let rows = record.as_chunks::<WIDTH>().0.first_chunk::<6>()?;
        let words = record.as_chunks::<4>().0.get(boxes::ORIGIN / 4..)?.first_chunk::<6>()?;
        let [x, y, z, a, b, c] = words.map(f32::from_le_bytes);
        let (middle, step) = (Vec3::new(x, y, z), Vec3::new(a, b, c));
        Some(NodeBoxes { rows, start: difference(middle, origin) - 128.0 * step, step })
    }

    /// For each wanted box the greatest `direction · place` of its places, plus `base`. It is not
    /// divided by the length of `direction`.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(super) fn tops(&self, direction: Vec3, base: f32, wanted: u32) -> [f32; WIDTH] {
        let [lx, hx, ly, hy, lz, hz] = self.rows;
        let by = direction * self.step;
        let base = Real(dot(direction, self.start)) + Real(base);
        let (x, y, z) = (Real(by.x), Real(by.y), Real(by.z));
        let rx = if by.x > 0.0 { hx } else { lx };
        let ry = if by.y > 0.0 { hy } else { ly };
        let rz = if by.z > 0.0 { hz } else { lz };
        let mut tops = [0.0; WIDTH];
        for i in 0..WIDTH {
            if WIDE || wanted >> i & 1 != 0 {
                let [a, b, c] = [rx[i], ry[i], rz[i]].map(|byte| Real(float(i32::from(byte))));
                tops[i] = ((x * a + y * b + z * c) + base).0;
            }
        }
        tops
    }

    /// Sum and difference of the planes of child `i` along each axis: twice the middle and the
    /// length, in steps from byte 0.
    #[inline(always)]
    fn doubled(&self, i: usize) -> [Vec3; 2] {
        let [lx, hx, ly, hy, lz, hz] =
            self.rows.map(|row| i32::from(row.get(i).copied().unwrap_or(0)));
        [
            Vec3::new(float(hx + lx), float(hy + ly), float(hz + lz)),
            Vec3::new(float(hx - lx), float(hy - ly), float(hz - lz)),
        ]
    }

    /// The box of child `i` of a node of the first model.
    #[inline(always)]
    fn axis_box(&self, i: usize) -> AxisBox {
        let [sum, length] = self.doubled(i);
        let step = 0.5 * self.step;
        AxisBox { middle: self.start + step * sum, half: step * length }
    }
}

/// A box along the axes of the first grid.
#[derive(Clone, Copy)]
pub(super) struct AxisBox {
    middle: Vec3,
    half: Vec3,
}

impl AxisBox {
    const NONE: AxisBox = AxisBox { middle: Vec3::ZERO, half: Vec3::ZERO };

    /// Middle and half along one axis.
    #[inline(always)]
    fn side(&self, axis: usize) -> [f32; 2] {
        let (middle, half) = (self.middle, self.half);
        match axis {
            0 => [middle.x, half.x],
            1 => [middle.y, half.y],
            _ => [middle.z, half.z],
        }
    }

    /// A lower bound of the squared distance. If the boxes meet: the least overlap along an axis,
    /// times −1, so that the deepest pair comes first.
    #[inline(always)]
    pub(super) fn key(&self, other: &AxisBox) -> f32 {
        let gap = difference(self.middle, other.middle).abs() - (self.half + other.half);
        let [x, y, z] = gap.to_array().map(Real);
        let zero = Real::ZERO;
        let square = if SOFT_FLOAT || WIDE {
            let (p, q, r) = (greater(zero, x), greater(zero, y), greater(zero, z));
            p * p + q * q + r * r
        } else {
            let [p, q, r] = each([x, y, z], |x: Real| Real(above_zero(x.0)));
            p * p + q * q + r * r
        };
        if square > zero { square.0 } else { greater(x, greater(y, z)).0 }
    }
}

/// Pairs of children farther apart than this are left out: the limit of the goal plus the rounding
/// of boxes.
pub(crate) struct PairLimit {
    /// Units of the first grid.
    pub(crate) length: f32,
    /// Square of the limit, rounded up.
    pub(crate) square: f32,
}

impl PairLimit {
    /// `far` is how far children may be, without the rounding of boxes.
    #[inline(always)]
    pub(super) fn of(pose: &GridPose<'_>, far: f32) -> PairLimit {
        let length = far + pose.box_error;
        PairLimit { length: length * (1.0 + 16.0 * U32), square: square_up(length) }
    }

    /// If the tops of two children along a direction add up to less than this, they are beyond the
    /// limit.
    #[inline(always)]
    pub(super) fn least_sum_of_tops(&self, pose: &GridPose<'_>, direction: &Direction) -> f32 {
        let between = Real(dot(pose.shift, direction.vector));
        let limit = (Real(self.length) * Real(direction.length)).0;
        (between - Real(limit)).0
    }
}

/// Adds the pairs of children that may be within the limit to those that wait. `None` if a tree is
/// unchecked or memory ends.
#[inline(never)]
pub(crate) fn push_children(
    pose: &GridPose<'_>,
    children: &[WantedChildren; 2],
    direction: &Direction,
    limit: &PairLimit,
    pending: &mut Pending<'_>,
    work: &mut Work,
) -> Option<()> {
    let ([tree_a, tree_b], [origin_a, origin_b]) = (pose.trees, pose.origins);
    let [a, b] = children;
    let boxes_a = NodeBoxes::of(tree_a, a.node, origin_a)?;
    let boxes_b = NodeBoxes::of(tree_b, b.node, origin_b)?;
    // `back` points from the second model to the first, in the frame of the second grid.
    let vector = direction.vector;
    let back = -turned(&columns(&pose.rows), vector);
    let least_sum = limit.least_sum_of_tops(pose, direction);
    let mut tops_a = boxes_a.tops(vector, 0.0, a.wanted);
    let mut tops_b = boxes_b.tops(back, 0.0, b.wanted);
    // A box of the first model with a lower top than this is beyond the limit of one with `top_b`.
    let least_top_a = |top_b: f32| Real(least_sum) - Real(top_b);
    work.bounds =
        work.bounds.saturating_add(a.wanted.count_ones().saturating_mul(b.wanted.count_ones()));
    let highest = bits(a.wanted).fold(f32::MIN, |most, i| greater(Real(most), Real(tops_a[i])).0);
    // Children that are within the limit of some child of the other node.
    let (mut near_a, mut near_b, mut lowest) = (0, 0, f32::INFINITY);
    for j in bits(b.wanted) {
        let least_top = least_top_a(tops_b[j]);
        if !is_below(highest, least_top) {
            near_b |= 1 << j;
            lowest = lesser(Real(lowest), least_top).0;
        }
    }
    for i in bits(a.wanted) {
        near_a |= u32::from(!is_below(tops_a[i], Real(lowest))) << i;
    }
    if near_b == 0 {
        return Some(());
    }
    let mut waiting = pending.begin([a.node, b.node])?;
    let first = along_axes(&boxes_a, near_a);
    let second = MovedBoxes::new(pose, &boxes_b);
    // Of pairs that are near along the direction most are far along the axis across it.
    let across = axis_across(vector);
    let sides = first.map(|first| first.side(across));
    let (mut leaves_a, mut leaves_b) = (0, 0);
    for j in bits(near_b) {
        let least_top = least_top_a(tops_b[j]);
        let other = second.along_axes(j);
        let side = other.side(across);
        for i in bits(near_a) {
            if is_below(tops_a[i], least_top)
                || is_above(Real(gap_of(sides[i], side)), limit.length)
            {
                continue;
            }
            let key = first[i].key(&other);
            if !is_above(Real(key), limit.square) {
                waiting.add(key, (i * WIDTH + j) as u32)?;
                leaves_a |= 1 << i;
                leaves_b |= 1 << j;
            }
        }
    }
    (leaves_a, leaves_b) = (leaves_a & a.leaves(), leaves_b & b.leaves());
    if leaves_a | leaves_b != 0 {
        // Most often a leaf's vertices lie below the top of its box. Rounded up they may lie above
        // it.
        if let Some(short) = ShortDirection::of(vector) {
            for i in bits(leaves_a) {
                tops_a[i] = lesser(tops_a[i], short.top(&tree_a.leaf(a.node, i as u32)?)?);
            }
        }
        if let Some(short) = ShortDirection::of(back) {
            for j in bits(leaves_b) {
                tops_b[j] = lesser(tops_b[j], short.top(&tree_b.leaf(b.node, j as u32)?)?);
            }
        }
        waiting.retain(|[i, j]| {
            let least_top = least_top_a(tops_b[j]);
            !is_below(tops_a[i], least_top)
        });
    }
    waiting.finish()
}

/// The axis at the largest angle to a direction.
#[inline(always)]
fn axis_across(direction: Vec3) -> usize {
    let [x, y, z] = direction.abs().to_array().map(Real);
    if x < y && x < z {
        0
    } else if y < z {
        1
    } else {
        2
    }
}

/// The gap of two boxes along an axis. Below 0: the overlap, times −1.
#[inline(always)]
fn gap_of([middle, half]: [f32; 2], [other, other_half]: [f32; 2]) -> f32 {
    (Real((Real(middle) - Real(other)).0.abs()) - (Real(half) + Real(other_half))).0
}

/// Whether a number is above a limit. Neither is NaN: [`GridPose::of`] refuses such a pose.
#[inline(always)]
pub(super) fn is_above(x: Real, limit: f32) -> bool {
    x > Real(limit)
}

/// Whether a number is below a limit. Neither is NaN, as for [`is_above`].
#[inline(always)]
pub(super) fn is_below(x: f32, limit: Real) -> bool {
    limit > Real(x)
}

/// The numbers of the lowest eight bits that are ones.
#[inline(always)]
pub(super) fn bits(mut mask: u32) -> impl Iterator<Item = usize> {
    mask &= 0xFF;
    core::iter::from_fn(move || {
        if mask == 0 {
            return None;
        }
        let bit = mask.trailing_zeros() as usize & (WIDTH - 1);
        mask &= mask - 1;
        Some(bit)
    })
}

/// The box of a leaf of the first model.
pub(super) fn first_box(pose: &GridPose<'_>, of: TriangleAt) -> Option<AxisBox> {
    let ([tree, _], [origin, _]) = (pose.trees, pose.origins);
    let boxes = NodeBoxes::of(tree, of.node(), origin)?;
    Some(boxes.axis_box(of.child() as usize))
}

/// The box around the box of a leaf of the second model.
pub(super) fn second_box(pose: &GridPose<'_>, of: TriangleAt) -> Option<AxisBox> {
    let ([_, tree], [_, origin]) = (pose.trees, pose.origins);
    let boxes = NodeBoxes::of(tree, of.node(), origin)?;
    Some(MovedBoxes::new(pose, &boxes).along_axes(of.child() as usize))
}

#[inline(always)]
fn along_axes(boxes: &NodeBoxes<'_>, wanted: u32) -> [AxisBox; WIDTH] {
    let mut found = [AxisBox::NONE; WIDTH];
    for i in bits(wanted) {
        found[i] = boxes.axis_box(i);
    }
    found
}

/// Boxes of the second model, turned into the first grid.
struct MovedBoxes<'b, 'a> {
    boxes: &'b NodeBoxes<'a>,
    /// The pose's rows times half a step: a sum of planes to a middle.
    rows: Rows,
    /// Their sizes: a length to half of the turned box.
    sizes: Rows,
    start: Vec3,
}

impl<'b, 'a> MovedBoxes<'b, 'a> {
    #[inline(always)]
    fn new(pose: &GridPose<'_>, boxes: &'b NodeBoxes<'a>) -> MovedBoxes<'b, 'a> {
        let step = 0.5 * boxes.step;
        let rows = each(pose.rows, |row| row * step);
        MovedBoxes { boxes, rows, sizes: each(rows, Vec3::abs), start: pose.moved(boxes.start) }
    }

    #[inline(always)]
    fn along_axes(&self, j: usize) -> AxisBox {
        let [sum, length] = self.boxes.doubled(j);
        AxisBox { middle: turned(&self.rows, sum) + self.start, half: turned(&self.sizes, length) }
    }
}
