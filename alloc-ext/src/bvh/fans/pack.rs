//! Greedy packing of a soup into leaves.

use super::adjacency::Adjacency;
use super::best_leaf::LeafSearch;
use super::front::Front;
use super::remaining::Remaining;
use super::speculation::Speculation;
use super::{Effort, FanLeaf, MAX_LEAF_TRIANGLES};
use crate::error::BuildError;
use crate::progress::Watch;
use crate::surface::EdgeTable;
use glam::DVec3;

/// Leaves between two calls of progress.
const LEAVES: usize = 256;

/// Packs a soup into leaves of the box tree. Every triangle is in exactly one leaf.
///
/// The paper's rule, with the leaf in place of the fan: the front starts at the boundary edges and
/// moves inwards. The next seed is the remaining triangle with the fewest remaining neighbours; of
/// equals, the oldest entry of the queue. In a window of 32 triangles about the seed, every run
/// that contains the seed is scored, alone and with each longest second run that joins it. A low
/// effort looks at fewer. The score counts the leaf's triangles, its edges to remaining triangles,
/// the triangles that it cuts off, and its box. The best candidate becomes the next leaf.
///
/// Triangles from different edge-connected components never share a leaf. Of three triangles on an
/// edge, two are neighbours.
///
/// The same input gives the same leaves, on any number of threads.
///
/// Cost: linear time and memory, about 10 µs a leaf, for any valences.
///
/// # Errors
/// [`BuildError::Cancelled`].
///
/// # Panics
/// If a triangle names a vertex that has no position, or if there are 2³²/3 triangles or more.
pub(in crate::bvh) fn pack(
    triangles: &[[u32; 3]],
    edges: &EdgeTable,
    positions: &[DVec3],
    effort: Effort,
    watch: Watch<'_>,
) -> Result<Vec<FanLeaf>, BuildError> {
    let adjacency = Adjacency::new(triangles, edges);
    let mut remaining = Remaining::new(&adjacency);
    let mut search = LeafSearch::new(&adjacency, positions, effort);
    let mut speculation = Speculation::new(&adjacency, positions, effort);
    let mut front = Front::default();
    for triangle in 0..triangles.len() as u32 {
        front.push(triangle, remaining.degree(triangle));
    }
    let mut leaves = Vec::with_capacity(triangles.len() / MAX_LEAF_TRIANGLES);
    let mut packed = 0;
    while let Some(degree) = front.lowest(&remaining) {
        speculation.prefetch(&front, degree, &remaining, &leaves);
        let Some(seed) = front.pop(&remaining) else { break };
        let leaf = speculation
            .take_if_current(seed, &remaining)
            .unwrap_or_else(|| search.best_leaf(&remaining, seed));
        front.take(&leaf, &adjacency, &mut remaining);
        packed += leaf.triangle_count();
        leaves.push(leaf);
        if leaves.len().is_multiple_of(LEAVES) {
            watch.step(packed, triangles.len())?;
        }
    }
    Ok(leaves)
}
