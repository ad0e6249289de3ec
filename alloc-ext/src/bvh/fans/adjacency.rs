//! Which triangle lies across which edge, for any triangle soup.
//!
//! Half-edge `3t + k` runs from corner `k` of triangle `t` to the next corner. Corner `3t + k` is
//! its start.

use crate::surface::{EdgeTable, ends};
use std::cmp::Ordering;

/// No half-edge, no corner.
pub(super) const NONE: u32 = u32::MAX;

/// A soup with its edges paired.
pub(super) struct Adjacency<'a> {
    triangles: &'a [[u32; 3]],
    across: Vec<u32>,
}

impl<'a> Adjacency<'a> {
    /// Pairs the half-edges of each edge: first those of opposite directions, in ascending order,
    /// then the rest of one direction. A half-edge left over has no partner. So each half-edge has
    /// at most one neighbour. An edge from a vertex to itself stays unpaired, and no triangle is
    /// its own neighbour.
    ///
    /// # Panics
    /// If the edges are not those of the triangles, or if half-edges do not fit in 32 bits.
    pub(super) fn new(triangles: &'a [[u32; 3]], edges: &EdgeTable) -> Self {
        assert!(triangles.len() < (u32::MAX / 3) as usize, "half-edges are numbered in 32 bits");
        let mut across = vec![NONE; 3 * triangles.len()];
        let mut pair = |g: u32, h: u32| {
            if g / 3 != h / 3 {
                across[g as usize] = h;
                across[h as usize] = g;
            }
        };
        let (mut up, mut down) = (Vec::new(), Vec::new());
        for edge in edges.edges() {
            up.clear();
            down.clear();
            for &(_, half_edge) in edge {
                let [from, to] = ends(triangles, half_edge);
                match from.cmp(&to) {
                    Ordering::Less => up.push(half_edge),
                    Ordering::Greater => down.push(half_edge),
                    Ordering::Equal => {} // A loop gets no partner.
                }
            }
            let both = up.len().min(down.len());
            up.iter().zip(&down).for_each(|(&g, &h)| pair(g, h));
            for rest in [&up[both..], &down[both..]] {
                rest.chunks_exact(2).for_each(|two| pair(two[0], two[1]));
            }
        }
        Self { triangles, across }
    }

    /// The corners' vertices of each triangle.
    pub(super) fn triangles(&self) -> &'a [[u32; 3]] {
        self.triangles
    }

    /// The vertex of a corner.
    pub(super) fn vertex(&self, corner: u32) -> u32 {
        self.triangles[corner as usize / 3][corner as usize % 3]
    }

    /// The half-edge paired with `half_edge`, whichever way it runs, or [`NONE`].
    pub(super) fn across(&self, half_edge: u32) -> u32 {
        self.across[half_edge as usize]
    }

    /// The half-edge paired with `half_edge` if it runs the other way, as in a consistently wound
    /// mesh, or [`NONE`].
    pub(super) fn opposite(&self, half_edge: u32) -> u32 {
        let across = self.across(half_edge);
        if across != NONE && self.vertex(across) == self.vertex(half_edge) { NONE } else { across }
    }
}

/// The half-edge after `half_edge` in its triangle.
pub(super) const fn following(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 { half_edge - 2 } else { half_edge + 1 }
}
