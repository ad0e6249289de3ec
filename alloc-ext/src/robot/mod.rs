//! From a robot's description (URDF) to blobs of its links, its joints, and the pairs of links that
//! keep a distance.
//!
//! ```text
//! URDF ─ links, joints ─┬─ mechanism ─ joints in order ─┬─ pairs ─ Robot ─ source: Rust
//!                       └─ shapes, meshes ─ Builder ─ blobs ─┘
//! ```
//!
//! Lengths are in metres and angles in radians, as in the file.

mod assembled;
mod link;
mod mechanism;
mod options;
mod package;
mod pairs;
mod shape;
mod source;
mod urdf;

pub use assembled::Robot;
pub use link::Link;
pub use mechanism::Place;
pub use options::RobotOptions;
pub use pairs::{RobotPair, Skipped};
pub use source::RobotSource;
