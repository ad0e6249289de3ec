//! [`HullSearch`]: the inputs and the state of a search.

use crate::error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Stage;
use crate::surface::{Solid, Stored};
use crate::tight::deadline::Deadline;
use crate::tight::initial::InitialInput;
use crate::tight::moves::Rounding;
use crate::tight::options::Options;
use crate::tight::proof::Obstacle;

/// The inputs and the state of a search.
pub(crate) struct HullSearch<'a, 'p> {
    pub mesh: &'a Mesh,
    /// The mesh in the frame of its own coordinates.
    pub stored: &'a Stored,
    /// The frame and the coordinate format of the hull.
    pub hull_frame: &'a Stored,
    pub obstacle: &'a Obstacle,
    /// `None` if the mesh bounds no volume.
    pub solid: Option<Solid>,
    pub options: &'a Options,
    pub deadline: Deadline<'a>,
    /// Whether the best initial hull was given up for lack of time.
    pub is_hurried: bool,
    pub on_progress: &'p mut dyn FnMut(Stage),
}

impl<'a> HullSearch<'a, '_> {
    pub(super) fn volume(&self) -> Option<f64> {
        self.solid.map(|solid| solid.volume)
    }

    /// The volume that gains are measured against: the mesh's, or 0 if it bounds none.
    pub(super) fn floor(&self) -> f64 {
        self.volume().unwrap_or(0.0)
    }

    pub(super) fn rounding(&self) -> Rounding {
        Rounding::new(self.hull_frame.grid, self.hull_frame.scale_exponent)
    }

    /// For initial hulls in the hull's own frame.
    pub(super) fn initial_input(&self) -> InitialInput<'a> {
        InitialInput {
            stored: self.hull_frame,
            obstacle: self.obstacle,
            rounding: self.rounding(),
            deadline: self.deadline,
        }
    }

    /// The longest side of the mesh's bounding box.
    pub(super) fn longest_side(&self) -> f64 {
        let bounds = self.obstacle.bounds();
        (bounds.high - bounds.low).max_element()
    }

    /// The largest magnitude of a coordinate of the mesh.
    pub(super) fn largest_coordinate(&self) -> f64 {
        let bounds = self.obstacle.bounds();
        bounds.low.abs().max(bounds.high.abs()).max_element()
    }

    /// Why there is no initial hull.
    pub(super) fn no_room(&self) -> BuildError {
        if self.obstacle.has_wide_margin() {
            BuildError::MarginTooLarge
        } else {
            BuildError::NoRoom
        }
    }

    pub(super) fn is_late(&self) -> bool {
        self.deadline.has_passed()
    }
}
