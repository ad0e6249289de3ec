//! STL, ASCII and binary.

use std::io::Cursor;
use std::path::Path;

use super::polygons::{FacePlace, Polygons};
use super::text::{lines, point};
use super::{LeftOut, MeshError, RawMesh};

const HEADER_BYTES: usize = 80;
const TRIANGLE_BYTES: u64 = 50;

/// Reads either kind. A file is binary if its size fits the count in its header, else ASCII if it
/// starts with `solid`: many binary files start with `solid` too. Normals and attributes are
/// ignored: the winding counts.
pub(super) fn read(file: &Path, bytes: Vec<u8>) -> Result<RawMesh, MeshError> {
    let count = announced(&bytes);
    let fits = count.is_some_and(|n| bytes.len() as u64 == binary_bytes(n));
    let first_word = bytes.trim_ascii_start().get(..5).unwrap_or_default();
    if !fits && first_word.eq_ignore_ascii_case(b"solid") {
        return read_ascii(file, &bytes);
    }
    match count {
        None => Err(MeshError::Truncated {
            file: file.to_owned(),
            what: "header byte".into(),
            wanted: HEADER_BYTES as u64 + 4,
            found: bytes.len() as u64,
        }),
        Some(count) => read_binary(file, bytes, count),
    }
}

fn announced(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER_BYTES..HEADER_BYTES + 4)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

fn binary_bytes(count: u32) -> u64 {
    HEADER_BYTES as u64 + 4 + TRIANGLE_BYTES * u64::from(count)
}

fn read_binary(file: &Path, mut bytes: Vec<u8>, count: u32) -> Result<RawMesh, MeshError> {
    let room = (bytes.len() as u64).saturating_sub(binary_bytes(0)) / TRIANGLE_BYTES;
    if room < u64::from(count) {
        return Err(MeshError::Truncated {
            file: file.to_owned(),
            what: "triangle".into(),
            wanted: count.into(),
            found: room,
        });
    }
    // `stl_io` takes any file that starts with "solid " for ASCII. This one is binary.
    bytes[..HEADER_BYTES].fill(0);
    let bytes_after_end = bytes.len() - binary_bytes(count) as usize;
    let mut cursor = Cursor::new(bytes);
    let malformed = |triangle: usize, error: std::io::Error| MeshError::Malformed {
        file: file.to_owned(),
        line: None,
        place: format!("triangle {triangle}"),
        reason: error.to_string(),
    };
    let mut positions = Vec::with_capacity(3 * count as usize);
    let reader = stl_io::create_stl_reader(&mut cursor).map_err(|error| malformed(0, error))?;
    for (i, triangle) in reader.enumerate() {
        let triangle = triangle.map_err(|error| malformed(i, error))?;
        positions.extend(triangle.vertices.map(|v| v.0.map(f64::from)));
    }
    let left_out = LeftOut { bytes_after_end, ..LeftOut::default() };
    Ok(RawMesh { left_out, ..raw(file, positions, Polygons::default(), false) })
}

/// Reads the `vertex` lines of all solids in the file. A facet of more than three vertices is
/// split.
fn read_ascii(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let malformed = |line: usize, facet: usize, reason: &str| MeshError::Malformed {
        file: file.to_owned(),
        line: Some(line),
        place: format!("facet {facet}"),
        reason: reason.into(),
    };
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut vertex = 0;
    let mut facet = 0;
    let mut polygons = Polygons::default();
    let mut fans = Vec::new();
    let mut polygon: Option<Vec<[f64; 3]>> = None;
    let mut last = 0;
    for (number, text) in lines(bytes) {
        last = number;
        let mut words = text.split_ascii_whitespace();
        let Some(word) = words.next() else { continue };
        match word.to_ascii_lowercase().as_str() {
            "facet" if polygon.is_some() => {
                return Err(malformed(number, facet, "a facet starts inside another"));
            }
            "facet" => polygon = Some(Vec::with_capacity(3)),
            "vertex" => {
                let at = point(file, number, vertex, &mut words)?;
                vertex += 1;
                match &mut polygon {
                    Some(corners) => corners.push(at),
                    None => return Err(malformed(number, facet, "a vertex outside any facet")),
                }
            }
            "endfacet" => match polygon.take().as_deref() {
                Some(corners @ [first, rest @ ..]) if rest.len() >= 2 => {
                    let place = FacePlace { face: facet, line: Some(number) };
                    let is_polygon = rest.len() > 2;
                    match is_polygon.then(|| polygons.ears(corners, place)).flatten() {
                        Some(ears) => {
                            let number = positions.len() / 3;
                            fans.extend((number..).zip(ears.iter().map(|e| e.map(|k| k as u32))));
                            positions.extend(ears.iter().flatten().map(|&k| corners[k]));
                        }
                        None => positions
                            .extend(rest.windows(2).flat_map(|pair| [*first, pair[0], pair[1]])),
                    }
                    facet += 1;
                }
                _ => return Err(malformed(number, facet, "fewer than three vertices")),
            },
            // Names may follow, and may be anything.
            "solid" | "endsolid" | "outer" | "endloop" => {}
            _ => return Err(malformed(number, facet, &format!("{word:?} is no word of STL"))),
        }
    }
    if polygon.is_some() {
        return Err(malformed(last, facet, "the file ends inside a facet"));
    }
    Ok(RawMesh { fans, ..raw(file, positions, polygons, true) })
}

/// Three positions for each triangle.
fn raw(file: &Path, positions: Vec<[f64; 3]>, polygons: Polygons, decimal: bool) -> RawMesh {
    let triangles =
        (0..positions.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let raw = RawMesh::from_f64(positions, triangles);
    RawMesh { file: file.to_owned(), polygons, decimal, ..raw }
}
