//! The triangles of a soup that are in no leaf yet.

use super::adjacency::{Adjacency, NONE};

/// Set in a triangle's entry once it is in a leaf.
const TAKEN: u8 = 1 << 7;

/// For each triangle its number of remaining neighbours, up to 3, and whether it is taken.
#[derive(Debug)]
pub(super) struct Remaining(Vec<u8>);

impl Remaining {
    /// All triangles.
    pub(super) fn new(adjacency: &Adjacency) -> Self {
        let degree = |t: u32| {
            (3 * t..3 * t + 3).filter(|&half_edge| adjacency.across(half_edge) != NONE).count()
        };
        Self((0..adjacency.triangles().len() as u32).map(|t| degree(t) as u8).collect())
    }

    pub(super) fn has(&self, triangle: u32) -> bool {
        self.0[triangle as usize] & TAKEN == 0
    }

    /// Edges of a triangle beyond which another one remains.
    pub(super) fn degree(&self, triangle: u32) -> usize {
        usize::from(self.0[triangle as usize] & !TAKEN)
    }

    pub(super) fn take(&mut self, adjacency: &Adjacency, triangle: u32) {
        self.0[triangle as usize] |= TAKEN;
        for neighbour in neighbours(adjacency, triangle) {
            self.0[neighbour as usize] -= 1;
        }
    }
}

/// The triangles across the edges of one, as often as there are edges.
pub(super) fn neighbours(adjacency: &Adjacency, triangle: u32) -> impl Iterator<Item = u32> {
    (3 * triangle..3 * triangle + 3)
        .map(|half_edge| adjacency.across(half_edge))
        .filter(|&across| across != NONE)
        .map(|across| across / 3)
}
