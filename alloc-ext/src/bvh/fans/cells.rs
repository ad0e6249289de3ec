//! Cells: groups of triangles that lie together. No leaf reaches out of its cell.
//!
//! A fan says nothing of how far its triangles reach. A long triangle of a plane and those of a
//! bore's wall share an edge, and the box of both is as large as the plane and as deep as the bore.
//! So triangles are first divided as the nodes above them will be: from the top, by the surface
//! area heuristic, until a cell has few enough. The top of a large mesh is cut between bins.

use super::super::nodes::blocks::Blocks;
use super::super::nodes::order::EXTENT_WEIGHT;
use super::super::nodes::sah::{Bounds, runs};
use super::LARGE;
use glam::DVec3;
use rayon::prelude::*;

/// Triangles above which a run is cut between bins, in a mesh that is not large. Queries do the
/// same work as with a sweep of all.
const BLOCK: usize = 1 << 15;

/// The triangles of each cell of at most `most`, in ascending order.
pub(super) fn cells(triangles: &[[u32; 3]], positions: &[DVec3], most: usize) -> Vec<Vec<u32>> {
    if triangles.is_empty() {
        return Vec::new();
    }
    let mut all: Vec<u32> = (0..triangles.len() as u32).collect();
    if triangles.len() <= most {
        return vec![all];
    }
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        Bounds::of((a.min(b).min(c), a.max(b).max(c)))
    };
    let bounds: Vec<Bounds> = triangles.par_iter().map(of).collect();
    let extent_weight = EXTENT_WEIGHT * diagonal(positions) as f32;
    let block = if triangles.len() > LARGE { most } else { BLOCK.max(most) };
    let blocks = Blocks { bounds: &bounds, extent_weight, most: block };
    blocks.flat_map(&mut all, &|block: &[u32]| {
        let bounds = block.iter().map(|&t| bounds[t as usize]).collect();
        let mut cells = runs(bounds, EXTENT_WEIGHT, most);
        for cell in &mut cells {
            cell.iter_mut().for_each(|at| *at = block[*at as usize]);
            cell.sort_unstable();
        }
        cells
    })
}

fn diagonal(positions: &[DVec3]) -> f64 {
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = positions.iter().fold(nothing, |(l, h), &p| (l.min(p), h.max(p)));
    (high - low).length()
}
