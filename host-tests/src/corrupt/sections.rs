//! Where things stand in a blob, by the numbers of the format and not by the reader's code.

/// Offset of the header's CRC.
pub(super) const HEADER_CRC: usize = 156;
/// Offset of the section table.
pub(super) const TABLE: usize = 160;
const ENTRY: usize = 16;

/// An entry of the section table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Offset of the entry itself: kind, offset, length, CRC.
    pub at: usize,
    /// Kind.
    pub kind: u32,
    /// First byte of the section.
    pub offset: u32,
    /// Bytes of the section.
    pub bytes: u32,
}

/// The little-endian word at `at`.
#[must_use]
pub fn word(blob: &[u8], at: usize) -> Option<u32> {
    blob.get(at..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}

/// Writes a little-endian word; does nothing beyond the end.
pub fn put_u32(blob: &mut [u8], at: usize, value: u32) {
    if let Some(slot) = blob.get_mut(at..).and_then(|rest| rest.first_chunk_mut()) {
        *slot = value.to_le_bytes();
    }
}

/// The section table, as far as it lies in the blob.
#[must_use]
pub fn entries(blob: &[u8]) -> Vec<Entry> {
    let count = word(blob, 20).unwrap_or(0).min(64) as usize;
    (0..count)
        .map_while(|index| {
            let at = TABLE + ENTRY * index;
            word(blob, at + 12)?;
            Some(Entry {
                at,
                kind: word(blob, at)?,
                offset: word(blob, at + 4)?,
                bytes: word(blob, at + 8)?,
            })
        })
        .collect()
}

/// The entry of the section of kind `kind`.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn entry(blob: &[u8], kind: u32) -> Entry {
    entries(blob).into_iter().find(|e| e.kind == kind).expect("the section exists")
}

/// Exchanges the table's entries number `i` and `j`.
pub fn swap_entries(blob: &mut [u8], i: usize, j: usize) {
    for k in 0..ENTRY {
        blob.swap(TABLE + ENTRY * i + k, TABLE + ENTRY * j + k);
    }
}
