//! Radii of all triangle instances.

use crate::collapse::History;
use crate::error::BuildError;
use crate::progress::Watch;
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;
use meshsweep_core::internal::hull::format::layout::BASE_GROUP;

/// The forest over all triangle instances of a [`History`].
#[derive(Clone, Debug)]
pub struct Forest {
    /// Radius of each instance, local frame, before it is rounded for storage. Infinite where it
    /// stands for no part of the surface.
    pub radius: Vec<f64>,
    /// For each collapse, whether the fine triangle at the right and at the left wing is a child of
    /// the coarse triangle before the wing, and not of the one after it.
    pub wings: Vec<[bool; 2]>,
    /// Vertices of the surface below each instance of the base hull, in the order of
    /// `History::base_instances`.
    pub base_vertices: Vec<Vec<u32>>,
    /// Queue entries that a depth-first sweep may need.
    pub queue_entries: u32,
}

/// Largest distance from any of `vertices` to the triangle, an upper bound in real arithmetic.
pub fn cover_radius(positions: &[DVec3], vertices: &[u32], [a, b, c]: [DVec3; 3]) -> f64 {
    vertices.iter().map(|&v| positions[v as usize]).fold(0f64, |r, p| {
        // A corner is at distance zero, and stays there without a rounding margin.
        if p == a || p == b || p == c { r } else { r.max(point_triangle(p, a, b, c).upper) }
    })
}

/// Collapses between two calls of progress. A coarse one takes as long as a thousand fine ones.
const COLLAPSES: usize = 64;

/// Replays the collapses fine to coarse. A fine triangle at a ring edge is a child of the coarse
/// one at the same edge. Each of the two at the wings is a child of one of the coarse two beside
/// it: of the one that covers it more tightly. Triangles that stand for no part of the surface
/// rather join each other.
///
/// `cover` gets each coarse instance, the original vertices of its part, and its corners: labels.
///
/// Cost: linear in the vertices below each fragment.
///
/// # Errors
/// [`BuildError::Cancelled`].
pub fn grow(
    history: &History,
    mut cover: impl FnMut(u32, &[u32], [u32; 3]),
    watch: Watch<'_>,
) -> Result<Forest, BuildError> {
    let count = history.instances();
    let mut radius = vec![0.0; count];
    // A triangle that closes a hole stands for no part of the surface.
    radius[history.surface_triangles..history.original_triangles.len()].fill(f64::INFINITY);
    let mut waiting = vec![0u32; count];
    let mut wings = Vec::with_capacity(history.collapses.len());
    let mut below: Vec<Vec<u32>> = history.original_triangles[..history.surface_triangles]
        .iter()
        .map(|t| t.to_vec())
        .collect();
    below.resize(count, Vec::new());
    for (index, collapse) in history.collapses.iter().enumerate() {
        if index.is_multiple_of(COLLAPSES) {
            watch.step(index, history.collapses.len())?;
        }
        let first = history.first_coarse(index) as usize;
        let ring_len = collapse.ring_len as usize;
        let fine = history.fine(index);
        let at = |i: usize| {
            history.coarse_corners(collapse, i).map(|label| history.positions[label as usize])
        };
        let mut children: Vec<Vec<u32>> = fine[..ring_len].iter().map(|&f| vec![f]).collect();
        let right = collapse.right as usize;
        let before = [(right, right - 1), (0, ring_len - 1)].map(|(after, before)| {
            let vertices = &below[fine[ring_len + usize::from(after == 0)] as usize];
            let joins_part = |i: usize| {
                let is_partless = below[fine[i] as usize].is_empty();
                let reach = cover_radius(&history.positions, vertices, at(i));
                (is_partless != vertices.is_empty(), reach)
            };
            joins_part(before) < joins_part(after)
        });
        wings.push(before);
        children[if before[0] { right - 1 } else { right }].push(fine[ring_len]);
        children[if before[1] { ring_len - 1 } else { 0 }].push(fine[ring_len + 1]);
        for (i, children) in children.into_iter().enumerate() {
            let coarse = first + i;
            let waits = entries(children.iter().map(|&child| waiting[child as usize])).max(1);
            for child in children {
                let vertices = std::mem::take(&mut below[child as usize]);
                merge(&mut below[coarse], vertices);
            }
            if below[coarse].is_empty() {
                radius[coarse] = f64::INFINITY;
            } else {
                radius[coarse] = cover_radius(&history.positions, &below[coarse], at(i));
                cover(coarse as u32, &below[coarse], history.coarse_corners(collapse, i));
                waiting[coarse] = waits;
            }
        }
    }
    let base_vertices =
        history.base_instances.iter().map(|&i| std::mem::take(&mut below[i as usize])).collect();
    let group = |instances: &[u32]| entries(instances.iter().map(|&i| waiting[i as usize]));
    let groups = history.base_instances.chunks(BASE_GROUP as usize).map(group);
    let queue_entries = entries(groups.map(|group| group.max(1))).max(1);
    Ok(Forest { radius, wings, base_vertices, queue_entries })
}

/// Queue entries that a depth-first sweep of triangles needs which enter the queue together, from
/// the needs of each. An instance of the surface does not enter, and needs 0.
///
/// The first that is opened leaves the queue, and its siblings wait.
fn entries(needs: impl Iterator<Item = u32>) -> u32 {
    let (mut count, mut most) = (0u32, 0);
    for need in needs.filter(|&need| need > 0) {
        count += 1;
        most = most.max(need);
    }
    (count + most).saturating_sub(1).max(count)
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
