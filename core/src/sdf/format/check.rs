//! Opening the distance field of a blob, and the check.

use super::layout::{BOOK, CELL_UNITS, MOST_BASE, MOST_STEP, SDF_BYTES, field};
use super::view::{Sdf, SdfKind};
use crate::format::Contradiction;
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError, SectionTable};
use crate::num::each;

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

    /// The field of bytes that were checked before.
    pub(crate) fn view(bytes: &'a [u8]) -> Result<Sdf<'a>, OpenError> {
        Sdf::locate(&SectionTable::view(bytes)?)
    }

    /// All there is to check of the bytes is their number: any code and any error is sound.
    fn locate(table: &SectionTable<'a>) -> Result<Sdf<'a>, OpenError> {
        let data = table.bytes(SectionKind::Sdf);
        let malformed = table.malformed(SectionKind::Sdf);
        let (head, rest) = data.split_at_checked(SDF_BYTES).ok_or(malformed)?;
        let header = Bytes(head);
        let book = |at: usize| -> Option<&'a [[u8; 2]; BOOK]> {
            header.slice(at, 2 * BOOK)?.as_chunks().0.first_chunk()
        };
        let (low, high) = (book(field::LOW), book(field::HIGH));
        let (Some(low), Some(high)) = (low, high) else { return Err(malformed) };
        let byte = |at: usize| header.u8(at).unwrap_or(0);
        if byte(field::RESERVED) != 0 || byte(field::RESERVED_2) != 0 {
            return Err(OpenError::Reserved);
        }
        let wrong = |what: Contradiction| OpenError::Counts { what };
        let cells = [0, 1, 2].map(|axis| usize::from(byte(field::CELLS + axis)));
        let kind = SdfKind::ALL.get(usize::from(byte(field::KIND)));
        let (Some(&kind), false) = (kind, cells.contains(&0)) else {
            return Err(wrong(Contradiction::FieldCells));
        };
        let step = header.u16(field::STEP).unwrap_or(0);
        let base = header.word(field::BASE).cast_signed();
        if step == 0 || step > MOST_STEP || base.unsigned_abs() > MOST_BASE.unsigned_abs() {
            return Err(wrong(Contradiction::FieldStep));
        }
        let origin = header.corner(field::ORIGIN);
        let per_unit = f32::from_bits(header.word(field::PER_UNIT));
        let unit = f32::from_bits(header.word(field::UNIT));
        // Of the inverse rounded to nearest, the product is within one unit of rounding.
        let defect = (unit * per_unit - 1.0).abs();
        let is_sound = per_unit.is_normal()
            && per_unit > 0.0
            && unit.is_normal()
            && defect <= f32::EPSILON
            && origin.iter().all(|x| x.is_finite());
        if !is_sound {
            return Err(wrong(Contradiction::FieldUnit));
        }
        let [x, y, z] = cells;
        // At most 2^24 each.
        let (row, layer) = (x + 1, (x + 1) * (y + 1));
        let (codes, errors) = rest.split_at_checked(layer * (z + 1)).ok_or(malformed)?;
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
            step: i32::from(step),
            least: if kind == SdfKind::Signed { i32::MIN } else { 0 },
            units: each(cells, |cells| cells as u32 * CELL_UNITS.unsigned_abs()),
            row: row as u32,
            layer: layer as u32,
            cell_layer: (x * y) as u32,
            kind,
        })
    }
}
