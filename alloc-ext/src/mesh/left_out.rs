//! What a reader left out of a file, or took with a doubt.

use std::fmt;

use super::polygons::NamedFaces;
use crate::counted::Counted;

/// Parts of a file that a reader leaves out, doubts, or takes for what they were once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Triangles of strips with a repeated corner: they join strips and have no surface.
    pub stitches: usize,
    /// Primitives of points or lines, one for each copy that a scene makes.
    pub lines_and_points: usize,
    /// Bytes after the last element that the file announces.
    pub bytes_after_end: usize,
    /// Faces of one or two corners, or of none.
    pub small_faces: NamedFaces,
    /// All other parts, a remark for each kind.
    pub remarks: Vec<Remark>,
}

/// A number of parts of one kind, and the place of the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Number of parts.
    pub count: usize,
    /// What one of them is, as `statement`.
    pub noun: &'static str,
    /// What there is to say of them, as `surf left out`.
    pub what: String,
    /// Where the first is.
    pub first: String,
}

impl LeftOut {
    /// Counts a part. The kind of a part is its noun and what is said of it.
    pub(super) fn remark(
        &mut self,
        noun: &'static str,
        what: &str,
        first: impl FnOnce() -> String,
    ) {
        match self.remarks.iter_mut().find(|of| of.noun == noun && of.what == what) {
            Some(of) => of.count += 1,
            None => {
                let (what, first) = (what.to_owned(), first());
                self.remarks.push(Remark { count: 1, noun, what, first });
            }
        }
    }

    /// Counts what was left out of another part of the file.
    pub(super) fn add(&mut self, others: &Self) {
        self.stitches += others.stitches;
        self.lines_and_points += others.lines_and_points;
        self.bytes_after_end += others.bytes_after_end;
        self.small_faces.add_all(others.small_faces);
        self.remarks.extend_from_slice(&others.remarks);
    }

    /// A sentence for each kind of part.
    pub(super) fn sentences(&self) -> impl Iterator<Item = String> {
        let Self { stitches, lines_and_points, bytes_after_end, .. } = *self;
        let counted = |count: usize, noun, what: &str| {
            (count > 0).then(|| format!("{} {what}", Counted(count, noun)))
        };
        let joins = "with a repeated corner left out of strips that they join";
        let counted = [
            counted(stitches, "triangle", joins),
            counted(lines_and_points, "primitive", "of points or lines left out"),
            counted(bytes_after_end, "byte", "after the announced end of the file left out"),
        ];
        let small = self.small_faces.said("face", "of fewer than three corners left out");
        let remarks = self.remarks.iter().map(Remark::to_string);
        small.into_iter().chain(remarks).chain(counted.into_iter().flatten())
    }

    /// What a file without triangles holds in their place.
    pub(super) fn instead(&self) -> Option<String> {
        let lines = Counted(self.lines_and_points, "primitive");
        let lines = (self.lines_and_points > 0).then(|| format!("{lines} of points or lines"));
        let stitches = Counted(self.stitches, "triangle");
        let stitches =
            (self.stitches > 0).then(|| format!("{stitches} of strips with a repeated corner"));
        let small = "of fewer than three corners";
        let others = self.remarks.first().map(Remark::to_string);
        others.or(lines).or_else(|| self.small_faces.said("face", small)).or(stitches)
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, noun, what, first } = self;
        let more = if *count > 1 { " …" } else { "" };
        write!(f, "{} {what}: {first}{more}", Counted(*count, noun))
    }
}
