//! A closed surface around a mesh, moved outward until it holds all points near the mesh.
//!
//! A level of a progressive hull may touch the mesh. If vertices of the mesh were rounded, the
//! input's surface may therefore stick out of it. Each vertex of the hull is lifted off the planes
//! of its star, and the result is proved as a whole: no face comes within the distance of the mesh,
//! and a witness of each connected component of the mesh is inside. No way from the mesh to a point
//! within the distance meets the hull, so the point is inside, too.

use super::initial::lift;
use super::moves::{Rounding, Shell};
use super::proof::{Obstacle, holds};
use crate::mesh::Mesh;
use crate::surface::{Grid, scale_exponent};
use glam::{DVec3, Vec3};

/// Lifts as multiples of the distance: the first that is proved is taken. Vertices that cannot be
/// lifted leave their neighbours nearer.
const LIFTS: [f64; 4] = [1.0, 2.0, 4.0, 16.0];

/// A closed manifold `hull` moved outward so that it holds all points within `distance` of `mesh`
/// and its wires, above 0; `None` if no lift that was tried is proved to. It may have fewer faces.
///
/// Cost: a linear program for each vertex, and a search of the triangles near each face.
#[must_use]
pub fn outset(hull: &Mesh, mesh: &Mesh, distance: f64) -> Option<Mesh> {
    let obstacle = Obstacle::of(mesh).with_margin(distance);
    let positions: Vec<DVec3> = hull.positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
    let shell = Shell::new(positions, &hull.triangles);
    let rounding = Rounding::new(Grid::F32, scale_exponent(hull));
    LIFTS.into_iter().find_map(|times| {
        let mut shell = shell.clone();
        lift(&mut shell, &rounding, times * distance);
        let faces: Vec<_> = shell.alive().map(|f| shell.face(f)).collect();
        holds(&faces, &obstacle).then(|| {
            let (positions, triangles) = shell.compact();
            Mesh::new(positions.iter().map(|p| p.as_vec3().to_array()).collect(), triangles)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(low: f32, high: f32) -> Mesh {
        let corner = |n: u32| [0, 1, 2].map(|k| if n >> k & 1 == 0 { low } else { high });
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Mesh::new((0..8).map(corner).collect(), triangles.collect())
    }

    fn beside(mut one: Mesh, other: &Mesh) -> Mesh {
        let first = one.positions.len() as u32;
        one.positions.extend(&other.positions);
        one.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        Mesh::new(one.positions, one.triangles)
    }

    fn turned(mut mesh: Mesh) -> Mesh {
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        mesh
    }

    #[test]
    fn a_hull_that_touches_its_mesh_is_moved_off_by_the_distance() {
        for (low, high) in [(-1.0, 1.0), (5e5, 5.001e5), (-1e-30, 3e-30), (1e30, 3e30)] {
            let mesh = cube(low, high);
            let distance = f64::from(high) * 1e-7;
            let hull = outset(&mesh, &mesh, distance).unwrap();
            let beyond = |p: &[f32; 3]| {
                p.iter().all(|&x| {
                    let x = f64::from(x);
                    x <= f64::from(low) - distance || x >= f64::from(high) + distance
                })
            };
            assert!(hull.positions.iter().all(beyond), "{low} {high} {:?}", hull.positions);
            assert_eq!(hull.triangles.len(), 12);
        }
    }

    #[test]
    fn a_cavity_becomes_smaller_and_one_that_vanishes_is_not_proved() {
        let mesh = beside(cube(0.0, 8.0), &turned(cube(3.0, 4.0)));
        let hull = outset(&mesh, &mesh, 0.25).unwrap();
        let inner = &hull.positions[8..];
        assert!(inner.iter().flatten().all(|&x| (3.25..=3.75).contains(&x)), "{inner:?}");
        assert_eq!(outset(&mesh, &mesh, 0.75), None);
    }

    #[test]
    fn a_hull_that_crosses_another_component_is_not_proved() {
        let mesh = beside(cube(0.0, 8.0), &cube(7.0, 9.0));
        assert_eq!(outset(&mesh, &mesh, 0.25), None);
    }
}
