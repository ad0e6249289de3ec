//! The goal and the options of a tight hull.

use crate::error::BuildError;
use crate::number::{ABOVE_ZERO, FROM_ZERO};
use crate::surface::VertexBits;
use std::time::Duration;

/// Faces of a tight or a base hull unless told otherwise.
pub const FACES: u32 = 200;

/// The goal of a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At most this number of faces, and the least volume found with them.
    Faces(usize),
    /// The fewest faces found whose void is at most this.
    ///
    /// The void is the volume of the hull beyond the mesh's, as a fraction of the mesh's volume. A
    /// margin counts as void. The mesh must be closed and must not overlap itself; a proved overlap
    /// is an error.
    Void(f64),
    /// The fewest faces found of which no point is farther than this from the input, in its unit;
    /// more than the margin and twice the distance that vertices moved.
    Slack(f64),
}

impl Goal {
    /// Refuses numbers out of range, and a slack within the margin. [`wrap`](super::wrap) does it
    /// first.
    ///
    /// # Errors
    /// [`BuildError::OutOfRange`], [`BuildError::SlackWithinMargin`].
    pub fn check(self, margin: f64) -> Result<(), BuildError> {
        BuildError::check_range("--margin", margin, FROM_ZERO)?;
        match self {
            Self::Faces(_) => Ok(()),
            Self::Void(void) => BuildError::check_range("--void", 100.0 * void, ABOVE_ZERO),
            Self::Slack(slack) => {
                BuildError::check_range("--slack", slack, ABOVE_ZERO)?;
                let error = BuildError::SlackWithinMargin { slack, margin };
                if slack <= margin { Err(error) } else { Ok(()) }
            }
        }
    }
}

impl Default for Goal {
    fn default() -> Self {
        Self::Faces(FACES as usize)
    }
}

/// How to make a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The goal.
    pub goal: Goal,
    /// Distance from the input's surface that the hull keeps, in the mesh's unit; finite and at
    /// least 0. Every point within the margin is inside the hull. The hull keeps as much more from
    /// the mesh as the mesh's vertices moved.
    pub margin: f64,
    /// How long to polish, as a factor of the time behind the numbers in `alloc-ext/DESIGN.md`.
    /// The result depends on the effort, and not on the machine.
    pub effort: f64,
    /// About when to stop; `None`: never. The result then depends on the machine: at worst it is
    /// the mesh's bounding box. A target without a clock ignores it.
    pub time_limit: Option<Duration>,
    /// Coordinate format of the vertices. [`VertexBits::Auto`] stands for single precision.
    pub vertex_bits: VertexBits,
}

impl Default for Options {
    /// [`FACES`] faces, no margin, an effort of 1, no time limit, single precision.
    fn default() -> Self {
        Self::new(Goal::default())
    }
}

impl Options {
    setters! {
        /// Sets the [margin](Self::margin).
        with_margin: f64 => margin,
        /// Sets the [effort](Self::effort).
        with_effort: f64 => effort,
        /// Sets the [time limit](Self::time_limit).
        with_time_limit: Option<Duration> => time_limit,
        /// Sets the [coordinate format](Self::vertex_bits).
        with_vertex_bits: VertexBits => vertex_bits,
    }

    /// A goal, no margin, an effort of 1, no time limit, single precision.
    #[must_use]
    pub const fn new(goal: Goal) -> Self {
        let vertex_bits = VertexBits::Auto;
        Self { goal, margin: 0.0, effort: 1.0, time_limit: None, vertex_bits }
    }

    /// The options of a hull of a mesh of which every point of the input is within `error`. The
    /// hull keeps that distance too, so that it holds the input as it was before vertices moved.
    /// And its slack is as much less, so that it is the slack from the input.
    ///
    /// # Errors
    /// As [`Goal::check`].
    pub(super) fn of_mesh(&self, error: f64) -> Result<Self, BuildError> {
        self.goal.check(self.margin)?;
        if error <= 0.0 {
            return Ok(*self);
        }
        let margin = (self.margin + error).next_up();
        self.goal.check((margin + error).next_up())?;
        let goal = match self.goal {
            // A little less: the sum of both is rounded up.
            Goal::Slack(slack) => {
                Goal::Slack((slack * (1.0 - 4.0 * f64::EPSILON) - error).next_down())
            }
            goal => goal,
        };
        Ok(Self { margin, goal, ..*self })
    }
}
