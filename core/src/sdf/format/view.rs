//! Checked view of the distance field.
//!
//! If [`Sdf::open`] returned `Ok`, then the field has at least one cell, no sum of a query leaves
//! an i32, and the unit is a normal f32. In a lattice every corner has a code and every cell its
//! errors. In a tree every place leads to a leaf in at most [`Sdf::steps`] entries.
//! Accessors return `Option` all the same. No path can panic.

use super::layout::{BOOK, FRACTION_BITS, SDF_BYTES, field, tree};
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

/// How a distance field lies in its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SdfLayout {
    /// Corners with codes, and an error byte a cell.
    Lattice,
    /// Cells of any dyadic size and shape, each with a function of its own.
    Tree,
}

impl SdfLayout {
    /// All layouts, in the order of their codes.
    pub const ALL: [SdfLayout; 2] = [SdfLayout::Lattice, SdfLayout::Tree];

    pub(super) const fn from_code(code: u8) -> Option<SdfLayout> {
        match code {
            0 => Some(SdfLayout::Lattice),
            1 => Some(SdfLayout::Tree),
            _ => None,
        }
    }

    /// The value of `meshsweep build --sdf-layout` that builds it.
    pub const fn name(self) -> &'static str {
        match self {
            SdfLayout::Lattice => "lattice",
            SdfLayout::Tree => "tree",
        }
    }

    /// Units along each axis of one of [`Sdf::cells`], as a power of 2.
    pub const fn cell_bits(self) -> u32 {
        match self {
            SdfLayout::Lattice => FRACTION_BITS,
            SdfLayout::Tree => tree::ROOT_BITS,
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
    /// From one code to the next: units of a lattice, about 31sts of a unit of a tree.
    pub step: u16,
    /// What the distances mean.
    pub kind: SdfKind,
    /// How the field lies in its bytes.
    pub layout: SdfLayout,
    /// Cells along each axis: root cells of a tree.
    pub cells: [u8; 3],
    /// Entries that a question of a tree reads at most; 0 of a lattice.
    pub steps: u8,
    /// Book of a lattice: how far the distance may be below the trilinear function, units. Of a
    /// tree the first sixteen widths.
    pub low: [u16; BOOK],
    /// Book of a lattice: how far the distance may be above it, and the loss of a query's shifts,
    /// units. Of a tree the last sixteen widths.
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
        put(field::KIND, &[self.kind as u8, self.layout as u8]);
        put(field::CELLS, &self.cells);
        put(field::STEPS, &[self.steps]);
        for (book, at) in [(&self.low, field::BOOKS), (&self.high, field::HIGH)] {
            for (index, error) in book.iter().enumerate() {
                put(at + 2 * index, &error.to_le_bytes());
            }
        }
        out
    }

    /// Corners of a lattice, and cells.
    pub fn counts(&self) -> [usize; 2] {
        let cells = each(self.cells, usize::from);
        [cells.iter().map(|n| n + 1).product(), cells.iter().product()]
    }
}

/// A distance field: each question is one look-up, without scratch memory and without a search.
///
/// The field covers the mesh's box and a margin. It is a lattice of cubic cells with a code of
/// eight bits at each corner, and a byte a cell that says how far the mesh's distance may be from
/// the trilinear function of the codes, below and above. Or it is a tree: each of its cells has a
/// plane with a curvature below the distance, and a width. The builder proves these errors.
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
    /// Of a lattice; empty of a tree.
    pub(in crate::sdf) codes: &'a [u8],
    /// Of a lattice; empty of a tree.
    pub(in crate::sdf) errors: &'a [u8],
    /// Of a tree; empty of a lattice.
    pub(in crate::sdf) entries: &'a [[u8; tree::ENTRY_BYTES]],
    pub(in crate::sdf) books: &'a [[u8; 2]; 2 * BOOK],
    pub(in crate::sdf) origin: [f32; 3],
    pub(in crate::sdf) per_unit: f32,
    pub(in crate::sdf) unit: f32,
    pub(in crate::sdf) base: i32,
    pub(in crate::sdf) step: i32,
    /// Distances are cut to at least this, units.
    pub(in crate::sdf) least: i32,
    /// Units along each axis of a lattice; 0 of a tree. So a question of a lattice is sure of its
    /// layout by the comparison that it makes anyway.
    pub(in crate::sdf) lattice: [u32; 3],
    /// The bits of the numbers of units along each axis, as f32.
    pub(in crate::sdf) ends: [u32; 3],
    /// Corners of a row, or root cells of a tree's.
    pub(in crate::sdf) row: u32,
    /// Corners of a layer, or root cells of a tree's.
    pub(in crate::sdf) layer: u32,
    /// Cells of a layer of a lattice.
    pub(in crate::sdf) cell_layer: u32,
    /// Root cells of a tree.
    pub(in crate::sdf) roots: u32,
    pub(in crate::sdf) kind: SdfKind,
    pub(in crate::sdf) layout: SdfLayout,
    pub(in crate::sdf) steps: u8,
    /// Cells along each axis, or root cells.
    pub(in crate::sdf) cells: [u8; 3],
}

impl Sdf<'_> {
    /// What the distances mean.
    pub const fn kind(&self) -> SdfKind {
        self.kind
    }

    /// How the field lies in its bytes.
    pub const fn layout(&self) -> SdfLayout {
        self.layout
    }

    /// Entries that a question reads at most: cells of a tree one in the other, from the root cell
    /// to the leaf. 1 of a lattice.
    pub const fn steps(&self) -> u32 {
        match self.layout {
            SdfLayout::Lattice => 1,
            SdfLayout::Tree => self.steps as u32,
        }
    }

    /// Cells along each axis: of a tree its root cells.
    pub fn cells(&self) -> [u32; 3] {
        each(self.cells, u32::from)
    }

    /// Units along each axis.
    pub(in crate::sdf) fn units(&self) -> [u32; 3] {
        let bits = self.layout.cell_bits();
        each(self.cells(), |cells| cells << bits)
    }

    /// A unit in input units, rounded to nearest. A cell of a lattice has 2048 units along each
    /// axis, a root cell of a tree 65,536.
    pub const fn unit(&self) -> f32 {
        self.unit
    }

    /// Units in one input unit.
    pub(crate) const fn per_unit(&self) -> f32 {
        self.per_unit
    }

    /// The box of the points that round into the field: the origin, half a unit below corner 0 of
    /// the first cell along each axis, and the opposite corner. Input units, rounded to nearest.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        let [x, y, z] = self.units();
        let [a, b, c] = self.origin;
        let end = |at: f32, units: u32| at + units as f32 * self.unit;
        [self.origin, [end(a, x), end(b, y), end(c, z)]]
    }

    /// The header.
    #[doc(hidden)]
    pub fn header(&self) -> SdfHeader {
        let (mut low, mut high) = ([0; BOOK], [0; BOOK]);
        for (entry, &bytes) in low.iter_mut().chain(&mut high).zip(self.books) {
            *entry = u16::from_le_bytes(bytes);
        }
        SdfHeader {
            origin: self.origin,
            per_unit: self.per_unit,
            unit: self.unit,
            base: self.base,
            step: self.step as u16,
            kind: self.kind,
            layout: self.layout,
            cells: self.cells,
            steps: self.steps,
            low,
            high,
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

    /// Entries of a tree.
    #[doc(hidden)]
    pub fn entries(&self) -> &[[u8; tree::ENTRY_BYTES]] {
        self.entries
    }
}
