//! The initial hull: a hull that satisfies the whole invariant, made without looking at the goal.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `levels.rs` | levels of the progressive hull, thinned and lifted off the mesh; the grown box |
//! | `voxel_closure.rs` | the closed surface of the voxels that a mesh meets |
//! | `voxels_met.rs` | which voxels a triangle meets |

pub(crate) mod levels;
mod voxel_closure;
mod voxels_met;
