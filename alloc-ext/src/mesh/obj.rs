//! Wavefront OBJ: the vertices and the polygons. Other geometry is counted and named.

use std::path::Path;

use super::polygons::{FacePlace, Faces, Split};
use super::text::{decoded, lines, lowercase, point, quoted, without_comment};
use super::{LeftOut, MeshError, RawMesh};

/// Reads `v x y z …` and `f v[/vt[/vn]] …`, or `fo` as it was called once, indices from 1 or
/// relative (negative), `\` at a line's end continuing it, but not a comment: that may end with the
/// path of a directory. Faces of one or two vertices have no surface and are counted, as points and
/// lines are (`p`, `l`), free-form curves and surfaces, materials, and calls of other files. A name
/// before a line of geometry is not continued.
///
/// A statement that OBJ does not have is counted. It is refused if numbers follow, for it may be a
/// misspelt vertex, without which all others have wrong numbers.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = decoded(bytes);
    let mut obj = Obj::new(file);
    let mut joined = String::new();
    let mut lines = lines(&text).peekable();
    while let Some((number, text)) = lines.next() {
        let text = without_comment(text).trim_end();
        let part = text.strip_suffix('\\');
        if let Some(part) = part
            && let Some((_, next)) = lines.peek()
        {
            let begun = if joined.is_empty() { part } else { &joined };
            // The name of a statement may end with the path of a directory, too.
            if is_geometry(next) && !may_hold_numbers(begun) {
                let what = "with a \\ at the end not continued, for geometry follows";
                obj.left_out.remark("line", what, || format!("line {number}"));
            } else {
                joined.push_str(part);
                joined.push(' ');
                continue;
            }
        }
        let text = part.unwrap_or(text);
        obj.line = number;
        if joined.is_empty() {
            obj.statement(text)?;
        } else {
            joined.push_str(text);
            obj.statement(&joined)?;
            joined.clear();
        }
    }
    obj.finish()
}

const OF_A_MATERIAL: &str = "of a material left out";

/// Whether a line is a vertex, a face or another statement of numbers.
fn is_geometry(line: &str) -> bool {
    let mut words = line.split_ascii_whitespace();
    let is_known = words.next().is_some_and(|keyword| {
        matches!(&*lowercase(keyword), "v" | "vt" | "vn" | "vp" | "f" | "fo" | "l" | "p")
    });
    is_known
        && words
            .next()
            .is_some_and(|word| word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)))
}

/// Whether a statement is one that a line may end within.
fn may_hold_numbers(statement: &str) -> bool {
    let keyword = statement.split_ascii_whitespace().next().unwrap_or_default();
    !matches!(
        &*lowercase(keyword),
        "usemtl" | "mtllib" | "usemap" | "maplib" | "g" | "o" | "s" | "newmtl"
    )
}

/// What a statement means.
enum Kind {
    Vertex,
    Face,
    /// The name of a face in the format's first version.
    OldFace,
    LineOrPoint,
    /// Geometry that is left out: what it is.
    Other(&'static str),
    /// No geometry, or the rest of a free-form curve or surface.
    Skipped,
    Unknown,
}

impl Kind {
    fn of(keyword: &str) -> Self {
        match &*lowercase(keyword) {
            "v" => Self::Vertex,
            "f" => Self::Face,
            "fo" => Self::OldFace,
            "l" | "p" => Self::LineOrPoint,
            "surf" => Self::Other("surf (a free-form surface) left out"),
            "curv" => Self::Other("curv (a free-form curve) left out"),
            "curv2" => Self::Other("curv2 (a free-form curve) left out"),
            // Of the format's first version.
            "bsp" => Self::Other("bsp (a free-form surface) left out"),
            "bzp" => Self::Other("bzp (a free-form surface) left out"),
            "cdc" => Self::Other("cdc (a free-form curve) left out"),
            "cdp" => Self::Other("cdp (a free-form surface) left out"),
            "call" => Self::Other("call (another file) left out"),
            "csh" => Self::Other("csh (a command) left out"),
            "vw" => Self::Other("vw (a weight) left out"),
            // Some programs write the library of materials into the file.
            "newmtl" | "ka" | "kd" | "ks" | "ke" | "tf" | "ns" | "ni" | "d" | "tr" | "illum"
            | "sharpness" | "bump" | "disp" | "decal" | "refl" | "pr" | "pm" | "ps" | "pc"
            | "pcr" | "aniso" | "anisor" | "norm" => Self::Other(OF_A_MATERIAL),
            keyword if keyword.starts_with("map_") => Self::Other(OF_A_MATERIAL),
            "vt" | "vn" | "vp" | "vc" | "cstype" | "deg" | "bmat" | "step" | "parm" | "trim"
            | "hole" | "scrv" | "sp" | "end" | "con" | "res" | "g" | "s" | "mg" | "o" | "bevel"
            | "c_interp" | "d_interp" | "lod" | "usemtl" | "mtllib" | "usemap" | "maplib"
            | "shadow_obj" | "trace_obj" | "ctech" | "stech" => Self::Skipped,
            _ => Self::Unknown,
        }
    }
}

/// The mesh as far as it is read.
struct Obj<'a> {
    file: &'a Path,
    /// The line of the statement's end.
    line: usize,
    positions: Vec<[f64; 3]>,
    faces: Faces,
    /// The number of the next face, from 1, as everything in such a file.
    next_face: usize,
    corners: Vec<u32>,
    /// The largest vertex that a face names, its line and the face. OBJ lets a face name a vertex
    /// that comes later in the file, so ranges are checked against the final count.
    highest: Option<(u32, usize, usize)>,
    left_out: LeftOut,
}

impl<'a> Obj<'a> {
    fn new(file: &'a Path) -> Self {
        Self {
            file,
            line: 0,
            positions: Vec::new(),
            faces: Faces::default(),
            next_face: 1,
            corners: Vec::new(),
            highest: None,
            left_out: LeftOut::default(),
        }
    }

    fn statement(&mut self, text: &str) -> Result<(), MeshError> {
        let mut words = text.split_ascii_whitespace();
        let Some(keyword) = words.next() else { return Ok(()) };
        let line = self.line;
        match Kind::of(keyword) {
            Kind::Vertex => {
                let vertex = self.positions.len() + 1;
                self.positions.push(point(self.file, line, vertex, &mut words)?);
            }
            Kind::Face => self.face(words)?,
            Kind::OldFace => {
                self.left_out.remark("statement", "fo read as f", || format!("line {line}"));
                self.face(words)?;
            }
            Kind::LineOrPoint => self.left_out.lines_and_points += 1,
            Kind::Other(what) => {
                self.left_out.remark("statement", what, || format!("line {line}"));
            }
            Kind::Skipped => {}
            Kind::Unknown if may_be_misspelt(keyword, words) => {
                return Err(MeshError::Malformed {
                    file: self.file.to_owned(),
                    line: Some(line),
                    place: format!("statement {}", quoted(keyword)),
                    reason: "OBJ has none of this name; correct or remove it".into(),
                });
            }
            Kind::Unknown => {
                let first = || format!("line {line}, {}", quoted(keyword));
                self.left_out.remark("statement", "of unknown name left out", first);
            }
        }
        Ok(())
    }

    fn face<'b>(&mut self, words: impl Iterator<Item = &'b str>) -> Result<(), MeshError> {
        let line = self.line;
        self.corners.clear();
        for word in words {
            let vertex = self.index(word)?;
            if self.highest.is_none_or(|(most, ..)| vertex > most) {
                self.highest = Some((vertex, line, self.next_face));
            }
            self.corners.push(vertex);
        }
        self.faces.add(&self.corners, FacePlace { face: self.next_face, line: Some(line) });
        self.next_face += 1;
        Ok(())
    }

    /// The vertex (from 0) that a word of a face names.
    fn index(&self, word: &str) -> Result<u32, MeshError> {
        let vertex_count = self.positions.len();
        let number = word.split('/').next().unwrap_or("");
        let index: i64 = number.parse().map_err(|_| MeshError::Malformed {
            file: self.file.to_owned(),
            line: Some(self.line),
            place: format!("face {}", self.next_face),
            reason: format!("{} does not name a vertex", quoted(word)),
        })?;
        let from_zero = match index {
            0 => None,
            1.. => Some(index - 1),
            _ => i64::try_from(vertex_count).ok().map(|count| count + index),
        };
        from_zero.and_then(|v| u32::try_from(v).ok()).ok_or_else(|| MeshError::IndexOutOfRange {
            file: self.file.to_owned(),
            line: Some(self.line),
            face: self.next_face,
            index,
            vertex_count,
        })
    }

    fn finish(self) -> Result<RawMesh, MeshError> {
        let Self { positions, faces, mut left_out, highest, .. } = self;
        let file = self.file.to_owned();
        match highest {
            Some((vertex, line, face)) if vertex as usize >= positions.len() => {
                Err(MeshError::IndexOutOfRange {
                    file,
                    line: Some(line),
                    face,
                    index: i64::from(vertex) + 1,
                    vertex_count: positions.len(),
                })
            }
            _ => {
                left_out.small_faces = faces.small;
                let Split { triangles, polygons, fans } = faces.finish(&positions);
                let raw = RawMesh::from_f64(positions, triangles);
                Ok(RawMesh { file, polygons, fans, decimal: true, left_out, ..raw })
            }
        }
    }
}

/// Whether a statement of unknown name may be a vertex or a face: numbers follow, perhaps without a
/// blank.
fn may_be_misspelt<'a>(keyword: &str, mut words: impl Iterator<Item = &'a str>) -> bool {
    let is_glued = keyword.starts_with(|c: char| "vVfF+-.0123456789".contains(c))
        && keyword.contains(|c: char| c.is_ascii_digit());
    let mut count = 0;
    let is_number = |part: &str| part.is_empty() || part.parse::<f64>().is_ok();
    words.all(|word| {
        count += 1;
        word.split('/').all(is_number)
    }) && (is_glued || count >= 2)
}
