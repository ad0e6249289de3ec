//! An initial hull of any triangles, open, crossing or loose: a level of their voxel closure.

use super::initial_hull::{InitialHull, InitialInput};
use super::levels::{ClosedSurface, Faces, tried};
use super::voxel_closure::voxel_closure;
use crate::collapse::Conditions;
use crate::progress::Stage;
use crate::tight::moves::Shell;
use crate::tight::report::Start;
use glam::DVec3;
use meshsweep_core::internal::num::exp2;

/// Conditions for closures that have to stay near the mesh. The closure of an oblique wall is a
/// staircase, of which the paper's conditions refuse most collapses; the edges that are left stand
/// out.
pub(crate) const STAIR_CONDITIONS: Conditions =
    Conditions { compactness_ratio: 0.2, min_normal_cosine: 0.2, ..Conditions::STANDARD };

/// Most faces of a closure that is an initial hull without any collapse.
const MOST_FACES: usize = 10_000;

/// The first level of the voxel closure that is proved to be a hull, or the closure itself.
///
/// `voxels` is the number of voxels along the longest side; `target` the number of faces of the
/// hull that is made from it. `None` if there is none, or the deadline passes.
pub(crate) fn closure_hull(
    input: &InitialInput<'_>,
    voxels: usize,
    target: usize,
    conditions: Conditions,
    on_progress: &mut dyn FnMut(Stage),
) -> Option<InitialHull> {
    let InitialInput { stored, obstacle, rounding, deadline } = input;
    let mut closure = voxel_closure(obstacle, voxels, *deadline)?;
    if obstacle.margin() > 0.0 {
        closure.positions =
            closure.positions.iter().map(|&p| rounding.round(p)).collect::<Option<Vec<DVec3>>>()?;
    }
    if closure.positions.iter().any(|&p| rounding.round(p) != Some(p)) {
        return None;
    }
    let start = Start::VoxelClosure { edge: closure.edge, voxels: closure.voxels };
    let local = exp2(-stored.scale_exponent);
    let positions: Vec<DVec3> = closure.positions.iter().map(|&p| p * local).collect();
    let surface =
        ClosedSurface { positions: &positions, triangles: &closure.triangles, conditions };
    let proved = |(positions, triangles): Faces| {
        InitialHull::proved(Shell::new(positions, &triangles), start, obstacle)
    };
    // Thinned levels may grow into each other in narrow places.
    for &thins in if surface.is_fine(target) { &[true, false][..] } else { &[false] } {
        // Coarser levels would be farther from the mesh than the closure.
        let wanted = || tried(thins).iter().filter(|&&level| level >= 0).map(|&level| Some(level));
        let mut levels = surface.levels(input, target, thins, wanted(), on_progress)?;
        let found = wanted().find_map(|level| levels.take(level).and_then(proved));
        if found.is_some() {
            return found;
        }
    }
    // The closure itself never meets itself, but each of its faces costs a collapse.
    if closure.triangles.len() <= MOST_FACES {
        proved((closure.positions, closure.triangles))
    } else {
        None
    }
}
