//! OFF in text.
//!
//! Vertices and faces may have more numbers than those of their place: normals, colours, texture
//! coordinates. Where an element has a line, all that follows on it belongs to it. Where line
//! breaks mean nothing, only numbers that the keyword announces do. A file is read in the first
//! layout that fits all of it, but one of lines by lines only.

use std::path::Path;

use super::layout::{Announced, Breaks, LINES, Layout, Surplus, next_word};
use super::polygons::{FacePlace, Faces, Split};
use super::text::{Words, decoded, lines, point, quoted, whole, without_comment};
use super::{LeftOut, MeshError, RawMesh};

/// Reads `OFF` and its variants with normals, colours and texture coordinates (`COFF`, `NOFF`,
/// `STOFF`): of a vertex the place, of a face the corners. Faces of one or two vertices have no
/// surface and are counted.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = decoded(bytes);
    let by_lines = open(file, &text)?.read(LINES);
    if by_lines.as_ref().is_ok() {
        return by_lines;
    }
    let layouts = open(file, &text)?.layouts();
    let fits =
        |raw: &RawMesh| raw.left_out.bytes_after_end == 0 && raw.left_out.small_faces.count == 0;
    let read = |layout| open(file, &text).ok()?.read(layout).ok().filter(fits);
    layouts.into_iter().find_map(read).map_or(by_lines, Ok)
}

/// A file whose header is read.
struct Reading<'a, L> {
    file: &'a Path,
    words: Words<'a, L>,
    vertices: usize,
    faces: usize,
    /// Numbers of a vertex that the keyword announces, besides its place.
    others: usize,
}

/// Reads the header.
fn open<'a>(
    file: &'a Path,
    text: &'a str,
) -> Result<Reading<'a, impl Iterator<Item = (usize, &'a str)>>, MeshError> {
    let mut words = Words::new(lines(text).map(|(line, text)| (line, without_comment(text))));
    let malformed = |line: usize, reason: &str| {
        malformed(file, line.max(1), "the header".into(), reason.into())
    };
    let unsupported = |what: String| MeshError::Unsupported { file: file.to_owned(), what };
    let word = words.next().unwrap_or_default();
    let keyword = Keyword::of(word).ok_or_else(|| malformed(words.line, "no keyword OFF"))?;
    if words.peek().is_some_and(|next| next.eq_ignore_ascii_case("binary")) {
        return Err(unsupported("the binary form of OFF".into()));
    }
    if keyword.has_dimensions {
        return Err(unsupported(format!("{}, of other than three dimensions,", keyword.word)));
    }
    let mut counts = [0; 2];
    let mut first = Some(keyword.rest).filter(|rest| !rest.is_empty());
    let mut line = words.line;
    for count in &mut counts {
        line = words.line;
        let Some(word) = first.take().or_else(|| words.next()) else {
            return Err(malformed(words.line, "it ends early"));
        };
        let wanted = "numbers of vertices and faces are wanted";
        *count = word.parse().map_err(|_| malformed(words.line, wanted))?;
    }
    // The number of edges. It means nothing, and some programs leave it out.
    if words.peek().is_some() || words.line != line {
        words.next();
    }
    let [vertices, faces] = counts;
    Ok(Reading { file, words, vertices, faces, others: keyword.others })
}

impl<'a, L: Iterator<Item = (usize, &'a str)>> Reading<'a, L> {
    /// The layouts besides one of lines that the file may have.
    fn layouts(self) -> Vec<Layout> {
        let announced = Announced {
            before_vertices: 0,
            vertices: self.vertices,
            width: 3 + self.others,
            elements: self.vertices.saturating_add(self.faces),
        };
        announced.layouts(self.words.widths())
    }

    fn read(mut self, layout: Layout) -> Result<RawMesh, MeshError> {
        let mut surplus = Surplus::default();
        let mut left_out = LeftOut::default();
        let done = self.vertices(layout.vertices, &mut surplus, &mut left_out);
        let done = done.and_then(|at| Ok((self.faces(&at, layout.others, &mut surplus)?, at)));
        let (surface, positions) = done.map_err(|error| match layout.vertices {
            Breaks::Lines => surplus.explain(self.file, error),
            _ => error,
        })?;
        let left = self.words.bytes_left();
        left_out.bytes_after_end = left.map_err(|line| surplus.numbers_follow(self.file, line))?;
        surplus.check(self.file)?;
        left_out.small_faces = surface.small;
        let Split { triangles, polygons, fans } = surface.finish(&positions);
        let (file, raw) = (self.file.to_owned(), RawMesh::from_f64(positions, triangles));
        Ok(RawMesh { file, polygons, fans, decimal: true, left_out, ..raw })
    }

    fn vertices(
        &mut self,
        breaks: Breaks,
        surplus: &mut Surplus,
        left_out: &mut LeftOut,
    ) -> Result<Vec<[f64; 3]>, MeshError> {
        if breaks != Breaks::None {
            self.words.skip_to("");
        }
        let mut positions: Vec<[f64; 3]> = Vec::new();
        while positions.len() < self.vertices {
            let vertex = positions.len();
            // So that an error names the line of the vertex, and an end is told from a defect.
            let Some(first) = self.words.next() else {
                return Err(self.ends_early("vertex", self.vertices, vertex));
            };
            let line = self.words.line;
            let words = std::iter::from_fn(|| next_word(&mut self.words, breaks));
            let mut rest = std::iter::once(first).chain(words);
            positions.push(point(self.file, line, vertex, &mut rest)?);
            match breaks {
                Breaks::None => self.words.by_ref().take(self.others).for_each(drop),
                _ => {
                    let left = self.end_line(breaks, line, || format!("vertex {vertex}"))?;
                    surplus.vertex(vertex, line, left);
                    if left > self.others {
                        let what = "with more values than the keyword says, which are left out";
                        left_out.remark("line", what, || format!("line {line}"));
                    }
                }
            }
        }
        Ok(positions)
    }

    fn faces(
        &mut self,
        positions: &[[f64; 3]],
        breaks: Breaks,
        surplus: &mut Surplus,
    ) -> Result<Faces, MeshError> {
        let mut surface = Faces::default();
        let mut corners: Vec<u32> = Vec::new();
        for face in 0..self.faces {
            let Some(size) = self.words.next() else {
                return Err(self.ends_early("face", self.faces, face));
            };
            let line = self.words.line;
            let file = self.file;
            let malformed = |reason| malformed(file, line, format!("face {face}"), reason);
            let size = whole(size)
                .and_then(|size| usize::try_from(size).ok())
                .ok_or_else(|| malformed(format!("{} is no number of corners", quoted(size))))?;
            corners.clear();
            let words = std::iter::from_fn(|| next_word(&mut self.words, breaks));
            for word in words.take(size) {
                let index = whole(word)
                    .ok_or_else(|| malformed(format!("{} does not name a vertex", quoted(word))))?;
                let vertex = u32::try_from(index).ok().filter(|&v| (v as usize) < positions.len());
                corners.push(vertex.ok_or_else(|| MeshError::IndexOutOfRange {
                    file: file.to_owned(),
                    line: Some(line),
                    face,
                    index,
                    vertex_count: positions.len(),
                })?);
            }
            if corners.len() < size {
                return Err(malformed(format!("{} of {size} corners are there", corners.len())));
            }
            let place = FacePlace { face, line: Some(line) };
            if breaks != Breaks::None {
                let left = self.end_line(breaks, line, || format!("face {face}"))?;
                surplus.face(place, size, left);
            }
            surface.add(&corners, place);
        }
        Ok(surface)
    }

    /// Goes to the end of the line of an element that began in line `begin`. Returns how many words
    /// follow there.
    fn end_line(
        &mut self,
        breaks: Breaks,
        begin: usize,
        place: impl FnOnce() -> String,
    ) -> Result<usize, MeshError> {
        let left = self.words.left_on_line();
        if breaks == Breaks::Spans && self.words.line != begin && left > 0 {
            let reason = "it ends within a line".into();
            return Err(malformed(self.file, begin, place(), reason));
        }
        self.words.skip_to("");
        Ok(left)
    }

    fn ends_early(&self, what: &str, wanted: usize, found: usize) -> MeshError {
        MeshError::Truncated {
            file: self.file.to_owned(),
            what: what.into(),
            wanted: wanted as u64,
            found: found as u64,
        }
    }
}

fn malformed(file: &Path, line: usize, place: String, reason: String) -> MeshError {
    MeshError::Malformed { file: file.to_owned(), line: Some(line), place, reason }
}

/// The first word of a file.
struct Keyword<'a> {
    word: &'a str,
    /// Numbers of a vertex, besides its place.
    others: usize,
    /// Points of four or of any number of dimensions.
    has_dimensions: bool,
    /// What follows the keyword without a blank: the first count.
    rest: &'a str,
}

impl<'a> Keyword<'a> {
    fn of(word: &'a str) -> Option<Self> {
        let at = word.to_ascii_uppercase().find("OFF")?;
        let rest = word.get(at + 3..)?;
        let mut prefix = word.get(..at)?;
        if !rest.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let mut of = Self { word: word.get(..at + 3)?, others: 0, has_dimensions: false, rest };
        // Programs do not agree on their order.
        while !prefix.is_empty() {
            let parts = [("ST", 2), ("st", 2), ("C", 4), ("c", 4), ("N", 3), ("4", 0), ("n", 0)];
            let part = parts
                .iter()
                .find_map(|&(part, count)| Some((part, count, prefix.strip_prefix(part)?)));
            let (part, count, left) = part?;
            of.has_dimensions |= matches!(part, "4" | "n");
            of.others += count;
            prefix = left;
        }
        Some(of)
    }
}
