//! Certified distances both ways between a hull and the mesh within.

use crate::hausdorff::{Farthest, Nearest, farthest, farthest_of_many};
use crate::mesh::Mesh;
use crate::progress::Watch;
use crate::tight::proof::Obstacle;
use glam::DVec3;

/// Distances between a hull and the mesh within, in their unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Distances {
    /// For each face of the hull an upper bound of the distance of its points from the mesh.
    pub slacks: Vec<f64>,
    /// The largest distance from a point of the hull to the mesh.
    pub slack: Farthest,
    /// The largest distance from a point of the mesh to the hull.
    pub depth: Farthest,
}

/// Accuracy of the slacks as a fraction of the largest: finer than the steps of two bytes at the
/// large slacks.
const FINE: f64 = 1.0 / 512.0;

/// Distances between `hull` and `mesh`, which may be any triangles and wires.
///
/// Cost: a branch and bound by nearest points for each face of the hull, and once for all of the
/// mesh.
pub fn distances(hull: &Mesh, mesh: &Mesh) -> Distances {
    let obstacle = Obstacle::of(mesh);
    let slack = farthest(hull.corners_f64(), 0.0, |p| nearest(&obstacle, p));
    distances_from(hull, &obstacle, slack, Watch::NONE)
}

fn nearest(surface: &Obstacle, p: DVec3) -> Option<Nearest> {
    let (triangle, [lower, upper]) = surface.nearest(p)?;
    Some(Nearest { lower, upper, triangle: Some(triangle) })
}

/// [`distances`] between a hull and its obstacle, if its slack is known. If the watch asks to end,
/// they mean nothing.
pub(super) fn distances_from(
    hull: &Mesh,
    obstacle: &Obstacle,
    slack: Farthest,
    watch: Watch<'_>,
) -> Distances {
    let all = obstacle.singles().len();
    let mut to_mesh = watch.asks(all, |p| nearest(obstacle, p));
    let enough = slack.lower * FINE;
    let slacks = hull
        .corners_f64()
        .map(|face| farthest(std::iter::once(face), enough, &mut to_mesh).upper.min(slack.upper))
        .collect();
    let hull_surface = Obstacle::of(hull);
    let to_hull = watch.asks(all, |p| nearest(&hull_surface, p));
    let depth = farthest_of_many(obstacle.singles(), to_hull);
    Distances { slacks, slack, depth }
}
