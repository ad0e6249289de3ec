//! Binary STL: a header, a count, and 50 bytes for each triangle, the last two of which announce
//! bytes of attributes that follow the triangle.
//!
//! Nearly all files have no attributes, and some programs write colours in place of their number.
//! So a file whose size fits the count has none. Any other size must be explained.

use std::path::Path;

use super::super::polygons::Polygons;
use super::super::{LeftOut, MeshError, RawMesh};
use super::soup::raw;

/// Bytes before the first triangle.
pub(super) const HEADER_BYTES: usize = 84;
pub(super) const TRIANGLE_BYTES: usize = 50;
/// Where the count is.
const COUNT: usize = 80;
/// Where a triangle announces its attributes.
const ATTRIBUTES: usize = 48;

/// How far the length of a normal may be off 1.
const NORMAL_OFF: f32 = 0.02;

/// Most bytes that a program or a copy adds at a file's end.
const MOST_PADDING: usize = 4;

pub(super) fn is_of_announced_size(bytes: &[u8]) -> bool {
    count(bytes).is_some_and(|count| bytes.len() as u64 == size(count))
}

fn count(bytes: &[u8]) -> Option<u32> {
    bytes.get(COUNT..)?.first_chunk().map(|count| u32::from_le_bytes(*count))
}

fn size(count: u32) -> u64 {
    HEADER_BYTES as u64 + TRIANGLE_BYTES as u64 * u64::from(count)
}

pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let Some(count) = count(bytes) else {
        return Err(too_short(file, bytes.len()));
    };
    let malformed = |place: String, reason: String| MeshError::Malformed {
        file: file.to_owned(),
        line: None,
        place,
        reason,
    };
    let body = &bytes[HEADER_BYTES..];
    let room = body.len() / TRIANGLE_BYTES;
    if room < count as usize {
        if bytes.len() as u64 == size(count.swap_bytes()) {
            let what = "binary STL of the other byte order".into();
            return Err(MeshError::Unsupported { file: file.to_owned(), what });
        }
        return Err(MeshError::Truncated {
            file: file.to_owned(),
            what: "triangle".into(),
            wanted: count.into(),
            found: room as u64,
        });
    }
    let wanted = count as usize;
    let after = body.len() - wanted * TRIANGLE_BYTES;
    let bare: Vec<usize> = (0..wanted).map(|triangle| triangle * TRIANGLE_BYTES).collect();
    let announced: Vec<u16> = bare.iter().map(|&at| attributes(body, at)).collect();
    let mut left_out = LeftOut::default();
    let places = if announced.iter().all(|&bytes| bytes == 0) && after == 0 {
        bare
    } else {
        let (with_attributes, end) = places_with_attributes(body, wanted);
        let is_whole = with_attributes.len() == wanted && end == body.len();
        if after > 0 && is_whole {
            for (triangle, &at) in with_attributes.iter().enumerate() {
                let bytes = attributes(body, at);
                if bytes > 0 {
                    let place = || format!("triangle {triangle}, {bytes} bytes");
                    left_out.remark("triangle", "with attributes, which are left out", place);
                }
            }
            with_attributes
        } else if is_sound(body, &bare) {
            refuse_more_triangles(body, wanted)
                .map_err(|reason| malformed("the count".into(), reason))?;
            left_out.bytes_after_end = after;
            bare
        } else if after == 0 && (with_attributes.len() < 2 || !is_sound(body, &with_attributes)) {
            // No sign of attributes: the normals are of another length.
            bare
        } else if after > 0 && after < wanted && announced.iter().all(|&bytes| bytes == 0) {
            // As above, and too few bytes for attributes of each.
            refuse_more_triangles(body, wanted)
                .map_err(|reason| malformed("the count".into(), reason))?;
            left_out.bytes_after_end = after;
            bare
        } else {
            let reason = format!(
                "{wanted} triangles and the attributes that they announce do not have the {} bytes \
                 of the file",
                bytes.len()
            );
            return Err(malformed("the triangles".into(), reason));
        }
    };
    if places.is_empty() && room > 0 {
        let reason = format!("it is 0, and {after} bytes follow, as of {room} triangles");
        return Err(malformed("the count".into(), reason));
    }
    let mut positions = Vec::with_capacity(3 * places.len());
    for at in places {
        let [_, corners @ ..] = vectors(body, at);
        positions.extend(corners.map(|corner| corner.map(f64::from)));
    }
    Ok(RawMesh { left_out, ..raw(file, positions, Polygons::default(), false) })
}

/// A file that ends in its header.
pub(super) fn too_short(file: &Path, size: usize) -> MeshError {
    MeshError::Truncated {
        file: file.to_owned(),
        what: "header byte".into(),
        wanted: HEADER_BYTES as u64,
        found: size as u64,
    }
}

/// Where triangles begin if attributes follow them as announced, and where the last ends. A file
/// that ends early has fewer.
fn places_with_attributes(body: &[u8], wanted: usize) -> (Vec<usize>, usize) {
    let mut places = Vec::new();
    let mut at = 0;
    while places.len() < wanted && at + TRIANGLE_BYTES <= body.len() {
        places.push(at);
        at += TRIANGLE_BYTES + usize::from(attributes(body, at));
    }
    (places, at)
}

fn attributes(body: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([body[at + ATTRIBUTES], body[at + ATTRIBUTES + 1]])
}

/// The normal and the corners of the triangle at `at`.
fn vectors(body: &[u8], at: usize) -> [[f32; 3]; 4] {
    let (floats, _) = body[at..][..ATTRIBUTES].as_chunks::<4>();
    [0, 3, 6, 9].map(|k| [0, 1, 2].map(|axis| f32::from_le_bytes(floats[k + axis])))
}

/// Whether all triangles there look like triangles: corners are finite, and normals have the length
/// 1 or are not given. Triangles that are read with a wrong step do not.
fn is_sound(body: &[u8], places: &[usize]) -> bool {
    places.iter().all(|&at| {
        let [normal, corners @ ..] = vectors(body, at);
        let square: f32 = normal.iter().map(|x| x * x).sum();
        let is_given = normal != [0.0; 3] && !normal.iter().all(|x| x.is_nan());
        let is_normal = !is_given || (square.sqrt() - 1.0).abs() < NORMAL_OFF;
        is_normal && corners.iter().flatten().all(|x| x.is_finite())
    })
}

/// Refuses bytes after the announced end that are triangles, or a file of their own.
fn refuse_more_triangles(body: &[u8], wanted: usize) -> Result<(), String> {
    let after = &body[wanted * TRIANGLE_BYTES..];
    if is_of_announced_size(after) && count(after) > Some(0) {
        return Err(format!("another binary STL file follows after triangle {wanted}"));
    }
    let more = after.len() / TRIANGLE_BYTES;
    let others: Vec<usize> = (0..more).map(|triangle| triangle * TRIANGLE_BYTES).collect();
    let are_triangles = match after.len() % TRIANGLE_BYTES {
        0 => true,
        1..=MOST_PADDING => is_sound(after, &others),
        _ => false,
    };
    if wanted > 0 && more > 0 && are_triangles && after.iter().any(|&b| b != 0) {
        return Err(format!("it is {wanted}, and the file has {} triangles", wanted + more));
    }
    Ok(())
}
