//! CRCs of a blob, computed again after it was changed.

use super::sections::{HEADER_CRC, TABLE, put_u32};
use meshsweep::check::{crc32, entries, word};

/// Writes the CRC of every section that lies inside the blob, of blobs within sections too, then
/// the header's. So `open` gets past the checksums of a damaged blob, as far as the table can be
/// followed.
pub fn seal(blob: &mut [u8]) {
    for entry in entries(blob) {
        let end = u64::from(entry.offset) + u64::from(entry.bytes);
        if end <= blob.len() as u64 {
            if entry.kind == TIGHT_HULLS {
                seal_hulls(&mut blob[entry.offset as usize..end as usize]);
            }
            let crc = crc32(&blob[entry.offset as usize..end as usize]);
            put_u32(blob, entry.at + 12, crc);
        }
    }
    let table_end = word(blob, 12).map_or(0, |end| end as usize).min(blob.len());
    if blob.len() >= TABLE && table_end >= TABLE {
        let mut covered = blob[..HEADER_CRC].to_vec();
        covered.extend(&blob[TABLE..table_end]);
        put_u32(blob, HEADER_CRC, crc32(&covered));
    }
}

/// The kind of section that holds blobs.
const TIGHT_HULLS: u32 = 20;

/// Seals the blobs in a section, as far as its table can be followed.
fn seal_hulls(section: &mut [u8]) {
    let count = word(section, 0).unwrap_or(0).min(64) as usize;
    for record in 0..count {
        let field = |at: usize| word(section, 8 + 24 * record + at);
        let (Some(offset), Some(bytes)) = (field(0), field(4)) else { return };
        let end = u64::from(offset) + u64::from(bytes);
        if end <= section.len() as u64 {
            seal(&mut section[offset as usize..end as usize]);
        }
    }
}
