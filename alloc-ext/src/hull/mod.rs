//! From a mesh to the tables of a hull hierarchy and their certified radii.
//!
//! Each collapse replaces a fine fragment by a coarse one. Every fine triangle gets one parent in
//! the coarse fragment, so that all levels form a forest whose leaves are the mesh's own triangles;
//! a coarse triangle stands for the leaves below it. Distance to a triangle is a convex function,
//! so the largest distance from a *vertex* of those leaves is the exact radius that makes the swept
//! triangle (Guéziec 2000, 3.1) contain them. Rounded up, it is certified for any assignment.

mod build;
mod cut;
mod deform;
mod encode;
mod forest;
mod groups;
mod levels;
mod stored;
mod swept;
mod tables;
mod wires;

pub use build::{BuildOptions, BuildReport, Kind, Levels, build, hull_of};
pub use cut::cut;
pub use stored::{enclosing_input, mesh_of, placed_mesh, sticks_out_note};
pub use tables::{SplitRecord, Tables};
pub use wires::{wires_note, wires_off_surface};
