//! Parents and radii of all triangle instances.

use crate::collapse::History;
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;

/// Parent of an instance of the base hull.
pub const NO_PARENT: u32 = u32::MAX;

/// The forest over all triangle instances of a [`History`].
#[derive(Clone, Debug)]
pub struct Forest {
    /// Coarse instance that each instance was assigned to.
    pub parent: Vec<u32>,
    /// Radius of each instance, local frame, before it is rounded for storage; infinite for an
    /// instance that covers nothing.
    pub radius: Vec<f64>,
    /// Original vertices below each instance of the base hull, in the order of
    /// `History::base_instances`.
    pub base_vertices: Vec<Vec<u32>>,
}

/// Largest distance from any of `vertices` to the triangle, an upper bound in real arithmetic.
pub fn cover_radius(positions: &[DVec3], vertices: &[u32], [a, b, c]: [DVec3; 3]) -> f64 {
    vertices.iter().map(|&v| positions[v as usize]).fold(0f64, |r, p| {
        // A corner is at distance zero, and stays there without a rounding margin.
        if p == a || p == b || p == c { r } else { r.max(point_triangle(p, a, b, c).upper) }
    })
}

/// Replays the collapses fine to coarse and assigns every fine triangle to the coarse one that
/// covers it most tightly.
///
/// Cost: per collapse, vertices below the fragment times a few candidates.
pub fn grow(history: &History) -> Forest {
    let count = history.instances();
    let mut parent = vec![NO_PARENT; count];
    let mut radius = vec![f64::INFINITY; count];
    let mut below: Vec<Vec<u32>> = history.original_triangles.iter().map(|t| t.to_vec()).collect();
    below.resize(count, Vec::new());
    radius[..history.original_triangles.len()].fill(0.0);

    let mut corners = Vec::new();
    for (index, collapse) in history.collapses.iter().enumerate() {
        let first = history.first_coarse(index);
        corners.clear();
        corners.extend((0..collapse.ring_len as usize).map(|i| {
            history.coarse_corners(collapse, i).map(|label| history.positions[label as usize])
        }));
        for (slot, &instance) in history.fine(index).iter().enumerate() {
            let vertices = std::mem::take(&mut below[instance as usize]);
            if vertices.is_empty() {
                continue;
            }
            let natural = natural_parent(slot, collapse.ring_len as usize, collapse.right as usize);
            let best = tightest(history, &vertices, &corners, natural);
            let adopted = first as usize + best;
            parent[instance as usize] = adopted as u32;
            merge(&mut below[adopted], vertices);
        }
        for (i, &triangle) in corners.iter().enumerate() {
            let coarse = first as usize + i;
            if !below[coarse].is_empty() {
                radius[coarse] = cover_radius(&history.positions, &below[coarse], triangle);
            }
        }
    }
    let base_vertices =
        history.base_instances.iter().map(|&i| std::mem::take(&mut below[i as usize])).collect();
    Forest { parent, radius, base_vertices }
}

/// The coarse triangle at the same ring edge; for the two that vanish, one beside them.
fn natural_parent(slot: usize, ring: usize, right: usize) -> usize {
    if slot < ring {
        slot
    } else if slot == ring {
        right
    } else {
        0
    }
}

/// The coarse triangle with the least largest distance to `vertices`; ties to the natural one, then
/// the first.
fn tightest(history: &History, vertices: &[u32], corners: &[[DVec3; 3]], natural: usize) -> usize {
    let mut best = natural;
    let mut best_sq = f64::INFINITY;
    let others = (0..corners.len()).filter(|&i| i != natural);
    for candidate in std::iter::once(natural).chain(others) {
        let [a, b, c] = corners[candidate];
        let mut worst = 0f64;
        for &v in vertices {
            worst = worst.max(point_triangle(history.positions[v as usize], a, b, c).distance_sq);
            if worst >= best_sq {
                break;
            }
        }
        if worst < best_sq {
            best_sq = worst;
            best = candidate;
        }
    }
    best
}

/// Union of vertex lists, without duplicates.
fn merge(into: &mut Vec<u32>, mut other: Vec<u32>) {
    if into.len() < other.len() {
        std::mem::swap(into, &mut other);
    }
    into.extend(other);
    if into.len() > 8 {
        into.sort_unstable();
        into.dedup();
    }
}
