//! Decimal text, as OBJ and ASCII STL share it.
//!
//! Both are read here and not by a crate: `tobj` renumbers vertices and names neither line nor face
//! in its errors, `stl_io` reads only the first solid of an ASCII file, silently, and rounds to
//! `f32` without saying by how much.

use std::path::Path;

use super::MeshError;

/// The lines of a text file, numbered from 1, without bytes that are not UTF-8 (they occur in names
/// and comments only).
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, std::borrow::Cow<'_, str>)> {
    bytes.split(|&b| b == b'\n').enumerate().map(|(i, line)| (i + 1, String::from_utf8_lossy(line)))
}

/// The next three words as the coordinates of vertex `vertex`.
pub(super) fn point<'a>(
    file: &Path,
    line: usize,
    vertex: usize,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<[f64; 3], MeshError> {
    let mut at = [0.0f64; 3];
    for x in &mut at {
        let word = words.next().unwrap_or("");
        *x = word.parse().map_err(|_| MeshError::Malformed {
            file: file.to_owned(),
            line: Some(line),
            place: format!("vertex {vertex}"),
            reason: if word.is_empty() {
                "fewer than three coordinates".into()
            } else {
                format!("{word:?} is not a number")
            },
        })?;
    }
    if at.iter().all(|x| x.is_finite()) {
        Ok(at)
    } else {
        Err(MeshError::NotFinite { file: file.to_owned(), line: Some(line), vertex, at })
    }
}
