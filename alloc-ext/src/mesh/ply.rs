//! PLY through `ply-rs-bw`, element by element, so that an error can name the vertex or face.

use std::io::BufRead;
use std::path::Path;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

use super::polygons::{FacePlace, Faces, Split};
use super::strip::strip;
use super::{LeftOut, MeshError, RawMesh};

/// Reads elements `vertex` (`x`, `y`, `z` of any scalar type), `face` and `tristrips`
/// (`vertex_indices` or `vertex_index`, a list of any integer type); other elements and properties
/// are skipped. In a list of `tristrips`, −1 begins a new strip.
///
/// A header's counts are limited by the file's size.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let malformed = |place: String, error: &ParseError| MeshError::Malformed {
        file: file.to_owned(),
        line: error.line(),
        place,
        // The first line names the error. The crate adds others that quote the input at any length.
        reason: error.to_string().lines().next().unwrap_or_default().to_owned(),
    };
    let mut reader = Reader::new(bytes);
    let header = Parser::<Ignored>::new()
        .read_header(&mut reader)
        .map_err(|error| malformed("the header".into(), &error))?;
    check_names(file, bytes)?;
    let mut source =
        Source { file, encoding: header.encoding, line: reader.line(), rest: reader.into_inner() };

    let mut positions = Vec::new();
    let mut surface = Faces::default();
    let mut stitches = 0;
    let mut corners: Vec<u32> = Vec::new();
    for (name, element) in &header.elements {
        source.check_room(element)?;
        match name.as_str() {
            "vertex" => {
                require(file, element, "vertex needs x, y and z", |e| {
                    ["x", "y", "z"].iter().all(|k| e.properties.contains_key(*k))
                })?;
                positions.reserve(element.count);
                for vertex in 0..element.count {
                    let Vertex(at) = source.next(element, vertex)?;
                    if !at.iter().all(|x| x.is_finite()) {
                        let line = source.line();
                        return Err(MeshError::NotFinite {
                            file: file.to_owned(),
                            line,
                            vertex,
                            at,
                        });
                    }
                    positions.push(at);
                }
            }
            "face" | "tristrips" => {
                // Then their indices are checked when all is read.
                let before_vertices = positions.is_empty();
                let is_strips = name == "tristrips";
                require(file, element, &format!("{name} needs one list vertex_indices"), |e| {
                    e.count == 0 || e.properties.keys().filter(|k| is_corners(k)).count() == 1
                })?;
                surface.triangles.reserve(element.count);
                for face in 0..element.count {
                    let Face(indices) = source.next(element, face)?;
                    corners.clear();
                    for index in indices {
                        if is_strips && index == -1 {
                            stitches += strip(&corners, &mut surface.triangles);
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
                        stitches += strip(&corners, &mut surface.triangles);
                    } else {
                        surface.add(&corners, FacePlace { face, line: source.line() });
                    }
                }
            }
            // Nothing to skip, and a header may announce any number of them.
            _ if element.properties.is_empty() && header.encoding != Encoding::Ascii => {}
            _ => {
                for i in 0..element.count {
                    let Ignored = source.next(element, i)?;
                }
            }
        }
    }
    // In ASCII a `float` is decimal text too, but the file says that it stands for an f32.
    let has_doubles = header.elements.get("vertex").is_some_and(|e| {
        e.properties.values().any(|p| p.data_type == PropertyType::Scalar(ScalarType::Double))
    });
    let decimal = header.encoding == Encoding::Ascii && has_doubles;
    let bytes_after_end = match header.encoding {
        Encoding::Ascii => source.rest.trim_ascii().len(),
        _ => source.rest.len(),
    };
    let small_faces = surface.small;
    let left_out = LeftOut { stitches, small_faces, bytes_after_end, ..LeftOut::default() };
    let Split { triangles, polygons, fans } = surface.finish(&positions);
    let raw = RawMesh::from_f64(positions, triangles);
    Ok(RawMesh { file: file.to_owned(), polygons, fans, decimal, left_out, ..raw })
}

/// Refuses two elements of one name, and two properties of an element: the crate keeps only the
/// last of them.
fn check_names(file: &Path, bytes: &[u8]) -> Result<(), MeshError> {
    let (mut elements, mut properties) = (Vec::new(), Vec::new());
    let lines = bytes.split(|byte| b"\r\n".contains(byte));
    for line in lines.take_while(|line| !line.starts_with(b"end_header")) {
        let words: Vec<&[u8]> =
            line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
        let (name, others) = match words[..] {
            [b"element", name, ..] => {
                properties.clear();
                (name, &mut elements)
            }
            [b"property", .., name] => (name, &mut properties),
            _ => continue,
        };
        if others.contains(&name) {
            let reason = format!("{} is there twice", String::from_utf8_lossy(name));
            return Err(malformed_header(file, reason));
        }
        others.push(name);
    }
    Ok(())
}

fn malformed_header(file: &Path, reason: String) -> MeshError {
    MeshError::Malformed { file: file.to_owned(), line: None, place: "the header".into(), reason }
}

fn require(
    file: &Path,
    element: &ElementDef,
    what: &str,
    holds: impl Fn(&ElementDef) -> bool,
) -> Result<(), MeshError> {
    if holds(element) {
        return Ok(());
    }
    Err(malformed_header(file, what.into()))
}

/// The payload that is left.
struct Source<'a> {
    file: &'a Path,
    encoding: Encoding,
    line: usize,
    rest: &'a [u8],
}

impl Source<'_> {
    /// The number of the line read last, counting from 1, if the file has lines.
    fn line(&self) -> Option<usize> {
        (self.encoding == Encoding::Ascii).then(|| self.line.saturating_sub(1))
    }

    /// An error unless the rest of the file could hold as many elements as announced, each as small
    /// as can be.
    fn check_room(&self, element: &ElementDef) -> Result<(), MeshError> {
        let ascii = self.encoding == Encoding::Ascii;
        let smallest: u64 = if ascii {
            2 * (element.properties.len() as u64).max(1)
        } else {
            element.properties.values().map(|p| least_bytes(&p.data_type)).sum()
        };
        // The last line of a text may lack its end.
        let have = self.rest.len() as u64 + u64::from(ascii);
        let wanted = element.count as u64;
        match have.checked_div(smallest) {
            Some(room) if room < wanted => Err(MeshError::Truncated {
                file: self.file.to_owned(),
                what: element.name.clone(),
                wanted,
                found: room,
            }),
            // Vertices and faces of no bytes at all would be counted, not read.
            None if wanted > 0
                && matches!(element.name.as_str(), "vertex" | "face" | "tristrips") =>
            {
                let reason = format!("element {} has no properties", element.name);
                Err(malformed_header(self.file, reason))
            }
            _ => Ok(()),
        }
    }

    fn next<E: PropertyAccess>(
        &mut self,
        element: &ElementDef,
        number: usize,
    ) -> Result<E, MeshError> {
        let parser = Parser::<E>::new();
        let result = match self.encoding {
            Encoding::BinaryLittleEndian => {
                parser.read_little_endian_element(&mut self.rest, element)
            }
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.rest, element),
            Encoding::Ascii => {
                let mut text = String::new();
                // Some writers leave a blank line between elements.
                while text.trim_ascii().is_empty() {
                    text.clear();
                    self.line += 1;
                    match self.rest.read_line(&mut text) {
                        Ok(0) => return Err(self.truncated(element, number)),
                        Ok(_) if element.properties.is_empty() => break,
                        Ok(_) => {}
                        Err(error) => {
                            return Err(self.malformed(element, number, error.to_string()));
                        }
                    }
                }
                let result = parser.read_ascii_element(&text, element);
                if result.is_err() && self.rest.is_empty() && !text.ends_with('\n') {
                    return Err(self.truncated(element, number));
                }
                result
            }
        };
        result.map_err(|error| {
            if error.kind() == std::io::ErrorKind::UnexpectedEof {
                self.truncated(element, number)
            } else {
                self.malformed(element, number, error.to_string())
            }
        })
    }

    fn truncated(&self, element: &ElementDef, number: usize) -> MeshError {
        MeshError::Truncated {
            file: self.file.to_owned(),
            what: element.name.clone(),
            wanted: element.count as u64,
            found: number as u64,
        }
    }

    fn malformed(&self, element: &ElementDef, number: usize, reason: String) -> MeshError {
        MeshError::Malformed {
            file: self.file.to_owned(),
            line: self.line(),
            place: format!("{} {number}", element.name),
            reason: reason.lines().map(str::trim).collect::<Vec<_>>().join(" "),
        }
    }
}

fn least_bytes(data_type: &PropertyType) -> u64 {
    // A list may be empty: its length is all that must be there.
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = data_type;
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

fn is_corners(key: &str) -> bool {
    matches!(key, "vertex_indices" | "vertex_index")
}

struct Ignored;

impl PropertyAccess for Ignored {
    fn new() -> Self {
        Self
    }
}

struct Vertex([f64; 3]);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self([0.0; 3])
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        let axis = match key {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ => return PropertyAccessResult::Ignored,
        };
        self.0[axis] = match property {
            Property::Float(x) => x.into(),
            Property::Double(x) => x,
            Property::Char(x) => x.into(),
            Property::UChar(x) => x.into(),
            Property::Short(x) => x.into(),
            Property::UShort(x) => x.into(),
            Property::Int(x) => x.into(),
            Property::UInt(x) => x.into(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

struct Face(Vec<i64>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        if !is_corners(key) {
            return PropertyAccessResult::Ignored;
        }
        self.0 = match property {
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}
