//! Measures of a tight hull and of the work for it.

use super::Goal;
use crate::counted::Counted;
use crate::hausdorff::Farthest;
use crate::mesh::NoVolume;
use crate::number::{About, AtMost, Typed};
use std::time::Duration;

/// The initial hull that a hull was made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// A level of the mesh's progressive hull, lifted off the mesh.
    Progressive {
        /// Faces of the level.
        faces: usize,
    },
    /// The voxel closure: the boundary of all voxels that the mesh meets or cuts off from outside.
    VoxelClosure {
        /// Edge of a voxel, in the mesh's unit.
        edge: f64,
        /// Voxels along the longest side of the grid.
        voxels: usize,
    },
    /// The mesh's bounding box, with faces split where a split gains most.
    Box,
}

/// Why the search for a hull ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The hull reached its goal.
    Reached,
    /// More faces than asked for: no edge collapse kept the hull closed, embedded, clear of the
    /// mesh and of a sound shape.
    Stuck,
    /// Even the finest hull that was tried is looser than asked for.
    TooLoose,
    /// The time was up.
    OutOfTime,
}

/// Measures of a hull and of the work for it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Number of faces.
    pub faces: usize,
    /// Volume, in the mesh's unit.
    pub volume: f64,
    /// Volume beyond that of the mesh, as a fraction of the mesh's volume; or why the mesh has no
    /// volume.
    pub void: Result<f64, NoVolume>,
    /// Whether the mesh crosses or touches itself, which is tested only where a void is asked for.
    /// Its volume may then count places more than once, and the true void may be larger.
    pub crosses: bool,
    /// Bounds of the largest distance from a point of the hull to the mesh, in its unit.
    pub slack: Farthest,
    /// No point of the input is farther than this from the mesh: how far vertices moved.
    pub input_error: f64,
    /// The initial hull.
    pub start: Start,
    /// Number of closed components that bounded cavities, or lay inside others, and are not in the
    /// hull.
    pub filled: usize,
    /// Why the search ended.
    pub stop: Outcome,
    /// Number of stars that were placed: the measure of work.
    pub stars: u64,
    /// Number of linear programs solved for the stars.
    pub programs: u64,
    /// Elapsed time.
    pub time: Duration,
}

impl Report {
    /// Bounds of the largest distance from a point of the hull to the input, in its unit.
    #[must_use]
    pub fn slack_of_input(&self) -> Farthest {
        let Self { slack: Farthest { lower, upper }, input_error: error, .. } = *self;
        if error > 0.0 {
            let lower = (lower - error).next_down().max(0.0);
            Farthest { lower, upper: (upper + error).next_up() }
        } else {
            self.slack
        }
    }

    /// Says why the search did not come to `goal`, or to a smaller hull that meets it.
    #[must_use]
    pub fn why_stopped(&self, goal: Goal) -> Option<String> {
        Some(match (self.stop, goal) {
            (Outcome::Reached, _) => return None,
            (Outcome::Stuck, Goal::Faces(faces)) => format!(
                "stopped before {faces} faces: no edge may collapse and leave the hull closed, \
                 clear of the mesh and of itself"
            ),
            (Outcome::Stuck, _) => "stopped where no edge may collapse any more".to_owned(),
            // A hull that misses the goal is not written. So the last change met it.
            (Outcome::TooLoose, _) => {
                "fewer faces were not tried: this is as tight as it gets".to_owned()
            }
            (Outcome::OutOfTime, Goal::Faces(faces)) if self.faces > faces => {
                format!("the time was up before {faces} faces: with more time the hull has fewer")
            }
            (Outcome::OutOfTime, Goal::Faces(_)) => {
                "the time was up: with more time the hull is tighter".to_owned()
            }
            (Outcome::OutOfTime, _) => {
                "the time was up: with more time the hull may have fewer faces".to_owned()
            }
        })
    }

    /// Says whether the mesh's volume is sure, how the hull began if not as the progressive hull,
    /// and which cavities it fills.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut texts = Vec::new();
        if self.crosses {
            texts.push(
                "the mesh crosses or touches itself: its volume may count places more than once, \
                 so that the true void may be larger"
                    .to_owned(),
            );
        }
        if let Start::VoxelClosure { edge, .. } = self.start {
            texts.push(format!(
                "the hull began as a voxel closure: the outside of the voxels of edge {} that the \
                 mesh meets",
                About(edge)
            ));
        }
        if self.start == Start::Box {
            texts.push("the hull began as the mesh's box".to_owned());
        }
        if self.filled > 0 {
            texts.push(format!(
                "{} filled: a cavity, or a connected component inside another",
                Counted(self.filled, "shell")
            ));
        }
        texts
    }
}

/// Says that a hull keeps its margin, if it has one. `of` names what it encloses.
#[must_use]
pub fn margin_note(margin: Option<f64>, of: &str) -> Option<String> {
    let margin = margin.filter(|&margin| margin > 0.0)?;
    Some(format!("all points within {} of the {of} are inside", Typed(margin)))
}

/// Says of what a hull holds, and of what its distances are, if vertices moved by up to `error`.
#[must_use]
pub fn rounded_note(error: f64) -> Option<String> {
    (error > 0.0).then(|| {
        format!(
            "the hull encloses the input as it was before its vertices moved; distances and void \
             are those of the mesh with moved vertices, up to {} from there",
            AtMost(error)
        )
    })
}

/// Says why there is no void, if there is none.
#[must_use]
pub fn no_void_note(void: &Result<f64, NoVolume>) -> Option<String> {
    let why = void.as_ref().err()?;
    Some(format!("{why}; there is no volume to measure void against"))
}
