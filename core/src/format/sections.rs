//! The section table: where sections lie, and their CRCs.

use super::bytes::Bytes;
use super::contradiction::Contradiction;
use super::error::OpenError;
use super::header::Header;
use super::layout::{
    HEADER_BYTES, MAX_SECTIONS, SECTION_ALIGNMENT, SECTION_ENTRY_BYTES, SectionKind, entry, field,
};
use crc::{CRC_32_ISO_HDLC, Crc, Table};

/// The smallest table. Larger ones are faster and take 3 KiB more, and a blob is opened once.
const CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// CRC-32 (ISO-HDLC) of a section, as the table stores it.
pub const fn section_crc(bytes: &[u8]) -> u32 {
    CRC.checksum(bytes)
}

/// CRC of header and section table, without the field that stores this CRC.
const fn header_crc(head: &[u8]) -> Option<u32> {
    let (before, rest) = some!(head.split_at_checked(field::CRC));
    let (_, after) = some!(rest.split_at_checked(4));
    let mut digest = CRC.digest();
    digest.update(before);
    digest.update(after);
    Some(digest.finalize())
}

/// A section as the table lists it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
#[inline(never)]
const fn read_header(bytes: &[u8]) -> Result<Header, OpenError> {
    let all = Bytes(bytes);
    let header = ok!(Header::read(all));
    let (total, found) = (header.total_bytes as usize, bytes.len());
    if found < total {
        return Err(OpenError::Truncated { needed: header.total_bytes, found: found as u32 });
    }
    if found > total {
        return Err(OpenError::TrailingBytes { expected: header.total_bytes, found: found as u32 });
    }
    let sections = header.section_count as usize;
    let wrong = OpenError::Counts { what: Contradiction::SectionTableSize };
    if sections > MAX_SECTIONS
        || header.header_bytes as usize != HEADER_BYTES + sections * SECTION_ENTRY_BYTES
        || header.header_bytes > header.total_bytes
    {
        return Err(wrong);
    }
    let head = ok!(all.slice(0, header.header_bytes as usize), wrong);
    match (header_crc(head), all.u32(field::CRC)) {
        (Some(computed), Some(stored)) if computed == stored => Ok(header),
        _ => Err(OpenError::Crc { section: None }),
    }
}

/// Entry `index` of the section table; `Ok(None)` if its kind is unknown.
pub(crate) const fn section(bytes: Bytes<'_>, index: u32) -> Result<Option<Section>, OpenError> {
    let malformed = OpenError::Section { index };
    let at = HEADER_BYTES + index as usize * SECTION_ENTRY_BYTES;
    let code = ok!(bytes.u32(at + entry::KIND), malformed);
    let offset = ok!(bytes.u32(at + entry::OFFSET), malformed);
    let length = ok!(bytes.u32(at + entry::BYTES), malformed);
    let crc = ok!(bytes.u32(at + entry::CRC), malformed);
    Ok(match SectionKind::from_code(code) {
        Some(kind) => Some(Section { kind, offset, bytes: length, crc }),
        None => None,
    })
}

/// A checked header and section table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SectionTable<'a> {
    pub(crate) header: Header,
    bytes: Bytes<'a>,
    /// By kind the number of its entry plus one, or 0.
    entries: [u8; MAX_SECTIONS],
}

impl<'a> SectionTable<'a> {
    /// Checks header and section table, and the CRC of both.
    pub(crate) const fn open(bytes: &'a [u8]) -> Result<Self, OpenError> {
        Self::of(ok!(read_header(bytes)), bytes)
    }

    /// Reads the table of bytes that were opened before: without the CRC.
    pub(crate) const fn view(bytes: &'a [u8]) -> Result<Self, OpenError> {
        Self::of(ok!(Header::read(Bytes(bytes))), bytes)
    }

    // Not inlined, here and below: each structure would have a copy.
    #[inline(never)]
    const fn of(header: Header, bytes: &'a [u8]) -> Result<Self, OpenError> {
        let bytes = Bytes(bytes);
        // Kinds are below `MAX_SECTIONS`; the remainder spares a bounds check that could panic.
        let mut entries = [0; MAX_SECTIONS];
        let mut end = header.header_bytes;
        let mut index = 0;
        while index < header.section_count {
            let malformed = OpenError::Section { index };
            // A later minor version may add a kind. Its section must keep the rules all the same.
            let at = HEADER_BYTES + index as usize * SECTION_ENTRY_BYTES;
            let offset = ok!(bytes.u32(at + entry::OFFSET), malformed);
            let length = ok!(bytes.u32(at + entry::BYTES), malformed);
            let section_end = ok!(offset.checked_add(length), malformed);
            if offset < end
                || section_end > header.total_bytes
                || !(offset as usize).is_multiple_of(SECTION_ALIGNMENT)
            {
                return Err(malformed);
            }
            // The gap between sections is padding: shorter than the alignment, and zero.
            let gap = (offset - end) as usize;
            if gap >= SECTION_ALIGNMENT || !bytes.is_zero(end as usize, gap) {
                return Err(malformed);
            }
            end = section_end;
            index += 1;
            let Some(section) = ok!(section(bytes, index - 1)) else { continue };
            let (_, rest) = entries.split_at_mut(section.kind as usize % MAX_SECTIONS);
            match rest.split_first_mut() {
                Some((entry, _)) if *entry == 0 => *entry = index as u8,
                _ => return Err(malformed),
            }
        }
        if end != header.total_bytes {
            return Err(OpenError::Counts { what: Contradiction::BytesAfterSections });
        }
        Ok(SectionTable { header, bytes, entries })
    }

    /// The CRC of header and section table. It covers the CRCs of the sections.
    pub(crate) const fn checksum(&self) -> u32 {
        self.bytes.word(field::CRC)
    }

    /// The entry of a kind, and its number.
    #[inline(never)]
    const fn entry(&self, kind: SectionKind) -> Option<(u32, Section)> {
        let Some(index) = self.entries[kind as usize % MAX_SECTIONS].checked_sub(1) else {
            return None;
        };
        match section(self.bytes, index as u32) {
            Ok(Some(section)) => Some((index as u32, section)),
            _ => None,
        }
    }

    /// Whether the blob has a section of this kind.
    pub(crate) const fn has(&self, kind: SectionKind) -> bool {
        self.entry(kind).is_some()
    }

    /// The bytes of a section; none if it is missing.
    #[inline(never)]
    pub(crate) const fn bytes(&self, kind: SectionKind) -> &'a [u8] {
        match self.entry(kind) {
            Some((_, section)) => {
                match self.bytes.slice(section.offset as usize, section.bytes as usize) {
                    Some(bytes) => bytes,
                    None => &[],
                }
            }
            None => &[],
        }
    }

    /// The error of a section whose bytes have the wrong number or content.
    #[inline(never)]
    pub(crate) const fn malformed(&self, kind: SectionKind) -> OpenError {
        match self.entry(kind) {
            Some((index, _)) => OpenError::Section { index },
            None => OpenError::MissingSection { section: kind },
        }
    }

    /// The records of a section; none if it is missing.
    #[inline(never)]
    pub(crate) const fn records<const N: usize>(
        &self,
        kind: SectionKind,
    ) -> Result<&'a [[u8; N]], OpenError> {
        match self.bytes(kind).as_chunks() {
            (records, []) => Ok(records),
            _ => Err(self.malformed(kind)),
        }
    }

    /// Checks the CRCs of the sections of some kinds.
    pub(crate) fn check_crcs(&self, wants: impl Fn(SectionKind) -> bool) -> Result<(), OpenError> {
        let mut kinds = SectionKind::ALL.into_iter().filter(|kind| wants(*kind));
        kinds.try_for_each(|kind| self.check_crc(kind))
    }

    /// Checks the CRCs of all sections of known kinds.
    pub(crate) const fn check_all_crcs(&self) -> Result<(), OpenError> {
        let mut kinds: &[SectionKind] = &SectionKind::ALL;
        while let Some((kind, rest)) = kinds.split_first() {
            ok!(self.check_crc(*kind));
            kinds = rest;
        }
        Ok(())
    }

    /// Checks the CRC of a section, if it is there.
    const fn check_crc(&self, kind: SectionKind) -> Result<(), OpenError> {
        match self.entry(kind) {
            Some((_, section)) if section_crc(self.bytes(kind)) != section.crc => {
                Err(OpenError::Crc { section: Some(kind) })
            }
            _ => Ok(()),
        }
    }
}
