//! Non-manifold vertices: where several triangle fans meet in one vertex, each gets its own copy.

use super::edges::{EdgeTable, UnionFind, ends};

/// Two corners at a vertex belong to one fan if a chain of shared edges joins them. Edges with more
/// than two triangles join all of theirs: splitting there would need a choice of who is whose
/// neighbour.
///
/// Returns for each corner (3 × triangle + k) its fan, named by the fan's first corner.
pub(super) fn fans(triangles: &[[u32; 3]], edges: &EdgeTable) -> Vec<u32> {
    let mut sets = UnionFind::new(3 * triangles.len());
    for edge in edges.edges() {
        let Some(((_, first), others)) = edge.split_first() else { continue };
        let [a, b] = corners_at(triangles, *first);
        for (_, other) in others {
            let [c, d] = corners_at(triangles, *other);
            sets.join(a, c);
            sets.join(b, d);
        }
    }
    (0..3 * triangles.len() as u32).map(|corner| sets.find(corner)).collect()
}

/// The corners at the lower and the higher vertex of a half-edge.
fn corners_at(triangles: &[[u32; 3]], half_edge: u32) -> [u32; 2] {
    let next = half_edge - half_edge % 3 + (half_edge + 1) % 3;
    let [from, to] = ends(triangles, half_edge);
    if from < to { [half_edge, next] } else { [next, half_edge] }
}

/// Gives each fan beyond the first at a vertex a new vertex. Returns for each new vertex the one
/// that it copies; they are numbered from `vertex_count`.
pub(super) fn split(vertex_count: usize, triangles: &mut [[u32; 3]], fans: &[u32]) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut first_fan = vec![NONE; vertex_count];
    let mut vertex_of_fan = vec![NONE; fans.len()];
    let mut copies = Vec::new();
    for (corner, &fan) in fans.iter().enumerate() {
        let vertex = &mut triangles[corner / 3][corner % 3];
        let first = &mut first_fan[*vertex as usize];
        if *first == NONE {
            *first = fan;
        }
        if *first == fan {
            continue;
        }
        let copy = &mut vertex_of_fan[fan as usize];
        if *copy == NONE {
            *copy = (vertex_count + copies.len()) as u32;
            copies.push(*vertex);
        }
        *vertex = *copy;
    }
    copies
}
