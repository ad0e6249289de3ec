//! What can be wrong with a mesh, said so that its owner can mend it.

use crate::counted::Counted;
use std::fmt;
use std::path::PathBuf;

/// An edge, by what its owner can find again in the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePlace {
    /// Input number of a triangle on the edge.
    pub triangle: u32,
    /// One end, in the file's unit and frame.
    pub from: [f32; 3],
    /// The other end.
    pub to: [f32; 3],
}

/// Why a mesh was refused. Each message names the place and, in one line, the remedy. Lists hold
/// the first five places.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[allow(
    missing_docs,
    reason = "a variant's sentence says what its fields are; their names are the terms of that \
        sentence"
)]
pub enum MeshError {
    /// The file could not be opened or read.
    Unreadable { file: PathBuf, reason: String },
    /// The file is a blob.
    Blob { file: PathBuf },
    /// The file's content is not of the kind that its name says.
    Misnamed { file: PathBuf, content: &'static str, extension: &'static str },
    /// A mesh and its key frame, or two meshes, are in different units, given by their symbols.
    Units { files: [PathBuf; 2], units: [&'static str; 2] },
    /// The extension is none of [`FORMATS`](super::FORMATS).
    UnknownExtension { file: PathBuf },
    /// The file needs a part of its format that is not read.
    Unsupported { file: PathBuf, what: String },
    /// The content does not follow its format.
    Malformed { file: PathBuf, line: Option<usize>, place: String, reason: String },
    /// The file ends before what it announced: `what` says of which kind of thing, `found` is the
    /// number, or an upper bound of it, of the one that it breaks off at.
    Truncated { file: PathBuf, what: String, wanted: u64, found: u64 },
    /// A coordinate is NaN or infinite.
    NotFinite { file: PathBuf, line: Option<usize>, vertex: usize, at: [f64; 3] },
    /// A face names a vertex that is not there. `face` and `index` count as the file does: from 1
    /// in OBJ, else from 0.
    IndexOutOfRange {
        file: PathBuf,
        line: Option<usize>,
        face: usize,
        index: i64,
        vertex_count: usize,
    },
    /// The file holds nothing, or blanks only.
    Empty { file: PathBuf },
    /// The file holds no face; what it holds in place of them.
    NoTriangles { file: PathBuf, instead: Option<String> },
    /// More vertices or triangles than 32-bit numbers can name.
    TooMany { file: PathBuf, what: &'static str, count: usize },
    /// A coordinate is beyond the largest `f32`.
    TooLarge { file: PathBuf, vertex: usize, at: [f64; 3] },
    /// No coordinate reaches the smallest normal `f32`.
    TooSmall { file: PathBuf, largest: f64 },
    /// Every triangle has zero area: a mesh of segments and points encloses no volume.
    NoArea { count: usize },
    /// Edges with one triangle only, so the mesh does not enclose a volume. Places: one edge of
    /// each of five holes.
    Open {
        edge_count: usize,
        hole_count: usize,
        largest_hole: usize,
        /// Holes whose corners all lie on one line: a T-junction or a zero-area triangle.
        slit_count: usize,
        places: Vec<EdgePlace>,
        /// Input number of a dropped zero-area triangle on one of the holes; filled by
        /// `RepairReport::explain`.
        dropped_triangle: Option<u32>,
    },
    /// Edges with more than two triangles.
    NonManifoldEdges { count: usize, most: usize, places: Vec<EdgePlace> },
    /// Vertices in which several triangle fans meet; `repair` splits them.
    NonManifoldVertices { count: usize, places: Vec<[f32; 3]> },
    /// One-sided components, such as a Möbius strip: no winding is consistent.
    NonOrientable { component_count: usize, places: Vec<EdgePlace> },
    /// Neighbours wound against each other; `repair` unifies them.
    InconsistentWinding { edge_count: usize, places: Vec<EdgePlace> },
    /// Outermost components whose triangles face inwards; `repair` turns them.
    InsideOut { component_count: usize, places: Vec<[f32; 3]> },
    /// A closed component whose volume may be zero within rounding; `bound` is the rounding error
    /// of the sum.
    ZeroVolume { triangle: u32, at: [f32; 3], volume: f64, bound: f64 },
    /// An index, coordinate or length of a `Mesh` that breaks the type's promise.
    Invalid { reason: String },
    /// A triangle that repair dropped or changed for want of an area may get one when its vertices
    /// move.
    Undeformable { triangle: u32 },
    /// A key frame has other numbers of vertices or triangles than the first mesh.
    FrameCount { file: PathBuf, what: &'static str, found: usize, wanted: usize },
    /// A triangle of a key frame has other vertices than that of the first mesh.
    FrameTriangle { file: PathBuf, triangle: usize, found: [u32; 3], wanted: [u32; 3] },
    /// Two vertices that lie in one place in the first mesh are apart in a key frame.
    FrameTorn { file: PathBuf, vertices: [u32; 2] },
}

impl std::error::Error for MeshError {}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { file, reason } => {
                write!(
                    f,
                    "{}: {reason}; check that the file exists and may be read",
                    file.display()
                )
            }
            Self::Blob { file } => write!(
                f,
                "{}: is a blob already; name the mesh that it was built from",
                file.display()
            ),
            Self::Misnamed { file, content, extension } => write!(
                f,
                "{}: the content looks like {content}; rename the file to end in .{extension}",
                file.display()
            ),
            Self::Units { files: [first, second], units: [a, b] } => write!(
                f,
                "{} is in {a} and {} in {b}; choose a unit by --unit",
                first.display(),
                second.display()
            ),
            Self::UnknownExtension { file } => {
                write!(
                    f,
                    "{}: unknown kind of mesh file; convert it to one of {}",
                    file.display(),
                    super::FORMATS.map(|kind| format!(".{kind}")).join(", ")
                )
            }
            Self::Unsupported { file, what } => {
                write!(f, "{}: {what} is not read; export the mesh without it", file.display())
            }
            Self::Malformed { file, line, place, reason } => {
                write!(
                    f,
                    "{}{}: {place}: {reason}; export the mesh again",
                    file.display(),
                    Line(*line)
                )
            }
            Self::Truncated { file, what, wanted, found } => write!(
                f,
                "{}: the file ends at {what} {found} of {wanted}; copy or export it again",
                file.display()
            ),
            Self::NotFinite { file, line, vertex, at } => write!(
                f,
                "{}{}: vertex {vertex} is at {at:?}; remove the vertex or give it finite \
                    coordinates",
                file.display(),
                Line(*line)
            ),
            Self::IndexOutOfRange { file, line, face, index, vertex_count } => write!(
                f,
                "{}{}: face {face} names vertex {index}, but there {} {}; remove or renumber the \
                    face",
                file.display(),
                Line(*line),
                if *vertex_count == 1 { "is" } else { "are" },
                Counted(*vertex_count, "vertex")
            ),
            Self::Empty { file } => {
                write!(f, "{}: the file is empty; copy or export it again", file.display())
            }
            Self::NoTriangles { file, instead: None } => {
                write!(
                    f,
                    "{}: holds no triangles; export the surface, not points or curves",
                    file.display()
                )
            }
            Self::NoTriangles { file, instead: Some(instead) } => {
                write!(
                    f,
                    "{}: holds no triangles that are read ({instead}); export the surface as \
                        triangles",
                    file.display()
                )
            }
            Self::TooMany { file, what, count } => write!(
                f,
                "{}: {count} {what} are more than 32-bit numbers can name; simplify or divide \
                    the mesh",
                file.display()
            ),
            Self::TooLarge { file, vertex, at } => write!(
                f,
                "{}: vertex {vertex} at {at:?} is beyond the range of f32 (3.4e38); choose a \
                    larger unit",
                file.display()
            ),
            Self::TooSmall { file, largest } => write!(
                f,
                "{}: the largest coordinate, {largest:e}, is below f32's normal range (1.2e-38); \
                    choose a smaller unit",
                file.display()
            ),
            Self::NoArea { count } => write!(
                f,
                "no triangle has an area, all are segments or points ({}); export with more \
                    digits or in a smaller unit",
                Counted(*count, "triangle")
            ),
            Self::Open {
                edge_count,
                hole_count,
                largest_hole,
                slit_count,
                places,
                dropped_triangle,
            } => {
                write!(
                    f,
                    "not closed: {} in {}, the largest of {}",
                    Counted(*edge_count, "boundary edge"),
                    Counted(*hole_count, "hole"),
                    Counted(*largest_hole, "edge")
                )?;
                if *slit_count > 0 {
                    write!(
                        f,
                        "; {} among them (T-junctions or zero-area triangles)",
                        Counted(*slit_count, "slit")
                    )?;
                }
                if let Some(triangle) = dropped_triangle {
                    write!(f, "; likely cause: zero-area triangle {triangle} was dropped there")?;
                }
                write!(f, "; fill the holes first{}", Edges(places))
            }
            Self::NonManifoldEdges { count, most, places } => write!(
                f,
                "{}, with up to {most} triangles; separate or unite the parts that meet there{}",
                Counted(*count, "non-manifold edge"),
                Edges(places)
            ),
            Self::NonManifoldVertices { count, places } => {
                write!(
                    f,
                    "several fans meet in {}; run repair{}",
                    Counted(*count, "vertex"),
                    Points(places)
                )
            }
            Self::NonOrientable { component_count, places } => write!(
                f,
                "no outside: {} (as a Möbius strip); cut or thicken it{}",
                Counted(*component_count, "one-sided component"),
                Edges(places)
            ),
            Self::InconsistentWinding { edge_count, places } => write!(
                f,
                "triangles wound against each other at {}; run repair{}",
                Counted(*edge_count, "edge"),
                Edges(places)
            ),
            Self::InsideOut { component_count, places } => {
                write!(
                    f,
                    "inside out: {}; reverse their triangles{}",
                    Counted(*component_count, "outermost component"),
                    Points(places)
                )
            }
            Self::ZeroVolume { triangle, at, volume, bound } => write!(
                f,
                "the closed component with triangle {triangle} at {at:?} has no volume \
                    ({volume:e} ± {bound:e}); remove or thicken it"
            ),
            Self::Invalid { reason } => write!(f, "not a valid mesh: {reason}; run repair"),
            Self::Undeformable { triangle } => write!(
                f,
                "triangle {triangle} has no area or was changed by repair, and may get an area \
                    when the mesh deforms; remove it from the first mesh and all frames"
            ),
            Self::FrameCount { file, what, found, wanted } => write!(
                f,
                "{}: {found} {what}, and the first mesh has {wanted}; frames must have the same \
                    triangles",
                file.display()
            ),
            Self::FrameTriangle { file, triangle, found, wanted } => write!(
                f,
                "{}: triangle {triangle} has the vertices {found:?}, and {wanted:?} in the first \
                    mesh; frames must have the same triangles",
                file.display()
            ),
            Self::FrameTorn { file, vertices: [a, b] } => write!(
                f,
                "{}: vertices {a} and {b} are apart, and lie in one place in the first mesh; \
                    frames must not tear it",
                file.display()
            ),
        }
    }
}

struct Line(Option<usize>);

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}

struct Edges<'a>(&'a [EdgePlace]);

impl fmt::Display for Edges<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for edge in self.0 {
            write!(f, "\n  triangle {}, edge {:?} to {:?}", edge.triangle, edge.from, edge.to)?;
        }
        Ok(())
    }
}

struct Points<'a>(&'a [[f32; 3]]);

impl fmt::Display for Points<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for point in self.0 {
            write!(f, "\n  at {point:?}")?;
        }
        Ok(())
    }
}
