//! The initial hull: a closed surface that satisfies the whole invariant, proved face by face, and
//! from which the search descends.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `lifted.rs` | levels of the mesh's own progressive hull, lifted off the mesh |
//! | `closure_hull.rs` | levels of a voxel closure, for any triangles |
//! | `grown_box.rs` | the mesh's bounding box, a little larger |
//! | `levels.rs` | levels of the progressive hull of any closed surface, thinned first |
//! | `voxel_closure.rs` | the voxel closure: the closed surface of the voxels that a mesh meets |
//! | `triangle_voxels.rs` | which voxels a triangle meets |
//!
//! A level of the mesh's own progressive hull is the tightest of these. It exists only for meshes
//! that bound a volume and whose components do not cross.

mod closure_hull;
mod grown_box;
mod levels;
mod lifted;
mod triangle_voxels;
mod voxel_closure;

pub(crate) use closure_hull::{STAIR_CONDITIONS, closure_hull};
pub(crate) use grown_box::grown_box;
pub(crate) use lifted::lifted_levels;

use crate::surface::Stored;
use crate::tight::moves::{Rounding, Shell};
use crate::tight::proof::{Obstacle, is_outer_hull};
use crate::tight::report::Start;
use std::time::Instant;

/// A proved hull that a search may start from.
pub(crate) struct InitialHull {
    pub shell: Shell,
    pub start: Start,
    /// Connected components that were dropped, because they lay inside others.
    pub filled: usize,
}

impl InitialHull {
    /// Drops components inside others; `None` unless the rest is proved to be an outer hull.
    fn proved(shell: Shell, start: Start, obstacle: &Obstacle) -> Option<Self> {
        let (shell, filled) = match shell.outermost() {
            Some(outermost) => outermost,
            None => (shell, 0),
        };
        let faces: Vec<_> = shell.alive().map(|f| shell.face(f)).collect();
        is_outer_hull(&faces, obstacle).then_some(Self { shell, start, filled })
    }
}

/// What every initial hull is made for, and until when.
#[derive(Clone, Copy)]
pub(crate) struct InitialInput<'a> {
    /// Frame and grid of the surface that is collapsed.
    pub stored: &'a Stored,
    pub obstacle: &'a Obstacle,
    /// Rounding to the coordinates of the hull.
    pub rounding: Rounding,
    pub deadline: Option<Instant>,
}
