//! The search of the best partition, and its entries.

use super::fit::Fitter;
use super::grid::{Batch, Grid};
use super::partition::{BOXES, Box3, Choice, LEVELS, boxes, partition};
use crate::error::BuildError;
use crate::progress::Watch;
use crate::sdf::domain::{Domain, ROOT};
use crate::sdf::truth::Truth;
use crate::sdf::widths::NEAR;
use meshsweep_core::SdfKind;
use meshsweep_core::internal::sdf::format::layout::tree::ENTRY_BYTES;

/// Part of an entry's price that a box costs at least for its halves to be fitted. Of a cheaper one
/// no half saves the price of its entry. While smaller boxes are looked at, the price mostly rises,
/// and seldom falls by a tenth.
const WORTH: f32 = 0.3;

/// The partition of each root cell. Boxes are fitted from large to small. Halves of a cheap box
/// get half of its cost without a fit.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub(super) fn search(
    truth: &Truth<'_>,
    domain: &Domain,
    most_entries: usize,
    watch: Watch<'_>,
) -> Result<Vec<Choice>, BuildError> {
    let is_cut = truth.kind != SdfKind::Signed;
    let roots = domain.cell_count();
    let grid = Grid::of(truth, domain, NEAR * domain.diagonal, watch.part(0.0, 0.5))?;
    let mut costs = vec![vec![0f32; BOXES]; roots];
    // The price of an entry if boxes are halved less often.
    let mut price = 0.0;
    let mut choices = Vec::new();
    for level in 0..=LEVELS {
        let part = |level: usize| 0.5 + 0.1 * level as f64;
        costs = watch.part(part(level), part(level + 1)).map(roots, |root| {
            let (mut batch, mut fitter) = (Batch::default(), Fitter::default());
            let mut costs = costs[root].clone();
            for (number, of) in boxes(domain.cell(root), level) {
                // A box that costs much less than an entry is not worth halving.
                if let Some(whole) = of.parent().map(|parent| costs[parent])
                    && whole < WORTH * price
                {
                    costs[number] = 0.5 * whole;
                    continue;
                }
                grid.fill(&of, &mut batch);
                let half = of.half() * (2.0 / ROOT);
                let volume = half.x * half.y * half.z;
                costs[number] = (fitter.fit(&batch, of.half(), is_cut).cost * volume) as f32;
            }
            costs
        })?;
        if level >= 2 {
            (choices, price) = partition(&costs, level, most_entries);
        }
    }
    Ok(choices)
}

/// A tree without its leaves' functions.
pub(in crate::sdf) struct Laid {
    /// Nodes as they stand, and leaves to be filled.
    pub(super) entries: Vec<[u8; ENTRY_BYTES]>,
    /// Numbers of the entries that are leaves, with their boxes.
    pub(super) leaves: Vec<(usize, Box3)>,
    /// The most entries that a question reads.
    pub(super) steps: u8,
}

/// The entries of the partition; `None` if a child is too far from its node.
pub(super) fn entries(domain: &Domain, choices: &[Choice]) -> Option<Laid> {
    let mut entries = vec![[0; ENTRY_BYTES]; choices.len()];
    let mut leaves = Vec::new();
    let mut steps = 0;
    for (root, choice) in choices.iter().enumerate() {
        let mut open = vec![(root, Box3::whole(domain.cell(root)), 1)];
        while let Some((number, of, depth)) = open.pop() {
            steps = steps.max(depth);
            let axes = choice.axes(&of);
            if axes == 0 {
                leaves.push((number, of));
                continue;
            }
            let first = entries.len();
            let [a, b] = u16::try_from(first - number - 1).ok()?.to_le_bytes();
            entries[number] = [a, b, 0, axes as u8, 0];
            let parts: Vec<Box3> = of.parts(axes).collect();
            entries.resize(first + parts.len(), [0; ENTRY_BYTES]);
            let children = parts.into_iter().enumerate();
            open.extend(children.rev().map(|(at, part)| (first + at, part, depth + 1)));
        }
    }
    Some(Laid { entries, leaves, steps })
}
