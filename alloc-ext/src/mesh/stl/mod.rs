//! STL, ASCII and binary.

mod ascii;
mod binary;
mod soup;

use std::path::Path;

use super::{MeshError, RawMesh, text};

/// Bytes of text in which an ASCII file names its first facet.
const FACET_WITHIN: usize = 1024;

/// Reads either kind. A file is binary if its size fits the count in its header, else ASCII if it
/// is text: many binary files start with `solid` too, and an ASCII file may begin with a comment.
/// Normals, colours and attributes are ignored: the winding counts.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    if !binary::is_of_announced_size(bytes) && is_text(bytes) {
        return ascii::read(file, bytes.len(), &text::decoded(bytes));
    }
    binary::read(file, bytes)
}

/// Whether the file is text. Within its header or its first triangle each binary file has a byte
/// that text has not: the count's high byte is 0.
fn is_text(bytes: &[u8]) -> bool {
    let utf_16: [&[u8]; 4] = [b"\xFF\xFE", b"\xFE\xFF", b"s\0o\0l\0i\0d\0", b"\0s\0o\0l\0i\0d"];
    if utf_16.iter().any(|mark| bytes.starts_with(mark)) {
        return true;
    }
    let padded = bytes.iter().rposition(|&b| b != 0).map_or(0, |last| last + 1);
    let head = &bytes[..padded.min(binary::HEADER_BYTES + binary::TRIANGLE_BYTES)];
    let is_of_text = |b: &u8| *b >= b' ' || matches!(b, 0x09..=0x0D | 0x1A);
    if head.iter().all(is_of_text) {
        return true;
    }
    // Some programs pad the name in an ASCII file's first line with zeros.
    let head = bytes[..bytes.len().min(FACET_WITHIN)].to_ascii_lowercase();
    let holds = |word: &[u8]| head.windows(word.len()).any(|at| at == word);
    holds(b"facet") && holds(b"vertex")
}
