//! Levels of detail: faces, volume, error and distance (Crosnier & Rossignac 1999, section 4 and
//! Table 1).

use super::extent::Extent;
use super::polygons::margin;
use super::split::Hierarchy;
use super::union::boundary_of_union;
use crate::hausdorff::{Farthest, farthest, nearest_in};
use crate::mesh::Mesh;
use crate::progress::Watch;
use meshsweep_core::Bvh;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::FACES;

/// About the number of queries of a level.
const QUERIES: usize = 10_000;

/// A union of triboxes that covers a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Number of triboxes.
    pub triboxes: usize,
    /// Their faces, without those of no extent: `M` of Table 1.
    pub faces: usize,
    /// Their volumes' sum, cubed input units. Simplified proxies may overlap; others do not.
    pub volume: f64,
    /// Formula (10), input units: the largest error of a node.
    ///
    /// As printed, ρ = max over vertices sᵢ and directions dⱼ of the cone of normals of sᵢ of
    /// (sᵢ·dⱼ) depends on where the origin is, and names no tribox. We read it as the
    /// Hausdorff distance of two convex bodies, the tribox T and the hull of the part S. sᵢ·dⱼ,
    /// with dⱼ of unit length in the normal cone of sᵢ, is the support function of S. The error
    /// along dⱼ is the excess of T's support function, and the cones of all vertices are all
    /// directions: ρ = max (h_T(d) − h_S(d)).
    ///
    /// It is an upper bound, up to the 2^-40 of the coordinates by which planes are moved, and at
    /// most 1 % too great where the descent converged. Undecided corners count as part of the
    /// solid. Cavities do not count here; they do in [`distance`](Self::distance).
    pub error: f64,
    /// Largest distance from a point of the union's boundary to the mesh, input units.
    pub distance: Farthest,
}

impl Level {
    /// Void beside a solid of this volume, as a part of it. Where components of a solid overlap,
    /// the overlap counts twice.
    #[must_use]
    pub fn void(&self, solid: f64) -> f64 {
        self.volume / solid - 1.0
    }
}

/// The proxies of a level with at most `count` triboxes.
#[must_use]
pub fn proxies(hierarchy: &Hierarchy, count: usize) -> Vec<Tribox> {
    hierarchy.leaves(count).into_iter().map(|node| hierarchy.nodes[node as usize].proxy).collect()
}

/// Measures the level with at most `count` triboxes. `tree` is the mesh's
/// [box tree](crate::bvh::exact_blob).
///
/// Cost: a closest-point query for each triangle of the union's boundary, and some dozens more for
/// the farthest.
#[must_use]
pub fn level(hierarchy: &Hierarchy, count: usize, mesh: &Mesh, tree: &Bvh<'_>) -> Level {
    level_watched(hierarchy, count, mesh, tree, Watch::NONE)
}

/// [`level`] under a watch. If it asks to end, the distance means nothing.
pub(super) fn level_watched(
    hierarchy: &Hierarchy,
    count: usize,
    mesh: &Mesh,
    tree: &Bvh<'_>,
    watch: Watch<'_>,
) -> Level {
    let triboxes = proxies(hierarchy, count);
    let errors =
        hierarchy.leaves(count).into_iter().map(|node| hierarchy.nodes[node as usize].error);
    Level {
        triboxes: triboxes.len(),
        faces: triboxes.iter().map(faces_of).sum(),
        volume: triboxes.iter().map(|tribox| Extent::of(tribox).volume).sum(),
        error: errors.fold(0.0, f64::max),
        distance: distance(&triboxes, mesh, tree, watch),
    }
}

/// Faces of a tribox, without those of no extent.
pub(super) fn faces_of(tribox: &Tribox) -> usize {
    let boundary = tribox.boundary().cleaned();
    (0..FACES).filter(|&face| !boundary.face(face).is_empty()).count()
}

fn distance(triboxes: &[Tribox], mesh: &Mesh, tree: &Bvh<'_>, watch: Watch<'_>) -> Farthest {
    let largest = |most: f64, x: f32| most.max(f64::from(x).abs());
    let size = triboxes
        .iter()
        .flat_map(|tribox| tribox.high.into_iter().chain(tribox.low))
        .fold(0.0, largest);
    let pieces = boundary_of_union(triboxes, margin(size) / 16.0);
    let triangles = pieces
        .iter()
        .flat_map(|piece| piece.windows(2).skip(1).map(|edge| [piece[0], edge[0], edge[1]]));
    let Farthest { lower, upper } =
        farthest(triangles, 0.0, watch.asks(QUERIES, nearest_in(tree, mesh)));
    // Room for the rounding of the pieces, and for missing slivers.
    Farthest { lower: (lower - margin(size)).max(0.0), upper: upper + margin(size) }
}
