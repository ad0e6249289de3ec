//! Why there is no blob.

use meshsweep_core::{OpenError, TriboxError};
use std::fmt;

/// Why there is no blob. Each message names what was wanted, what was found, and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// More records than a blob can address.
    TooLarge {
        /// Triangles of the mesh.
        triangles: usize,
    },
    /// The signed volume is not positive: the mesh is inside out where it passes through itself.
    NotPositive {
        /// The volume, input units.
        volume: f64,
    },
    /// Triboxes do not hold the mesh's coordinates.
    Triboxes(TriboxError),
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

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge { triangles } => write!(
                f,
                "{triangles} triangles are more than a blob can hold (20 million): simplify or split the mesh"
            ),
            Self::NotPositive { volume } => write!(
                f,
                "the enclosed volume is {volume}: the mesh passes through itself and is inside out there; unite its parts first"
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

impl From<TriboxError> for BuildError {
    fn from(error: TriboxError) -> Self {
        Self::Triboxes(error)
    }
}
