//! The stages of a tree's build, and its bytes.

use super::codes::{Coded, Scale};
use super::encode::section;
use super::fit::{Fitted, Fitter};
use super::grid::Batch;
use super::leaf::{Leaf, Shape, entry, losses};
use super::partition::Box3;
use super::search::{Laid, entries, search};
use crate::error::BuildError;
use crate::progress::Watch;
use crate::sdf::allowed::{Allowed, widest};
use crate::sdf::books::{self, book};
use crate::sdf::domain::{Domain, ROOT};
use crate::sdf::function::{Function, Linear};
use crate::sdf::prove::{Errors, FLOOR_OF_DIAGONAL, Proof, Prover, SLACK_OF_DIAGONAL};
use crate::sdf::region::MARGIN;
use crate::sdf::samples::{Sample, of_box};
use crate::sdf::truth::{Side, Truth};
use crate::sdf::widths::{LEAST_WEIGHT, NEAR, Widths};
use glam::DVec3;
use meshsweep_core::SdfKind;
use meshsweep_core::internal::sdf::format::layout::SDF_BYTES;
use meshsweep_core::internal::sdf::format::layout::tree::{ENTRY_BYTES, MOST_ENTRIES, WIDTHS};

/// Boxes of no larger radius than this part of the leaf's width are not halved either. Else large
/// leaves would be proved by too many boxes.
const FLOOR_OF_WIDTH: f64 = 1.0 / 16.0;

/// The same of a second proof, where widths are limited and the first makes a leaf wider. It saves
/// 5 % of the bytes of the bracket's field for ±2 % of the diagonal (*historical*).
const FINER_OF_WIDTH: f64 = 1.0 / 64.0;

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
    /// No answer is wider, units.
    pub widest: f64,
    /// Leaves with places whose side is undecided.
    pub undecided: usize,
    pub boxes: usize,
    pub widened: usize,
}

/// A leaf in progress.
pub(in crate::sdf) struct Made {
    of: Box3,
    samples: Vec<Sample>,
    /// Steps between them along each side.
    steps: usize,
    fitted: Fitted,
}

impl Made {
    /// How far a query's value may be below and above the function, and the mesh from the input,
    /// units.
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
        (sum / batch.weight.len() as f64 + LEAST_WEIGHT) * self.volume()
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

/// What trees of a mesh are made of.
#[derive(Clone, Copy)]
pub(in crate::sdf) struct Maker<'a> {
    pub truth: &'a Truth<'a>,
    pub domain: &'a Domain,
    /// How far the input may be from the mesh, units.
    pub off: f64,
    pub allowed: Option<Allowed>,
}

/// Why leaves make no tree.
pub(in crate::sdf) enum Failure {
    /// These take more than 1 of the allowed width: so much.
    TooWide(Vec<(usize, f64)>),
    /// The field does not fit the numbers of a tree.
    NoRoom,
}

/// Leaves with codes and widths that samples need, before their proof.
pub(in crate::sdf) struct Draft<'a> {
    laid: Laid,
    leaves: Vec<&'a Made>,
    scale: Scale,
    asked: Vec<Coded>,
    weights: Vec<f64>,
    book: [u32; WIDTHS],
}

/// The leaves of the best partition into so many bytes; `None` of a field that does not fit the
/// numbers of a tree.
pub(in crate::sdf) fn leaves(
    maker: &Maker<'_>,
    most_bytes: usize,
    watch: Watch<'_>,
) -> Result<Option<(Laid, Vec<Made>)>, BuildError> {
    let Maker { truth, domain, .. } = *maker;
    let most_entries = most_entries(most_bytes);
    if domain.cell_count() > most_entries {
        return Ok(None);
    }
    let choices = search(truth, domain, most_entries, watch.part(0.0, 0.75))?;
    let Some(laid) = entries(domain, &choices) else { return Ok(None) };
    let made =
        watch.part(0.75, 1.0).map(laid.leaves.len(), |leaf| maker.made(laid.leaves[leaf].1))?;
    Ok(Some((laid, made)))
}

/// Entries of a tree of so many bytes.
pub(super) fn most_entries(most_bytes: usize) -> usize {
    (most_bytes.saturating_sub(SDF_BYTES) / ENTRY_BYTES).min(MOST_ENTRIES)
}

impl Maker<'_> {
    /// Distance from the surface up to which a box's fit looks at all samples, units. Where widths
    /// are limited all of them count.
    pub(super) fn near(&self) -> f64 {
        match self.allowed {
            Some(_) => f64::INFINITY,
            None => NEAR * self.domain.diagonal,
        }
    }

    pub(super) fn is_cut(&self) -> bool {
        self.truth.kind != SdfKind::Signed
    }

    fn slack(&self) -> f64 {
        SLACK_OF_DIAGONAL * self.domain.diagonal
    }

    /// How much of the allowed width a leaf takes with this value at its centre; 0 if all is
    /// allowed.
    fn taken(&self, half: DVec3, shape: Shape, value: f64, width: f64) -> f64 {
        let lower = lowest(half, shape, value);
        self.allowed.map_or(0.0, |allowed| allowed.taken(lower, width))
    }

    /// The same of a box that samples fitted, with a code that is off by a step.
    pub(super) fn taken_by(&self, half: DVec3, fitted: &Fitted, step: f64) -> f64 {
        let [below, above] = losses(fitted.shape, half).map(|loss| loss + self.off + MARGIN);
        let Errors { low, high } = fitted.errors;
        let value = -low - above - self.slack() - step;
        self.taken(half, fitted.shape, value, high + self.slack() - value + below + 1.0)
    }

    /// A leaf, fitted at last.
    pub(super) fn made(&self, of: Box3) -> Made {
        let steps = STEPS[usize::from(of.half().max_element() > ROOT / 8.0 + 1.0)];
        let samples = of_box(self.truth, [of.corner(), 2.0 * of.half()], steps);
        let (mut batch, mut fitter) = (Batch::default(), Fitter::default());
        batch.fill(&samples, steps, self.truth.kind, self.near());
        let first = fitter.fit(&batch, of.half(), self.is_cut());
        let fitted = fitter.polish(&batch, of.half(), self.is_cut(), first);
        Made { of, samples, steps, fitted }
    }

    /// Codes, books and proofs of leaves.
    pub(super) fn finish(
        &self,
        laid: Laid,
        leaves: Vec<&Made>,
        watch: Watch<'_>,
    ) -> Result<Result<Tree, Failure>, BuildError> {
        match self.draft(laid, leaves) {
            Ok(draft) => self.proved(draft, watch),
            Err(failure) => Ok(Err(failure)),
        }
    }

    /// The width that holds an error above of the function with the value 0 at the centre.
    fn width(&self, leaf: &Made, scale: Scale, code: i64, high: f64) -> u32 {
        let [below, _] = leaf.losses(self.off);
        (high - scale.value(code) + below).ceil().clamp(0.0, 1e9) as u32
    }

    /// Codes and a book as the samples of leaves need them.
    pub(in crate::sdf) fn draft<'a>(
        &self,
        laid: Laid,
        leaves: Vec<&'a Made>,
    ) -> Result<Draft<'a>, Failure> {
        let (off, slack, near) = (self.off, self.slack(), NEAR * self.domain.diagonal);
        let offsets: Vec<f64> = leaves.iter().map(|leaf| leaf.offset(off, slack)).collect();
        let scale = Scale::of(offsets.iter().copied()).ok_or(Failure::NoRoom)?;
        let asked: Vec<Coded> = (leaves.iter().zip(&offsets))
            .map(|(leaf, &offset)| {
                let code = scale.code(offset);
                let high = leaf.fitted.errors.high + slack;
                Coded { code, width: self.width(leaf, scale, code, high) }
            })
            .collect();
        let mut batch = Batch::default();
        let mut weight = |leaf: &&Made| leaf.weight(&mut batch, self.truth.kind, near);
        let weights: Vec<f64> = leaves.iter().map(&mut weight).collect();
        let widths: Vec<u32> = asked.iter().map(|coded| coded.width).collect();
        let book: [u32; WIDTHS] = book(&widths, &weights);
        self.check_widths(&leaves, scale, &asked, &book)?;
        // A proof makes them no smaller.
        if book[WIDTHS - 1] > u32::from(u16::MAX) {
            return Err(Failure::NoRoom);
        }
        Ok(Draft { laid, leaves, scale, asked, weights, book })
    }

    /// Refuses leaves that are wider than allowed with the entries of a book.
    fn check_widths(
        &self,
        leaves: &[&Made],
        scale: Scale,
        coded: &[Coded],
        book: &[u32; WIDTHS],
    ) -> Result<(), Failure> {
        let taken = |(leaf, &Coded { code, width }): (usize, &Coded)| {
            let (of, width) = (leaves[leaf], book[books::entry(book, width)]);
            let value = scale.value(code);
            (leaf, self.taken(of.of.half(), of.fitted.shape, value, f64::from(width)))
        };
        let wide: Vec<(usize, f64)> =
            coded.iter().enumerate().map(taken).filter(|&(_, taken)| taken > 1.0).collect();
        if wide.is_empty() { Ok(()) } else { Err(Failure::TooWide(wide)) }
    }

    /// The widths of leaves at their samples, with the entries of a book.
    fn widths(
        &self,
        draft: &Draft<'_>,
        scale: Scale,
        coded: &[Coded],
        book: &[u32; WIDTHS],
    ) -> Widths {
        let (kind, near) = (self.truth.kind, NEAR * self.domain.diagonal);
        let (mut found, mut batch, mut fitter) =
            (Widths::default(), Batch::default(), Fitter::default());
        for (leaf, &Coded { code, width }) in draft.leaves.iter().zip(coded) {
            let (shape, half) = (leaf.fitted.shape, leaf.of.half());
            let weight = leaf.volume() / leaf.samples.len() as f64;
            batch.fill(&leaf.samples, leaf.steps, kind, near);
            let (value, wide) = (scale.value(code), f64::from(book[books::entry(book, width)]));
            for (number, (more, &sample)) in
                fitter.values(&batch, half, shape).iter().zip(&leaf.samples).enumerate()
            {
                if self.domain.is_asked(leaf.place(number)) {
                    let lower = f64::from(*more) + value;
                    found.add(sample, kind, near, [lower, lower + wide], weight);
                }
            }
        }
        found
    }

    /// The mean width of a draft's intervals, units.
    pub(in crate::sdf) fn mean_width(&self, draft: &Draft<'_>) -> f64 {
        let [mean, _] = self.widths(draft, draft.scale, &draft.asked, &draft.book).found();
        mean
    }

    /// The tree of a draft: its leaves are proved, and widened where the proof needs it.
    pub(in crate::sdf) fn proved(
        &self,
        draft: Draft<'_>,
        watch: Watch<'_>,
    ) -> Result<Result<Tree, Failure>, BuildError> {
        let Self { truth, domain, off, .. } = *self;
        let kind = truth.kind;
        let Draft { leaves, scale, asked, weights, book: first, .. } = &draft;
        let held = |leaf: &Made, code: i64, width: u32| {
            let [below, above] = leaf.losses(off);
            (scale.value(code), Errors { low: -above, high: f64::from(width) - below })
        };
        let proofs = watch.map(leaves.len(), |number| {
            let (leaf, Coded { code, width }) = (leaves[number], asked[number]);
            let width = first[books::entry(first, width)];
            let (offset, wanted) = held(leaf, code, width);
            let half = leaf.of.half();
            let function = Leaf { half, shape: leaf.fitted.shape, offset };
            let boxed = [leaf.of.corner(), 2.0 * half];
            let floor =
                |part: f64| (FLOOR_OF_DIAGONAL * domain.diagonal).max(part * f64::from(width));
            let prove = |part| Prover::cell(truth, function, boxed, wanted, floor(part));
            let proof = prove(FLOOR_OF_WIDTH);
            // A leaf that is too wide is halved: smaller boxes cost less.
            if proof.is_widened && self.allowed.is_some() {
                let finer = prove(FINER_OF_WIDTH);
                let sum = |proof: &Proof| proof.errors.low + proof.errors.high;
                let boxes = proof.boxes + finer.boxes;
                Proof { boxes, ..if sum(&finer) < sum(&proof) { finer } else { proof } }
            } else {
                proof
            }
        })?;
        let mut needed: Vec<Coded> = (leaves.iter().zip(asked).zip(&proofs))
            .map(|((leaf, &coded), proof)| {
                if !proof.is_widened {
                    return Coded { width: first[books::entry(first, coded.width)], ..coded };
                }
                let (offset, wanted) = held(leaf, coded.code, 0);
                let down = ((proof.errors.low - wanted.low) / scale.step()).ceil();
                let code = coded.code - down as i64;
                Coded { code, width: self.width(leaf, *scale, code, offset + proof.errors.high) }
            })
            .collect();
        let Some(scale) = scale.holding(&mut needed) else { return Ok(Err(Failure::NoRoom)) };
        // Some widths grew in the proof, so the book is made again. Each width is rounded up to a
        // value of the new book, so the proofs still hold.
        let widths: Vec<u32> = needed.iter().map(|coded| coded.width).collect();
        let book: [u32; WIDTHS] = book(&widths, weights);
        if let Err(failure) = self.check_widths(leaves, scale, &needed, &book) {
            return Ok(Err(failure));
        }
        if book[WIDTHS - 1] > u32::from(u16::MAX) {
            return Ok(Err(Failure::NoRoom));
        }
        let found = self.widths(&draft, scale, &needed, &book);
        let Draft { laid: Laid { mut entries, leaves: places, steps }, leaves, .. } = draft;
        let (mut largest, mut most) = (0, 0f64);
        for ((leaf, &Coded { code, width }), &(number, _)) in
            leaves.iter().zip(&needed).zip(&places)
        {
            let place = books::entry(&book, width);
            let (shape, half) = (leaf.fitted.shape, leaf.of.half());
            let Some(bytes) = entry(shape, code, place) else { return Ok(Err(Failure::NoRoom)) };
            entries[number] = bytes;
            largest = largest.max(book[place]);
            let lower = lowest(half, shape, scale.value(code));
            most = most.max(widest(kind, lower, f64::from(book[place])));
        }
        let section = section(domain, kind, scale, steps, &book, entries);
        let is_undecided =
            |(leaf, proof): &(&&Made, &Proof)| proof.is_undecided || leaf.is_undecided();
        Ok(Ok(Tree {
            section,
            widths: found,
            steps: u32::from(steps),
            leaves: leaves.len(),
            largest,
            widest: most,
            undecided: leaves.iter().zip(&proofs).filter(is_undecided).count(),
            boxes: proofs.iter().map(|proof| proof.boxes).sum(),
            widened: proofs.iter().filter(|proof| proof.is_widened).count(),
        }))
    }
}

/// The least and the greatest lower end in a leaf with this value at its centre, units.
fn lowest(half: DVec3, shape: Shape, value: f64) -> [f64; 2] {
    let Linear { value, gradient, rest } = Leaf { half, shape, offset: value }.about(half, half);
    let rise = gradient.abs().dot(half) + rest;
    let [below, above] = losses(shape, half);
    [value - rise - below, value + rise + above]
}
