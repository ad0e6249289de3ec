//! Why there is no blob.

mod curve;
mod unmet;

use crate::mesh::{MeshError, NoVolume};
use crate::number::{About, AtMost, Typed, wanted};
use meshsweep_core::{OpenError, TriboxError};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

pub use curve::CurveError;
pub use unmet::{Tightness, Unmet};

/// Why there is no blob. Each message names what was wanted, what was found, and what to do.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// A file cannot be read.
    Unreadable {
        /// The file.
        file: PathBuf,
        /// The kind of the operating system's error.
        kind: io::ErrorKind,
        /// Its message.
        reason: String,
    },
    /// The mesh, or a key frame of it, is refused.
    Mesh {
        /// Its file.
        file: PathBuf,
        /// Why.
        error: Box<MeshError>,
    },
    /// A hull encloses a solid, and the mesh bounds none.
    NotSolid {
        /// Its file.
        file: PathBuf,
        /// Why.
        error: Box<MeshError>,
    },
    /// The curve is refused.
    Curve {
        /// Its file.
        file: PathBuf,
        /// Why.
        error: CurveError,
    },
    /// The description of a robot is refused.
    Robot {
        /// Its file.
        file: PathBuf,
        /// Where.
        line: Option<usize>,
        /// Which element, why, and the remedy.
        what: String,
    },
    /// An option says nothing about what the blob is to serve, or contradicts it. Options have the
    /// names of the program's.
    Option {
        /// Its name.
        option: &'static str,
        /// Why, and the remedy.
        why: &'static str,
    },
    /// The number of an option is out of range, or NaN.
    OutOfRange {
        /// The option's name.
        option: &'static str,
        /// The number.
        found: f64,
        /// Least number.
        least: f64,
        /// Greatest number.
        most: f64,
    },
    /// More tight hulls were asked for than a blob holds.
    TooManyHulls {
        /// Most hulls.
        most: usize,
    },
    /// No tight hull is as tight as asked for.
    Unmet(Unmet),
    /// A callback of progress asked to end the build.
    Cancelled,
    /// More triangles, wires among them, than the structure can number.
    TooLarge {
        /// Triangles of the mesh.
        triangles: usize,
        /// Most triangles of the structure.
        most: usize,
    },
    /// A triangle names a vertex that is not there.
    NoSuchVertex {
        /// The triangle; wires count after the triangles.
        triangle: usize,
        /// The vertex.
        vertex: u32,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// [`Mesh::source`](crate::mesh::Mesh::source) is longer or shorter than the triangles.
    SourceNumbers {
        /// Triangles of the mesh.
        triangles: usize,
        /// Length of `source`.
        numbers: usize,
    },
    /// The signed volume is not positive: the mesh is inside out where it passes through itself.
    NotPositive {
        /// The volume, input units.
        volume: f64,
    },
    /// A hull of a mesh whose vertices moved is not proved to enclose the input.
    NotEnclosed {
        /// How far the input's surface may be from the mesh, input units.
        error: f64,
    },
    /// A tight hull was asked for, and the mesh has no triangle and no wire.
    Empty,
    /// A tight hull of a void was asked for, and the mesh has no volume to measure it against.
    NoVolume(NoVolume),
    /// No surface around the mesh has coordinates in the stored range: they end at 3.4e38, or the
    /// mesh is as small as the steps of its coordinates.
    NoRoom,
    /// The mesh with its margin leaves the range of single precision.
    MarginTooLarge,
    /// A margin is negative, or no number.
    NegativeMargin,
    /// The slack is not more than the margin.
    SlackWithinMargin {
        /// The slack.
        slack: f64,
        /// The margin, with what rounding of the mesh may take from it.
        margin: f64,
    },
    /// A field with sides was asked for, and the mesh is not closed, or walls of it were merged.
    NoSides {
        /// The kind of field.
        kind: &'static str,
    },
    /// The unit of a distance field is no normal number of single precision.
    FieldUnit {
        /// The longest side of the field, in the mesh's unit.
        side: f64,
    },
    /// An error of a field is too large for its numbers of 16 bits. Either points far from the
    /// surface have no certain side, or a tree has so few leaves that one is wide.
    FieldTooWide {
        /// The kind of field.
        kind: &'static str,
        /// The layout, if one was asked for.
        layout: Option<&'static str>,
        /// Most bytes of the field.
        bytes: u32,
    },
    /// No field of at most these bytes is as narrow everywhere.
    FieldNotNarrow {
        /// The largest width that was asked for, in the mesh's unit.
        error: f64,
        /// Most bytes of the field.
        bytes: u32,
        /// With this error there would be one, about.
        widest: f64,
    },
    /// A field that is as narrow everywhere takes more bytes.
    FieldNeedsBytes {
        /// The largest width that was asked for, in the mesh's unit.
        error: f64,
        /// Most bytes of the field.
        bytes: u32,
        /// Bytes that it takes, about: the search ended there, and more may be needed.
        needed: usize,
    },
    /// A field of this layout takes more bytes.
    FieldTooSmall {
        /// Bytes that were asked for.
        bytes: u32,
        /// Bytes of the smallest one.
        least: u32,
    },
    /// Triboxes do not hold the mesh's coordinates.
    Triboxes(TriboxError),
    /// A hull that deforms stores the vertices as they are: no other precision can be asked for.
    NotExact,
    /// A vertex of a key frame is 64 times the first mesh's size from its origin, or farther.
    FrameTooFar {
        /// The frame; the first mesh is 0.
        frame: usize,
        /// Number of the vertex in the input file.
        vertex: u32,
    },
    /// The blob to cut has no such level.
    NoLevel {
        /// Level asked for.
        wanted: u32,
        /// Levels of the blob.
        levels: u32,
    },
    /// The blob to cut has no triboxes.
    NoTriboxes,
    /// The blob to cut has no tight hulls.
    NoTightHulls,
    /// The bytes to cut changed after they were opened as a blob.
    Unchecked,
    /// The reader refused the blob that was written: a defect of this library.
    Reopen(OpenError),
}

/// The remedy for a mesh that is not closed, on a line of its own, like places.
const NO_SOLID: &str = "for distances and segments, --for closest,segment and --for sweep need no closed mesh; of one \
     that deforms, --for sweep,deform";

/// What to do about an error of the operating system.
#[doc(hidden)]
#[must_use]
pub fn io_remedy(kind: io::ErrorKind) -> &'static str {
    match kind {
        io::ErrorKind::NotFound => "check the path",
        io::ErrorKind::IsADirectory => "name a file in it",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "change permissions or the path"
        }
        io::ErrorKind::StorageFull => "make room",
        io::ErrorKind::FileTooLarge => "ask for less, or choose another file system",
        _ => "check path and medium",
    }
}

/// Writes an error after its file's name, which it may begin with itself.
fn write_of(
    f: &mut fmt::Formatter<'_>,
    file: &Path,
    mark: &str,
    error: &impl fmt::Display,
) -> fmt::Result {
    let text = error.to_string();
    if text.starts_with(&*file.to_string_lossy()) {
        return f.write_str(&text);
    }
    write!(f, "{}{mark} {text}", file.display())
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { file, kind, reason } => {
                write!(f, "{}: cannot be read: {reason}; {}", file.display(), io_remedy(*kind))
            }
            Self::Mesh { file, error } => write_of(f, file, ":", error),
            Self::NotSolid { file, error } => {
                write_of(f, file, ":", error)?;
                f.write_str("\n")?;
                f.write_str(NO_SOLID)
            }
            Self::Curve { file, error } => {
                // A line of the file, else what all of the file lacks.
                write_of(f, file, if error.names_line() { "," } else { ":" }, error)
            }
            Self::Robot { file, line, what } => {
                write!(f, "{}", file.display())?;
                line.map_or(Ok(()), |line| write!(f, ", line {line}"))?;
                write!(f, ": {what}")
            }
            Self::Option { option, why } => write!(f, "{option} {why}"),
            Self::OutOfRange { option, found, least, most } => {
                write!(f, "{option} {}: {}", Typed(*found), wanted([*least, *most]))
            }
            Self::TooManyHulls { most } => {
                write!(f, "--tight takes at most {most} numbers of faces")
            }
            Self::Unmet(unmet) => unmet.fmt(f),
            Self::Cancelled => f.write_str("the build was cancelled"),
            Self::TooLarge { triangles, most } => write!(
                f,
                "{triangles} triangles are more than the {most} that the structure holds: simplify \
                 or split the mesh"
            ),
            Self::NoSuchVertex { triangle, vertex, vertices } => write!(
                f,
                "triangle {triangle} names vertex {vertex}, and the mesh has {vertices}: run repair"
            ),
            Self::NotFinite { vertex } => {
                write!(f, "vertex {vertex} has a coordinate that is not finite: run repair")
            }
            Self::SourceNumbers { triangles, numbers } => write!(
                f,
                "{triangles} triangles have {numbers} numbers in the input file: give one to each"
            ),
            Self::NotPositive { volume } => write!(
                f,
                "the enclosed volume is {volume}: the mesh passes through itself and is inside \
                 out there; unite its parts first"
            ),
            Self::NotEnclosed { error } => write!(
                f,
                "vertices moved by up to {} when they were rounded, and no progressive hull is \
                 proved to keep that distance from the mesh: leave out --progressive, a tight hull \
                 encloses any mesh; or move the mesh to its origin",
                AtMost(*error)
            ),
            Self::Empty => f.write_str("the mesh has no triangles; give one that has"),
            Self::NoVolume(why) => write!(
                f,
                "{why}; there is no volume to measure void against: ask for faces or slack"
            ),
            Self::NoRoom => f.write_str(
                "there are no coordinates of single precision around the mesh to put a hull on; \
                 move or scale it",
            ),
            Self::MarginTooLarge => f.write_str(
                "the mesh and its margin leave the range of single precision, 3.4e38; ask for \
                 less, or scale both down",
            ),
            Self::NegativeMargin => f.write_str("a margin is 0 or more"),
            Self::SlackWithinMargin { slack, margin } => write!(
                f,
                "--slack {} is no more than the margin of {} (--margin, and what rounding may \
                 add); ask for a larger --slack",
                Typed(*slack),
                Typed(*margin)
            ),
            Self::NotExact => f.write_str(
                "a hull that deforms keeps the vertices as they are: leave out --vertex-bits",
            ),
            Self::FrameTooFar { frame, vertex } => write!(
                f,
                "key frame {frame}, counted from 0: vertex {vertex} is 64 times the first mesh's \
                 size or more from the place of that mesh; move the frames nearer"
            ),
            Self::NoSides { kind } => write!(
                f,
                "the mesh is not closed, or walls of it that coincide were merged, so that no point \
                 is inside or outside: a {kind} field needs sides; close it and unite its parts, or \
                 ask for --sdf-kind surface"
            ),
            Self::FieldUnit { side } => write!(
                f,
                "a field of side {} has no unit in single precision; scale the mesh, or give it an \
                 extent or a --sdf-margin",
                About(*side)
            ),
            Self::FieldTooWide { kind, layout: Some("tree"), bytes } => write!(
                f,
                "a leaf of a {kind} tree of {bytes} bytes is wider than its numbers hold: give it \
                 more --sdf bytes, or leave out --sdf-layout, and a lattice is built instead"
            ),
            Self::FieldTooWide { kind: "surface", bytes, .. } => write!(
                f,
                "a cell of a surface field of {bytes} bytes is wider than its numbers hold: give \
                 it more --sdf bytes, or less --sdf-margin"
            ),
            Self::FieldTooWide { kind, .. } => write!(
                f,
                "points far from the surface are neither inside nor outside: the errors of a {kind} \
                 field have no room in its bytes; unite the mesh's parts, or ask for --sdf-kind \
                 surface"
            ),
            Self::FieldNotNarrow { error, bytes, widest } => write!(
                f,
                "no field of {bytes} bytes or fewer was found with intervals of at most {} \
                 everywhere: the narrowest one needs an --sdf-error of about {} or more; ask for \
                 that, for a larger --sdf-rel if it is far from the surface, or for --sdf-kind \
                 solid if it is inside",
                Typed(*error),
                About(*widest)
            ),
            Self::FieldNeedsBytes { error, bytes, needed } => write!(
                f,
                "a field with intervals of at most {} everywhere takes about {needed} bytes or \
                 more, not {bytes}: ask for a larger --sdf-error or --sdf-rel, for less \
                 --sdf-margin, or for more --sdf bytes where their range has more",
                Typed(*error)
            ),
            Self::FieldTooSmall { bytes, least } => write!(
                f,
                "a tree takes {least} bytes at least, not {bytes}: give it more --sdf bytes, or \
                 leave out --sdf-layout"
            ),
            Self::Triboxes(error) => write!(f, "{error}; choose a larger unit"),
            Self::NoLevel { levels: 0, .. } => {
                f.write_str("the blob has no hull hierarchy to cut: build it with --for hull")
            }
            Self::NoLevel { wanted, levels } => {
                write!(f, "level {wanted} does not exist: the blob has levels 0 to {}", levels - 1)
            }
            Self::NoTriboxes => {
                f.write_str("the blob has no triboxes to cut: build it with --for triboxes")
            }
            Self::NoTightHulls => {
                f.write_str("the blob has no tight hulls to cut: build it with --for tight")
            }
            Self::Unchecked => f.write_str("the blob changed after it was opened: open it again"),
            Self::Reopen(error) => {
                write!(f, "internal error: the blob does not open: {error}; please report it")
            }
        }
    }
}

impl std::error::Error for BuildError {}

impl BuildError {
    /// Refuses the number of an option that is out of its range.
    pub(crate) fn check_range(
        option: &'static str,
        found: f64,
        [least, most]: [f64; 2],
    ) -> Result<(), Self> {
        let is_in = (least..=most).contains(&found);
        if is_in { Ok(()) } else { Err(Self::OutOfRange { option, found, least, most }) }
    }
}

impl From<CurveError> for BuildError {
    /// Of a curve in memory.
    fn from(error: CurveError) -> Self {
        Self::Curve { file: PathBuf::from("(memory)"), error }
    }
}

impl From<TriboxError> for BuildError {
    fn from(error: TriboxError) -> Self {
        Self::Triboxes(error)
    }
}
