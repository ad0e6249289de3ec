//! Checked view of the distance field.
//!
//! If [`Sdf::open`] returned `Ok`, then the lattice has at least one cell, every corner has a code
//! and every cell its errors, no sum of a query leaves an i32, and the unit is a normal f32.
//! Accessors return `Option` all the same. No path can panic.

use super::layout::{BOOK, CELL_UNITS, SDF_BYTES, field};
use crate::num::each;

/// What a distance field says of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SdfKind {
    /// The distance to the surface. Any mesh has it.
    Surface,
    /// The signed distance to the surface, negative inside. Of closed meshes.
    Signed,
    /// The distance to the solid: 0 inside. Of closed meshes. A wall thinner than a cell
    /// does not widen the interval.
    Solid,
}

impl SdfKind {
    /// All kinds, in the order of their codes.
    pub const ALL: [SdfKind; 3] = [SdfKind::Surface, SdfKind::Signed, SdfKind::Solid];

    pub(super) const fn from_code(code: u8) -> Option<SdfKind> {
        match code {
            0 => Some(SdfKind::Surface),
            1 => Some(SdfKind::Signed),
            2 => Some(SdfKind::Solid),
            _ => None,
        }
    }

    /// The value of `meshsweep build --sdf-kind` that builds it.
    pub const fn name(self) -> &'static str {
        match self {
            SdfKind::Surface => "surface",
            SdfKind::Signed => "signed",
            SdfKind::Solid => "solid",
        }
    }
}

/// The header of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SdfHeader {
    /// Input units. Corner 0 of the lattice lies half a unit above, along each axis.
    pub origin: [f32; 3],
    /// Units in one input unit.
    pub per_unit: f32,
    /// A unit in input units, rounded to nearest.
    pub unit: f32,
    /// The distance that code 0 stands for, units.
    pub base: i32,
    /// Units from one code to the next.
    pub step: u16,
    /// What the distances mean.
    pub kind: SdfKind,
    /// Cells along each axis.
    pub cells: [u8; 3],
    /// Book: how far the distance may be below the trilinear function, units.
    pub low: [u16; BOOK],
    /// Book: how far the distance may be above it, and the loss of a query's shifts, units.
    pub high: [u16; BOOK],
}

impl SdfHeader {
    /// Writes the header.
    pub fn write(&self) -> [u8; SDF_BYTES] {
        let mut out = [0u8; SDF_BYTES];
        let mut put = |at: usize, bytes: &[u8]| {
            for (slot, &byte) in out.iter_mut().skip(at).zip(bytes) {
                *slot = byte;
            }
        };
        for (at, x) in [0, 4, 8].into_iter().zip(self.origin) {
            put(field::ORIGIN + at, &x.to_le_bytes());
        }
        put(field::PER_UNIT, &self.per_unit.to_le_bytes());
        put(field::UNIT, &self.unit.to_le_bytes());
        put(field::BASE, &self.base.to_le_bytes());
        put(field::STEP, &self.step.to_le_bytes());
        put(field::KIND, &[self.kind as u8]);
        put(field::CELLS, &self.cells);
        for (book, at) in [(&self.low, field::LOW), (&self.high, field::HIGH)] {
            for (index, error) in book.iter().enumerate() {
                put(at + 2 * index, &error.to_le_bytes());
            }
        }
        out
    }

    /// Corners of the lattice, and cells.
    pub fn counts(&self) -> [usize; 2] {
        let cells = each(self.cells, usize::from);
        [cells.iter().map(|n| n + 1).product(), cells.iter().product()]
    }
}

/// A distance field: each question is one look-up, without scratch memory and without a search.
///
/// The field covers the mesh's box and a margin. It is a lattice of cubic cells with a code of eight
/// bits at each corner, and a byte a cell that says how far the mesh's distance may be from the
/// trilinear function of the codes, below and above. The builder proves these errors.
///
/// ```
/// use meshsweep_core::{Sdf, Side};
/// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/field.msw"));
/// let field = Sdf::open(bytes)?;
/// let far = field.distance([300.0, 0.0, 0.0])?;
/// assert!(far.side == Side::Outside && far.distance.lower <= far.distance.upper);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sdf<'a> {
    pub(in crate::sdf) codes: &'a [u8],
    pub(in crate::sdf) errors: &'a [u8],
    pub(in crate::sdf) low: &'a [[u8; 2]; BOOK],
    pub(in crate::sdf) high: &'a [[u8; 2]; BOOK],
    pub(in crate::sdf) origin: [f32; 3],
    pub(in crate::sdf) per_unit: f32,
    pub(in crate::sdf) unit: f32,
    pub(in crate::sdf) base: i32,
    pub(in crate::sdf) step: i32,
    /// Distances are cut to at least this, units.
    pub(in crate::sdf) least: i32,
    /// Units along each axis.
    pub(in crate::sdf) units: [u32; 3],
    /// Corners of a row.
    pub(in crate::sdf) row: u32,
    /// Corners of a layer.
    pub(in crate::sdf) layer: u32,
    /// Cells of a layer.
    pub(in crate::sdf) cell_layer: u32,
    pub(in crate::sdf) kind: SdfKind,
}

impl Sdf<'_> {
    /// What the distances mean.
    pub const fn kind(&self) -> SdfKind {
        self.kind
    }

    /// Cells along each axis.
    pub fn cells(&self) -> [u32; 3] {
        each(self.units, |units| units / CELL_UNITS.unsigned_abs())
    }

    /// A unit in input units, rounded to nearest. A cell has 2048 units along each axis.
    pub const fn unit(&self) -> f32 {
        self.unit
    }

    /// Units in one input unit.
    pub(crate) const fn per_unit(&self) -> f32 {
        self.per_unit
    }

    /// The box of the points that round into the field: the origin, half a unit below corner 0 of the
    /// lattice along each axis, and the opposite corner. Input units, rounded to nearest.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        let [x, y, z] = self.units;
        let [a, b, c] = self.origin;
        let end = |at: f32, units: u32| at + units as f32 * self.unit;
        [self.origin, [end(a, x), end(b, y), end(c, z)]]
    }

    /// The header.
    #[doc(hidden)]
    pub fn header(&self) -> SdfHeader {
        let book = |book: &[[u8; 2]; BOOK]| book.map(u16::from_le_bytes);
        SdfHeader {
            origin: self.origin,
            per_unit: self.per_unit,
            unit: self.unit,
            base: self.base,
            step: self.step as u16,
            kind: self.kind,
            cells: each(self.cells(), |cells| cells as u8),
            low: book(self.low),
            high: book(self.high),
        }
    }

    /// Codes of the corners, x fastest, then y, then z.
    #[doc(hidden)]
    pub fn codes(&self) -> &[u8] {
        self.codes
    }

    /// Errors of the cells in the same order: number in the book below, 16 times that above.
    #[doc(hidden)]
    pub fn errors(&self) -> &[u8] {
        self.errors
    }
}
