//! The initial hull: a closed surface that satisfies the whole invariant, proved face by face, and
//! from which the search descends.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `lifted.rs` | levels of the mesh's own progressive hull, lifted off the mesh |
//! | `closure_hull.rs` | levels of a voxel closure, for any triangles |
//! | `grown_box.rs` | the mesh's bounding box, a little larger |
//! | `initial_hull.rs` | [`InitialHull`]: how an initial hull is proved |
//! | `levels.rs` | levels of the progressive hull of any closed surface, thinned first |
//! | `voxel_closure.rs` | the voxel closure: the closed surface of the voxels that a mesh meets |
//! | `triangle_voxels.rs` | which voxels a triangle meets |
//!
//! A level of the mesh's own progressive hull is the tightest of these. It exists only for meshes
//! that bound a volume and whose components do not cross.

mod closure_hull;
mod grown_box;
mod initial_hull;
mod levels;
mod lifted;
mod triangle_voxels;
mod voxel_closure;

pub(crate) use closure_hull::{STAIR_CONDITIONS, closure_hull};
pub(crate) use grown_box::grown_box;
pub(crate) use initial_hull::{InitialHull, InitialInput};
pub(crate) use levels::ample_faces;
pub(crate) use lifted::{lift, lifted_levels};
