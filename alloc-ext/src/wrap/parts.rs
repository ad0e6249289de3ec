//! The parts of a mesh that a hull of their own may have.

use crate::mesh::{Enclosure, Mesh, require_closed_manifold};
use rustc_hash::FxHashMap;

/// Splits a mesh into its connected parts, by shared vertices; what lies inside a closed part stays with it, as cavities do. In the order of their
/// first triangles; `source` refers to what the mesh's refers to.
///
/// Cost: linear, and for each pair of a part and a closed part whose boxes overlap one test of a point.
#[must_use]
pub fn parts(mesh: &Mesh) -> Vec<Mesh> {
    let mut parent: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for &[a, b, c] in &mesh.triangles {
        for v in [b, c] {
            let (p, q) = (root(&mut parent, a), root(&mut parent, v));
            parent[p.max(q) as usize] = p.min(q);
        }
    }
    let roots: Vec<u32> = mesh.triangles.iter().map(|t| root(&mut parent, t[0])).collect();
    let mut number = vec![usize::MAX; mesh.positions.len()];
    let mut loose: Vec<Vec<usize>> = Vec::new();
    for (triangle, &root) in roots.iter().enumerate() {
        let part = &mut number[root as usize];
        if *part == usize::MAX {
            *part = loose.len();
            loose.push(Vec::new());
        }
        loose[*part].push(triangle);
    }
    if loose.len() < 2 {
        return vec![mesh.clone()];
    }
    let closed: Vec<(usize, Enclosure)> = loose
        .iter()
        .enumerate()
        .filter(|(_, part)| bounds_a_volume(&select(mesh, part)))
        .map(|(i, part)| (i, Enclosure::new(part.iter().filter_map(|&t| mesh.corners(t)).collect())))
        .collect();
    let mut grouped: Vec<Vec<usize>> = vec![Vec::new(); loose.len()];
    for (i, part) in loose.iter().enumerate() {
        let witness = part.first().and_then(|&t| mesh.corners(t)).map(|[p, ..]| p);
        let around: Vec<usize> = closed
            .iter()
            .filter(|(j, enclosure)| *j != i && witness.is_some_and(|p| enclosure.holds(p)))
            .map(|(j, _)| *j)
            .collect();
        // The outermost of those around is around the fewest of the others' witnesses, and comes first among equals.
        let home = around.iter().copied().min_by_key(|&j| {
            let p = loose[j].first().and_then(|&t| mesh.corners(t)).map(|[p, ..]| p);
            closed.iter().filter(|(k, e)| *k != j && p.is_some_and(|p| e.holds(p))).count()
        });
        grouped[home.unwrap_or(i)].extend(part);
    }
    grouped
        .into_iter()
        .filter(|part| !part.is_empty())
        .map(|mut part| {
            part.sort_unstable();
            select(mesh, &part)
        })
        .collect()
}

/// A mesh and the further triangles, by their corners, that its hull has to enclose.
pub type Shared = (Mesh, Vec<[[f32; 3]; 3]>);

/// Gives each of further triangles, by their corners, to the first part that has a vertex in the same place. Those that no part has are parts of their own, at the end.
#[must_use]
pub fn share(parts: Vec<Mesh>, further: &[[[f32; 3]; 3]]) -> Vec<Shared> {
    // Both zeros are one place.
    let place = |p: &[f32; 3]| p.map(|x| (x + 0.0).to_bits());
    let mut home: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    for (i, part) in parts.iter().enumerate() {
        for p in &part.positions {
            home.entry(place(p)).or_insert(i);
        }
    }
    let mut shared: Vec<Shared> = parts.into_iter().map(|part| (part, Vec::new())).collect();
    let mut loose = Mesh::default();
    let mut number: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    for corners in further {
        match corners.iter().find_map(|p| home.get(&place(p))) {
            Some(&i) => shared[i].1.push(*corners),
            None => {
                loose.source.push(loose.triangles.len() as u32);
                loose.triangles.push(corners.map(|p| {
                    *number.entry(place(&p)).or_insert_with(|| {
                        loose.positions.push(p);
                        loose.positions.len() as u32 - 1
                    })
                }));
            }
        }
    }
    if !loose.triangles.is_empty() {
        shared.extend(self::parts(&loose).into_iter().map(|part| (part, Vec::new())));
    }
    shared
}

/// Whether a part is closed, cavity or solid: turned inside out, a cavity is a solid.
fn bounds_a_volume(part: &Mesh) -> bool {
    let turned =
        Mesh { triangles: part.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(), ..part.clone() };
    require_closed_manifold(part).is_ok() || require_closed_manifold(&turned).is_ok()
}

fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}

/// Some triangles, and the vertices that they have.
fn select(mesh: &Mesh, triangles: &[usize]) -> Mesh {
    let mut number = vec![u32::MAX; mesh.positions.len()];
    let mut part = Mesh { rounding: mesh.rounding, ..Mesh::default() };
    for &t in triangles {
        part.source.push(mesh.source[t]);
        part.triangles.push(mesh.triangles[t].map(|v| {
            let number = &mut number[v as usize];
            if *number == u32::MAX {
                *number = part.positions.len() as u32;
                part.positions.push(mesh.positions[v as usize]);
            }
            *number
        }));
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron(at: f32, size: f32, inward: bool) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0f32]];
        let positions = positions.map(|p| p.map(|x| x * size + at)).to_vec();
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3u32]];
        let triangles = triangles.map(|[a, b, c]| if inward { [a, c, b] } else { [a, b, c] }).to_vec();
        (positions, triangles)
    }

    #[test]
    fn cavities_and_what_is_in_them_stay_with_their_part() {
        let mut mesh = Mesh::default();
        for (positions, triangles) in [
            tetrahedron(0.0, 10.0, false),
            tetrahedron(20.0, 1.0, false),
            tetrahedron(1.0, 2.0, true),
            tetrahedron(1.1, 1.0, false),
        ] {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(positions);
            mesh.triangles.extend(triangles.into_iter().map(|t| t.map(|v| v + first)));
        }
        mesh.source = (0..mesh.triangles.len() as u32).collect();
        let parts = parts(&mesh);
        let sources: Vec<_> = parts.iter().map(|p| p.source.clone()).collect();
        assert_eq!(sources, [vec![0, 1, 2, 3, 8, 9, 10, 11, 12, 13, 14, 15], vec![4, 5, 6, 7]]);
        assert!(parts.iter().all(|p| p.positions.len() == p.triangles.len()));
    }
}
