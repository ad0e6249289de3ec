//! The best partition of root cells into dyadic boxes for a number of bytes.

use crate::sdf::domain::ROOT;
use glam::DVec3;
use rayon::prelude::*;

/// Halvings of a root cell along each axis, at most.
pub(super) const LEVELS: usize = 4;

/// Dyadic intervals along one axis.
const ALONG: usize = (2 << LEVELS) - 1;

/// Dyadic boxes of a root cell.
pub(super) const BOXES: usize = ALONG * ALONG * ALONG;

/// Halvings of the price's range.
const PRICES: usize = 26;

/// A dyadic box of a root cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Box3 {
    /// Number of the root cell along each axis.
    pub root: [usize; 3],
    /// How often each axis is halved.
    pub level: [usize; 3],
    /// Number among the intervals of the level.
    pub at: [usize; 3],
}

impl Box3 {
    /// The whole root cell.
    pub const fn whole(root: [usize; 3]) -> Self {
        Self { root, level: [0; 3], at: [0; 3] }
    }

    fn by_number(root: [usize; 3], number: usize) -> Self {
        let along = [number % ALONG, number / ALONG % ALONG, number / (ALONG * ALONG)];
        let level = along.map(|along| (along + 1).ilog2() as usize);
        Self { root, level, at: [0, 1, 2].map(|axis| along[axis] + 1 - (1 << level[axis])) }
    }

    pub fn number(&self) -> usize {
        let [x, y, z] = [0, 1, 2].map(|axis| (1 << self.level[axis]) - 1 + self.at[axis]);
        x + ALONG * (y + ALONG * z)
    }

    /// The number of the box that this is a half of, along the axis that is halved most.
    pub fn parent(&self) -> Option<usize> {
        let axis = (0..3).max_by_key(|&axis| self.level[axis])?;
        let mut parent = *self;
        parent.level[axis] = parent.level[axis].checked_sub(1)?;
        parent.at[axis] /= 2;
        Some(parent.number())
    }

    /// Least place, with so many steps along a root cell's side.
    pub fn start(&self, steps: usize) -> [usize; 3] {
        let size = self.size(steps);
        [0, 1, 2].map(|axis| self.root[axis] * steps + self.at[axis] * size[axis])
    }

    /// Steps along each side.
    pub fn size(&self, steps: usize) -> [usize; 3] {
        self.level.map(|level| steps >> level)
    }

    /// Half sides, units.
    pub fn half(&self) -> DVec3 {
        DVec3::from(self.level.map(|level| 0.5 * ROOT / (1 << level) as f64))
    }

    /// Least corner, units.
    pub fn corner(&self) -> DVec3 {
        DVec3::from(self.start(1 << LEVELS).map(|at| at as f64)) * (ROOT / (1 << LEVELS) as f64)
    }

    /// The parts of a box that is halved along these axes, as a node's children stand.
    pub fn parts(self, axes: usize) -> impl Iterator<Item = Self> {
        (0..8).filter(move |part| part & !axes == 0).map(move |part: usize| {
            let mut of = self;
            for axis in 0..3 {
                if axes >> axis & 1 != 0 {
                    of.level[axis] += 1;
                    of.at[axis] = 2 * of.at[axis] + (part >> axis & 1);
                }
            }
            of
        })
    }
}

/// The boxes of a root cell that are halved so often along the axis that is halved most. Parents
/// stand before their halves.
pub(super) fn boxes(root: [usize; 3], most: usize) -> Vec<(usize, Box3)> {
    let all = (0..BOXES).map(move |number| (number, Box3::by_number(root, number)));
    let mut kept: Vec<(usize, Box3)> =
        all.filter(|(_, of)| of.level.iter().max() == Some(&most)).collect();
    kept.sort_by_key(|(_, of)| of.level.iter().sum::<usize>());
    kept
}

/// The partition of one root cell at a price.
#[derive(Debug)]
pub(super) struct Choice {
    /// Per box the axes that it is halved along; 0 of a leaf.
    axes: Vec<u8>,
    /// Entries below the root's.
    pub entries: usize,
}

impl Choice {
    pub fn axes(&self, of: &Box3) -> usize {
        usize::from(self.axes[of.number()])
    }
}

/// Numbers of the boxes whose axes are all halved at most so often, those of the most halvings
/// first.
fn order(most: usize) -> Vec<u32> {
    let level = |number: &u32| Box3::by_number([0; 3], *number as usize).level;
    let mut order: Vec<u32> = (0..BOXES as u32)
        .filter(|number| level(number).iter().all(|&level| level <= most))
        .collect();
    order.sort_by_key(|number| std::cmp::Reverse(level(number).iter().sum::<usize>()));
    order
}

/// The best partition at a price of an entry.
fn choose(costs: &[f32], order: &[u32], most: usize, price: f32) -> Choice {
    let mut best = vec![0f32; BOXES];
    let mut axes_of = vec![0u8; BOXES];
    for &number in order {
        let number = number as usize;
        let of = Box3::by_number([0; 3], number);
        // Numbers of both halves along each axis are one apart.
        let along = [number % ALONG, number / ALONG % ALONG, number / (ALONG * ALONG)];
        let stride = [1, ALONG, ALONG * ALONG];
        let (mut least, mut chosen) = (costs[number] + price, 0u8);
        for axes in 1..8usize {
            if (0..3).any(|axis| axes >> axis & 1 != 0 && of.level[axis] == most) {
                continue;
            }
            let mut first = 0;
            for axis in 0..3 {
                let is_halved = axes >> axis & 1 != 0;
                first += stride[axis] * if is_halved { 2 * along[axis] + 1 } else { along[axis] };
            }
            let mut sum = price;
            for part in 0..8usize {
                if part & !axes == 0 {
                    let up = |axis: usize| stride[axis] * (part >> axis & 1);
                    sum += best[first + up(0) + up(1) + up(2)];
                }
            }
            if sum < least {
                (least, chosen) = (sum, axes as u8);
            }
        }
        (best[number], axes_of[number]) = (least, chosen);
    }
    let mut choice = Choice { axes: axes_of, entries: 0 };
    let mut open = vec![Box3::whole([0; 3])];
    while let Some(of) = open.pop() {
        let axes = choice.axes(&of);
        if axes != 0 {
            let before = open.len();
            open.extend(of.parts(axes));
            choice.entries += open.len() - before;
        }
    }
    choice
}

/// A partition of all root cells into at most so many entries, from the costs of all boxes of each,
/// and the price of an entry that gave it. No partition of as many entries costs less. The price is
/// a Lagrange multiplier, found by halving its range: some numbers of entries have none, and then
/// fewer are taken. No axis is halved more often than `most` times.
pub(super) fn partition(
    costs: &[Vec<f32>],
    most: usize,
    most_entries: usize,
) -> (Vec<Choice>, f32) {
    let order = order(most);
    let at = |price: f64| -> Vec<Choice> {
        costs.par_iter().map(|costs| choose(costs, &order, most, price as f32)).collect()
    };
    let entries =
        |all: &[Choice]| costs.len() + all.iter().map(|choice| choice.entries).sum::<usize>();
    let whole: f64 = costs.iter().map(|costs| f64::from(costs[0])).sum();
    // Nothing is halved at the first price: all that it may save costs as much.
    let (mut high, mut low) = (whole.max(f64::MIN_POSITIVE), whole * 1e-9);
    let mut best = at(high);
    for _ in 0..PRICES {
        let price = (low * high).sqrt();
        let found = at(price);
        let count = entries(&found);
        if count > most_entries {
            low = price;
        } else {
            (high, best) = (price, found);
            if count + 8 > most_entries {
                break;
            }
        }
    }
    (best, high as f32)
}

/// The partition of all root cells into the fewest entries, by boxes of cost 0 and none of an
/// infinite one. Where there is no such partition, a leaf costs infinitely much.
pub(super) fn fewest(costs: &[Vec<f32>]) -> Vec<Choice> {
    let order = order(LEVELS);
    costs.par_iter().map(|costs| choose(costs, &order, LEVELS, 1.0)).collect()
}
