//! An initial hull of any triangles, open, crossing or loose: a level of their voxel closure.

use super::initial_hull::{InitialHull, InitialInput};
use super::levels::ClosedSurface;
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

/// The level of the voxel closure that a hull of `target` faces is made from.
///
/// `voxels` is the number of voxels along the longest side. `None` if there is no closure, if it
/// does not keep the margin, or if the deadline passes.
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
    // In narrow places walls may grow into each other. Those that may not have fewer collapses to
    // choose from, and the closure does not meet itself, so the second level is proved.
    [false, true].into_iter().find_map(|keeps_apart| {
        let conditions = Conditions { keeps_apart, ..conditions };
        let surface =
            ClosedSurface { positions: &positions, triangles: &closure.triangles, conditions };
        let mut levels = surface.levels(input, target, true, [Some(0)], on_progress)?;
        let (positions, triangles) = levels.take(Some(0))?;
        InitialHull::proved(Shell::new(positions, &triangles), start, obstacle)
    })
}
