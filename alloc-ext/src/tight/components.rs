//! Splits a mesh into the components that get a hull each.

use crate::bvh::MAX_TRIANGLES;
use crate::error::BuildError;
use crate::geom::Enclosures;
use crate::mesh::{Mesh, Wire, require_closed_manifold};
use crate::surface::{components, require_valid};
use rustc_hash::FxHashMap;

/// Splits a mesh into its connected components, by shared vertices. Everything inside a closed
/// component stays with it, as cavities do. A wire goes to the first component that has a vertex at
/// one of its ends. In the order of their first triangles, then wires that no component has.
///
/// Cost: n log n, and one point test for each component and each closed component whose box holds
/// that point.
///
/// # Errors
/// Those of [`wrap`](super::wrap()) on a mesh that [`repair`](crate::mesh::repair) did not make.
pub fn split_components(mesh: &Mesh) -> Result<Vec<Mesh>, BuildError> {
    require_valid(mesh, MAX_TRIANGLES)?;
    let parts = triangle_parts(mesh);
    Ok(if mesh.wires.is_empty() { parts } else { distribute(mesh, parts) })
}

fn triangle_parts(mesh: &Mesh) -> Vec<Mesh> {
    let all = components(mesh.positions.len(), &mesh.triangles);
    if all.len() < 2 {
        return all.iter().map(|_| mesh.without_wires()).collect();
    }
    let mut select = Selection::of(mesh);
    let closed: Vec<usize> =
        (0..all.len()).filter(|&i| bounds_a_volume(&select.take(&all[i]))).collect();
    let corners = |i: usize| all[i].iter().filter_map(|&t| mesh.corners(t as usize));
    let enclosures = Enclosures::new(closed.iter().map(|&i| corners(i).collect()));
    // For each component the closed components that hold its first corner.
    let around = |i: usize| -> Vec<usize> {
        let but = closed.binary_search(&i).ok();
        let found =
            corners(i).next().map(|[witness, ..]| enclosures.around(witness.map(f64::from), but));
        found.into_iter().flatten().map(|j| closed[j]).collect()
    };
    let around: Vec<Vec<usize>> = (0..all.len()).map(around).collect();
    let mut grouped: Vec<Vec<u32>> = vec![Vec::new(); all.len()];
    for (i, component) in all.iter().enumerate() {
        // The outermost component around it has the fewest around itself, and the least number.
        let home = around[i].iter().copied().min_by_key(|&j| around[j].len());
        grouped[home.unwrap_or(i)].extend(component);
    }
    grouped
        .into_iter()
        .filter(|group| !group.is_empty())
        .map(|mut group| {
            group.sort_unstable();
            select.take(&group)
        })
        .collect()
}

/// Whether a component is closed: a solid, or a cavity. A cavity turned inside out is a solid.
fn bounds_a_volume(component: &Mesh) -> bool {
    let turned = Mesh {
        triangles: component.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
        ..component.clone()
    };
    require_closed_manifold(component).is_ok() || require_closed_manifold(&turned).is_ok()
}

/// Adds the mesh's wires to its parts.
fn distribute(mesh: &Mesh, mut parts: Vec<Mesh>) -> Vec<Mesh> {
    let mut home: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    for (i, part) in parts.iter().enumerate() {
        for &p in &part.positions {
            home.entry(place(p)).or_insert(i);
        }
    }
    let at = |v: u32| place(mesh.positions[v as usize]);
    let mut wires: Vec<Vec<Wire>> = vec![Vec::new(); parts.len()];
    let mut loose: Vec<Wire> = Vec::new();
    for wire in &mesh.wires {
        match wire.ends.iter().find_map(|&v| home.get(&at(v))) {
            Some(&i) => wires[i].push(*wire),
            None => loose.push(*wire),
        }
    }
    let triangles: Vec<[u32; 3]> = loose.iter().map(Wire::triangle).collect();
    for component in components(mesh.positions.len(), &triangles) {
        parts.push(Mesh { rounding: mesh.rounding, ..Mesh::default() });
        wires.push(component.into_iter().map(|i| loose[i as usize]).collect());
    }
    for (part, wires) in parts.iter_mut().zip(&wires).filter(|(_, wires)| !wires.is_empty()) {
        add_wires(part, mesh, wires);
    }
    parts
}

/// Adds wires of a mesh to a part of it.
fn add_wires(part: &mut Mesh, mesh: &Mesh, wires: &[Wire]) {
    let mut number: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    for (v, &p) in (0u32..).zip(&part.positions) {
        number.entry(place(p)).or_insert(v);
    }
    let Mesh { positions, wires: all, .. } = part;
    all.extend(wires.iter().map(|wire| {
        let ends = wire.ends.map(|v| {
            let p = mesh.positions[v as usize];
            *number.entry(place(p)).or_insert_with(|| {
                positions.push(p);
                positions.len() as u32 - 1
            })
        });
        Wire { ends, ..*wire }
    }));
}

/// Bits of a position. Both zeros are the same place.
fn place(p: [f32; 3]) -> [u32; 3] {
    p.map(|x| (x + 0.0).to_bits())
}

/// Takes components out of a mesh, each in time that does not depend on the mesh's size. There may
/// be thousands.
struct Selection<'a> {
    mesh: &'a Mesh,
    /// Per vertex of the mesh its number in the component that is being taken; `u32::MAX`
    /// otherwise.
    number: Vec<u32>,
}

impl<'a> Selection<'a> {
    fn of(mesh: &'a Mesh) -> Self {
        Self { mesh, number: vec![u32::MAX; mesh.positions.len()] }
    }

    /// Some triangles, and their vertices.
    fn take(&mut self, triangles: &[u32]) -> Mesh {
        let Self { mesh, number } = self;
        let mut part = Mesh { rounding: mesh.rounding, ..Mesh::default() };
        for &t in triangles {
            part.source.push(mesh.source[t as usize]);
            part.triangles.push(mesh.triangles[t as usize].map(|v| {
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
            .flat_map(|&t| mesh.triangles[t as usize])
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
        let parts = split_components(&mesh).unwrap();
        let sources: Vec<_> = parts.iter().map(|p| p.source.clone()).collect();
        assert_eq!(sources, [vec![0, 1, 2, 3, 8, 9, 10, 11, 12, 13, 14, 15], vec![4, 5, 6, 7]]);
        assert!(parts.iter().all(|p| p.positions.len() == p.triangles.len()));
    }
}
