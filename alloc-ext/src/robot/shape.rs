//! Collision shapes as meshes. Round shapes become polyhedra that contain them.

use super::package::Packages;
use crate::load::Source;
use crate::mesh::{Placement, RawMesh, Unit};
use glam::DVec3;
use std::f64::consts::TAU;

/// A collision shape, in its own frame.
pub(super) enum Shape {
    Mesh { file: String, scale: [f64; 3] },
    Box([f64; 3]),
    Cylinder { radius: f64, length: f64 },
    Sphere { radius: f64 },
}

/// Sides of the prism of a cylinder.
const SIDES: usize = 32;

/// Factor with room for the roundings of f64 in a polyhedron about a round shape.
const ABOUT: f64 = 1.0 + 1e-12;

/// The mesh of a shape, a transform of it into the shape's frame (the scale of a mesh file), and
/// how far it reaches beyond a round shape, in metres.
pub(super) fn mesh(
    shape: &Shape,
    packages: &Packages<'_>,
) -> Result<(RawMesh, Placement, f64), String> {
    let made = |(positions, triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>)| {
        let raw = RawMesh::from_f64(positions, triangles);
        // The sizes are decimals.
        RawMesh { decimal: true, ..raw }
    };
    match shape {
        Shape::Mesh { file, scale } => {
            let path = packages.find(file)?;
            let source =
                Source::of_file(&path, Some(Unit::M)).map_err(|error| error.to_string())?;
            let scale =
                if *scale == [1.0; 3] { Placement::IDENTITY } else { Placement::of_scale(*scale) };
            Ok((source.raw().clone(), scale, 0.0))
        }
        Shape::Box(size) => {
            let corner =
                |at: usize| [0, 1, 2].map(|k| size[k] * if at >> k & 1 == 0 { -0.5 } else { 0.5 });
            Ok((made(((0..8).map(corner).collect(), BOX.to_vec())), Placement::IDENTITY, 0.0))
        }
        Shape::Cylinder { radius, length } => {
            let reach = radius / (0.5 * TAU / SIDES as f64).cos() * ABOUT;
            let more = (reach * ABOUT - radius).next_up();
            Ok((made(prism(reach, 0.5 * length)), Placement::IDENTITY, more))
        }
        Shape::Sphere { radius } => {
            let (directions, triangles) = icosphere();
            let plane = |triangle: &[u32; 3]| {
                let [a, b, c] = triangle.map(|v| directions[v as usize]);
                let n = (b - a).cross(c - a);
                n.dot(a).abs() / n.dot(n).sqrt()
            };
            // No plane of a face is nearer to the middle than the radius.
            let nearest = triangles.iter().map(plane).fold(f64::INFINITY, f64::min);
            let reach = radius / nearest * ABOUT;
            let positions = directions.iter().map(|&d| (d * reach).to_array()).collect();
            let more = (reach * ABOUT - radius).next_up();
            Ok((made((positions, triangles)), Placement::IDENTITY, more))
        }
    }
}

const BOX: [[u32; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

/// A prism about the z axis, by the distance of its corners from the axis, and half its length.
fn prism(reach: f64, half: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let sides = SIDES as u32;
    let corner = |at: usize| {
        let (sin, cos) = (TAU * (at % SIDES) as f64 / SIDES as f64).sin_cos();
        [reach * cos, reach * sin, if at < SIDES { -half } else { half }]
    };
    let wall = |side: u32| {
        let next = (side + 1) % sides;
        [[side, next, side + sides], [next, next + sides, side + sides]]
    };
    let lid = |v: u32| [[0, v + 1, v], [sides, sides + v, sides + v + 1]];
    let triangles = (0..sides).flat_map(wall).chain((1..sides - 1).flat_map(lid)).collect();
    ((0..2 * SIDES).map(corner).collect(), triangles)
}

/// Directions and faces of an icosahedron, each face cut into four twice.
fn icosphere() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    // Not `normalize`, which multiplies by the inverse: other bits.
    let unit = |v: DVec3| v / v.length();
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut directions: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        directions.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]].map(|v| unit(v.into())));
    }
    // Corners of a face are nearest neighbours of each other.
    let edge = |a: u32, b: u32| directions[a as usize].dot(directions[b as usize]) > 0.4;
    let mut faces = Vec::new();
    for (a, b, c) in
        (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| (a, b, c))))
    {
        if edge(a, b) && edge(b, c) && edge(c, a) {
            let [p, q, r] = [a, b, c].map(|v: u32| directions[v as usize]);
            let outward = (q - p).cross(r - p).dot(p) > 0.0;
            faces.push(if outward { [a, b, c] } else { [a, c, b] });
        }
    }
    for _ in 0..2 {
        let mut middles = std::collections::HashMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(a, b): (u32, u32)| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let (p, q) = (directions[a as usize], directions[b as usize]);
                    directions.push(unit(p + q));
                    directions.len() as u32 - 1
                })
            });
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    (directions, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{repair, require_closed_manifold};

    /// The least distance of a face's plane from the middle, and that of the lids.
    #[test]
    fn round_shapes_are_inside_their_polyhedra_and_all_shapes_are_closed() {
        let packages = Packages::new(std::path::Path::new("robot.urdf"), &[]);
        for shape in [
            Shape::Box([0.1, 0.2, 0.3]),
            Shape::Cylinder { radius: 0.3, length: 0.7 },
            Shape::Sphere { radius: 0.3 },
        ] {
            let (raw, _, more) = mesh(&shape, &packages).unwrap();
            for triangle in &raw.triangles {
                let [a, b, c] = triangle.map(|v| DVec3::from(raw.positions[v as usize]));
                let n = (b - a).cross(c - a);
                let n = n / n.length();
                let needed = match shape {
                    Shape::Sphere { radius } => radius,
                    Shape::Cylinder { length, .. } if n.z.abs() > 0.5 => 0.5 * length,
                    Shape::Cylinder { radius, .. } => radius,
                    _ => n.abs().dot(DVec3::new(0.05, 0.1, 0.15)) - 1e-16,
                };
                assert!(n.dot(a) >= needed, "{:e}", n.dot(a) - needed);
                assert!([a, b, c].iter().all(|p| match shape {
                    Shape::Sphere { radius } => p.length() <= radius + more,
                    Shape::Cylinder { radius, .. } => p.x.hypot(p.y) <= radius + more,
                    _ => true,
                }));
            }
            let (mesh, report) = repair(raw).unwrap();
            assert!(require_closed_manifold(&mesh).is_ok(), "{report}");
        }
    }
}
