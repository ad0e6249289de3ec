//! Elements of a text: one on a line, or anywhere.
//!
//! OFF and PLY allow any line breaks, and nearly all programs write one element on a line. If line
//! breaks mean nothing, one lost number shifts all that follow, and garbage may use up all numbers.
//! So a file of lines is read by lines only, and an element that looks like another kind is named.

use rustc_hash::FxHashSet;
use std::path::Path;

use super::MeshError;
use super::polygons::FacePlace;
use super::text::Words;
use crate::counted::Counted;

/// What line breaks mean.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Breaks {
    /// One element has a line, whatever follows on it.
    Lines,
    /// An element may have several lines, if it ends with the last of them.
    Spans,
    /// Nothing.
    None,
}

/// What line breaks of a file mean.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    pub(super) vertices: Breaks,
    pub(super) others: Breaks,
}

/// One element has one line.
pub(super) const LINES: Layout = Layout { vertices: Breaks::Lines, others: Breaks::Lines };

/// The elements that a header announces.
pub(super) struct Announced {
    pub(super) before_vertices: usize,
    pub(super) vertices: usize,
    /// Words of a vertex.
    pub(super) width: usize,
    /// All of them.
    pub(super) elements: usize,
}

impl Announced {
    /// The layouts besides [`LINES`] that a file may have whose lines have so many words each.
    pub(super) fn layouts(&self, widths: impl Iterator<Item = usize>) -> Vec<Layout> {
        let (mut lines, mut of_vertices) = (0usize, 0usize);
        for width in widths {
            let is_of_vertex = lines.checked_sub(self.before_vertices);
            let is_of_vertex = is_of_vertex.is_some_and(|line| line < self.vertices);
            of_vertices += usize::from(is_of_vertex && width == self.width);
            lines += 1;
        }
        let both = |vertices, others| Layout { vertices, others };
        let mut layouts = vec![both(Breaks::Spans, Breaks::Spans)];
        // Counts may be wrong, and lines may be lost.
        let is_near = lines.abs_diff(self.elements) <= 2 + self.elements / 8;
        if is_near {
            return layouts;
        }
        layouts.push(both(Breaks::Lines, Breaks::None));
        if 2 * of_vertices <= self.vertices.min(lines.saturating_sub(self.before_vertices)) {
            layouts.push(both(Breaks::None, Breaks::None));
        }
        layouts
    }
}

/// The next word of an element of which words were read.
pub(super) fn next_word<'a>(
    words: &mut Words<'a, impl Iterator<Item = (usize, &'a str)>>,
    breaks: Breaks,
) -> Option<&'a str> {
    if breaks == Breaks::Lines { words.next_on_line() } else { words.next() }
}

/// Numbers that follow an element on its line.
#[derive(Default)]
pub(super) struct Surplus {
    /// Words that follow the first vertex on its line.
    of_first_vertex: Option<usize>,
    /// The first vertex that others follow.
    vertex: Option<Suspect>,
    /// The first face of fewer than three corners, and of those that words follow.
    small_face: Option<Suspect>,
    small_faces: Vec<Suspect>,
    of_faces: FxHashSet<usize>,
}

/// An element that may be one of another kind.
#[derive(Clone, Copy)]
struct Suspect {
    number: usize,
    line: usize,
    surplus: usize,
}

impl Surplus {
    pub(super) fn vertex(&mut self, number: usize, line: usize, surplus: usize) {
        if surplus != *self.of_first_vertex.get_or_insert(surplus) {
            self.vertex.get_or_insert(Suspect { number, line, surplus });
        }
    }

    pub(super) fn face(&mut self, place: FacePlace, corners: usize, surplus: usize) {
        if corners >= 3 {
            self.of_faces.insert(surplus);
            return;
        }
        let suspect = Suspect { number: place.face, line: place.line.unwrap_or(0), surplus };
        self.small_face.get_or_insert(suspect);
        // Further ones of as many words say the same.
        if surplus > 0 && self.small_faces.iter().all(|other| other.surplus != surplus) {
            self.small_faces.push(suspect);
        }
    }

    /// Refuses a vertex that is followed by more or fewer numbers than the first: one is there
    /// twice, or the line is a face. Refuses a face of fewer than three corners with numbers as no
    /// other face has them: one of its own was lost, or the line is a vertex.
    pub(super) fn check(&self, file: &Path) -> Result<(), MeshError> {
        if let Some(Suspect { number, line, surplus }) = self.vertex {
            let first = self.of_first_vertex.unwrap_or(0);
            let reason = format!(
                "{} after its place, and {first} after that of vertex 0: one is there twice, a \
                 line is lost, or the header announces too many vertices",
                Counted(surplus, "number")
            );
            return Err(malformed(file, Some(line), format!("vertex {number}"), reason));
        }
        let is_odd = |face: &&Suspect| !self.of_faces.contains(&face.surplus);
        self.small_faces.iter().find(is_odd).map_or(Ok(()), |face| {
            let reason = format!(
                "fewer than three corners, and {} after them, as no other face has",
                Counted(face.surplus, "number")
            );
            Err(malformed(file, Some(face.line), format!("face {}", face.number), reason))
        })
    }

    /// The error of a file of lines, or that of an element before which explains it.
    pub(super) fn explain(&self, file: &Path, error: MeshError) -> MeshError {
        self.check(file).err().unwrap_or(error)
    }

    /// Refuses numbers, the first of them in `line`, that follow the last announced element.
    pub(super) fn numbers_follow(&self, file: &Path, line: usize) -> MeshError {
        let reason = "numbers follow its last element: it announces too few";
        match self.small_face {
            Some(Suspect { number, line, .. }) => {
                let reason = "fewer than three corners, and the header announces too few elements";
                malformed(file, Some(line), format!("face {number}"), reason.into())
            }
            None => malformed(file, Some(line), "the header".into(), reason.into()),
        }
    }
}

fn malformed(file: &Path, line: Option<usize>, place: String, reason: String) -> MeshError {
    MeshError::Malformed { file: file.to_owned(), line, place, reason }
}
