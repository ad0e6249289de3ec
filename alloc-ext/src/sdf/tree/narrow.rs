//! A tree of the fewest bytes whose leaves are as narrow as allowed.
//!
//! Every dyadic box of a root cell is fitted by few samples, unless a box that it is a half of is
//! narrow enough. The fewest entries of narrow boxes follow from the smallest boxes upwards. Then
//! leaves are fitted by more samples, coded and proved. A box whose leaf comes out too wide counts
//! as too wide from then on, and the fewest entries are found anew.

use super::build::{Failure, Made, Maker, Tree, most_entries};
use super::codes::Scale;
use super::fit::Fitter;
use super::grid::{Batch, Grid};
use super::partition::{BOXES, Box3, LEVELS, boxes, fewest};
use super::search::entries;
use crate::error::BuildError;
use crate::progress::Watch;
use meshsweep_core::internal::sdf::format::layout::SDF_BYTES;
use meshsweep_core::internal::sdf::format::layout::tree::ENTRY_BYTES;
use std::collections::HashMap;

/// A box is polished if it takes no more than this of the allowed width.
const NEARLY: f64 = 1.5;

/// What came of a limit of widths.
pub(in crate::sdf) enum Narrow {
    Tree(Tree),
    /// So many bytes at least, more than were allowed.
    Bytes(usize),
    /// The smallest boxes take so much of the allowed width.
    Taken(f64),
}

/// Fits boxes of a grid.
struct Boxes<'a> {
    maker: &'a Maker<'a>,
    grid: Grid,
    /// A code's step, units: leaves' values are about those of the samples.
    step: f64,
}

impl Boxes<'_> {
    /// How much of the allowed width a box takes.
    fn taken(&self, of: &Box3, batch: &mut Batch, fitter: &mut Fitter) -> f64 {
        let (maker, half) = (self.maker, of.half());
        self.grid.fill(of, batch);
        let fitted = fitter.fit(batch, half, maker.is_cut());
        let taken = maker.taken_by(half, &fitted, self.step);
        if taken <= 1.0 || taken > NEARLY {
            return taken;
        }
        let fitted = fitter.polish(batch, half, maker.is_cut(), fitted);
        maker.taken_by(half, &fitted, self.step)
    }

    /// The most that one of the smallest boxes takes.
    fn smallest(&self, watch: Watch<'_>) -> Result<f64, BuildError> {
        let domain = self.maker.domain;
        let found = watch.map(domain.cell_count(), |root| {
            let (mut batch, mut fitter) = (Batch::default(), Fitter::default());
            boxes(domain.cell(root), LEVELS)
                .iter()
                .filter(|(_, of)| of.level == [LEVELS; 3])
                .map(|(_, of)| self.taken(of, &mut batch, &mut fitter))
                .fold(0.0, f64::max)
        })?;
        Ok(found.into_iter().fold(0.0, f64::max))
    }

    /// Per root cell 0 of each box that is narrow enough, else infinity.
    fn costs(&self, watch: Watch<'_>) -> Result<Vec<Vec<f32>>, BuildError> {
        let domain = self.maker.domain;
        watch.map(domain.cell_count(), |root| {
            let (mut batch, mut fitter) = (Batch::default(), Fitter::default());
            let mut costs = vec![0f32; BOXES];
            for level in 0..=LEVELS {
                for (number, of) in boxes(domain.cell(root), level) {
                    let is_known = of.parent().is_some_and(|parent| costs[parent] == 0.0);
                    if !is_known && self.taken(&of, &mut batch, &mut fitter) > 1.0 {
                        costs[number] = f32::INFINITY;
                    }
                }
            }
            costs
        })
    }
}

/// Builds one; `None` of a field that does not fit the numbers of a tree.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub(in crate::sdf) fn build(
    maker: &Maker<'_>,
    most_bytes: usize,
    watch: Watch<'_>,
) -> Result<Option<Narrow>, BuildError> {
    let Maker { domain, .. } = *maker;
    let grid = Grid::of(maker.truth, domain, maker.near(), watch.part(0.0, 0.2))?;
    let step = Scale::of(grid.values()).map_or(0.0, Scale::step);
    let all = Boxes { maker, grid, step };
    let mut widest = all.smallest(watch.part(0.2, 0.25))?;
    // A box is taken to be no narrower than the boxes in it: here, and where halves of a narrow box
    // are not fitted. Where that is wrong, the proof refuses a leaf and the next round halves it,
    // or a field that could be built is refused.
    if widest > 1.0 {
        return Ok(Some(Narrow::Taken(widest)));
    }
    let mut costs = all.costs(watch.part(0.25, 0.5))?;
    let mut made: HashMap<Box3, Made> = HashMap::new();
    // Each round has less left to do than the one before.
    let (mut begun, mut rest) = (0.5, 0.5);
    let root = |of: &Box3| domain.cell_number(of.root);
    loop {
        rest *= 0.5;
        let watch = watch.part(begun, begun + rest);
        begun += rest;
        let choices = fewest(&costs);
        let count = choices.len() + choices.iter().map(|choice| choice.entries).sum::<usize>();
        let Some(laid) = entries(domain, &choices) else {
            return Ok(Some(Narrow::Bytes(SDF_BYTES + ENTRY_BYTES * count)));
        };
        if laid.leaves.iter().any(|(_, of)| costs[root(of)][of.number()] > 0.0) {
            return Ok(Some(Narrow::Taken(widest)));
        }
        if count > most_entries(most_bytes) {
            return Ok(Some(Narrow::Bytes(SDF_BYTES + ENTRY_BYTES * count)));
        }
        let of_leaves: Vec<Box3> = laid.leaves.iter().map(|&(_, of)| of).collect();
        let new: Vec<Box3> =
            of_leaves.iter().copied().filter(|of| !made.contains_key(of)).collect();
        let found = watch.part(0.0, 0.3).map(new.len(), |leaf| maker.made(new[leaf]))?;
        made.extend(new.into_iter().zip(found));
        let leaves: Vec<&Made> = of_leaves.iter().map(|of| &made[of]).collect();
        match maker.finish(laid, leaves, watch.part(0.3, 1.0))? {
            Ok(tree) => return Ok(Some(Narrow::Tree(tree))),
            Err(Failure::NoRoom) => return Ok(None),
            Err(Failure::TooWide(wide)) => {
                for (leaf, taken) in wide {
                    let of = of_leaves[leaf];
                    costs[root(&of)][of.number()] = f32::INFINITY;
                    if of.level == [LEVELS; 3] {
                        widest = widest.max(taken);
                    }
                }
            }
        }
    }
}
