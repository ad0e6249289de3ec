//! The parts of a mesh that a hull of their own may have.

use crate::mesh::{Enclosure, Mesh, require_closed_manifold};
use crate::tight::proof::boxes::{Bounds, BoxTree};
use crate::tight::proof::connected::connected;
use glam::Vec3;
use rustc_hash::FxHashMap;

/// Splits a mesh into its connected parts, by shared vertices; what lies inside a closed part stays
/// with it, as cavities do. In the order of their first triangles; wires are in none. `source` refers to what the
/// mesh's refers to.
///
/// Cost: n log n, and one test of a point for each part and each closed part whose box holds that
/// point.
#[must_use]
pub fn parts(mesh: &Mesh) -> Vec<Mesh> {
    let least = connected(mesh.positions.len(), &mesh.triangles);
    let mut number = vec![usize::MAX; mesh.positions.len()];
    let mut loose: Vec<Vec<usize>> = Vec::new();
    for (triangle, &[a, ..]) in mesh.triangles.iter().enumerate() {
        let part = &mut number[least[a as usize] as usize];
        if *part == usize::MAX {
            *part = loose.len();
            loose.push(Vec::new());
        }
        loose[*part].push(triangle);
    }
    if loose.len() < 2 {
        return if loose.is_empty() { Vec::new() } else { vec![mesh.without_wires()] };
    }
    let mut select = Selection::of(mesh);
    let closed: Vec<(usize, Enclosure)> = loose
        .iter()
        .enumerate()
        .filter(|(_, part)| bounds_a_volume(&select.take(part)))
        .map(|(i, part)| {
            (i, Enclosure::new(part.iter().filter_map(|&t| mesh.corners(t)).collect()))
        })
        .collect();
    let around = around(mesh, &loose, &closed);
    let mut grouped: Vec<Vec<usize>> = vec![Vec::new(); loose.len()];
    for (i, part) in loose.iter().enumerate() {
        // The outermost of those around has the fewest around itself, and comes first among equals.
        let home = around[i].iter().copied().min_by_key(|&j| around[j].len());
        grouped[home.unwrap_or(i)].extend(part);
    }
    grouped
        .into_iter()
        .filter(|part| !part.is_empty())
        .map(|mut part| {
            part.sort_unstable();
            select.take(&part)
        })
        .collect()
}

/// For each part the closed ones that hold its first vertex, in order.
fn around(mesh: &Mesh, loose: &[Vec<usize>], closed: &[(usize, Enclosure)]) -> Vec<Vec<usize>> {
    let boxes: Vec<Bounds> =
        closed.iter().map(|(_, enclosure)| Bounds::around(enclosure)).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let around = |(i, part): (usize, &Vec<usize>)| {
        let mut found = Vec::new();
        if let Some([witness, ..]) = part.first().and_then(|&t| mesh.corners(t)) {
            let at = Bounds::of(&[Vec3::from(witness).as_dvec3()]);
            tree.visit(
                |of| of.meets(&at),
                |item| {
                    let (j, enclosure) = &closed[order[item] as usize];
                    if *j != i && enclosure.holds(witness) {
                        found.push(*j);
                    }
                    true
                },
            );
        }
        found.sort_unstable();
        found
    };
    loose.iter().enumerate().map(around).collect()
}

/// A mesh and the further triangles, by their corners, that its hull has to enclose.
pub type Shared = (Mesh, Vec<[[f32; 3]; 3]>);

/// Gives each of further triangles, by their corners, to the first part that has a vertex in the
/// same place. Those that no part has are parts of their own, at the end.
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
    let turned = Mesh {
        triangles: part.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
        ..part.clone()
    };
    require_closed_manifold(part).is_ok() || require_closed_manifold(&turned).is_ok()
}

/// Takes parts out of a mesh in time that does not depend on how many there are.
struct Selection<'a> {
    mesh: &'a Mesh,
    /// Per vertex of the mesh its number in the part that is being taken, and `u32::MAX`
    /// otherwise.
    number: Vec<u32>,
}

impl<'a> Selection<'a> {
    fn of(mesh: &'a Mesh) -> Self {
        Self { mesh, number: vec![u32::MAX; mesh.positions.len()] }
    }

    /// Some triangles, and the vertices that they have.
    fn take(&mut self, triangles: &[usize]) -> Mesh {
        let Self { mesh, number } = self;
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
        triangles
            .iter()
            .flat_map(|&t| mesh.triangles[t])
            .for_each(|v| number[v as usize] = u32::MAX);
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron(at: f32, size: f32, inward: bool) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0f32]];
        let positions = positions.map(|p| p.map(|x| x * size + at)).to_vec();
        let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3u32]];
        let triangles =
            triangles.map(|[a, b, c]| if inward { [a, c, b] } else { [a, b, c] }).to_vec();
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
