//! From a robot's description (URDF) to blobs of its links, its joints, and the pairs of links that
//! keep a distance.
//!
//! ```text
//! URDF ─ links, joints ─┬─ mechanism ─ joints in order ─┬─ pairs ─ Robot ─ source: Rust
//!                       └─ shapes, meshes ─ Builder ─ blobs ─┘
//! ```
//!
//! Lengths are in metres and angles in radians, as in the file.
//!
//! | file | owns |
//! | --- | --- |
//! | `urdf` | the elements of the description and of an SRDF |
//! | `package` | names of mesh files, as paths |
//! | `shape` | collision shapes as meshes |
//! | `link` | [`Link`]: the shapes of a link as one mesh, and its blob |
//! | `mechanism` | [`Place`]: joints and links with geometry, in the order of computation |
//! | `pairs` | [`RobotPair`], [`Skipped`]: which pairs keep a distance |
//! | `options` | [`RobotOptions`] |
//! | `assembled` | [`Robot`]: the stages from a description to a robot |
//! | `source` | [`RobotSource`]: the Rust module |

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
