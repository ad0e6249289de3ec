//! Opening the tight hulls of a blob, and the check.

use super::layout::{TIGHT_BYTES, TIGHT_HULL_BYTES, field};
use super::view::{TightHulls, read};
use crate::bvh::tree::format::Bvh;
use crate::format::Contradiction;
use crate::format::layout::{MAX_LEVELS, SECTION_ALIGNMENT, SectionKind};
use crate::format::{Bytes, OpenError, SectionTable, ok};
use crate::num::Radius16;

impl<'a> TightHulls<'a> {
    /// Opens the tight hulls of a blob where they lie, and checks all of them: CRCs, each tree,
    /// each distance. Any bytes are safe to open. It reads no other sections, so that the code that
    /// checks them is not linked.
    ///
    /// Cost: linear in the hulls; no allocation; once per start. Alignment of `bytes` does not
    /// matter.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without tight hulls.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<TightHulls<'a>, OpenError> {
        let table = SectionTable::open(bytes)?;
        table.check_crcs(|kind| kind == SectionKind::TightHulls)?;
        let hulls = TightHulls::locate(&table)?;
        hulls.check()?;
        Ok(hulls)
    }

    /// Opens the tight hulls of an image that was verified before, and checks header and tables
    /// only. It is a constant function, as [`Bvh::open_trusted`], which says what changed bytes can
    /// do and what they cannot. [`get`](Self::get) is constant too, so a hull can be a `static`.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without tight hulls.
    pub const fn open_trusted(bytes: &'a [u8]) -> Result<TightHulls<'a>, OpenError> {
        TightHulls::locate(&ok!(SectionTable::open(bytes)))
    }

    /// The hulls of bytes that were checked before.
    pub(crate) const fn view(bytes: &'a [u8]) -> Result<TightHulls<'a>, OpenError> {
        TightHulls::locate(&ok!(SectionTable::view(bytes)))
    }

    const fn locate(table: &SectionTable<'a>) -> Result<TightHulls<'a>, OpenError> {
        let kind = SectionKind::TightHulls;
        if !table.has(kind) {
            return Err(OpenError::MissingSection { section: kind });
        }
        let data = Bytes(table.bytes(kind));
        let count = ok!(data.u32(field::COUNT), table.malformed(kind));
        if !data.is_zero(field::RESERVED, 4) {
            return Err(OpenError::Reserved);
        }
        if count == 0 || count > MAX_LEVELS {
            return Err(OpenError::Counts { what: Contradiction::TightHullCount });
        }
        let records = data.slice(TIGHT_BYTES, count as usize * TIGHT_HULL_BYTES);
        Ok(TightHulls { records: ok!(records, table.malformed(kind)).as_chunks().0, data })
    }

    fn check(&self) -> Result<(), OpenError> {
        let mut end = TIGHT_BYTES + self.records.len() * TIGHT_HULL_BYTES;
        let mut faces_before = 0;
        for (index, bytes) in (0u32..).zip(self.records) {
            let bad = OpenError::Record { section: SectionKind::TightHulls, index };
            let (place, record) = read(bytes);
            // Hulls follow each other. Bytes between them are zeros, fewer than the alignment.
            let start = end.next_multiple_of(SECTION_ALIGNMENT);
            let gap = self.data.slice(end, start - end).ok_or(bad)?;
            if place.offset as usize != start || gap.iter().any(|&byte| byte != 0) {
                return Err(bad);
            }
            let length = |x: f32| x >= 0.0 && x.is_finite();
            if record.faces <= faces_before
                || !(length(record.slack) && length(record.depth) && record.void_ratio.is_finite())
            {
                return Err(bad);
            }
            let (blob, slacks) = self.parts(place, record.faces).ok_or(bad)?;
            let tree = Bvh::open(blob)?;
            let whole =
                tree.header().triangles == record.faces && tree.input_triangles() == record.faces;
            let sound = |bytes: &[u8; 2]| length(Radius16(u16::from_le_bytes(*bytes)).get());
            if !whole || slacks.len() != record.faces as usize || !slacks.iter().all(sound) {
                return Err(bad);
            }
            faces_before = record.faces;
            // In range: the parts are slices of the section.
            end = start + blob.len() + slacks.len() * 2;
        }
        if end == self.data.len() {
            Ok(())
        } else {
            Err(OpenError::Counts { what: Contradiction::BytesAfterTightHulls })
        }
    }
}
