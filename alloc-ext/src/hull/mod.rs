//! From a closed mesh to the tables of a hull hierarchy.

mod build;
mod one_sided;
mod wires;

pub use build::{BuildError, BuildOptions, BuildReport, Built, build, hull_of};
pub use one_sided::{Farthest, Nearest, farthest, hull_to_surface, is_within};
pub use wires::wires_off_surface;
