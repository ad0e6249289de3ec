//! Exact predicates, proved distances, and enclosure: they decide whether an edit is made.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `predicates.rs` | whether triangles meet, exactly |
//! | `clearance.rs` | whether triangles keep a distance, proved in floating point |
//! | `obstacle.rs` | [`Obstacle`]: the mesh that a hull may not meet, with its search trees |
//! | `distance_field.rs` | bounds of the distance to the mesh, kept on a lattice |
//! | `enclosure.rs` | whether a whole surface is an outer hull; components inside others |
//! | `volume.rs` | the volume that a mesh bounds, and the void of its hull |
//! | `tetrahedron.rs` | the tetrahedron that an edit cuts off, in floating point |

mod clearance;
mod distance_field;
mod enclosure;
mod obstacle;
mod predicates;
mod tetrahedron;
mod volume;

pub(crate) use clearance::{Clearance, Nearest};
pub(crate) use distance_field::DistanceField;
pub(crate) use enclosure::{is_outer_hull, outermost};
pub(crate) use obstacle::Obstacle;
pub(crate) use predicates::{Face, Triangle, are_apart, is_degenerate, side};
pub(crate) use tetrahedron::Tetrahedron;
pub(crate) use volume::{Solid, crosses_itself};
