//! Opening a blob: header, section table and CRCs here, the contents of the sections in `check`.

use super::error::OpenError;
use super::header::Header;
use super::layout::{
    HEADER_BYTES, HEADER_CRC_AT, MAX_SECTIONS, SECTION_ALIGNMENT, SECTION_ENTRY_BYTES, SectionKind,
};
use super::model::{Model, Section, Vertices, Widths};
use super::read::Bytes;
use crc::{CRC_32_ISO_HDLC, Crc, Table};

/// Sixteen-bit tables would be faster and 3 KiB larger; a blob is opened once.
const CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// CRC-32 (ISO-HDLC) of a section, as the table stores it.
pub fn section_crc(bytes: &[u8]) -> u32 {
    CRC.checksum(bytes)
}

/// CRC of header and section table, the field that holds it left out.
fn header_crc(bytes: &[u8]) -> Option<u32> {
    let mut digest = CRC.digest();
    digest.update(bytes.get(..HEADER_CRC_AT)?);
    digest.update(bytes.get(HEADER_CRC_AT + 4..)?);
    Some(digest.finalize())
}

impl<'a> Model<'a> {
    /// Opens a blob where it lies, and checks all of it: CRCs, every index, every coordinate, every order that the
    /// queries rely on. Any bytes are safe to open.
    ///
    /// Cost: linear in the blob, no allocation; once per start, not per query. Alignment of `bytes` does not matter.
    ///
    /// # Errors
    /// [`OpenError`] says what was wanted and what was found.
    pub fn open(bytes: &'a [u8]) -> Result<Model<'a>, OpenError> {
        let all = Bytes(bytes);
        let header = Header::read(all)?;
        let (total, found) = (header.total_bytes as usize, bytes.len());
        if found < total || total < HEADER_BYTES {
            return Err(OpenError::Truncated { needed: header.total_bytes, found: found as u32 });
        }
        if found > total {
            return Err(OpenError::TrailingBytes { expected: header.total_bytes, found: found as u32 });
        }
        let sections = header.section_count as usize;
        if sections > MAX_SECTIONS
            || header.header_bytes as usize != HEADER_BYTES + sections * SECTION_ENTRY_BYTES
            || header.header_bytes > header.total_bytes
        {
            return Err(OpenError::Counts { what: "size of the section table" });
        }
        let head = all.slice(0, header.header_bytes as usize).unwrap_or_default();
        if header_crc(head) != all.u32(HEADER_CRC_AT) {
            return Err(OpenError::Crc { section: None });
        }
        let mut model = Model {
            header,
            widths: Widths::of(&header),
            bytes: all,
            vertices: Vertices::new(header.vertex_format, &[]),
            base: Bytes(&[]),
            groups: Bytes(&[]),
            splits: Bytes(&[]),
            rings: Bytes(&[]),
            radii: Bytes(&[]),
            splits_with: Bytes(&[]),
            cover: Bytes(&[]),
            surface: Bytes(&[]),
            source: Bytes(&[]),
            levels: Bytes(&[]),
        };
        model.place_sections()?;
        model.check()?;
        Ok(model)
    }

    /// Sections of the blob, in file order. Entries of a kind that this version does not know are passed over.
    pub fn sections(&self) -> impl Iterator<Item = Section> + '_ {
        (0..self.header.section_count).filter_map(|index| self.section(index).ok().flatten())
    }

    /// Entry `index` of the section table; `Ok(None)` if its kind is unknown.
    fn section(&self, index: u32) -> Result<Option<Section>, OpenError> {
        let malformed = OpenError::Section { index };
        let at = HEADER_BYTES + index as usize * SECTION_ENTRY_BYTES;
        let word = |k: usize| self.bytes.u32(at + 4 * k).ok_or(malformed);
        let code = word(0)?;
        let kind = SectionKind::ALL.into_iter().find(|kind| *kind as u32 == code);
        let (offset, bytes, crc) = (word(1)?, word(2)?, word(3)?);
        Ok(kind.map(|kind| Section { kind, offset, bytes, crc }))
    }

    fn place_sections(&mut self) -> Result<(), OpenError> {
        let mut end = self.header.header_bytes;
        let mut seen = 0u32;
        for index in 0..self.header.section_count {
            let malformed = OpenError::Section { index };
            // An unknown kind still has to lie where sections may lie; a later minor version may add one.
            let at = HEADER_BYTES + index as usize * SECTION_ENTRY_BYTES;
            let offset = self.bytes.u32(at + 4).ok_or(malformed)?;
            let length = self.bytes.u32(at + 8).ok_or(malformed)?;
            let section_end = offset.checked_add(length).ok_or(malformed)?;
            if offset < end
                || section_end > self.header.total_bytes
                || !(offset as usize).is_multiple_of(SECTION_ALIGNMENT)
            {
                return Err(malformed);
            }
            // The gap between sections is padding: shorter than the alignment, and zero.
            let gap = self.bytes.slice(end as usize, (offset - end) as usize).ok_or(malformed)?;
            if gap.len() >= SECTION_ALIGNMENT || gap.iter().any(|&b| b != 0) {
                return Err(malformed);
            }
            end = section_end;
            let Some(section) = self.section(index)? else { continue };
            let bit = 1u32.checked_shl(section.kind as u32).ok_or(malformed)?;
            if seen & bit != 0 {
                return Err(malformed);
            }
            seen |= bit;
            let data = self.bytes.slice(offset as usize, length as usize).ok_or(malformed)?;
            if section_crc(data) != section.crc {
                return Err(OpenError::Crc { section: Some(section.kind) });
            }
            if Some(data.len()) != self.section_len(section.kind) {
                return Err(malformed);
            }
            if section.kind == SectionKind::Vertices {
                self.vertices = Vertices::new(self.header.vertex_format, data);
            } else {
                *self.slot(section.kind) = Bytes(data);
            }
        }
        if end != self.header.total_bytes {
            return Err(OpenError::Counts { what: "bytes after the last section" });
        }
        let missing = SectionKind::ALL.into_iter().find(|&kind| {
            let present = seen.checked_shr(kind as u32).unwrap_or(0) & 1 != 0;
            !present && self.section_len(kind) != Some(0)
        });
        missing.map_or(Ok(()), |section| Err(OpenError::MissingSection { section }))
    }

    fn slot(&mut self, kind: SectionKind) -> &mut Bytes<'a> {
        match kind {
            SectionKind::Vertices | SectionKind::BaseTriangles => &mut self.base,
            SectionKind::BaseGroups => &mut self.groups,
            SectionKind::Splits => &mut self.splits,
            SectionKind::Rings => &mut self.rings,
            SectionKind::Radii => &mut self.radii,
            SectionKind::SplitsWith => &mut self.splits_with,
            SectionKind::Cover => &mut self.cover,
            SectionKind::Surface => &mut self.surface,
            SectionKind::Source => &mut self.source,
            SectionKind::Levels => &mut self.levels,
        }
    }
}
