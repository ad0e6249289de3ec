//! Exact predicates, proved distances, and enclosure: what decides whether an edit is made.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `predicates.rs` | whether triangles meet, exactly |
//! | `distance.rs` | whether triangles are farther apart than a distance, proved in floating point |
//! | `obstacle.rs` | the mesh that a hull may not meet, with its search trees |
//! | `distance_field.rs` | bounds of the distance to the mesh, kept on a lattice |
//! | `region.rs` | planes and tetrahedra, in floating point |
//! | `volume.rs` | the volume that a mesh bounds, or why there is none |
//! | `surface.rs` | distances to any triangles, for callers |
//! | `boxes.rs` | a static binary tree of boxes |
//! | `cells.rs` | a static tree of boxes eight wide |
//! | `connected.rs` | connected components of triangles |

pub(crate) mod boxes;
pub(crate) mod cells;
pub(crate) mod connected;
pub(crate) mod distance;
pub(crate) mod distance_field;
pub(crate) mod obstacle;
pub(crate) mod predicates;
pub(crate) mod region;
pub(crate) mod surface;
pub(crate) mod volume;
