//! The top of a large tree: cuts between bins of centres, until blocks are small.
//!
//! A full sweep sorts all items on three axes, and reads them in that order on each level. For
//! millions of items that takes longer than all else, and few cuts would move by more than a bin.
//! Source: Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.

use super::sah::{Bounds, BoxMeasure};

/// Bins of an axis.
const BINS: usize = 32;

/// A cut that takes a smaller part of the items than this gives way to the median. So the depth is
/// bounded.
const LEAST_PART: usize = 64;

/// Items with their boxes, by number.
pub(in crate::bvh) struct Blocks<'a> {
    /// The boxes of all items.
    pub bounds: &'a [Bounds],
    /// Weight of summed extents beside half a surface, grid units.
    pub extent_weight: f32,
    /// Items of a block at most.
    pub most: usize,
}

/// What lies in a bin.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, count: 0 };

    fn include(&mut self, other: &Self) {
        self.bounds.include(&other.bounds);
        self.count += other.count;
    }
}

impl Blocks<'_> {
    /// The results of `of` for each block, from first to last, on all threads. Blocks and the order
    /// of their items are the same on any number of them.
    pub(in crate::bvh) fn flat_map<T: Send>(
        &self,
        items: &mut [u32],
        of: &(impl Fn(&[u32]) -> Vec<T> + Sync),
    ) -> Vec<T> {
        if items.len() <= self.most {
            return of(items);
        }
        let (low, high) = self.halves(items);
        let (mut all, others) = rayon::join(|| self.flat_map(low, of), || self.flat_map(high, of));
        all.extend(others);
        all
    }

    /// An item's box, and twice its centre.
    fn item(&self, item: u32) -> (Bounds, [f32; 3]) {
        let bounds = self.bounds[item as usize];
        (bounds, [0, 1, 2].map(|k| bounds.low[k] + bounds.high[k]))
    }

    /// Both parts of the best cut.
    fn halves<'i>(&self, items: &'i mut [u32]) -> (&'i mut [u32], &'i mut [u32]) {
        let mut centres = Bounds::EMPTY;
        for &item in &*items {
            let at = self.item(item).1;
            centres.include(&Bounds { low: at, high: at });
        }
        let extent = [0, 1, 2].map(|k| centres.high[k] - centres.low[k]);
        // Of an axis without extent all items are in the first bin.
        let bin_of = |axis: usize, centre: f32| {
            let part = (centre - centres.low[axis]) / extent[axis];
            ((part * BINS as f32) as usize).min(BINS - 1)
        };
        let mut bins = [[Bin::EMPTY; BINS]; 3];
        for &item in &*items {
            let (bounds, centre) = self.item(item);
            for (axis, bins) in bins.iter_mut().enumerate() {
                bins[bin_of(axis, centre[axis])].include(&Bin { bounds, count: 1 });
            }
        }
        let mut low_count = 0;
        if let Some((axis, cut)) = self.best_cut(&bins) {
            for rank in 0..items.len() {
                if bin_of(axis, self.item(items[rank]).1[axis]) < cut {
                    items.swap(rank, low_count);
                    low_count += 1;
                }
            }
        }
        if low_count.min(items.len() - low_count) * LEAST_PART < items.len() {
            low_count = items.len() / 2;
            let longest = (0..3).max_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(0);
            let centre = |item: u32| self.item(item).1[longest];
            items.select_nth_unstable_by(low_count, |&a, &b| {
                centre(a).total_cmp(&centre(b)).then(a.cmp(&b))
            });
        }
        items.split_at_mut(low_count)
    }

    /// The axis and the first bin above the cut of the least cost. `None` if one bin holds all.
    fn best_cut(&self, bins: &[[Bin; BINS]; 3]) -> Option<(usize, usize)> {
        let measure = BoxMeasure { extent_weight: self.extent_weight };
        let cost = |bin: &Bin| measure.of(&bin.bounds) * bin.count as f32;
        let mut best = (f32::INFINITY, None);
        for (axis, bins) in bins.iter().enumerate() {
            let mut above = [Bin::EMPTY; BINS];
            let mut all = Bin::EMPTY;
            for at in (1..BINS).rev() {
                all.include(&bins[at]);
                above[at] = all;
            }
            let mut below = Bin::EMPTY;
            for at in 1..BINS {
                below.include(&bins[at - 1]);
                if below.count == 0 || above[at].count == 0 {
                    continue;
                }
                let cost = cost(&below) + cost(&above[at]);
                if cost < best.0 {
                    best = (cost, Some((axis, at)));
                }
            }
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;
    use glam::DVec3;

    fn blocks_of(bounds: &[(DVec3, DVec3)], most: usize) -> Vec<Vec<u32>> {
        let bounds: Vec<Bounds> = bounds.iter().map(|&of| Bounds::of(of)).collect();
        let blocks = Blocks { bounds: &bounds, extent_weight: 0.1, most };
        let mut items: Vec<u32> = (0..bounds.len() as u32).collect();
        blocks.flat_map(&mut items, &|block: &[u32]| vec![block.to_vec()])
    }

    fn scattered(count: usize) -> Vec<(DVec3, DVec3)> {
        let mut noise = SplitMix::new(4);
        let mut item = || {
            let low = noise.point(DVec3::ZERO, DVec3::new(1000.0, 100.0, 10.0));
            (low, low + 1.0)
        };
        (0..count).map(|_| item()).collect()
    }

    #[test]
    fn each_item_is_in_one_block_that_is_not_too_large() {
        let growing = |i: i32| (DVec3::splat(2f64.powi(i)), DVec3::splat(2f64.powi(i) * 1.5));
        let soups = [
            scattered(5000),
            vec![(DVec3::ONE, DVec3::ONE); 3000],
            (-100..100).map(growing).collect(),
        ];
        for bounds in soups {
            for most in [1, 7, 100] {
                let blocks = blocks_of(&bounds, most);
                assert!(blocks.iter().all(|block| (1..=most).contains(&block.len())));
                let mut all = blocks.concat();
                all.sort_unstable();
                assert_eq!(all, (0..bounds.len() as u32).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn clusters_are_separated_first() {
        let at = |i: u32| f64::from(i) + if i < 400 { 0.0 } else { 1e4 };
        let bounds: Vec<_> =
            (0..1000).map(|i| (DVec3::splat(at(i)), DVec3::splat(at(i) + 1.0))).collect();
        let blocks = blocks_of(&bounds, 600);
        let sizes: Vec<usize> = blocks.iter().map(Vec::len).collect();
        assert_eq!(sizes, [400, 600]);
        assert!(blocks[0].iter().all(|&item| item < 400));
    }

    #[test]
    fn blocks_are_the_same_on_any_number_of_threads() {
        let bounds = scattered(20_000);
        let of = [1, 2, 5].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| blocks_of(&bounds, 50))
        });
        assert!(of[0] == of[1] && of[0] == of[2]);
    }
}
