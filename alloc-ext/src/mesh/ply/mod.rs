//! PLY, in text or binary.
//!
//! The crate `ply-rs-bw` refuses `nan` in properties that nobody wants, strings, and headers whose
//! lines end with CR, and it drops what stands twice.

mod body;
mod header;

use std::borrow::Cow;
use std::path::Path;

use self::body::{Body, Role, Values};
use self::header::{Element, Encoding, Header, Scalar};
use super::layout::{Announced, Breaks, LINES, Layout, Surplus};
use super::polygons::{FacePlace, Faces, Split};
use super::strip::strip;
use super::text::{Words, decoded, lines};
use super::{LeftOut, MeshError, RawMesh};

/// Reads elements `vertex` (`x`, `y`, `z` of any scalar type), `face` and `tristrips`
/// (`vertex_indices` or `vertex_index`, a list of any integer type); other elements and properties
/// are skipped. In a list of `tristrips`, −1 begins a new strip.
///
/// A header's counts are limited by the file's size.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let bytes = match bytes {
        [0xEF, 0xBB, 0xBF, bytes @ ..] => Cow::Borrowed(bytes),
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => Cow::Owned(decoded(bytes).into_owned().into_bytes()),
        _ => Cow::Borrowed(bytes),
    };
    let header = header::read(file, &bytes)?;
    if header.encoding != Encoding::Text {
        return read_body(file, &header, "", LINES);
    }
    let text = String::from_utf8_lossy(header.body);
    let text = text.trim_end_matches(['\0', '\x1A']);
    let by_lines = read_body(file, &header, text, LINES);
    let fits = |raw: &RawMesh| raw.left_out.remarks.is_empty() && raw.left_out.bytes_after_end == 0;
    if by_lines.as_ref().is_ok_and(fits) {
        return by_lines;
    }
    // Some programs break lines elsewhere.
    let fits = |raw: &RawMesh| fits(raw) && raw.left_out.small_faces.count == 0;
    let read = |layout| read_body(file, &header, text, layout).ok().filter(fits);
    layouts(&header, text).into_iter().find_map(read).map_or(by_lines, Ok)
}

/// The layouts besides one of lines that a text may have.
fn layouts(header: &Header<'_>, text: &str) -> Vec<Layout> {
    let elements = || header.elements.iter().filter(|element| !element.properties.is_empty());
    let count = |sum: usize, element: &Element| sum.saturating_add(element.count);
    let vertices = elements().find(|element| element.name == "vertex");
    let announced = Announced {
        before_vertices: elements().take_while(|element| element.name != "vertex").fold(0, count),
        vertices: vertices.map_or(0, |element| element.count),
        width: vertices.map_or(0, |element| element.properties.len()),
        elements: elements().fold(0, count),
    };
    announced.layouts(Words::new(lines(text)).widths())
}

fn read_body(
    file: &Path,
    header: &Header<'_>,
    text: &str,
    layout: Layout,
) -> Result<RawMesh, MeshError> {
    let mut surplus = Surplus::default();
    let read = read_elements(file, header, text, layout, &mut surplus);
    let is_by_lines = header.encoding == Encoding::Text && layout.vertices == Breaks::Lines;
    let read = read.map_err(|error| match error {
        error if is_by_lines => surplus.explain(file, error),
        error => error,
    })?;
    surplus.check(file)?;
    Ok(read)
}

fn read_elements(
    file: &Path,
    header: &Header<'_>,
    text: &str,
    layout: Layout,
    surplus: &mut Surplus,
) -> Result<RawMesh, MeshError> {
    let numbered = lines(text).map(|(line, text)| (line + header.lines, text));
    let mut source = Body {
        file,
        encoding: header.encoding,
        breaks: layout.vertices,
        is_begun: false,
        words: Words::new(numbered),
        may_be_cut: !text.ends_with(['\n', '\r']),
        rest: header.body,
        long_lines: (0, 0),
        surplus: 0,
    };
    let mut positions = Vec::new();
    let mut surface = Faces::default();
    let mut left_out = LeftOut::default();
    let mut values = Values::default();
    let mut corners: Vec<u32> = Vec::new();
    for (i, element) in header.elements.iter().enumerate() {
        if header.encoding != Encoding::Text && element.properties.iter().any(|p| p.has_strings()) {
            if header.elements[i..].iter().any(is_wanted) {
                let what = format!("element {}, which has strings in binary,", element.name);
                return Err(MeshError::Unsupported { file: file.to_owned(), what });
            }
            break;
        }
        check_room(file, header, element, source.rest.len())?;
        let roles = roles(file, element)?;
        let is_vertex = element.name == "vertex";
        source.breaks = if is_vertex { layout.vertices } else { layout.others };
        match element.name.as_str() {
            "vertex" => {
                positions.reserve(element.count);
                for vertex in 0..element.count {
                    source.read(element, &roles, vertex, &mut values)?;
                    let at = values.at;
                    if !at.iter().all(|x| x.is_finite()) {
                        let (file, line) = (file.to_owned(), source.line());
                        return Err(MeshError::NotFinite { file, line, vertex, at });
                    }
                    positions.push(at);
                    surplus.vertex(vertex, source.words.line, source.surplus);
                }
            }
            "face" | "tristrips" => {
                // Then their indices are checked when all is read.
                let before_vertices = positions.is_empty();
                let is_strips = element.name == "tristrips";
                surface.triangles.reserve(element.count);
                for face in 0..element.count {
                    source.read(element, &roles, face, &mut values)?;
                    corners.clear();
                    for &index in &values.corners {
                        if is_strips && index == -1 {
                            left_out.stitches += strip(&corners, &mut surface.triangles);
                            corners.clear();
                            continue;
                        }
                        let vertex = u32::try_from(index).ok();
                        let in_range =
                            vertex.filter(|&v| before_vertices || (v as usize) < positions.len());
                        let Some(vertex) = in_range else {
                            return Err(MeshError::IndexOutOfRange {
                                file: file.to_owned(),
                                line: source.line(),
                                face,
                                index,
                                vertex_count: positions.len(),
                            });
                        };
                        corners.push(vertex);
                    }
                    if is_strips {
                        left_out.stitches += strip(&corners, &mut surface.triangles);
                    } else {
                        let place = FacePlace { face, line: source.line() };
                        surface.add(&corners, place);
                        surplus.face(place, corners.len(), source.surplus);
                    }
                }
            }
            // Nothing to skip, and a header may announce any number of them.
            _ if element.properties.is_empty() => {}
            name => {
                for i in 0..element.count {
                    source.read(element, &roles, i, &mut values)?;
                }
                if name == "edge" {
                    left_out.lines_and_points += element.count;
                }
            }
        }
    }
    if source.long_lines.0 > 0 {
        let (count, first) = source.long_lines;
        let what = "with more values than the header says, which are left out";
        left_out.remark("line", what, || format!("line {first}"));
        left_out.remarks.iter_mut().for_each(|remark| remark.count = count);
    }
    // In ASCII a `float` is decimal text too, but the file says that it stands for an f32.
    let vertex = header.elements.iter().find(|element| element.name == "vertex");
    let has_doubles = vertex.is_some_and(|element| {
        element.properties.iter().any(|p| p.length.is_none() && p.scalar == Scalar::F64)
    });
    let decimal = header.encoding == Encoding::Text && has_doubles;
    left_out.bytes_after_end = match header.encoding {
        Encoding::Text => {
            let left = source.words.bytes_left();
            left.map_err(|line| surplus.numbers_follow(file, line))?
        }
        _ => source.rest.len(),
    };
    left_out.small_faces = surface.small;
    let Split { triangles, polygons, fans } = surface.finish(&positions);
    let raw = RawMesh::from_f64(positions, triangles);
    Ok(RawMesh { file: file.to_owned(), polygons, fans, decimal, left_out, ..raw })
}

fn is_wanted(element: &Element) -> bool {
    matches!(element.name.as_str(), "vertex" | "face" | "tristrips")
}

fn malformed_header(file: &Path, reason: String) -> MeshError {
    MeshError::Malformed { file: file.to_owned(), line: None, place: "the header".into(), reason }
}

/// What is read of an element, or why it cannot be.
fn roles(file: &Path, element: &Element) -> Result<Vec<Role>, MeshError> {
    let name = element.name.as_str();
    let is_vertex = name == "vertex";
    let role = |property: &header::Property| {
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == property.name);
        let is_corners = property.length.is_some() && is_corners(&property.name);
        match axis {
            Some(axis) if is_vertex && property.length.is_none() && !property.has_strings() => {
                Role::Axis(axis)
            }
            _ if !is_vertex && is_corners && property.scalar.is_whole() => Role::Corners,
            _ => Role::Skipped,
        }
    };
    let roles: Vec<Role> = element.properties.iter().map(role).collect();
    let axes = roles.iter().filter(|role| matches!(role, Role::Axis(_))).count();
    let lists = roles.iter().filter(|role| **role == Role::Corners).count();
    match name {
        "vertex" if axes != 3 => Err(malformed_header(file, "vertex needs x, y and z".into())),
        "face" | "tristrips" if element.count > 0 && lists != 1 => {
            let reason = format!("{name} needs one list vertex_indices of whole numbers");
            Err(malformed_header(file, reason))
        }
        "vertex" | "face" | "tristrips" => Ok(roles),
        _ if element.count > 0 && lists > 0 => {
            let what = format!("element {name}, which has lists of vertices,");
            Err(MeshError::Unsupported { file: file.to_owned(), what })
        }
        _ => Ok(roles),
    }
}

fn is_corners(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index" | "vertex_indexes" | "vertices")
}

/// An error unless the rest of the file could hold as many elements as announced, each as small as
/// can be.
fn check_room(
    file: &Path,
    header: &Header<'_>,
    element: &Element,
    rest: usize,
) -> Result<(), MeshError> {
    let is_text = header.encoding == Encoding::Text;
    let smallest: usize = if is_text {
        2 * element.properties.len()
    } else {
        element.properties.iter().map(|property| property.least_bytes()).sum()
    };
    // The last line of a text may lack its end.
    let have = rest + usize::from(is_text);
    match have.checked_div(smallest) {
        Some(room) if room < element.count => Err(MeshError::Truncated {
            file: file.to_owned(),
            what: element.name.clone(),
            wanted: element.count as u64,
            found: room as u64,
        }),
        // Vertices and faces of no bytes at all would be counted, not read.
        None if element.count > 0 && is_wanted(element) => {
            let reason = format!("element {} has no properties", element.name);
            Err(malformed_header(file, reason))
        }
        _ => Ok(()),
    }
}
