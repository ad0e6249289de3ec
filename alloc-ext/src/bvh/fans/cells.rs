//! Cells: groups of triangles that lie together. No leaf reaches from one into another.
//!
//! A vertex of a fan says nothing of how far its triangles reach. A long triangle of a plane and
//! those of a bore's wall share an edge, and the box of both is as large as the plane and as deep
//! as the bore. So triangles are first divided as the nodes above them will be: from the top, by
//! the surface area heuristic, until a cell has few enough.

use super::super::nodes::order::EXTENT_WEIGHT;
use super::super::nodes::sah::runs;
use glam::DVec3;

/// Which triangles may share a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::bvh) enum Cells {
    /// All that share an edge.
    Whole,
    /// Those of one subtree of at most so many triangles.
    OfAtMost(usize),
}

impl Cells {
    /// Cells for a mesh of so many triangles: a small mesh gains from small ones.
    pub(in crate::bvh) const fn for_mesh(triangles: usize) -> Self {
        Self::OfAtMost(if triangles < 4096 { 64 } else { 128 })
    }

    /// The triangles of each cell, in ascending order.
    pub(super) fn of(self, triangles: &[[u32; 3]], positions: &[DVec3]) -> Vec<Vec<u32>> {
        let most = match self {
            Self::OfAtMost(most) if most < triangles.len() => most,
            _ if triangles.is_empty() => return Vec::new(),
            _ => return vec![(0..triangles.len() as u32).collect()],
        };
        let bounds: Vec<(DVec3, DVec3)> = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|v| positions[v as usize]);
                (a.min(b).min(c), a.max(b).max(c))
            })
            .collect();
        let mut cells = runs(&bounds, EXTENT_WEIGHT, most);
        cells.iter_mut().for_each(|cell| cell.sort_unstable());
        cells
    }
}
