//! The stages of a field's build, in order, and their report.

use super::codes::{Codes, widths};
use super::domain::{CELL, Domain, bytes};
use super::encode::{Books, Stored, section};
use super::prove::{Errors, Proof, Prover};
use super::samples::Samples;
use super::tree;
use super::truth::{Side, Truth};
use super::widths::Widths;
use crate::bvh::FileSides;
use crate::clock::Instant;
use crate::emit::Sections;
use crate::error::BuildError;
use crate::geom::Bounds;
use crate::mesh::Input;
use crate::progress::{Stage, Watch};
use crate::surface::scale_exponent;
use glam::{DVec3, Vec3};
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::num::{exp2, up_to_f32};
use meshsweep_core::internal::sdf::format::layout::{SDF_BYTES, tree as tree_layout};
use meshsweep_core::{SdfKind, SdfLayout, SectionKind};
use rayon::prelude::*;
use std::time::Duration;

/// Bytes of a field unless told otherwise.
pub const BYTES: u32 = 16 << 10;

/// Bytes of the smallest tree: the header and one leaf.
const LEAST_OF_TREE: u32 = (SDF_BYTES + tree_layout::ENTRY_BYTES) as u32;

/// Wanted errors are above those of the samples, at least by the greater of so many units and of a
/// part of the diagonal. Samples miss what lies between them, and a proof without slack never ends.
const SLACK: [f64; 2] = [CELL / 400.0, 1e-4];

/// Boxes of no larger radius are not halved: so many units, and a part of the diagonal.
const FLOOR: [f64; 2] = [CELL / 160.0, 3e-4];

fn of_field([units, part]: [f64; 2], domain: &Domain) -> f64 {
    units.max(part * domain.diagonal)
}

/// How to build a field.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SdfOptions {
    /// Most bytes of the section. The header and one cell of a lattice take 105: of fewer bytes
    /// there is this lattice. One leaf of a tree takes 101: of fewer bytes there is no tree, and
    /// [`BuildError::FieldTooSmall`] if one was asked for.
    pub bytes: u32,
    /// Distance about the mesh's box that the field covers, in the mesh's unit. `None`: a tenth of
    /// the box's diagonal.
    pub margin: Option<f64>,
    /// What distances mean. `None`: signed if the mesh is closed and has sides, else surface.
    pub kind: Option<SdfKind>,
    /// How the field lies in its bytes. `None`: both are built, and the one of the smaller mean
    /// width is kept.
    pub layout: Option<SdfLayout>,
}

impl Default for SdfOptions {
    fn default() -> Self {
        Self { bytes: BYTES, margin: None, kind: None, layout: None }
    }
}

impl SdfOptions {
    setters! {
        /// Sets the [bytes](Self::bytes).
        with_bytes: u32 => bytes,
        /// Sets the [margin](Self::margin).
        with_margin: Option<f64> => margin,
        /// Sets the [kind](Self::kind).
        with_kind: Option<SdfKind> => kind,
        /// Sets the [layout](Self::layout).
        with_layout: Option<SdfLayout> => layout,
    }
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
    /// Mean width of the intervals at the samples in the mesh's box and the margin, up to a tenth of
    /// the diagonal from the surface. Of a signed field all samples inside count too, of a solid one
    /// none.
    pub mean_width: f64,
    /// The same of the other layout, if it was built too.
    pub other_width: Option<f64>,
    /// Largest width at those samples. Between them an interval that is cut at 0 may be wider.
    pub largest_width: f64,
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

/// Builds the field of a mesh. Same mesh and options, same bytes, on any number of threads.
///
/// Cost: some seconds, for samples and proof. `watch` can end it.
///
/// # Errors
/// [`BuildError::Empty`]: no triangle. [`BuildError::NegativeMargin`].
/// [`BuildError::MarginTooLarge`]: mesh and margin leave the range of f32.
/// [`BuildError::FieldUnit`]: a unit is no normal f32, or f32 cannot place the lattice about the
/// mesh. [`BuildError::NoSides`]: a signed or solid field of a mesh that is not closed, or whose
/// walls were merged. [`BuildError::FieldTooSmall`]: a tree of fewer bytes than one leaf takes.
/// [`BuildError::FieldTooWide`]: an error does not fit 16 bits, in any layout that was asked for.
/// [`BuildError::Cancelled`].
pub fn build(
    input: Input<'_>,
    options: &SdfOptions,
    watch: Watch<'_>,
) -> Result<(Sections, SdfReport), BuildError> {
    let watch = watch.during(Stage::Sdf);
    let started = Instant::now();
    let mesh = input.mesh;
    let corners = mesh.all_corners_f64().flatten();
    let bounds = corners.fold(Bounds::EMPTY, Bounds::with);
    if mesh.all_triangles().next().is_none() {
        return Err(BuildError::Empty);
    }
    let surface = bounds.grown(input.error_up());
    let sides = match options.kind {
        Some(SdfKind::Surface) => None,
        _ => FileSides::of(mesh)?,
    };
    let lacks_sides = sides.is_none() && options.kind != Some(SdfKind::Surface);
    let kind = match (options.kind, lacks_sides) {
        (Some(kind), true) => return Err(BuildError::NoSides { kind: kind.name() }),
        (Some(kind), false) => kind,
        (None, true) => SdfKind::Surface,
        (None, false) => SdfKind::Signed,
    };
    let of = Work { input, surface, options, kind, sides: sides.as_ref() };
    let is_wanted = |layout| options.layout.is_none_or(|wanted| wanted == layout);
    let lattice = match is_wanted(SdfLayout::Lattice) {
        true => match of.lattice(watch.part(0.0, 0.5)) {
            Err(BuildError::FieldTooWide { .. }) => None,
            found => Some(found?),
        },
        false => None,
    };
    if options.layout == Some(SdfLayout::Tree) && options.bytes < LEAST_OF_TREE {
        return Err(BuildError::FieldTooSmall { bytes: options.bytes, least: LEAST_OF_TREE });
    }
    let tree = match is_wanted(SdfLayout::Tree) {
        // A unit of a tree is smaller: what f32 cannot place may fit a lattice.
        true => match of.tree(watch.part(0.5, 1.0)) {
            Err(BuildError::FieldUnit { .. }) if lattice.is_some() => None,
            found => found?,
        },
        false => None,
    };
    let width = |field: &Option<Field>| field.as_ref().map(|field| field.report.mean_width);
    let widths = [width(&lattice), width(&tree)];
    let is_narrower = widths[1].is_some_and(|tree| widths[0].is_none_or(|other| tree < other));
    let (field, other) = if is_narrower { (tree, widths[0]) } else { (lattice, widths[1]) };
    let Some(Field { body, report }) = field else {
        return Err(too_wide(kind, options));
    };
    let time = started.elapsed();
    let report = SdfReport { lacks_sides, other_width: other, time, ..report };
    let scale = scale_exponent(mesh);
    let local = exp2(-scale);
    let corner = |p: DVec3| -> Vec3 { (p * local).as_vec3() };
    let header = Sections::new(
        scale,
        up_to_f32(input.error_up() * local),
        input.triangle_count(),
        Aabb { min: corner(bounds.low), max: corner(bounds.high) },
        vec![(SectionKind::Sdf, body)],
    );
    Ok((header, report))
}

/// Why a field has no room for its errors.
fn too_wide(kind: SdfKind, options: &SdfOptions) -> BuildError {
    let layout = options.layout.map(SdfLayout::name);
    BuildError::FieldTooWide { kind: kind.name(), layout, bytes: options.bytes }
}

/// A field, before it is a section.
struct Field {
    body: Vec<u8>,
    report: SdfReport,
}

/// What fields of both layouts are made of.
#[derive(Clone, Copy)]
struct Work<'a> {
    input: Input<'a>,
    surface: Bounds,
    options: &'a SdfOptions,
    kind: SdfKind,
    sides: Option<&'a FileSides>,
}

impl Work<'_> {
    /// How far the input may be from the mesh, units.
    fn off(&self, domain: &Domain) -> f64 {
        self.input.error_up() * f64::from(domain.per_unit) * (1.0 + 1e-6)
    }

    fn lattice(&self, watch: Watch<'_>) -> Result<Field, BuildError> {
        let Self { kind, options, .. } = *self;
        let domain = Domain::of(&self.surface, options.margin, options.bytes as usize)?;
        let truth = Truth::new(self.input.mesh, domain, kind, self.sides);
        watch.step(5, 100)?;
        let samples = Samples::of(&truth, &domain, watch.part(0.05, 0.35))?;
        let codes = Codes::of(&truth, &domain, &samples);
        watch.step(40, 100)?;
        let stored = Stored::new(self.off(&domain), codes.step);
        let (slack, floor) = (of_field(SLACK, &domain), of_field(FLOOR, &domain));
        let cells = 0..domain.cell_count();
        let asked: Vec<[u32; 2]> = (cells.into_par_iter())
            .map(|cell| {
                let Errors { low, high } = codes.errors(&domain, &samples, cell, kind);
                stored.up(Errors { low: low + slack, high: high + slack })
            })
            .collect();
        let mut books = Books::of(&asked, &codes.weights);
        let proofs = watch.part(0.4, 1.0).map(domain.cell_count(), |cell| {
            let corner = DVec3::from(domain.cell(cell).map(|at| at as f64)) * CELL;
            let wanted = stored.errors(books.errors(cell));
            let boxed = [corner, DVec3::splat(CELL)];
            Prover::cell(&truth, codes.function(&domain, cell), boxed, wanted, floor)
        })?;
        let proved = |(cell, proof): (usize, &Proof)| match proof.is_widened {
            true => stored.up(proof.errors),
            false => books.errors(cell),
        };
        let needed: Vec<[u32; 2]> = proofs.iter().enumerate().map(proved).collect();
        books.hold(&needed);
        let body = section(&domain, kind, &codes, &books).ok_or(too_wide(kind, options))?;
        let mut found = Widths::default();
        for cell in 0..domain.cell_count() {
            let [low, high] = books.errors(cell).map(f64::from);
            found.join(widths(&codes, &domain, &samples, cell, kind, Errors { low, high }));
        }
        let has_doubt = |cell: &usize| {
            let is_in_doubt = |sample: &super::samples::Sample| sample.side == Side::Undecided;
            proofs[*cell].is_undecided || samples.cells[*cell].iter().any(is_in_doubt)
        };
        let in_units = 1.0 / f64::from(domain.per_unit);
        let largest = needed.iter().flatten().max().map_or(0.0, |&error| f64::from(error));
        let [mean_width, largest_width] = found.found().map(|width| width * in_units);
        let report = SdfReport {
            kind,
            layout: SdfLayout::Lattice,
            lacks_sides: false,
            cells: domain.cells,
            cell_count: domain.cell_count(),
            steps: 1,
            bytes: bytes(domain.cells),
            mean_width,
            other_width: None,
            largest_width,
            largest_error: largest * in_units,
            undecided: (0..domain.cell_count()).filter(has_doubt).count(),
            boxes: proofs.iter().map(|proof| proof.boxes).sum(),
            widened: proofs.iter().filter(|proof| proof.is_widened).count(),
            time: Duration::ZERO,
        };
        Ok(Field { body, report })
    }

    /// `None` if the field does not fit the numbers of a tree.
    fn tree(&self, watch: Watch<'_>) -> Result<Option<Field>, BuildError> {
        let Self { kind, options, .. } = *self;
        let domain = Domain::of_tree(&self.surface, options.margin, options.bytes as usize)?;
        // More than any bound of a tree, in units: the core refuses a field whose bounds overflow.
        if ((1u32 << 22) as f32 / domain.per_unit).is_infinite() {
            let size = self.surface.high - self.surface.low;
            return Err(BuildError::FieldUnit { side: size.max_element() });
        }
        let truth = Truth::new(self.input.mesh, domain, kind, self.sides);
        watch.step(2, 100)?;
        let watch = watch.part(0.02, 1.0);
        let off = self.off(&domain);
        let Some(tree) = tree::build(&truth, &domain, off, options.bytes as usize, watch)? else {
            return Ok(None);
        };
        let in_units = 1.0 / f64::from(domain.per_unit);
        let [mean_width, largest_width] = tree.widths.found().map(|width| width * in_units);
        let report = SdfReport {
            kind,
            layout: SdfLayout::Tree,
            lacks_sides: false,
            cells: domain.cells,
            cell_count: tree.leaves,
            steps: tree.steps,
            bytes: tree.section.len(),
            mean_width,
            other_width: None,
            largest_width,
            largest_error: f64::from(tree.largest) * in_units,
            undecided: tree.undecided,
            boxes: tree.boxes,
            widened: tree.widened,
            time: Duration::ZERO,
        };
        Ok(Some(Field { body: tree.section, report }))
    }
}
