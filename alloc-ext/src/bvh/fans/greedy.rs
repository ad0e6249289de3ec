//! Greedy packing of one cell into leaves.

use super::adjacency::Adjacency;
use super::best_leaf::LeafSearch;
use super::front::Front;
use super::remaining::Remaining;
use super::soup::Soup;
use super::{Effort, FanLeaf, MAX_LEAF_TRIANGLES};
use crate::surface::EdgeTable;

/// The leaves of a soup, with its own numbers.
///
/// The paper's rule, with the leaf in place of the fan: the front starts at the boundary edges and
/// moves inwards. The next seed is the remaining triangle with the fewest remaining neighbours; of
/// equals, the oldest entry of the queue. In a window of 32 triangles about the seed, every run
/// that contains the seed is scored, alone and with each longest second run that joins it. A low
/// effort looks at fewer. The score counts the leaf's triangles, its edges to remaining triangles,
/// the triangles that it cuts off, and its box. The best candidate becomes the next leaf.
///
/// Cost: linear time and memory, about 10 µs a leaf, for any valences.
pub(super) fn greedy(soup: &Soup, effort: Effort) -> Vec<FanLeaf> {
    let Soup { triangles, positions, .. } = soup;
    let adjacency = Adjacency::new(triangles, &EdgeTable::new(positions.len(), triangles));
    let mut remaining = Remaining::new(&adjacency);
    let mut search = LeafSearch::new(&adjacency, positions, effort);
    let mut front = Front::default();
    for triangle in 0..triangles.len() as u32 {
        front.push(triangle, remaining.degree(triangle));
    }
    let mut leaves = Vec::with_capacity(triangles.len() / MAX_LEAF_TRIANGLES + 1);
    while let Some(seed) = front.pop(&remaining) {
        let leaf = search.best_leaf(&remaining, seed);
        front.take(&leaf, &adjacency, &mut remaining);
        leaves.push(leaf);
    }
    leaves
}
