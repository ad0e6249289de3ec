//! The field's errors and bytes.

use super::books::{book, entry};
use super::codes::Codes;
use super::domain::Domain;
use super::prove::Errors;
use super::region::MARGIN;
use meshsweep_core::internal::sdf::format::SdfHeader;
use meshsweep_core::internal::sdf::format::layout::{BOOK, value_loss};
use meshsweep_core::{SdfKind, SdfLayout};

/// From the errors of the trilinear function to those that are stored, units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stored {
    below: f64,
    above: f64,
}

impl Stored {
    /// The stored errors include how far the mesh may be from the input, units, and what the value
    /// of a place loses.
    ///
    /// Move each vertex from its place in the mesh to its place in the input: by `off` at most. So
    /// a distance changes by `off` at most. If the surface passes the point on the way, the
    /// distances before and after add up to `off` at most. So a signed distance changes by no more
    /// either.
    pub fn new(off: f64, step: u16) -> Self {
        Self { below: off + MARGIN, above: off + MARGIN + f64::from(value_loss(step)) }
    }

    /// The least stored errors that hold these.
    pub fn up(&self, of: Errors) -> [u32; 2] {
        [of.low + self.below, of.high + self.above].map(|x| x.ceil().clamp(0.0, 1e9) as u32)
    }

    /// The errors that stored ones hold.
    pub fn errors(&self, [low, high]: [u32; 2]) -> Errors {
        Errors { low: f64::from(low) - self.below, high: f64::from(high) - self.above }
    }
}

/// Two books, ascending, and a place in each for every cell.
#[derive(Clone, Debug)]
pub(super) struct Books {
    pub books: [[u32; BOOK]; 2],
    pub cells: Vec<[usize; 2]>,
}

impl Books {
    /// The best books of stored errors.
    pub fn of(errors: &[[u32; 2]], weights: &[f64]) -> Self {
        let books = [0, 1].map(|side| {
            let of: Vec<u32> = errors.iter().map(|errors| errors[side]).collect();
            book(&of, weights)
        });
        Self { cells: errors.iter().map(|&errors| places(&books, errors)).collect(), books }
    }

    /// The stored errors of a cell.
    pub fn errors(&self, cell: usize) -> [u32; 2] {
        [0, 1].map(|side| self.books[side][self.cells[cell][side]])
    }

    /// Whether the entries fit 16 bits, as they are stored.
    pub fn fit(&self) -> bool {
        self.books.as_flattened().iter().all(|&error| u16::try_from(error).is_ok())
    }

    /// Gives each cell the least entries that hold its errors. The last entries grow where none
    /// does.
    pub fn hold(&mut self, errors: &[[u32; 2]]) {
        for side in [0, 1] {
            let most = errors.iter().map(|errors| errors[side]).max().unwrap_or(0);
            let last = &mut self.books[side][BOOK - 1];
            *last = most.max(*last);
        }
        self.cells = errors.iter().map(|&errors| places(&self.books, errors)).collect();
    }
}

fn places(books: &[[u32; BOOK]; 2], errors: [u32; 2]) -> [usize; 2] {
    [0, 1].map(|side| entry(&books[side], errors[side]))
}

/// The section's bytes; `None` if an error is beyond what a book holds.
pub(super) fn section(
    domain: &Domain,
    kind: SdfKind,
    codes: &Codes,
    books: &Books,
) -> Option<Vec<u8>> {
    if !books.fit() {
        return None;
    }
    let [low, high] = books.books.map(|book| book.map(|error| error as u16));
    let header = SdfHeader {
        origin: domain.origin,
        per_unit: domain.per_unit,
        unit: domain.unit,
        base: codes.base,
        step: codes.step,
        kind,
        layout: SdfLayout::Lattice,
        steps: 0,
        cells: domain.cells.map(|count| count as u8),
        low,
        high,
    };
    let mut bytes = header.write().to_vec();
    bytes.extend(&codes.codes);
    bytes.extend(books.cells.iter().map(|&[low, high]| (low | high << 4) as u8));
    Some(bytes)
}
