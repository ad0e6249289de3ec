//! Certified distances both ways between a hull and the mesh within.

use crate::hausdorff::{Farthest, Nearest, farthest};
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
    distances_watched(hull, mesh, Watch::NONE)
}

/// [`distances`] under a watch. If it asks to end, they mean nothing.
pub(super) fn distances_watched(hull: &Mesh, mesh: &Mesh, watch: Watch<'_>) -> Distances {
    let (hull_surface, mesh_surface) = (Obstacle::of(hull), Obstacle::of(mesh));
    let to = |surface: &Obstacle, p: DVec3| {
        let (triangle, [lower, upper]) = surface.nearest(p)?;
        Some(Nearest { lower, upper, triangle: Some(triangle) })
    };
    let all = mesh.triangles.len();
    let mut to_mesh = watch.asks(all, |p| to(&mesh_surface, p));
    let slack = farthest(hull.corners_f64(), 0.0, &mut to_mesh);
    let enough = slack.lower * FINE;
    let slacks = hull
        .corners_f64()
        .map(|face| farthest(std::iter::once(face), enough, &mut to_mesh).upper.min(slack.upper))
        .collect();
    let to_hull = watch.asks(all, |p| to(&hull_surface, p));
    let depth = farthest(mesh.all_corners_f64(), 0.0, to_hull);
    Distances { slacks, slack, depth }
}
