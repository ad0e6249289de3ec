//! Where things stand in a blob, by the numbers of the format and not by the reader's code.

use meshsweep::check::{Entry, entries};

/// Offset of the header's CRC.
pub(super) const HEADER_CRC: usize = 156;
/// Offset of the section table.
pub(super) const TABLE: usize = 160;
const ENTRY: usize = 16;

/// Writes a little-endian word; does nothing beyond the end.
pub fn put_u32(blob: &mut [u8], at: usize, value: u32) {
    if let Some(slot) = blob.get_mut(at..).and_then(|rest| rest.first_chunk_mut()) {
        *slot = value.to_le_bytes();
    }
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
