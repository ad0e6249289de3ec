//! Header and section table of a blob read anew, checksums proved.

use crate::corrupt::{crc32, entries, word};

/// The word of the header at `offset`.
pub(super) fn header_word(bytes: &[u8], offset: usize) -> Result<u32, String> {
    word(bytes, offset).ok_or("the header is cut short".to_owned())
}

/// Proves that it is a whole blob whose header's CRC holds.
pub(super) fn check_header(bytes: &[u8]) -> Result<(), String> {
    let at = |offset: usize| header_word(bytes, offset);
    if bytes.get(..10) != Some(b"meshswep\x03\x00".as_slice()) || at(16)? as usize != bytes.len() {
        return Err("not a whole blob of version 3".into());
    }
    let table_end = (at(12)? as usize).min(bytes.len()).max(160);
    if crc32(&[&bytes[..156], &bytes[160..table_end]].concat()) != at(156)? {
        return Err("the header's CRC does not hold".into());
    }
    Ok(())
}

/// Bytes of a section, its CRC proved; none if it is not there.
pub(super) fn section<'a>(bytes: &'a [u8], kind: u32, name: &str) -> Result<&'a [u8], String> {
    let Some(entry) = entries(bytes).into_iter().find(|entry| entry.kind == kind) else {
        return Ok(&[]);
    };
    let start = entry.offset as usize;
    let body =
        bytes.get(start..start + entry.bytes as usize).ok_or(format!("{name} leaves the blob"))?;
    if Some(crc32(body)) == word(bytes, entry.at + 12) {
        Ok(body)
    } else {
        Err(format!("the CRC of {name} does not hold"))
    }
}
