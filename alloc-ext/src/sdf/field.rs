//! The stages of a field, in order, and its report.

use super::allowed::{Allowed, widest};
use super::codes::{Codes, widths};
use super::domain::{CELL, Domain, bytes};
use super::encode::{Books, Stored, section};
use super::options::SdfOptions;
use super::prove::{Errors, FLOOR_OF_DIAGONAL, Proof, Prover, SLACK_OF_DIAGONAL};
use super::samples::{Sample, Samples};
use super::tree;
use super::truth::{Side, Truth};
use super::widths::Widths;
use crate::bvh::FileSides;
use crate::error::BuildError;
use crate::geom::Bounds;
use crate::mesh::Input;
use crate::progress::Watch;
use glam::DVec3;
use meshsweep_core::{SdfKind, SdfLayout};
use rayon::prelude::*;
use std::time::Duration;

/// Slack of a lattice's cells, at least so many units or [`SLACK_OF_DIAGONAL`].
const SLACK: [f64; 2] = [CELL / 400.0, SLACK_OF_DIAGONAL];

/// Boxes of no larger radius than so many units, or [`FLOOR_OF_DIAGONAL`], are not halved.
const FLOOR: [f64; 2] = [CELL / 160.0, FLOOR_OF_DIAGONAL];

fn of_field([units, part]: [f64; 2], domain: &Domain) -> f64 {
    units.max(part * domain.diagonal)
}

/// What a field is, and its proof. Lengths are in the mesh's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SdfReport {
    /// What distances mean.
    pub kind: SdfKind,
    /// Whether no kind was asked for and the mesh has no sides, so that a surface field was built.
    pub lacks_sides: bool,
    /// How the field lies in its bytes.
    pub layout: SdfLayout,
    /// Cells along each axis: of a tree its root cells.
    pub cells: [usize; 3],
    /// Cells of a lattice, or leaves of a tree.
    pub cell_count: usize,
    /// Entries that a question reads at most: 1 of a lattice.
    pub steps: u32,
    /// Bytes of the section.
    pub bytes: usize,
    /// Mean width of the intervals at the samples in the mesh's box and the margin, up to a tenth
    /// of the diagonal from the surface. Of a signed field all samples inside count too, of a solid
    /// one none.
    pub mean_width: f64,
    /// The same before the proof, and that of the other layout before a proof. `None` if one layout
    /// was asked for, or one has no room for its errors.
    pub drafted_widths: Option<[f64; 2]>,
    /// Largest width at those samples. Between them an interval that is cut at 0 may be wider.
    pub largest_width: f64,
    /// No interval in the field is wider: proved, with what f32 adds.
    pub widest: f64,
    /// Largest error of a lattice's cell, below or above; largest width of a tree's leaf.
    pub largest_error: f64,
    /// Cells with places whose side is undecided.
    pub undecided: usize,
    /// Boxes of the proof.
    pub boxes: usize,
    /// Cells whose errors grew in the proof.
    pub widened: usize,
    /// Time of the whole build.
    pub time: Duration,
}

/// A field, before it is a section.
pub(super) struct Field {
    pub body: Vec<u8>,
    pub report: SdfReport,
}

/// What fields of both layouts are made of.
#[derive(Clone, Copy)]
pub(super) struct Work<'a> {
    pub input: Input<'a>,
    pub surface: Bounds,
    pub options: &'a SdfOptions,
    pub kind: SdfKind,
    pub sides: Option<&'a FileSides>,
}

/// A lattice before its proof.
pub(super) struct Draft<'a> {
    domain: Domain,
    truth: Truth<'a>,
    samples: Samples,
    codes: Codes,
    stored: Stored,
    books: Books,
    allowed: Option<Allowed>,
}

impl Draft<'_> {
    pub fn bytes(&self) -> usize {
        bytes(self.domain.cells)
    }

    /// Whether the errors fit the books' numbers. A proof makes them no smaller.
    pub fn has_room(&self) -> bool {
        self.books.fit()
    }

    /// The mean width of intervals, in the mesh's unit.
    pub fn mean_width(&self, kind: SdfKind) -> f64 {
        let [mean, _] = self.widths(kind).found();
        mean / f64::from(self.domain.per_unit)
    }

    fn widths(&self, kind: SdfKind) -> Widths {
        let mut found = Widths::default();
        for cell in 0..self.domain.cell_count() {
            let [low, high] = self.books.errors(cell).map(f64::from);
            let errors = Errors { low, high };
            found.join(widths(&self.codes, &self.domain, &self.samples, cell, kind, errors));
        }
        found
    }

    /// How much of the allowed width the widest cell takes; 0 if all is allowed.
    pub fn taken(&self) -> f64 {
        let Some(allowed) = self.allowed else { return 0.0 };
        let taken = |cell| {
            let (lower, width) = self.interval(cell);
            allowed.taken(lower, width)
        };
        (0..self.domain.cell_count()).map(taken).fold(0.0, f64::max)
    }

    /// The least and the greatest lower end in a cell, and the width, units.
    fn interval(&self, cell: usize) -> ([f64; 2], f64) {
        let [low, high] = self.books.errors(cell).map(f64::from);
        (self.codes.lowest(&self.domain, cell, Errors { low, high }), low + high)
    }
}

impl<'a> Work<'a> {
    /// Why a field has no room for its errors.
    pub fn too_wide(&self) -> BuildError {
        let layout = self.options.layout.map(SdfLayout::name);
        BuildError::FieldTooWide { kind: self.kind.name(), layout, bytes: self.options.bytes }
    }

    /// The width that is allowed, if it is limited.
    fn allowed(&self, domain: &Domain) -> Option<Allowed> {
        let error = self.options.error?;
        Some(Allowed::new(error, self.options.relative, domain, self.kind))
    }

    /// How far the input may be from the mesh, units.
    fn off(&self, domain: &Domain) -> f64 {
        self.input.error_up() * f64::from(domain.per_unit) * (1.0 + 1e-6)
    }

    /// A lattice of at most so many bytes.
    pub fn draft(&self, most_bytes: usize, watch: Watch<'_>) -> Result<Draft<'a>, BuildError> {
        let kind = self.kind;
        let domain = Domain::of(&self.surface, self.options.margin, most_bytes)?;
        let allowed = self.allowed(&domain);
        let truth = Truth::new(self.input.mesh, domain, kind, self.sides);
        let truth = truth.with_off(self.off(&domain));
        watch.step(1, 8)?;
        let samples = Samples::of(&truth, &domain, watch.part(0.125, 0.875))?;
        let codes = Codes::of(&truth, &domain, &samples, allowed);
        watch.step(1, 1)?;
        let stored = Stored::new(self.off(&domain), codes.step);
        let slack = of_field(SLACK, &domain);
        let asked: Vec<[u32; 2]> = (0..domain.cell_count())
            .into_par_iter()
            .map(|cell| {
                let Errors { low, high } = codes.errors(&domain, &samples, cell, kind);
                stored.up(Errors { low: low + slack, high: high + slack })
            })
            .collect();
        let books = Books::of(&asked, &codes.weights);
        Ok(Draft { domain, truth, samples, codes, stored, books, allowed })
    }

    /// A lattice with its proof, and how much of the allowed width its widest cell takes.
    pub fn proved(
        &self,
        mut draft: Draft<'_>,
        watch: Watch<'_>,
    ) -> Result<(Field, f64), BuildError> {
        let kind = self.kind;
        let Draft { domain, truth, samples, codes, stored, books, .. } = &mut draft;
        let floor = of_field(FLOOR, domain);
        let proofs = watch.map(domain.cell_count(), |cell| {
            let corner = DVec3::from(domain.cell(cell).map(|at| at as f64)) * CELL;
            let wanted = stored.errors(books.errors(cell));
            let boxed = [corner, DVec3::splat(CELL)];
            Prover::cell(truth, codes.function(domain, cell), boxed, wanted, floor)
        })?;
        let proved = |(cell, proof): (usize, &Proof)| match proof.is_widened {
            true => stored.up(proof.errors),
            false => books.errors(cell),
        };
        let needed: Vec<[u32; 2]> = proofs.iter().enumerate().map(proved).collect();
        books.hold(&needed);
        let body = section(domain, kind, codes, books).ok_or(self.too_wide())?;
        let has_doubt = |cell: &usize| {
            let is_in_doubt = |sample: &Sample| sample.side == Side::Undecided;
            proofs[*cell].is_undecided
                || samples.cell(domain.cell(*cell)).any(|sample| is_in_doubt(&sample))
        };
        let undecided = (0..domain.cell_count()).filter(has_doubt).count();
        let (cells, in_units) = (domain.cells, 1.0 / f64::from(domain.per_unit));
        let widest = |cell| {
            let (lower, width) = draft.interval(cell);
            widest(kind, lower, width)
        };
        let largest = needed.iter().flatten().max().map_or(0.0, |&error| f64::from(error));
        let [mean_width, largest_width] = draft.widths(kind).found().map(|width| width * in_units);
        let report = SdfReport {
            kind,
            layout: SdfLayout::Lattice,
            lacks_sides: false,
            cells,
            cell_count: proofs.len(),
            steps: 1,
            bytes: body.len(),
            mean_width,
            drafted_widths: None,
            largest_width,
            widest: (0..proofs.len()).map(widest).fold(0.0, f64::max) * in_units,
            largest_error: largest * in_units,
            undecided,
            boxes: proofs.iter().map(|proof| proof.boxes).sum(),
            widened: proofs.iter().filter(|proof| proof.is_widened).count(),
            time: Duration::ZERO,
        };
        Ok((Field { body, report }, draft.taken()))
    }

    /// Makes something of trees of a domain.
    pub fn with_maker<T>(
        &self,
        domain: &Domain,
        watch: Watch<'_>,
        make: impl FnOnce(&tree::Maker<'_>, Watch<'_>) -> Result<T, BuildError>,
    ) -> Result<T, BuildError> {
        // More than any bound of a tree, in units: the core refuses a field whose bounds overflow.
        if ((1u32 << 22) as f32 / domain.per_unit).is_infinite() {
            let size = self.surface.high - self.surface.low;
            return Err(BuildError::FieldUnit { side: size.max_element() });
        }
        let (off, allowed) = (self.off(domain), self.allowed(domain));
        let truth = Truth::new(self.input.mesh, *domain, self.kind, self.sides);
        let truth = &truth.with_off(off);
        watch.step(2, 100)?;
        make(&tree::Maker { truth, domain, off, allowed }, watch.part(0.02, 1.0))
    }

    /// The field of a tree.
    pub fn of_tree(&self, domain: &Domain, tree: tree::Tree) -> Field {
        let in_units = 1.0 / f64::from(domain.per_unit);
        let [mean_width, largest_width] = tree.widths.found().map(|width| width * in_units);
        let report = SdfReport {
            kind: self.kind,
            layout: SdfLayout::Tree,
            lacks_sides: false,
            cells: domain.cells,
            cell_count: tree.leaves,
            steps: tree.steps,
            bytes: tree.section.len(),
            mean_width,
            drafted_widths: None,
            largest_width,
            widest: tree.widest * in_units,
            largest_error: f64::from(tree.largest) * in_units,
            undecided: tree.undecided,
            boxes: tree.boxes,
            widened: tree.widened,
            time: Duration::ZERO,
        };
        Field { body: tree.section, report }
    }
}
