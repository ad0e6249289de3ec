//! CRCs of a blob, computed again after it was changed.

use super::sections::{HEADER_CRC, TABLE, entries, put_u32, word};

/// CRC-32 (ISO-HDLC: reflected 0x04C11DB7, all ones in and out), eight bits at a time.
#[must_use]
pub fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0u32; 256];
        let mut at = 0;
        while at < 256 {
            let mut x = at as u32;
            let mut bit = 0;
            while bit < 8 {
                x = if x & 1 == 0 { x >> 1 } else { x >> 1 ^ 0xEDB8_8320 };
                bit += 1;
            }
            table[at] = x;
            at += 1;
        }
        table
    };
    !bytes.iter().fold(!0u32, |crc, &b| crc >> 8 ^ TABLE[((crc ^ u32::from(b)) & 0xFF) as usize])
}

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

#[cfg(test)]
mod tests {
    use super::crc32;

    #[test]
    fn crc32_has_the_published_check_value() {
        assert_eq!(crc32(b"123456789"), 0xCBF4_3926);
    }
}
