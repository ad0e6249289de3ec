//! A mesh with few enough triangles to be drawn. After Rossignac & Borrel 1993: the vertices in a
//! cube of a grid become one.

use std::collections::BTreeMap;

use glam::DVec3;
use meshsweep::mesh::Mesh;

/// Cubes along the longest side, in the order in which they are tried.
const CELLS: [u32; 9] = [256, 160, 112, 80, 64, 48, 36, 24, 12];

/// Triangles that look like the mesh's, at most `most` if a grid of a dozen cubes does that.
#[must_use]
pub fn cluster(mesh: &Mesh, most: usize) -> Vec<[DVec3; 3]> {
    let at = |v: u32| DVec3::from_array(mesh.positions[v as usize].map(f64::from));
    if mesh.triangles.len() <= most {
        return mesh.triangles.iter().map(|t| t.map(at)).collect();
    }
    let used = || mesh.triangles.iter().flatten().map(|&v| at(v));
    let low = used().fold(DVec3::INFINITY, DVec3::min);
    let extent = (used().fold(DVec3::NEG_INFINITY, DVec3::max) - low).max_element();
    let mut triangles = Vec::new();
    for cells in CELLS {
        let cube = |p: DVec3| ((p - low) / extent * f64::from(cells)).floor().as_ivec3().to_array();
        let mut sums: BTreeMap<[i32; 3], (DVec3, f64)> = BTreeMap::new();
        for p in used() {
            let (sum, count) = sums.entry(cube(p)).or_insert((DVec3::ZERO, 0.0));
            (*sum, *count) = (*sum + p, *count + 1.0);
        }
        let mean =
            |cube: [i32; 3]| sums.get(&cube).map_or(DVec3::ZERO, |(sum, count)| *sum / *count);
        // One of each set of corners, with the first one's winding.
        let mut kept: BTreeMap<[[i32; 3]; 3], [[i32; 3]; 3]> = BTreeMap::new();
        for &t in &mesh.triangles {
            let [a, b, c] = t.map(|v| cube(at(v)));
            if a != b && b != c && c != a {
                let mut sorted = [a, b, c];
                sorted.sort_unstable();
                kept.entry(sorted).or_insert([a, b, c]);
            }
        }
        triangles = kept.into_values().map(|t| t.map(mean)).collect();
        if triangles.len() <= most {
            break;
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fine_grid_of_triangles_becomes_coarse_and_stays_where_it_was() {
        let count = 120u32;
        let positions = (0..=count).flat_map(|i| {
            (0..=count).map(move |j| [i as f32 / count as f32, j as f32 / count as f32, 0.0])
        });
        let at = |i: u32, j: u32| i * (count + 1) + j;
        let triangles = (0..count).flat_map(|i| {
            (0..count).flat_map(move |j| {
                [
                    [at(i, j), at(i + 1, j), at(i, j + 1)],
                    [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)],
                ]
            })
        });
        let mesh = Mesh::new(positions.collect(), triangles.collect());
        assert_eq!(cluster(&mesh, 30_000).len(), mesh.triangles.len());
        let few = cluster(&mesh, 3_000);
        assert!((100..=3_000).contains(&few.len()), "{}", few.len());
        let area: f64 = few.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a).z / 2.0).sum();
        assert!(area > 0.9 && area < 1.0, "{area}");
    }
}
