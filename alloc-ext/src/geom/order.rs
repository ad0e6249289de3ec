//! Orders of boxes by halving at the median of the longest axis.

use super::bounds::Bounds;
use arrayvec::ArrayVec;

/// Boxes of a node of the static tree, and lanes that are compared at once.
pub(super) const WIDTH: usize = 8;

/// An item beside the sum of its box's ends. Halving moves both, because it would wait for memory
/// at each comparison if it looked up a box.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    centre: [f64; 3],
    pub item: u32,
}

impl Placed {
    /// All items of boxes, in their order.
    pub fn all(boxes: &[Bounds]) -> Vec<Self> {
        let placed = |(b, item): (&Bounds, u32)| Self { centre: (b.low + b.high).to_array(), item };
        boxes.iter().zip(0..).map(placed).collect()
    }
}

/// Puts the items of the lower half of boxes, along the longest axis of their centres, before place
/// `middle`.
fn halve(items: &mut [Placed], middle: usize) {
    let all = items.iter().fold(Bounds::EMPTY, |all, i| all.with(i.centre.into()));
    let axis = all.longest_axis();
    items.select_nth_unstable_by(middle, |i, j| {
        i.centre[axis].total_cmp(&j.centre[axis]).then(i.item.cmp(&j.item))
    });
}

/// Items of a run that [`spatial_order`] leaves as they are.
const RUN: usize = 4;

/// The boxes' numbers in an order in which neighbours in space are near each other: halved at the
/// median of the longest axis, again and again.
pub(crate) fn spatial_order(boxes: &[Bounds]) -> Vec<u32> {
    let mut order = Placed::all(boxes);
    let mut open = vec![(0, boxes.len())];
    while let Some((from, to)) = open.pop() {
        if to - from > RUN {
            let middle = (to - from) / 2;
            halve(&mut order[from..to], middle);
            open.extend([(from, from + middle), (from + middle, to)]);
        }
    }
    order.into_iter().map(|placed| placed.item).collect()
}

/// Ranges of up to eight parts of items, which are ordered by halving, again and again.
pub(super) fn ranges(order: &mut [Placed]) -> ArrayVec<(usize, usize), WIDTH> {
    let mut ranges: ArrayVec<(usize, usize), WIDTH> = ArrayVec::new();
    if !order.is_empty() {
        ranges.push((0, order.len()));
    }
    // Parts of full nodes, so that few lanes are empty.
    let mut full = 1;
    while full * WIDTH < order.len() {
        full *= WIDTH;
    }
    while ranges.len() < WIDTH {
        let widest = (0..ranges.len()).max_by_key(|&i| ranges[i].1 - ranges[i].0);
        let Some(i) = widest.filter(|&i| ranges[i].1 - ranges[i].0 > full) else { break };
        let (from, to) = ranges[i];
        let middle = (to - from).div_ceil(full) / 2 * full;
        halve(&mut order[from..to], middle);
        ranges[i] = (from, from + middle);
        ranges.push((from + middle, to));
    }
    ranges
}
