//! Searches for a goal: which initial hulls are tried, and how each is brought to the goal.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `faces.rs` | the tightest hull of a number of faces |
//! | `void.rs` | the fewest faces for a void |
//! | `slack.rs` | the fewest faces for a slack |
//! | `candidate.rs` | [`CandidateHull`]: a hull that reached its goal or not; which of two is better |
//! | `descent.rs` | brings a hull down to fewer faces in stages |
//! | `polish.rs` | exchanges, flips and kicks in rounds |

mod candidate;
mod descent;
mod faces;
mod polish;
mod slack;
mod void;

pub(crate) use candidate::CandidateHull;

use crate::mesh::Mesh;
use crate::surface::Stored;
use crate::tight::initial::InitialInput;
use crate::tight::moves::Rounding;
use crate::tight::options::{Goal, Options, WrapError};
use crate::tight::proof::{Obstacle, Solid};
use crate::tight::report::Progress;
use faces::Target;
use std::time::Instant;

/// What a search is given, and its state.
pub(crate) struct HullSearch<'a, 'p> {
    pub mesh: &'a Mesh,
    /// The mesh in the frame of its own coordinates.
    pub stored: &'a Stored,
    /// The frame and the coordinate format of the hull.
    pub around: &'a Stored,
    pub obstacle: &'a Obstacle,
    /// `None` if the mesh bounds no volume.
    pub solid: Option<Solid>,
    pub options: &'a Options,
    pub deadline: Option<Instant>,
    /// Whether the best initial hull was given up for lack of time.
    pub is_hurried: bool,
    pub on_progress: &'p mut dyn FnMut(Progress),
}

impl<'a> HullSearch<'a, '_> {
    /// The best hull found for the goal of the options.
    pub fn run(&mut self) -> Result<CandidateHull<'a>, WrapError> {
        match self.options.goal {
            Goal::Faces(faces) => self.of_faces(Target { faces, descends: true }),
            Goal::Void(void) => self.fewest_faces_by_void(void),
            Goal::Slack(slack) => self.fewest_faces_by_slack(slack),
        }
    }

    fn volume(&self) -> Option<f64> {
        self.solid.map(|solid| solid.volume)
    }

    /// The volume that gains are measured against.
    fn floor(&self) -> f64 {
        self.volume().unwrap_or(0.0)
    }

    fn rounding(&self) -> Rounding {
        Rounding::new(self.around.grid, self.around.scale_exponent)
    }

    /// For initial hulls in the hull's own frame.
    fn initial_input(&self) -> InitialInput<'a> {
        InitialInput {
            stored: self.around,
            obstacle: self.obstacle,
            rounding: self.rounding(),
            deadline: self.deadline,
        }
    }

    /// The longest side of the mesh's bounding box.
    fn longest_side(&self) -> f64 {
        let bounds = self.obstacle.bounds();
        (bounds.high - bounds.low).max_element()
    }

    /// The largest magnitude of a coordinate of the mesh.
    fn largest_coordinate(&self) -> f64 {
        let bounds = self.obstacle.bounds();
        bounds.low.abs().max(bounds.high.abs()).max_element()
    }

    /// Why there is no initial hull.
    fn no_room(&self) -> WrapError {
        if self.obstacle.margin() > 0.0 { WrapError::MarginTooLarge } else { WrapError::NoRoom }
    }

    fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }
}
