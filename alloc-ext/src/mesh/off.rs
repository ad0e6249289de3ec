//! OFF in text.

use std::path::Path;

use super::polygons::{FacePlace, Faces, Split};
use super::text::{lines, point};
use super::{LeftOut, MeshError, RawMesh};

/// Reads `OFF` and its variants with normals, colours and texture coordinates (`COFF`, `NOFF`,
/// `STOFF`): of a vertex's line the first three numbers, of a face's line its corners. Faces of one
/// or two vertices have no surface and are counted.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let malformed = |line: usize, place: String, reason: String| MeshError::Malformed {
        file: file.to_owned(),
        line: Some(line),
        place,
        reason,
    };
    let header = |line: usize, reason: &str| malformed(line, "the header".into(), reason.into());
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut surface = Faces::default();
    let mut bytes_after_end = 0;
    let mut corners: Vec<u32> = Vec::new();
    let mut has_keyword = false;
    let mut counts: Option<[usize; 2]> = None;
    let mut face = 0;
    for (number, text) in lines(bytes) {
        let text = text.split('#').next().unwrap_or("");
        let mut words = text.split_ascii_whitespace().peekable();
        if words.peek().is_none() {
            continue;
        }
        if !has_keyword {
            let keyword = words.next().unwrap_or("");
            check_keyword(file, keyword, words.clone().next())
                .map_err(|refused| refused.unwrap_or_else(|| header(number, "no keyword OFF")))?;
            has_keyword = true;
            if words.peek().is_none() {
                continue;
            }
        }
        let Some([vertices, faces]) = counts else {
            let mut count = || words.next().and_then(|word| word.parse().ok());
            let (Some(vertices), Some(faces)) = (count(), count()) else {
                return Err(header(number, "numbers of vertices and faces are wanted"));
            };
            counts = Some([vertices, faces]);
            continue;
        };
        if positions.len() < vertices {
            positions.push(point(file, number, positions.len(), &mut words)?);
            continue;
        }
        if face == faces {
            bytes_after_end += text.len();
            continue;
        }
        let place = || format!("face {face}");
        let size = words.next().unwrap_or("");
        let size: usize = size
            .parse()
            .map_err(|_| malformed(number, place(), format!("{size:?} is no number of corners")))?;
        corners.clear();
        for word in words.by_ref().take(size) {
            let index: i64 = word.parse().map_err(|_| {
                malformed(number, place(), format!("{word:?} does not name a vertex"))
            })?;
            let vertex = u32::try_from(index).ok().filter(|&v| (v as usize) < positions.len());
            corners.push(vertex.ok_or(MeshError::IndexOutOfRange {
                file: file.to_owned(),
                line: Some(number),
                face,
                index,
                vertex_count: positions.len(),
            })?);
        }
        if corners.len() < size {
            let reason = format!("{} of {size} corners are there", corners.len());
            return Err(malformed(number, place(), reason));
        }
        surface.add(&corners, FacePlace { face, line: Some(number) });
        face += 1;
    }
    let Some([vertices, faces]) = counts else {
        return Err(header(1, if has_keyword { "it ends early" } else { "no keyword OFF" }));
    };
    for (what, wanted, found) in [("vertex", vertices, positions.len()), ("face", faces, face)] {
        if found < wanted {
            return Err(MeshError::Truncated {
                file: file.to_owned(),
                what: what.into(),
                wanted: wanted as u64,
                found: found as u64,
            });
        }
    }
    let small_faces = surface.small;
    let left_out = LeftOut { small_faces, bytes_after_end, ..LeftOut::default() };
    let Split { triangles, polygons, fans } = surface.finish(&positions);
    let raw = RawMesh::from_f64(positions, triangles);
    Ok(RawMesh { file: file.to_owned(), polygons, fans, decimal: true, left_out, ..raw })
}

/// Whether the first word is that of a form which is read; else the refusal, or none if the word
/// is none of OFF.
fn check_keyword(file: &Path, word: &str, next: Option<&str>) -> Result<(), Option<MeshError>> {
    let unsupported = |what: String| Some(MeshError::Unsupported { file: file.to_owned(), what });
    let prefix = word.strip_suffix("OFF").or_else(|| word.strip_suffix("off")).ok_or(None)?;
    if next == Some("BINARY") {
        return Err(unsupported("the binary form of OFF".into()));
    }
    let rest = prefix.strip_prefix("ST").unwrap_or(prefix);
    let rest = rest.strip_prefix('C').unwrap_or(rest);
    match rest.strip_prefix('N').unwrap_or(rest) {
        "" => Ok(()),
        "4" | "n" | "4n" => Err(unsupported(format!("{word}, of other than three dimensions,"))),
        _ => Err(None),
    }
}
