//! Boundary edges, grouped into holes.

use super::collinear::collinear;
use super::edges::{BOUNDARY, UnionFind, ends};

/// The boundary of a mesh.
pub(super) struct Boundary {
    /// Half-edges without a twin.
    pub edge_count: usize,
    /// A half-edge of each hole: slits first, for they are the least visible, then from the largest
    /// hole to the smallest.
    pub of_holes: Vec<u32>,
    /// Edges of the largest hole.
    pub largest: usize,
    /// Holes whose vertices all lie on one line.
    pub slit_count: usize,
}

/// Boundary edges that share a vertex belong to one hole.
pub(super) fn boundary(positions: &[[f32; 3]], triangles: &[[u32; 3]], twins: &[u32]) -> Boundary {
    let half_edges: Vec<u32> =
        (0..twins.len() as u32).filter(|&h| twins[h as usize] == BOUNDARY).collect();
    if half_edges.is_empty() {
        return Boundary { edge_count: 0, of_holes: Vec::new(), largest: 0, slit_count: 0 };
    }
    let mut sets = UnionFind::new(positions.len());
    for &h in &half_edges {
        let [from, to] = ends(triangles, h);
        sets.join(from, to);
    }
    let mut by_hole: Vec<(u32, u32)> =
        half_edges.iter().map(|&h| (sets.find(ends(triangles, h)[0]), h)).collect();
    by_hole.sort_unstable();
    let mut holes: Vec<(bool, usize, u32)> = by_hole
        .chunk_by(|a, b| a.0 == b.0)
        .map(|hole| (is_slit(positions, triangles, hole), hole.len(), hole[0].1))
        .collect();
    // Stable, so that holes of one size stay in the order of their vertices.
    holes.sort_by_key(|&(slit, edge_count, _)| std::cmp::Reverse((slit, edge_count)));
    Boundary {
        edge_count: half_edges.len(),
        of_holes: holes.iter().map(|&(.., half_edge)| half_edge).collect(),
        largest: holes.iter().map(|&(_, edge_count, _)| edge_count).max().unwrap_or(0),
        slit_count: holes.iter().filter(|&&(slit, ..)| slit).count(),
    }
}

fn is_slit(positions: &[[f32; 3]], triangles: &[[u32; 3]], hole: &[(u32, u32)]) -> bool {
    let Some(&(_, first)) = hole.first() else { return false };
    let [a, b] = ends(triangles, first).map(|v| positions[v as usize]);
    hole.iter()
        .all(|&(_, h)| ends(triangles, h).iter().all(|&v| collinear(a, b, positions[v as usize])))
}
