//! Wavefront OBJ: the `v` and `f` statements. `l` and `p` are counted, all others skipped.

use std::path::Path;

use super::polygons::{FacePlace, Faces, Split};
use super::text::{lines, point};
use super::{LeftOut, MeshError, RawMesh};

/// Reads `v x y z …` and `f v[/vt[/vn]] …`, indices from 1 or relative (negative), `\` at a line's
/// end continuing it, but not a comment: that may end with the path of a directory. Faces of one or
/// two vertices have no surface and are counted, as points and lines are (`p`, `l`).
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut positions = Vec::new();
    let mut faces = Faces::default();
    let mut lines_and_points = 0;
    // From 1, as everything in such a file.
    let mut face = 1;
    let mut corners: Vec<u32> = Vec::new();
    // OBJ lets a face name a vertex that comes later in the file, so ranges are checked against the
    // final count.
    let mut highest: Option<(u32, usize, usize)> = None;
    let mut joined = String::new();
    let mut lines = lines(bytes).peekable();
    while let Some((number, text)) = lines.next() {
        let text = text.split('#').next().unwrap_or("").trim_end();
        let part = text.strip_suffix('\\');
        if let Some(part) = part
            && lines.peek().is_some()
        {
            joined.push_str(part);
            joined.push(' ');
            continue;
        }
        let text = part.unwrap_or(text);
        let whole;
        let statement = if joined.is_empty() {
            text
        } else {
            whole = std::mem::take(&mut joined) + text;
            &whole
        };
        let mut words = statement.split_ascii_whitespace();
        match words.next() {
            Some("v") => positions.push(point(file, number, positions.len() + 1, &mut words)?),
            Some("f") => {
                corners.clear();
                for word in words {
                    let vertex = index(file, number, face, word, positions.len())?;
                    if highest.is_none_or(|(most, ..)| vertex > most) {
                        highest = Some((vertex, number, face));
                    }
                    corners.push(vertex);
                }
                faces.add(&corners, FacePlace { face, line: Some(number) });
                face += 1;
            }
            Some("l" | "p") => lines_and_points += 1,
            _ => {}
        }
    }
    match highest {
        Some((vertex, line, face)) if vertex as usize >= positions.len() => {
            Err(MeshError::IndexOutOfRange {
                file: file.to_owned(),
                line: Some(line),
                face,
                index: i64::from(vertex) + 1,
                vertex_count: positions.len(),
            })
        }
        _ => {
            let small_faces = faces.small;
            let Split { triangles, polygons, fans } = faces.finish(&positions);
            let left_out = LeftOut { lines_and_points, small_faces, ..LeftOut::default() };
            let raw = RawMesh::from_f64(positions, triangles);
            Ok(RawMesh { file: file.to_owned(), polygons, fans, decimal: true, left_out, ..raw })
        }
    }
}

/// The vertex (from 0) that a word of an `f` statement names, `vertex_count` vertices having been
/// read so far.
fn index(
    file: &Path,
    line: usize,
    face: usize,
    word: &str,
    vertex_count: usize,
) -> Result<u32, MeshError> {
    let number = word.split('/').next().unwrap_or("");
    let index: i64 = number.parse().map_err(|_| MeshError::Malformed {
        file: file.to_owned(),
        line: Some(line),
        place: format!("face {face}"),
        reason: format!("{word:?} does not name a vertex"),
    })?;
    let from_zero = match index {
        0 => None,
        1.. => Some(index - 1),
        _ => i64::try_from(vertex_count).ok().map(|count| count + index),
    };
    from_zero.and_then(|v| u32::try_from(v).ok()).ok_or(MeshError::IndexOutOfRange {
        file: file.to_owned(),
        line: Some(line),
        face,
        index,
        vertex_count,
    })
}
