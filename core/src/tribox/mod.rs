//! Triboxes: bounds of eighteen planes, after Crosnier & Rossignac, *Tribox bounds for
//! three-dimensional objects* (1999).
//!
//! A tribox is the intersection of nine slabs, along the axes and the diagonals of the coordinate
//! planes: a box whose twelve edges are chamfered. Its parameters are what the object's points
//! measure along nine directions that need no root, for bounds along one direction are only ever
//! compared with each other. What it is for: a first reject that is tighter than a box for three
//! times the comparisons, and a proxy that can be drawn.
//!
//! ```text
//! bounds    18 parameters: of points, unions, intersections, translations; containment, overlap
//! closure   parameters that no other ones imply: the strong closure of octagons
//! boundary  faces, as loops of vertices, corner by corner
//! snap      planes moved outward until small faces vanish
//! measure   distance, segments
//! moved     bounds of what was rotated
//! support   how far they reach along any direction
//! ```

mod boundary;
mod bounds;
mod closure;
mod measure;
mod moved;
mod snap;
mod support;

pub use boundary::{Boundary, FACES, LOOP, Scalar, VERTICES, boundary};
pub use bounds::{Tribox, TriboxError};
pub use moved::Pose;
pub(crate) use support::Support;

/// Number of slabs.
pub const SLABS: usize = 9;

/// The slabs' directions. Not of unit length: of the last six it is √2.
pub const DIRECTIONS: [[i8; 3]; SLABS] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 1, 0],
    [1, -1, 0],
    [0, 1, 1],
    [0, 1, -1],
    [1, 0, 1],
    [-1, 0, 1],
];
