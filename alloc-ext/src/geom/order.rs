//! Orders of boxes by halving at the median of the longest axis.

use super::bounds::Bounds;
use arrayvec::ArrayVec;

/// Boxes of a node of the static tree, and lanes that are compared at once.
pub(super) const WIDTH: usize = 8;

/// Puts the items of the lower half of boxes, along the longest axis of their centres, before place
/// `middle`.
fn halve(items: &mut [u32], boxes: &[Bounds], middle: usize) {
    let centre = |i: u32| boxes[i as usize].low + boxes[i as usize].high;
    let axis = items.iter().fold(Bounds::EMPTY, |all, &i| all.with(centre(i))).longest_axis();
    items.select_nth_unstable_by(middle, |&i, &j| {
        centre(i)[axis].total_cmp(&centre(j)[axis]).then(i.cmp(&j))
    });
}

/// Items of a run that [`spatial_order`] leaves as they are.
const RUN: usize = 4;

/// The boxes' numbers in an order in which neighbours in space are near each other: halved at the
/// median of the longest axis, again and again.
pub(crate) fn spatial_order(boxes: &[Bounds]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut open = vec![(0, boxes.len())];
    while let Some((from, to)) = open.pop() {
        if to - from > RUN {
            let middle = (to - from) / 2;
            halve(&mut order[from..to], boxes, middle);
            open.extend([(from, from + middle), (from + middle, to)]);
        }
    }
    order
}

/// Ranges of up to eight parts of a range. The items are ordered by halving, again and again.
pub(super) fn ranges(
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
        let middle = (to - from).div_ceil(full) / 2 * full;
        halve(&mut order[from..to], boxes, middle);
        ranges[i] = (from, from + middle);
        ranges.push((from + middle, to));
    }
    ranges
}
