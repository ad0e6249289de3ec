//! Proved distances and enclosure. With the exact predicates of [`surface`](crate::surface) they
//! decide whether an edit is made.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `clearance.rs` | whether triangles keep a distance, proved in floating point |
//! | `obstacle.rs` | [`Obstacle`]: the mesh that a hull may not meet, with its search trees |
//! | `distance_field.rs` | bounds of the distance to the mesh, kept on a lattice |
//! | `enclosure.rs` | whether a whole surface is an outer hull; components inside others |
//! | `tetrahedron.rs` | the tetrahedron that an edit cuts off, in floating point |

mod clearance;
mod distance_field;
mod enclosure;
mod obstacle;
mod tetrahedron;

pub(crate) use clearance::{Clearance, Nearest};
pub(crate) use distance_field::DistanceField;
pub(crate) use enclosure::{holds, is_outer_hull, outermost};
pub(crate) use obstacle::Obstacle;
pub(crate) use tetrahedron::Tetrahedron;
