//! Initial hulls from the mesh's own progressive hull.
//!
//! A level of the progressive hull may touch the mesh, and itself. Its vertices are therefore
//! lifted by a few steps of the grid. Where that does not prove a level, another may do.

use super::initial_hull::{InitialHull, InitialInput};
use super::levels::{ClosedSurface, tried};
use crate::collapse::{Conditions, MAX_STAR};
use crate::geom::side;
use crate::lp::{HalfSpace, Order, minimise_bounded};
use crate::mesh::Mesh;
use crate::progress::Stage;
use crate::tight::moves::{Rounding, Shell, StarFace};
use crate::tight::report::Start;
use glam::DVec3;

/// Initial hulls that come from levels of the progressive hull.
#[derive(Default)]
pub(crate) struct LiftedLevels {
    /// The first level that is proved: the choice for round meshes.
    pub ample: Option<InitialHull>,
    /// The level with the target faces, if it is proved. On blocks with few flat faces it may be
    /// the solid itself.
    pub exact: Option<InitialHull>,
}

/// The levels of the mesh's progressive hull that are proved to be hulls before the deadline.
pub(crate) fn lifted_levels(
    input: &InitialInput<'_>,
    mesh: &Mesh,
    target: usize,
    on_progress: &mut dyn FnMut(Stage),
) -> LiftedLevels {
    let InitialInput { stored, obstacle, rounding, .. } = input;
    let surface = ClosedSurface {
        positions: &stored.positions,
        triangles: &mesh.triangles,
        conditions: Conditions::STANDARD,
    };
    let mut hulls = |thins| {
        let ample = tried(thins);
        let wanted = ample.iter().copied().map(Some).chain([None]);
        let levels = surface.levels(input, target, thins, wanted, on_progress);
        let mut levels = levels.unwrap_or_default();
        let mut lifted = |level: Option<i32>| {
            let (positions, triangles) = levels.take(level)?;
            let mut shell = Shell::new(positions, &triangles);
            let faces = shell.face_count();
            lift(&mut shell, rounding, obstacle.margin());
            InitialHull::proved(shell, Start::Progressive { faces }, obstacle)
        };
        LiftedLevels {
            exact: lifted(None),
            ample: ample.iter().find_map(|&level| lifted(Some(level))),
        }
    };
    // Thinning may make the surface grow into itself where collapses in order do not.
    let thinned = if surface.is_fine(target) { hulls(true) } else { LiftedLevels::default() };
    if thinned.ample.is_some() { thinned } else { hulls(false) }
}

/// Heights that a vertex is lifted by, in half-steps of the grid: the first that is strictly
/// outside of every face is taken.
pub(super) const LIFTS: [f64; 5] = [3.0, 6.0, 12.0, 48.0, 192.0];

/// Moves every vertex strictly outside of all planes of its star, by the margin and a few steps of
/// the grid. The surface then lies strictly outside of its former place. A vertex that has no such
/// place is collapsed into a neighbour if both together have one, and stays otherwise.
pub(crate) fn lift(shell: &mut Shell, rounding: &Rounding, margin: f64) {
    let mut star = Vec::new();
    let mut left = Vec::new();
    // Planes that were already lifted by the margin would lift their neighbours by it again. A few
    // steps of the grid do no harm.
    let before = if margin > 0.0 { Some(shell.clone()) } else { None };
    for v in 0..shell.vertex_slots() {
        if shell.mesh.at(v).is_empty() {
            continue;
        }
        before.as_ref().unwrap_or(shell).vertex_star(v, &mut star);
        match lifted(&star, shell.position(v), rounding, margin) {
            Some(x) => shell.move_vertex(v, x),
            None => left.push(v),
        }
    }
    let mut faces = Vec::new();
    for v in left {
        let neighbours: Vec<u32> = shell.mesh.neighbours(v).collect();
        for u in neighbours {
            if !shell.mesh.collapsible_star(u, v, MAX_STAR, &mut faces) {
                continue;
            }
            star.clear();
            star.extend(faces.iter().map(|&f| shell.star_face(f, [u, v])));
            let middle = (shell.position(u) + shell.position(v)) * 0.5;
            if let Some(x) = lifted(&star, middle, rounding, margin) {
                shell.collapse(u, v, x);
                break;
            }
        }
    }
}

/// About the nearest point to `from` that is strictly outside of all planes of a star, which is
/// exact, and about the margin farther out.
fn lifted(star: &[StarFace], from: DVec3, rounding: &Rounding, margin: f64) -> Option<DVec3> {
    let step = rounding.half_step(from.abs().max_element());
    LIFTS.into_iter().find_map(|lift| {
        // The program's unit is a half-step, or with a margin about the margin, so that its
        // tolerances are far below 1.
        let (unit, height) = if margin > 0.0 {
            (step + margin, (step * lift + margin) / (step + margin))
        } else {
            (step, lift)
        };
        let plane = |face: &StarFace| HalfSpace {
            normal: face.normal,
            offset: height + face.normal.dot(face.corners[0] - from) / unit,
        };
        let mut planes: Vec<HalfSpace> = star.iter().map(plane).collect();
        let x = minimise_bounded(DVec3::ZERO, &mut planes, 1.0, Order::MostViolated)?;
        let x = rounding.round(from + x * unit)?;
        star.iter().all(|face| side(&face.corners, x) > 0.0).then_some(x)
    })
}
