//! Opening the distance field of a blob, and the check.

use super::layout::{BOOK, CELL_UNITS, MOST_BASE, MOST_STEP, SDF_BYTES, field};
use super::view::{Sdf, SdfKind};
use crate::format::Contradiction;
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError, SectionTable, ok, some};

impl<'a> Sdf<'a> {
    /// Opens the distance field of a blob where it lies, and checks it: CRC, header, lengths. Any
    /// bytes are safe to open. It reads no other sections, so that the code that checks them is
    /// not linked.
    ///
    /// Cost: the CRC, linear in the bytes; no allocation; once per start. Alignment of `bytes` does
    /// not matter.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without a field.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<Sdf<'a>, OpenError> {
        let table = SectionTable::open(bytes)?;
        table.check_crcs(SectionKind::is_sdf)?;
        Sdf::locate(&table)
    }

    /// Opens the field of an image that was verified before, and checks header and lengths only. It
    /// is a constant function: a `static` field costs no start-up, and the compiler refuses bytes
    /// that are no field.
    ///
    /// Verified means as for [`Bvh::open_trusted`](crate::Bvh::open_trusted). Of bytes that were
    /// changed since, any answer may be wrong, and none panics.
    ///
    /// Cost: none in a constant; else some hundred instructions.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without a field.
    pub const fn open_trusted(bytes: &'a [u8]) -> Result<Sdf<'a>, OpenError> {
        Sdf::locate(&ok!(SectionTable::open(bytes)))
    }

    /// The field of bytes that were checked before.
    pub(crate) const fn view(bytes: &'a [u8]) -> Result<Sdf<'a>, OpenError> {
        Sdf::locate(&ok!(SectionTable::view(bytes)))
    }

    /// Of codes and errors only the number is checked: every byte is a valid code, or two numbers in
    /// the books.
    const fn locate(table: &SectionTable<'a>) -> Result<Sdf<'a>, OpenError> {
        let data = table.bytes(SectionKind::Sdf);
        let malformed = table.malformed(SectionKind::Sdf);
        let (head, rest) = ok!(data.split_at_checked(SDF_BYTES), malformed);
        let header = Bytes(head);
        let (low, high) =
            (ok!(book(header, field::LOW), malformed), ok!(book(header, field::HIGH), malformed));
        let [x, y, z] = ok!(header.array::<3>(field::CELLS), malformed);
        let [kind, reserved] = ok!(header.array::<2>(field::KIND), malformed);
        if reserved != 0 || ok!(header.u8(field::RESERVED_2), malformed) != 0 {
            return Err(OpenError::Reserved);
        }
        let kind =
            ok!(SdfKind::from_code(kind), OpenError::Counts { what: Contradiction::FieldKind });
        if x == 0 || y == 0 || z == 0 {
            return Err(OpenError::Counts { what: Contradiction::FieldCells });
        }
        let step = ok!(header.u16(field::STEP), malformed);
        let base = header.word(field::BASE).cast_signed();
        if step == 0 || step > MOST_STEP || base.unsigned_abs() > MOST_BASE.unsigned_abs() {
            return Err(OpenError::Counts { what: Contradiction::FieldStep });
        }
        let origin @ [a, b, c] = header.corner(field::ORIGIN);
        let per_unit = f32::from_bits(header.word(field::PER_UNIT));
        let unit = f32::from_bits(header.word(field::UNIT));
        // The unit is the inverse, rounded to nearest: the product is within EPSILON of 1.
        let defect = (unit * per_unit - 1.0).abs();
        let is_sound = per_unit.is_normal()
            && per_unit > 0.0
            && unit.is_normal()
            && defect <= f32::EPSILON
            && a.is_finite()
            && b.is_finite()
            && c.is_finite();
        // No bound of a query may overflow in input units.
        let largest = base.unsigned_abs() + 256 * step as u32 + greatest(low) + greatest(high) + 2;
        let is_sound = is_sound && (largest as f32 * unit * (1.0 + 8.0 * f32::EPSILON)).is_finite();
        if !is_sound {
            return Err(OpenError::Counts { what: Contradiction::FieldUnit });
        }
        let (x, y, z) = (x as usize, y as usize, z as usize);
        // At most 2^24 each.
        let (row, layer) = (x + 1, (x + 1) * (y + 1));
        let (codes, errors) = ok!(rest.split_at_checked(layer * (z + 1)), malformed);
        if errors.len() != x * y * z {
            return Err(malformed);
        }
        Ok(Sdf {
            codes,
            errors,
            low,
            high,
            origin,
            per_unit,
            unit,
            base,
            step: step as i32,
            least: if matches!(kind, SdfKind::Signed) { i32::MIN } else { 0 },
            units: [units(x), units(y), units(z)],
            row: row as u32,
            layer: layer as u32,
            cell_layer: (x * y) as u32,
            kind,
        })
    }
}

/// The greatest error of a book.
const fn greatest(mut book: &[[u8; 2]]) -> u32 {
    let mut most = 0;
    while let Some((error, rest)) = book.split_first() {
        let error = u16::from_le_bytes(*error) as u32;
        if error > most {
            most = error;
        }
        book = rest;
    }
    most
}

/// Units along so many cells.
const fn units(cells: usize) -> u32 {
    cells as u32 * CELL_UNITS.unsigned_abs()
}

/// The errors of a book.
const fn book(header: Bytes<'_>, at: usize) -> Option<&[[u8; 2]; BOOK]> {
    some!(header.slice(at, 2 * BOOK)).as_chunks().0.first_chunk()
}
