//! Hulls as tight as they can be: an outer hull of few faces, shrunk onto the original triangles
//! and proved to enclose them.
//!
//! ```text
//! mesh ─┬─ collapse (progressive hull) ─ lift ─┐
//!       └─ closure (any triangles) ────────────┴─ first hull ─ decimate ─ polish ─ Hull
//!                                                               └─ placement ─ proof ─┘
//! ```
//! What holds of every [`Hull`], exactly, for its coordinates as stored:
//! - it is a closed manifold whose faces have no points in common but the corners and edges that
//!   they share, and face outwards;
//! - it has no point in common with any triangle of the mesh: not even touching;
//! - every vertex of the mesh is inside it;
//! - with a margin, no point of it is as near to the mesh as that, or nearer: all that is within
//!   the margin is inside, for the way there does not meet the hull. This is proved in floating
//!   point with its rounding bounded; see `distance`.
//!
//! So the first hull is tested as a whole, and after that a move is made only if exact predicates
//! prove that all three still hold; see `work`. Where floating point decides, it decides only what
//! is tried.
//!
//! Unlike a level of the hull hierarchy, a tight hull does not enclose others of its kind, and has
//! no cavities. The mesh may be open, cross itself, or be a heap of loose triangles.
//!
//! After Platis & Theoharis 2003 for the first hull and its program; the shrinking is our own.

mod apart;
mod boxes;
mod build;
mod cells;
mod closure;
mod connected;
mod decimate;
mod distance;
mod exchange;
mod fewest;
mod field;
mod flip;
mod hull;
mod memo;
mod met;
mod obstacle;
mod options;
mod parts;
mod placement;
mod polish;
mod predicates;
mod region;
mod rounding;
mod shell;
mod slack;
mod start;
mod surface;
mod vertex;
mod volume;
mod work;

pub use hull::{Hull, wrap, wrap_all};
pub use options::{Goal, Options, Outcome, Progress, Report, Stage, Start, WrapError};
pub use parts::{parts, share};
pub use surface::Surface;
pub use volume::NoVolume;
pub(crate) use volume::Solid;
