//! Header, section table and sections of a blob read anew, checksums proved, by the numbers of the
//! format and not by the reader's code.

/// Offset of the section table.
const TABLE: usize = 160;
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

/// The word of the header at `offset`.
pub(crate) fn header_word(bytes: &[u8], offset: usize) -> Result<u32, String> {
    word(bytes, offset).ok_or("the header is cut short".to_owned())
}

/// Proves that it is a whole blob whose header's CRC holds.
pub(crate) fn check_header(bytes: &[u8]) -> Result<(), String> {
    let at = |offset: usize| header_word(bytes, offset);
    if bytes.len() < TABLE {
        return Err("the header is cut short".into());
    }
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
pub(crate) fn section<'a>(bytes: &'a [u8], kind: u32, name: &str) -> Result<&'a [u8], String> {
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

/// A section, read from front to back.
pub(crate) struct Cursor<'a>(pub(crate) &'a [u8], pub(crate) &'static str);

impl Cursor<'_> {
    pub(crate) fn uint(&mut self, width: usize) -> Result<u32, String> {
        let Some((head, rest)) = self.0.split_at_checked(width) else {
            return Err(format!("section {} ends early", self.1));
        };
        self.0 = rest;
        Ok(head.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte)))
    }

    pub(crate) fn float(&mut self) -> Result<f32, String> {
        self.uint(4).map(f32::from_bits)
    }

    pub(crate) fn triple(&mut self, width: usize) -> Result<[u32; 3], String> {
        Ok([self.uint(width)?, self.uint(width)?, self.uint(width)?])
    }

    pub(crate) fn end(self) -> Result<(), String> {
        if self.0.is_empty() { Ok(()) } else { Err(format!("section {} is too long", self.1)) }
    }
}

/// Bytes that hold `count` values and one more.
pub(crate) fn width(count: u32) -> usize {
    [0xFF, 0xFFFF, 0xFF_FFFF].iter().position(|&most| count <= most).map_or(4, |at| at + 1)
}

#[cfg(test)]
mod tests {
    use super::crc32;

    #[test]
    fn crc32_has_the_published_check_value() {
        assert_eq!(crc32(b"123456789"), 0xCBF4_3926);
    }
}
