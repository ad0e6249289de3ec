//! The field's domain: cells, units, and the frame in which all else is computed.
//!
//! The frame's unit is the field's unit, and its origin the lattice's corner 0. Coordinates in the
//! domain are below 2^19. Those of the mesh are f32 numbers, so the way into the frame is a
//! difference, a product and a difference of f64: off by less than three parts in 2^53 of 2^19
//! units, 2^-32 of a unit.

use crate::error::BuildError;
use crate::geom::Bounds;
use glam::DVec3;
use meshsweep_core::internal::sdf::format::layout::{CELL_UNITS, MOST_CELLS, SDF_BYTES, tree};

/// Units along each axis of a lattice's cell.
pub(super) const CELL: f64 = CELL_UNITS as f64;

/// Units along each axis of a tree's root cell.
pub(super) const ROOT: f64 = (1u32 << tree::ROOT_BITS) as f64;

/// Where the field's cells are: those of a lattice, or the root cells of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Domain {
    /// Corner 0 of the lattice is half a unit above, input units.
    pub origin: [f32; 3],
    /// Units in one input unit.
    pub per_unit: f32,
    /// Its inverse, rounded.
    pub unit: f32,
    /// Units along each axis of a cell.
    pub side: f64,
    /// Cells along each axis.
    pub cells: [usize; 3],
    /// Diagonal of the mesh's box, units.
    pub diagonal: f64,
    /// The box that was asked for: the mesh's and the margin. Cells of a lattice stand out of it
    /// otherwise than those of a tree, so widths of both are compared in it.
    pub asked: [DVec3; 2],
}

/// Bytes of a field with so many cells along each axis.
pub(super) fn bytes([x, y, z]: [usize; 3]) -> usize {
    SDF_BYTES + (x + 1) * (y + 1) * (z + 1) + x * y * z
}

/// Index along each axis of an item of a grid with so many along each axis, x fastest.
pub(super) fn index_of(number: usize, [x, y, _]: [usize; 3]) -> [usize; 3] {
    [number % x, number / x % y, number / (x * y)]
}

/// Number of the item at an index along each axis.
pub(super) fn number_of([i, j, k]: [usize; 3], [x, y, _]: [usize; 3]) -> usize {
    i + x * (j + y * k)
}

/// Cells of a side along each axis that hold a box.
fn cells(size: DVec3, side: f64) -> [usize; 3] {
    size.to_array().map(|size| (size / side).ceil().max(1.0) as usize)
}

/// Most root cells along the longest side of a box. With few bytes the smaller ones are taken.
const ROOTS_BY_BYTES: [usize; 3] = [5, 2, 1];

/// Part of the volume that a side of root cells must save to replace one that was found before.
const SAVED: f64 = 0.02;

/// The side of a tree's root cells that wastes the least volume about a box. Some side of the box
/// is a whole number of them. The longest side has at most `most`. If `most` is five or more it has
/// at least `most` - 2: larger cells would be halved too often. `None` if each side makes more than
/// `most_count` root cells.
fn root_side_of(size: DVec3, most: usize, most_count: usize) -> Option<f64> {
    let longest = size.max_element();
    let mut best = None;
    let sides = (1..=most.max(5)).flat_map(|n| (size / n as f64).to_array());
    for side in sides.filter(|side| *side > 0.0) {
        let of = cells(size, side * (1.0 + 1e-9));
        let count: usize = of.iter().product();
        let along = of.into_iter().max().unwrap_or(1);
        if along > most || (most >= 5 && along + 2 < most) || count > most_count {
            continue;
        }
        let volume = count as f64 * (side / longest).powi(3);
        if best.is_none_or(|(least, _)| volume < (1.0 - SAVED) * least) {
            best = Some((volume, side * (1.0 + 1e-9)));
        }
    }
    best.map(|(_, side)| side)
}

/// Entries for each root cell that the bytes must have room for: with fewer, root cells are hardly
/// halved.
const ENTRIES_OF_ROOT: usize = 8;

/// The same with the most root cells along the longest side that the bytes have room for.
fn root_side(size: DVec3, most_bytes: usize) -> f64 {
    let room = most_bytes / (ENTRIES_OF_ROOT * tree::ENTRY_BYTES);
    let count = |most: usize| if most > 1 { room } else { usize::MAX };
    let side = ROOTS_BY_BYTES.into_iter().find_map(|most| root_side_of(size, most, count(most)));
    side.unwrap_or(size.max_element())
}

/// The largest step of f32 numbers in a box: corners of the lattice are off by half of it.
fn step(bounds: &Bounds) -> f64 {
    let largest = bounds.low.abs().max(bounds.high.abs()).max_element();
    let above = (largest as f32).next_up();
    f64::from(above.next_up()) - f64::from(above)
}

impl Domain {
    /// Cells of at most so many bytes about the box of a mesh, and a margin about it, input units.
    /// Without one, a tenth of the box's diagonal.
    ///
    /// # Errors
    /// [`BuildError::NegativeMargin`], [`BuildError::FieldUnit`], [`BuildError::MarginTooLarge`].
    pub fn of(bounds: &Bounds, margin: Option<f64>, most_bytes: usize) -> Result<Self, BuildError> {
        Self::about(bounds, margin, CELL, |size| {
            let fits = |side: f64| {
                let cells = cells(size, side);
                cells.iter().all(|&n| n <= usize::from(MOST_CELLS)) && bytes(cells) <= most_bytes
            };
            // One cell always fits. Halved until f64 tells no more.
            let (mut least, mut side) = (0.0, size.max_element());
            for _ in 0..60 {
                let middle = 0.5 * (least + side);
                *(if fits(middle) { &mut side } else { &mut least }) = middle;
            }
            side
        })
    }

    /// The same of a tree: root cells of the side that [`root_side`] finds.
    ///
    /// # Errors
    /// As of a lattice.
    pub fn of_tree(
        bounds: &Bounds,
        margin: Option<f64>,
        most_bytes: usize,
    ) -> Result<Self, BuildError> {
        Self::about(bounds, margin, ROOT, |size| root_side(size, most_bytes))
    }

    /// The same with at most so many root cells along the longest side.
    ///
    /// # Errors
    /// As of a lattice.
    pub fn of_roots(bounds: &Bounds, margin: Option<f64>, most: usize) -> Result<Self, BuildError> {
        Self::about(bounds, margin, ROOT, |size| {
            root_side_of(size, most, usize::MAX).unwrap_or(size.max_element())
        })
    }

    fn about(
        bounds: &Bounds,
        margin: Option<f64>,
        units: f64,
        side: impl FnOnce(DVec3) -> f64,
    ) -> Result<Self, BuildError> {
        let diagonal = (bounds.high - bounds.low).length();
        let margin = margin.unwrap_or(0.1 * diagonal);
        if margin.is_nan() || margin < 0.0 {
            return Err(BuildError::NegativeMargin);
        }
        let bounds = bounds.grown(margin);
        let size = bounds.high - bounds.low;
        if size.max_element() > f64::from(f32::MAX) || step(&bounds).is_nan() {
            return Err(BuildError::MarginTooLarge);
        }
        // Room for corner 0 to be a number of f32, and for the rounding of the unit.
        let size = size * (1.0 + 1e-5) + 2.0 * step(&bounds);
        let side = side(size);
        let per_unit = (units / side) as f32;
        let unit = (1.0 / f64::from(per_unit)) as f32;
        if !(per_unit.is_normal() && unit.is_normal()) {
            return Err(BuildError::FieldUnit { side: size.max_element() });
        }
        let cells = cells(size, side);
        let middle = 0.5 * (bounds.low + bounds.high);
        // Corner 0 is half a unit above the origin.
        let whole = (DVec3::from(cells.map(|n| n as f64)) * units + 1.0) / f64::from(per_unit);
        let origin = (middle - 0.5 * whole).to_array().map(|x| x as f32);
        if !origin.iter().all(|x| x.is_finite()) {
            return Err(BuildError::MarginTooLarge);
        }
        let diagonal = diagonal * f64::from(per_unit);
        let asked = [DVec3::ZERO; 2];
        let mut domain = Self { origin, per_unit, unit, side: units, cells, diagonal, asked };
        let ends = [bounds.low, bounds.high].map(|p| domain.place(p));
        let top = domain.size();
        // With the room that was added above: of a plate without a margin too, samples are in it.
        domain.asked = [-0.5, 0.5].map(|part| domain.place(middle + part * size));
        let is_within = ends[0].min_element() >= 0.0 && ends[1].cmple(top).all();
        if is_within { Ok(domain) } else { Err(BuildError::FieldUnit { side: size.max_element() }) }
    }

    /// A point of the input in the frame.
    pub fn place(&self, p: DVec3) -> DVec3 {
        (p - self.input_origin()) * f64::from(self.per_unit) - 0.5
    }

    /// A point of the frame in the input's.
    pub fn input_place(&self, p: DVec3) -> DVec3 {
        self.input_origin() + (p + 0.5) / f64::from(self.per_unit)
    }

    fn input_origin(&self) -> DVec3 {
        DVec3::from(self.origin.map(f64::from))
    }

    /// Whether a place of the frame is in the box that was asked for.
    pub fn is_asked(&self, p: DVec3) -> bool {
        let [low, high] = self.asked;
        low.cmple(p).all() && p.cmple(high).all()
    }

    /// The domain's upper corner.
    fn size(&self) -> DVec3 {
        DVec3::from(self.cells.map(|n| n as f64)) * self.side
    }

    pub fn cell_count(&self) -> usize {
        self.cells.iter().product()
    }

    pub fn corner_count(&self) -> usize {
        self.cells.iter().map(|n| n + 1).product()
    }

    /// Index of a cell along each axis, from its number.
    pub fn cell(&self, number: usize) -> [usize; 3] {
        index_of(number, self.cells)
    }

    /// Index of a corner along each axis, from its number.
    pub fn corner(&self, number: usize) -> [usize; 3] {
        index_of(number, self.cells.map(|n| n + 1))
    }

    pub fn cell_number(&self, index: [usize; 3]) -> usize {
        number_of(index, self.cells)
    }

    pub fn corner_number(&self, index: [usize; 3]) -> usize {
        number_of(index, self.cells.map(|n| n + 1))
    }
}
