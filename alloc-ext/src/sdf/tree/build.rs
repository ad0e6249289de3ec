//! The stages of a tree's build, and its bytes.

use super::codes::{Coded, Scale};
use super::fit::{Fitted, Fitter};
use super::grid::Batch;
use super::leaf::{Leaf, entry, losses};
use super::partition::Box3;
use super::search::{entries, search};
use crate::error::BuildError;
use crate::progress::Watch;
use crate::sdf::books::{self, book};
use crate::sdf::domain::{Domain, ROOT};
use crate::sdf::prove::{Errors, Proof, Prover};
use crate::sdf::region::MARGIN;
use crate::sdf::samples::{Sample, of_box};
use crate::sdf::truth::{Side, Truth};
use crate::sdf::widths::{NEAR, Widths};
use glam::DVec3;
use meshsweep_core::internal::sdf::format::SdfHeader;
use meshsweep_core::internal::sdf::format::layout::tree::{ENTRY_BYTES, MOST_ENTRIES, WIDTHS};
use meshsweep_core::internal::sdf::format::layout::{BOOK, SDF_BYTES};
use meshsweep_core::{SdfKind, SdfLayout};

/// As of a lattice, parts of the diagonal: slack of wanted errors, and the least radius of a box.
const SLACK: f64 = 1e-4;
const FLOOR: f64 = 3e-4;

/// The least radius of a box, as a part of the leaf's width, if that is more. Large leaves have too
/// many boxes of the other.
const FLOOR_OF_WIDTH: f64 = 1.0 / 16.0;

/// Steps along each side of a leaf at whose places it is fitted at last: of most leaves, and of
/// those with a side of more than a quarter of a root cell's.
const STEPS: [usize; 2] = [8, 12];

/// A tree.
pub(in crate::sdf) struct Tree {
    pub section: Vec<u8>,
    pub widths: Widths,
    pub steps: u32,
    pub leaves: usize,
    /// Largest width of a leaf, units.
    pub largest: u32,
    /// Leaves with places whose side is undecided.
    pub undecided: usize,
    pub boxes: usize,
    pub widened: usize,
}

/// A leaf in progress.
struct Made {
    of: Box3,
    /// Number of its entry.
    number: usize,
    samples: Vec<Sample>,
    /// Steps between them along each side.
    steps: usize,
    fitted: Fitted,
}

impl Made {
    /// How much of an error above is added for rounding and for how far the mesh may be off.
    fn losses(&self, off: f64) -> [f64; 2] {
        losses(self.fitted.shape, self.of.half()).map(|loss| loss + off + MARGIN)
    }

    /// The function's value at the centre that its samples allow, with slack.
    fn offset(&self, off: f64, slack: f64) -> f64 {
        let [_, above] = self.losses(off);
        -self.fitted.errors.low - above - slack
    }

    /// Weight of the leaf's width.
    fn weight(&self, batch: &mut Batch, kind: SdfKind, near: f64) -> f64 {
        batch.fill(&self.samples, self.steps, kind, near);
        let sum: f64 = batch.weight.iter().map(|&weight| f64::from(weight)).sum();
        (sum / batch.weight.len() as f64 + 1e-3) * self.volume()
    }

    /// In root cells.
    fn volume(&self) -> f64 {
        let half = self.of.half() * (2.0 / ROOT);
        half.x * half.y * half.z
    }

    /// Where a sample is, units.
    fn place(&self, number: usize) -> DVec3 {
        let side = self.steps + 1;
        let at = [number % side, number / side % side, number / (side * side)];
        let step = 2.0 * self.of.half() / self.steps as f64;
        self.of.corner() + DVec3::from(at.map(|at| at as f64)) * step
    }

    fn is_undecided(&self) -> bool {
        self.samples.iter().any(|sample| sample.side == Side::Undecided)
    }
}

/// Builds a tree; `None` of a field that does not fit its numbers. `off` is how far the input may
/// be from the mesh, units.
pub(in crate::sdf) fn build(
    truth: &Truth<'_>,
    domain: &Domain,
    off: f64,
    most_bytes: usize,
    watch: Watch<'_>,
) -> Result<Option<Tree>, BuildError> {
    let kind = truth.kind;
    let is_cut = kind != SdfKind::Signed;
    let (near, slack) = (NEAR * domain.diagonal, SLACK * domain.diagonal);
    let most_entries = (most_bytes.saturating_sub(SDF_BYTES) / ENTRY_BYTES).min(MOST_ENTRIES);
    if domain.cell_count() > most_entries {
        return Ok(None);
    }
    let choices = search(truth, domain, most_entries, watch.part(0.0, 0.5))?;
    let Some((mut entries, leaves, steps)) = entries(domain, &choices) else { return Ok(None) };
    let leaves = watch.part(0.5, 0.65).map(leaves.len(), |leaf| {
        let (number, of) = leaves[leaf];
        let steps = STEPS[usize::from(of.half().max_element() > ROOT / 8.0 + 1.0)];
        let samples = of_box(truth, of.corner(), 2.0 * of.half(), steps);
        let (mut batch, mut fitter) = (Batch::default(), Fitter::default());
        batch.fill(&samples, steps, kind, near);
        let first = fitter.fit(&batch, of.half(), is_cut);
        let fitted = fitter.polish(&batch, of.half(), is_cut, first);
        Made { of, number, samples, steps, fitted }
    })?;
    let offsets: Vec<f64> = leaves.iter().map(|leaf| leaf.offset(off, slack)).collect();
    let Some(scale) = Scale::of(offsets.iter().copied()) else { return Ok(None) };
    // The width that holds an error above of the function with the value 0 at the centre.
    let width = |leaf: &Made, code: i64, high: f64| {
        let [below, _] = leaf.losses(off);
        (high - scale.value(code) + below).ceil().clamp(0.0, 1e9) as u32
    };
    let asked: Vec<Coded> = (leaves.iter().zip(&offsets))
        .map(|(leaf, &offset)| {
            let code = scale.code(offset);
            Coded { code, width: width(leaf, code, leaf.fitted.errors.high + slack) }
        })
        .collect();
    let mut batch = Batch::default();
    let weights: Vec<f64> = leaves.iter().map(|leaf| leaf.weight(&mut batch, kind, near)).collect();
    let widths: Vec<u32> = asked.iter().map(|coded| coded.width).collect();
    let first: [u32; WIDTHS] = book(&widths, &weights);
    let held = |leaf: &Made, code: i64, width: u32| {
        let [below, above] = leaf.losses(off);
        (scale.value(code), Errors { low: -above, high: f64::from(width) - below })
    };
    let proofs = watch.part(0.65, 1.0).map(leaves.len(), |number| {
        let (leaf, Coded { code, width }) = (&leaves[number], asked[number]);
        let width = first[books::entry(&first, width)];
        let (offset, wanted) = held(leaf, code, width);
        let half = leaf.of.half();
        let function = Leaf { half, shape: leaf.fitted.shape, offset };
        let boxed = [leaf.of.corner(), 2.0 * half];
        let floor = (FLOOR * domain.diagonal).max(FLOOR_OF_WIDTH * f64::from(width));
        Prover::cell(truth, function, boxed, wanted, floor)
    })?;
    let mut needed: Vec<Coded> = (leaves.iter().zip(&asked).zip(&proofs))
        .map(|((leaf, &coded), proof)| {
            if !proof.is_widened {
                return Coded { width: first[books::entry(&first, coded.width)], ..coded };
            }
            let (offset, wanted) = held(leaf, coded.code, 0);
            let down = ((proof.errors.low - wanted.low) / scale.step()).ceil();
            let code = coded.code - down as i64;
            Coded { code, width: width(leaf, code, offset + proof.errors.high) }
        })
        .collect();
    let Some(scale) = scale.holding(&mut needed) else { return Ok(None) };
    // The entries that were proved, and the widths that had to grow, have one book more.
    let widths: Vec<u32> = needed.iter().map(|coded| coded.width).collect();
    let book: [u32; WIDTHS] = book(&widths, &weights);
    if book[WIDTHS - 1] > u32::from(u16::MAX) {
        return Ok(None);
    }
    let (mut found, mut largest) = (Widths::default(), 0);
    let mut fitter = Fitter::default();
    for (leaf, &Coded { code, width }) in leaves.iter().zip(&needed) {
        let place = books::entry(&book, width);
        let Some(bytes) = entry(leaf.fitted.shape, code, place) else { return Ok(None) };
        entries[leaf.number] = bytes;
        let weight = leaf.volume() / leaf.samples.len() as f64;
        batch.fill(&leaf.samples, leaf.steps, kind, near);
        let values = fitter.values(&batch, leaf.of.half(), leaf.fitted.shape);
        for (number, (value, &sample)) in values.iter().zip(&leaf.samples).enumerate() {
            if !domain.is_asked(leaf.place(number)) {
                continue;
            }
            let lower = f64::from(*value) + scale.value(code);
            found.add(sample, kind, near, [lower, lower + f64::from(book[place])], weight);
        }
        largest = largest.max(book[place]);
    }
    let book = book.map(|width| width as u16);
    let [low, high] = [0, BOOK].map(|from| std::array::from_fn(|k| book[from + k]));
    let header = SdfHeader {
        origin: domain.origin,
        per_unit: domain.per_unit,
        unit: domain.unit,
        base: scale.base,
        step: scale.step,
        kind,
        layout: SdfLayout::Tree,
        cells: domain.cells.map(|count| count as u8),
        steps,
        low,
        high,
    };
    let mut section = header.write().to_vec();
    section.extend(entries.into_flattened());
    let is_undecided = |(leaf, proof): &(&Made, &Proof)| proof.is_undecided || leaf.is_undecided();
    Ok(Some(Tree {
        section,
        widths: found,
        steps: u32::from(steps),
        leaves: leaves.len(),
        largest,
        undecided: leaves.iter().zip(&proofs).filter(is_undecided).count(),
        boxes: proofs.iter().map(|proof| proof.boxes).sum(),
        widened: proofs.iter().filter(|proof| proof.is_widened).count(),
    }))
}
