//! OFF in text.
//!
//! Vertices and faces may have more numbers than those of their place: normals, colours, texture
//! coordinates. Programs write one vertex or one face on a line, and then all that follows on the
//! line belongs to it. But the format allows any line breaks, and then only numbers that the
//! keyword announces belong to it. A file is read in the first of these ways that fits all of it.

use std::path::Path;

use super::polygons::{FacePlace, Faces, Split};
use super::text::{Words, decoded, lines, point, quoted, whole, without_comment};
use super::{LeftOut, MeshError, RawMesh};

/// Reads `OFF` and its variants with normals, colours and texture coordinates (`COFF`, `NOFF`,
/// `STOFF`): of a vertex the place, of a face the corners. Faces of one or two vertices have no
/// surface and are counted.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = decoded(bytes);
    let by_lines = open(file, &text)?.read(Breaks::Strict, Breaks::Strict);
    let fits = |raw: &RawMesh| raw.left_out.bytes_after_end == 0;
    if by_lines.as_ref().is_ok_and(fits) {
        return by_lines;
    }
    let all = [Breaks::Strict, Breaks::Loose, Breaks::None];
    let others = all.iter().flat_map(|&vertices| all.map(|faces| (vertices, faces))).skip(1);
    let read = |(vertices, faces)| open(file, &text).ok()?.read(vertices, faces).ok().filter(fits);
    others.into_iter().find_map(read).map_or(by_lines, Ok)
}

/// What line breaks mean.
#[derive(Clone, Copy, PartialEq)]
enum Breaks {
    /// One vertex or one face has a line, whatever follows on it.
    Strict,
    /// It may have several lines, and what follows on the last of them.
    Loose,
    /// Nothing.
    None,
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
    let malformed = |line: usize, reason: &str| MeshError::Malformed {
        file: file.to_owned(),
        line: Some(line.max(1)),
        place: "the header".into(),
        reason: reason.into(),
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
    fn read(mut self, of_vertices: Breaks, of_faces: Breaks) -> Result<RawMesh, MeshError> {
        if of_vertices != Breaks::None {
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
            let words = std::iter::from_fn(|| next(&mut self.words, of_vertices));
            let mut rest = std::iter::once(first).chain(words);
            positions.push(point(self.file, line, vertex, &mut rest)?);
            if of_vertices == Breaks::None {
                self.words.by_ref().take(self.others).for_each(drop);
            } else {
                self.words.skip_to("");
            }
        }
        let mut surface = Faces::default();
        let mut corners: Vec<u32> = Vec::new();
        for face in 0..self.faces {
            let Some(size) = self.words.next() else {
                return Err(self.ends_early("face", self.faces, face));
            };
            let line = self.words.line;
            let malformed = |reason: String| MeshError::Malformed {
                file: self.file.to_owned(),
                line: Some(line),
                place: format!("face {face}"),
                reason,
            };
            let size = whole(size)
                .and_then(|size| usize::try_from(size).ok())
                .ok_or_else(|| malformed(format!("{} is no number of corners", quoted(size))))?;
            corners.clear();
            let words = std::iter::from_fn(|| next(&mut self.words, of_faces));
            for word in words.take(size) {
                let index = whole(word)
                    .ok_or_else(|| malformed(format!("{} does not name a vertex", quoted(word))))?;
                let vertex = u32::try_from(index).ok().filter(|&v| (v as usize) < positions.len());
                corners.push(vertex.ok_or_else(|| MeshError::IndexOutOfRange {
                    file: self.file.to_owned(),
                    line: Some(line),
                    face,
                    index,
                    vertex_count: positions.len(),
                })?);
            }
            if corners.len() < size {
                return Err(malformed(format!("{} of {size} corners are there", corners.len())));
            }
            if of_faces != Breaks::None {
                self.words.skip_to("");
            }
            surface.add(&corners, FacePlace { face, line: Some(line) });
        }
        // Each word with the blank before it.
        let bytes_after_end =
            self.words.map(|word| word.len() + 1).sum::<usize>().saturating_sub(1);
        let left_out =
            LeftOut { small_faces: surface.small, bytes_after_end, ..LeftOut::default() };
        let Split { triangles, polygons, fans } = surface.finish(&positions);
        let (file, raw) = (self.file.to_owned(), RawMesh::from_f64(positions, triangles));
        Ok(RawMesh { file, polygons, fans, decimal: true, left_out, ..raw })
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

/// The next word of a vertex or a face.
fn next<'a>(
    words: &mut Words<'a, impl Iterator<Item = (usize, &'a str)>>,
    breaks: Breaks,
) -> Option<&'a str> {
    if breaks == Breaks::Strict { words.next_on_line() } else { words.next() }
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
