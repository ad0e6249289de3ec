//! The section table: where sections lie, and their CRCs.

use super::bytes::Bytes;
use super::error::OpenError;
use super::header::Header;
use super::layout::{
    HEADER_BYTES, MAX_SECTIONS, SECTION_ALIGNMENT, SECTION_ENTRY_BYTES, SectionKind, entry, field,
};
use crc::{CRC_32_ISO_HDLC, Crc, Table};

/// The smallest table. Larger ones are faster and take 3 KiB more, and a blob is opened once.
const CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// CRC-32 (ISO-HDLC) of a section, as the table stores it.
pub fn section_crc(bytes: &[u8]) -> u32 {
    CRC.checksum(bytes)
}

/// CRC of header and section table, without the field that stores this CRC.
fn header_crc(bytes: &[u8]) -> Option<u32> {
    let mut digest = CRC.digest();
    digest.update(bytes.get(..field::CRC)?);
    digest.update(bytes.get(field::CRC + 4..)?);
    Some(digest.finalize())
}

/// A section as the table lists it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Section {
    /// Its contents.
    pub kind: SectionKind,
    /// First byte.
    pub offset: u32,
    /// Bytes.
    pub bytes: u32,
    /// CRC-32 (ISO-HDLC) of the bytes.
    pub crc: u32,
}

/// Reads the header. Checks its CRC, the size of the section table, and the length of `bytes`.
pub(crate) fn read_header(bytes: &[u8]) -> Result<Header, OpenError> {
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
    if header_crc(head) != all.u32(field::CRC) {
        return Err(OpenError::Crc { section: None });
    }
    Ok(header)
}

/// Entry `index` of the section table; `Ok(None)` if its kind is unknown.
pub(crate) fn section(bytes: Bytes<'_>, index: u32) -> Result<Option<Section>, OpenError> {
    let malformed = OpenError::Section { index };
    let at = HEADER_BYTES + index as usize * SECTION_ENTRY_BYTES;
    let word = |field: usize| bytes.u32(at + field).ok_or(malformed);
    let code = word(entry::KIND)?;
    let kind = SectionKind::ALL.into_iter().find(|kind| *kind as u32 == code);
    let (offset, bytes, crc) = (word(entry::OFFSET)?, word(entry::BYTES)?, word(entry::CRC)?);
    Ok(kind.map(|kind| Section { kind, offset, bytes, crc }))
}

/// Checks the section table, and calls `place` with the index, kind and bytes of every section that
/// `wants` accepts. Checks the CRCs of these sections if `check`. Returns a bit for each kind in
/// the table.
pub(crate) fn place_sections<'a>(
    header: &Header,
    bytes: Bytes<'a>,
    check: bool,
    wants: impl Fn(SectionKind) -> bool,
    mut place: impl FnMut(u32, SectionKind, &'a [u8]) -> Result<(), OpenError>,
) -> Result<u32, OpenError> {
    let mut end = header.header_bytes;
    let mut seen = 0u32;
    for index in 0..header.section_count {
        let malformed = OpenError::Section { index };
        // A later minor version may add a kind. Its section must keep the rules all the same.
        let at = HEADER_BYTES + index as usize * SECTION_ENTRY_BYTES;
        let offset = bytes.u32(at + entry::OFFSET).ok_or(malformed)?;
        let length = bytes.u32(at + entry::BYTES).ok_or(malformed)?;
        let section_end = offset.checked_add(length).ok_or(malformed)?;
        if offset < end
            || section_end > header.total_bytes
            || !(offset as usize).is_multiple_of(SECTION_ALIGNMENT)
        {
            return Err(malformed);
        }
        // The gap between sections is padding: shorter than the alignment, and zero.
        let gap = bytes.slice(end as usize, (offset - end) as usize).ok_or(malformed)?;
        if gap.len() >= SECTION_ALIGNMENT || gap.iter().any(|&b| b != 0) {
            return Err(malformed);
        }
        end = section_end;
        let Some(section) = section(bytes, index)? else { continue };
        let bit = 1u32.checked_shl(section.kind as u32).ok_or(malformed)?;
        if seen & bit != 0 {
            return Err(malformed);
        }
        seen |= bit;
        if !wants(section.kind) {
            continue;
        }
        let data = bytes.slice(offset as usize, length as usize).ok_or(malformed)?;
        if check && section_crc(data) != section.crc {
            return Err(OpenError::Crc { section: Some(section.kind) });
        }
        place(index, section.kind, data)?;
    }
    if end != header.total_bytes {
        return Err(OpenError::Counts { what: "bytes after the last section" });
    }
    Ok(seen)
}
