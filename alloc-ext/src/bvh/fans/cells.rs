//! Cells: groups of triangles that lie together. No leaf reaches out of its cell.
//!
//! A fan says nothing of how far its triangles reach. A long triangle of a plane and those of a
//! bore's wall share an edge, and the box of both is as large as the plane and as deep as the bore.
//! So triangles are first divided as the nodes above them will be: from the top, by the surface
//! area heuristic, until a cell has few enough.

use super::super::nodes::order::EXTENT_WEIGHT;
use super::super::nodes::sah::runs;
use glam::DVec3;

/// The triangles of each cell of at most `most`, in ascending order.
pub(super) fn cells(triangles: &[[u32; 3]], positions: &[DVec3], most: usize) -> Vec<Vec<u32>> {
    if triangles.is_empty() {
        return Vec::new();
    }
    if triangles.len() <= most {
        return vec![(0..triangles.len() as u32).collect()];
    }
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
