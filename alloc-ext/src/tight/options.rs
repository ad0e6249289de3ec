//! What is asked of a hull, and what is said about it.

use crate::hausdorff::Farthest;
use crate::surface::VertexBits;
use crate::tight::proof::NoVolume;
use std::time::Duration;

/// What a hull has to reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At most so many faces, and as little volume as can be had with them.
    Faces(usize),
    /// The fewest faces found whose volume exceeds the mesh's by at most this part of it; a margin
    /// counts as volume beyond. For closed meshes that do not overlap themselves; where one is
    /// found to, that is an error.
    Void(f64),
    /// The fewest faces found of which no point is farther than this from the mesh, in its unit;
    /// more than the margin.
    Slack(f64),
}

/// How to make a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What to reach.
    pub goal: Goal,
    /// Distance from the mesh that no point of the hull comes within, in its unit; finite and at
    /// least 0. With more than 0 every point that is no farther from the mesh is inside the
    /// hull.
    pub margin: f64,
    /// How long to polish, as a factor of what suffices for the numbers in `core/DESIGN.md`. The
    /// result depends on it and on nothing else that is not an input.
    pub effort: f64,
    /// When to stop, about; what is had by then depends on the machine: at worst the mesh's box.
    /// `None`: never.
    pub time_limit: Option<Duration>,
    /// Coordinate format of the vertices. [`VertexBits::Auto`]: single precision, whatever the
    /// mesh would do with.
    pub vertex_bits: VertexBits,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            goal: Goal::Faces(200),
            margin: 0.0,
            effort: 1.0,
            time_limit: None,
            vertex_bits: VertexBits::Auto,
        }
    }
}

/// What a hull was made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// A level of the progressive hull, of so many faces, lifted off the mesh.
    Progressive {
        /// Faces of the level.
        faces: usize,
    },
    /// The boundary of all cubes of a grid that the mesh meets or cuts off from outside.
    Closure {
        /// Edge of a cube, in the mesh's unit.
        cell: f64,
        /// Cubes along the longest side of the grid.
        cells: usize,
    },
    /// The mesh's box, with faces split where that gains most.
    Box,
}

/// Why a hull has the faces that it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It reached its goal.
    Reached,
    /// More faces than asked for: no collapse of an edge kept it closed, embedded, clear of the
    /// mesh and of a sound shape.
    Stuck,
    /// Even the finest hull that was tried is looser than asked for.
    TooLoose,
    /// The time was up.
    OutOfTime,
}

/// What a hull is, and what it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Faces.
    pub faces: usize,
    /// Volume, in the mesh's unit.
    pub volume: f64,
    /// Volume beyond that of the mesh as a part of it, or why the mesh has none to measure that
    /// against.
    pub void: Result<f64, NoVolume>,
    /// Whether the mesh crosses or touches itself, which is looked for where a void is asked for:
    /// then its volume may count places more than once, and the void be more than is said.
    pub crosses: bool,
    /// Bounds of the largest distance from a point of the hull to the mesh, in its unit.
    pub slack: Farthest,
    /// What it was made from.
    pub start: Start,
    /// Closed parts that bounded cavities of the start, or lay or came to lie inside others, and
    /// are not in the hull.
    pub filled: usize,
    /// Why it stopped.
    pub stop: Outcome,
    /// Stars that were placed: the measure of work.
    pub stars: u64,
    /// Linear programs solved for them.
    pub programs: u64,
    /// Time.
    pub time: Duration,
}

/// Where the work stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// Steps done.
    pub done: usize,
    /// Steps in all.
    pub of: usize,
}

/// The stages, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Progressive hull; counts triangles that are gone.
    Collapsing,
    /// Collapses against the mesh; counts faces that are gone.
    Wrapping,
    /// Polishing; counts stars.
    Polishing,
}

/// Why there is no hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WrapError {
    /// No triangle.
    Empty,
    /// A void was asked for, and the mesh has no volume to measure it against.
    NoVolume(NoVolume),
    /// No surface around the mesh has coordinates in the stored range: they end at 3.4e38, or the
    /// mesh is as small as the steps of its coordinates.
    NoRoom,
    /// The margin is negative or not a finite number.
    BadMargin,
    /// With its margin the mesh does not fit in single precision's range.
    MarginTooLarge,
    /// A slack was asked for that is not more than the margin.
    SlackWithinMargin {
        /// The margin.
        margin: f64,
    },
}

impl std::fmt::Display for WrapError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let WrapError::NoVolume(why) = self {
            return write!(
                f,
                "{why}; there is no volume to measure void against: ask for faces or slack"
            );
        }
        if let WrapError::SlackWithinMargin { margin } = self {
            return write!(
                f,
                "no hull can be within the slack: it is not more than {margin:e}, the margin with what rounding may take from it; ask for a larger slack"
            );
        }
        f.write_str(match self {
            WrapError::Empty => "the mesh has no triangles; give one that has",
            WrapError::NoVolume(_) => "there is no volume to measure void against",
            WrapError::NoRoom => {
                "there are no coordinates of single precision around the mesh to put a hull on; move or scale it"
            }
            WrapError::BadMargin => "a margin is a finite number, at least 0",
            WrapError::MarginTooLarge => {
                "the mesh and its margin leave the range of single precision, 3.4e38; ask for less, or scale both down"
            }
            WrapError::SlackWithinMargin { .. } => "the slack is not more than the margin",
        })
    }
}

impl std::error::Error for WrapError {}
