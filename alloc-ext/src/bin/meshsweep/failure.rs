//! What can go wrong. Each variant is one line that names the file, the place and the remedy.

use meshsweep::counted::Counted;
use meshsweep::mesh::MeshError;
use meshsweep::number::Typed;
use meshsweep::{BuildError, io_remedy};
use meshsweep_core::{OpenError, QueryError};
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Why a command failed. It has written no file then. The standard output has the answers to the
/// queries before the refused one.
#[derive(Debug)]
pub enum Failure {
    /// A file of queries cannot be read.
    ReadQueries { file: PathBuf, error: io::Error, wanted: &'static str },
    /// A file cannot be written.
    Write { file: PathBuf, error: io::Error },
    /// The output is one of the inputs.
    SameFile { file: PathBuf },
    /// The directory of an output does not exist.
    NoDirectory { file: PathBuf, directory: PathBuf },
    /// The blob cannot be built or cut.
    Build { file: PathBuf, error: BuildError },
    /// Two meshes are not proved to be as close to each other as asked for.
    Apart { first: PathBuf, second: PathBuf, most: f64, lower: f64, upper: f64 },
    /// Not all that the blob claims of the mesh is proved. `open` counts the missing proofs.
    NotVerified { blob: PathBuf, mesh: PathBuf, open: String },
    /// No setting of the mesh meets the limits.
    Limits { file: PathBuf, what: String },
    /// The blob is refused.
    Open { file: PathBuf, error: OpenError },
    /// The blob was built without the structure that the question needs. `other` names an engine
    /// that has it; `served` lists the questions that the blob serves.
    NotServed {
        file: PathBuf,
        structure: &'static str,
        build_for: String,
        other: Option<&'static str>,
        served: String,
    },
    /// The blob serves none of the questions whose costliest query can be searched.
    NothingToSearch { file: PathBuf, served: String },
    /// The levels of the blob's hierarchy enclose nothing.
    NotEnclosing { file: PathBuf },
    /// The curves of the blob bound no area.
    NoFence { file: PathBuf, error: QueryError },
    /// All tight hulls of the blob have more faces.
    NoTightHull { file: PathBuf, faces: u32, least: u32 },
    /// The blob has no such key frame.
    NoFrame { file: PathBuf, frame: f32, last: u32 },
    /// The mesh bounds no solid, and signs are wanted.
    NotClosed { file: PathBuf, instead: &'static str },
    /// A grid reaches beyond f32.
    GridTooLarge { file: PathBuf },
    /// A query line has too few or too many fields.
    FieldCount { file: PathBuf, line: usize, wanted: &'static str, found: usize },
    /// A field of a query is no number.
    Field { file: PathBuf, line: usize, field: usize, text: String, reason: &'static str },
    /// A raw file does not hold whole queries.
    RawLength { file: PathBuf, bytes: usize, record: usize },
    /// A query is refused.
    Query { place: Place, error: QueryError },
    /// A pose's quaternion is 0.
    NoRotation { place: Place },
    /// A pose's matrix has an entry that is too large, or is no rotation where one is needed.
    Matrix { place: Place, fault: String },
    /// An end of a segment is too far away. `limit` is the greatest distance, in words.
    TooFar { place: Place, limit: String },
    /// The queries end early, so no file of answers is written.
    Unwritten { file: PathBuf, cause: Box<Failure> },
    /// A query that the program made itself is refused.
    Search { file: PathBuf, error: QueryError },
    /// The arguments do not go together.
    Usage { what: String },
    /// The reader of the standard output has closed it: no error.
    ClosedPipe,
}

/// Which query.
#[derive(Debug)]
pub enum Place {
    /// Line of a text, from 1.
    Line { file: PathBuf, line: usize },
    /// Number of a raw record, from 0, and its first byte.
    Record { file: PathBuf, number: usize, byte: usize },
    /// One of the command line.
    Argument { text: String },
    /// One of the demonstration's.
    BuiltIn,
}

impl Failure {
    pub fn build(file: &Path, error: BuildError) -> Self {
        let is_usage = match &error {
            BuildError::Option { .. }
            | BuildError::OutOfRange { .. }
            | BuildError::TooManyHulls { .. }
            | BuildError::SlackWithinMargin { .. } => true,
            BuildError::Mesh { error, .. } => matches!(**error, MeshError::Units { .. }),
            _ => false,
        };
        if is_usage {
            return Failure::Usage { what: error.to_string() };
        }
        Failure::Build { file: file.to_owned(), error }
    }

    /// A file, or the standard input, cannot be read.
    pub fn read(file: &Path, error: &io::Error) -> Self {
        let (kind, reason) = (error.kind(), error.to_string());
        Self::build(file, BuildError::Unreadable { file: file.to_owned(), kind, reason })
    }

    pub fn open(file: &Path, error: OpenError) -> Self {
        Failure::Open { file: file.to_owned(), error }
    }

    pub fn write(file: &Path, error: io::Error) -> Self {
        let directory =
            file.parent().filter(|parent| !parent.as_os_str().is_empty() && !parent.exists());
        match directory {
            Some(directory) if error.kind() == io::ErrorKind::NotFound => {
                Failure::NoDirectory { file: file.to_owned(), directory: directory.to_owned() }
            }
            _ => Failure::Write { file: file.to_owned(), error },
        }
    }

    /// Prints the failure to the standard error.
    pub fn report(&self) -> ExitCode {
        if matches!(self, Failure::ClosedPipe) {
            return ExitCode::SUCCESS;
        }
        // A mesh error lists each place on a line of its own.
        let text = self.to_string();
        let line = text.lines().map(str::trim).collect::<Vec<_>>().join("; ");
        // If the standard error is closed too, nobody can be told.
        let _ = writeln!(io::stderr(), "error: {line}");
        ExitCode::from(match self {
            Failure::Usage { .. } | Failure::NoRotation { place: Place::Argument { .. } } => 2,
            Failure::Apart { .. } | Failure::NotVerified { .. } => 3,
            _ => 1,
        })
    }
}

/// The operating system's message, and a remedy.
struct Cause<'a>(&'a io::Error);

impl fmt::Display for Cause<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.0, io_remedy(self.0.kind()))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::ReadQueries { file, error, wanted } => {
                write!(f, "{}: cannot be read: {}", file.display(), Cause(error))?;
                if error.kind() == io::ErrorKind::NotFound {
                    write!(f, ", or write the query with commas ({wanted})")?;
                }
                Ok(())
            }
            Failure::Write { file, error } => {
                write!(f, "{}: cannot be written: {}", file.display(), Cause(error))
            }
            Failure::SameFile { file } => {
                write!(f, "{}: is both input and output; name another output", file.display())
            }
            Failure::NoDirectory { file, directory } => write!(
                f,
                "{}: cannot be written: there is no directory {}; make it first",
                file.display(),
                directory.display()
            ),
            Failure::Apart { first, second, most, lower, upper } => {
                let most = Typed(*most);
                write!(f, "{} and {}: the distance is ", first.display(), second.display())?;
                if lower > &most.0 {
                    write!(f, "at least {lower}, and at most {most} was asked for")
                } else {
                    write!(
                        f,
                        "from {lower} to {upper}: too close to {most} to be decided; ask for a \
                         little more"
                    )
                }
            }
            Failure::NotVerified { blob, mesh, open } => {
                write!(f, "{} of {}: {open}", blob.display(), mesh.display())
            }
            Failure::Limits { file, what } => write!(f, "{}: {what}", file.display()),
            Failure::Build { file, error } => match error {
                BuildError::Unreadable { .. }
                | BuildError::Mesh { .. }
                | BuildError::NotSolid { .. }
                | BuildError::Robot { .. }
                | BuildError::Curve { .. } => error.fmt(f),
                BuildError::Unmet(_) => {
                    write!(f, "{}: {error}; nothing is written", file.display())
                }
                _ => write!(f, "{}: {error}", file.display()),
            },
            Failure::NothingToSearch { file, served } => write!(
                f,
                "{}: serves {served}; worst searches closest, within, signed, winding and segment",
                file.display()
            ),
            Failure::NoFence { file, error } => write!(f, "{}: {error}", file.display()),
            Failure::NotEnclosing { file } => write!(
                f,
                "{}: was built --for sweep, and its levels are no hulls; build it --for hull from \
                 a closed mesh, or draw its levels with meshsweep refine",
                file.display()
            ),
            Failure::Open { file, error } => {
                write!(f, "{}: {error}; {}", file.display(), remedy(error))
            }
            Failure::NotServed { file, structure, build_for, other, served } => {
                write!(f, "{}: has no {structure}, and serves {served}", file.display())?;
                write!(
                    f,
                    "; build one from the mesh: meshsweep build MESH -o BLOB --for {build_for}"
                )?;
                other.map_or(Ok(()), |engine| write!(f, ", or use --engine {engine}"))
            }
            Failure::NoTightHull { file, faces, least } => write!(
                f,
                "{}: has no tight hull of {faces} faces or fewer: the coarsest has {least}",
                file.display()
            ),
            Failure::NoFrame { file, frame, last } => write!(
                f,
                "{}: has no frame {frame}: its key frames are 0 to {last}",
                file.display()
            ),
            Failure::NotClosed { file, instead } => write!(
                f,
                "{}: was built from a mesh that is not closed, so inside and outside are not \
                 defined; {instead}",
                file.display()
            ),
            Failure::GridTooLarge { file } => write!(
                f,
                "{}: the grid reaches beyond f32 (3.4e38); choose a smaller --margin",
                file.display()
            ),
            Failure::FieldCount { file, line, wanted, found } => write!(
                f,
                "{}, line {line}: {}, and the query needs {wanted}; mend the line or begin it \
                 with #",
                file.display(),
                Counted(*found, "field")
            ),
            Failure::Field { file, line, field, text, reason } => {
                let text: String = text.chars().take(40).collect();
                write!(f, "{}, line {line}, field {field}: {text:?} {reason}", file.display())
            }
            Failure::RawLength { file, bytes, record } => write!(
                f,
                "{}: {} is no whole number of queries of {record} bytes, the last begins at byte \
                 {}; write little-endian f32",
                file.display(),
                Counted(*bytes, "byte"),
                bytes - bytes % record
            ),
            Failure::Query { place, error } => {
                let remedy = match error {
                    QueryError::NotFinite => "; remove the query",
                    _ => "",
                };
                write!(f, "{place}: {error}{remedy}")
            }
            Failure::NoRotation { place } => {
                write!(
                    f,
                    "{place}: the quaternion is 0, which says no rotation; 1,0,0,0 turns nothing"
                )
            }
            Failure::Matrix { place, fault } => write!(f, "{place}: {fault}"),
            Failure::TooFar { place, limit } => {
                write!(
                    f,
                    "{place}: an end is too far away for this blob: {limit}; clip the segment first"
                )
            }
            Failure::Unwritten { file, cause } => {
                write!(f, "{cause}; {} is not written", file.display())
            }
            Failure::Search { file, error } => write!(f, "{}: {error}", file.display()),
            Failure::Usage { what } => f.write_str(what),
            Failure::ClosedPipe => f.write_str("the standard output was closed"),
        }
    }
}

fn remedy(error: &OpenError) -> &'static str {
    match error {
        OpenError::NotABlob => "make one with: meshsweep build MESH -o BLOB",
        OpenError::Version { .. } => "or use the program that it was built with",
        _ => "copy or build it again",
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line { file, line } => write!(f, "{}, line {line}", file.display()),
            Place::Record { file, number, byte } => {
                write!(f, "{}, query {number} at byte {byte}", file.display())
            }
            Place::Argument { text } => write!(f, "query {text}"),
            Place::BuiltIn => f.write_str("the built-in query"),
        }
    }
}
