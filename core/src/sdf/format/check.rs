//! Opening the distance field of a blob, and the check.

use super::layout::{BOOK, MOST_BASE, MOST_STEP, SDF_BYTES, field, tree};
use super::shape::steps;
use super::view::{Sdf, SdfKind, SdfLayout};
use crate::format::Contradiction;
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError, SectionTable, ok, some};

impl<'a> Sdf<'a> {
    /// Opens the distance field of a blob where it lies, and checks it: CRC, header, lengths, and
    /// of a tree that all entries are reached, and in how many steps. Any bytes are safe to open.
    /// It reads no other sections, so that the code that checks them is not linked.
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
        let field = Sdf::locate(&table)?;
        if field.layout == SdfLayout::Tree
            && steps(field.entries, field.cells().into_iter().product()) != Some(field.steps)
        {
            return Err(OpenError::Counts { what: Contradiction::FieldTree });
        }
        Ok(field)
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

    /// Of codes and errors only the number is checked: every byte is a valid code, or two numbers
    /// in the books. A question of a tree ends and does not panic whatever its entries are.
    const fn locate(table: &SectionTable<'a>) -> Result<Sdf<'a>, OpenError> {
        let data = table.bytes(SectionKind::Sdf);
        let malformed = table.malformed(SectionKind::Sdf);
        let (head, rest) = ok!(data.split_at_checked(SDF_BYTES), malformed);
        let header = Bytes(head);
        let books = ok!(books(header), malformed);
        let cells @ [x, y, z] = ok!(header.array::<3>(field::CELLS), malformed);
        let [steps] = ok!(header.array::<1>(field::STEPS), malformed);
        let [kind, layout] = ok!(header.array::<2>(field::KIND), malformed);
        let Some(layout) = SdfLayout::from_code(layout) else { return Err(OpenError::Reserved) };
        let is_tree = matches!(layout, SdfLayout::Tree);
        if !is_tree && steps != 0 {
            return Err(OpenError::Reserved);
        }
        let kind =
            ok!(SdfKind::from_code(kind), OpenError::Counts { what: Contradiction::FieldKind });
        if x == 0 || y == 0 || z == 0 {
            return Err(OpenError::Counts { what: Contradiction::FieldCells });
        }
        let most_roots = tree::MOST_ROOTS;
        if is_tree && (x > most_roots || y > most_roots || z > most_roots) {
            return Err(OpenError::Counts { what: Contradiction::FieldCells });
        }
        if is_tree && (steps == 0 || steps > tree::MOST_STEPS) {
            return Err(OpenError::Counts { what: Contradiction::FieldTree });
        }
        let step = ok!(header.u16(field::STEP), malformed);
        let most_step = if is_tree { tree::MOST_STEP } else { MOST_STEP };
        let base = header.word(field::BASE).cast_signed();
        if step == 0 || step > most_step || base.unsigned_abs() > MOST_BASE.unsigned_abs() {
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
        let most = if is_tree { tree::MOST_VALUE } else { 256 * step as u32 };
        let largest = base.unsigned_abs() + most + 2 * greatest(books) + 2;
        let is_sound = is_sound && (largest as f32 * unit * (1.0 + 8.0 * f32::EPSILON)).is_finite();
        if !is_sound {
            return Err(OpenError::Counts { what: Contradiction::FieldUnit });
        }
        let (x, y, z) = (x as usize, y as usize, z as usize);
        // At most 2^24 each.
        let corners = if is_tree { 0 } else { (x + 1) * (y + 1) * (z + 1) };
        let (codes, rest) = ok!(rest.split_at_checked(corners), malformed);
        let (entries, over) = rest.as_chunks::<{ tree::ENTRY_BYTES }>();
        let (entries, errors) = if is_tree { (entries, over) } else { (&[] as &[_], rest) };
        let is_whole = match is_tree {
            true => over.is_empty() && entries.len() <= tree::MOST_ENTRIES,
            false => errors.len() == x * y * z,
        };
        if !is_whole {
            return Err(malformed);
        }
        let (row, rows) = if is_tree { (x, y) } else { (x + 1, y + 1) };
        let bits = layout.cell_bits();
        let units = [(x as u32) << bits, (y as u32) << bits, (z as u32) << bits];
        Ok(Sdf {
            codes,
            errors,
            entries,
            books,
            origin,
            per_unit,
            unit,
            base,
            step: step as i32,
            least: if matches!(kind, SdfKind::Signed) { i32::MIN } else { 0 },
            lattice: if is_tree { [0; 3] } else { units },
            ends: [
                (units[0] as f32).to_bits(),
                (units[1] as f32).to_bits(),
                (units[2] as f32).to_bits(),
            ],
            row: row as u32,
            layer: (row * rows) as u32,
            cell_layer: (x * y) as u32,
            roots: (x * y * z) as u32,
            kind,
            layout,
            steps,
            cells,
        })
    }
}

/// The greatest error of both books.
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

/// The errors of both books.
const fn books(header: Bytes<'_>) -> Option<&[[u8; 2]; 2 * BOOK]> {
    some!(header.slice(field::BOOKS, 4 * BOOK)).as_chunks().0.first_chunk()
}
