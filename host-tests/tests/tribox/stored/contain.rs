//! Every level holds the mesh, and of a solid its inside, by parameters as stored and sums in f64.

use super::{blob, mesh};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::{Blob, Triboxes};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, joined, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::oracle::{distance_to_mesh, winding_number};

const DIRECTIONS: [[f64; 3]; 9] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
];

/// Whether a point is in a union, or outside of it by no more than `off` by the worst plane of a
/// tribox.
fn is_held(leaves: &[([f32; 9], [f32; 9])], p: [f64; 3], off: f64) -> bool {
    let along = DIRECTIONS.map(|d| d[0] * p[0] + d[1] * p[1] + d[2] * p[2]);
    leaves.iter().any(|(low, high)| {
        (0..9).all(|k| f64::from(low[k]) - along[k] <= off && along[k] - f64::from(high[k]) <= off)
    })
}

/// Points of triangles: corners, and sums of their eighths, which f64 holds.
fn samples(mesh: &Mesh) -> Vec<[f64; 3]> {
    let mut all = Vec::new();
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(t).expect("a triangle").map(|p| p.map(f64::from));
        for i in 0..=8 {
            for j in (0..=8 - i).step_by(if mesh.triangles.len() > 500 { 4 } else { 1 }) {
                let [u, v, w] = [i, j, 8 - i - j].map(f64::from);
                all.push([0, 1, 2].map(|k| (u * a[k] + v * b[k] + w * c[k]) / 8.0));
            }
        }
    }
    all
}

fn leaves(triboxes: Triboxes<'_>) -> Vec<([f32; 9], [f32; 9])> {
    triboxes.leaves().map(|(_, tribox)| (tribox.low, tribox.high)).collect()
}

fn shapes() -> Vec<(&'static str, Triangles)> {
    let turned = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let mut open = rough_sphere(2, 0.4, 3);
    open.1.truncate(150);
    vec![
        ("torus", torus(2.0, 0.75, 24, 12)),
        ("turned torus", transformed(&torus(2.0, 0.75, 16, 8), turned, [0.3, 0.1, -0.2])),
        ("bracket", bracket()),
        ("groove", groove_block()),
        ("cube", cube(1)),
        ("open", open),
        ("far", transformed(&torus(2.0, 0.75, 12, 8), turned, [300.0, -2000.0, 10.0])),
        ("two", joined(&cube(2), &transformed(&cube(1), turned, [0.4, 0.4, 0.4]))),
        ("small", scaled(&torus(2.0, 0.75, 12, 8), 1e-30)),
        ("large", scaled(&torus(2.0, 0.75, 12, 8), 1e30)),
        ("least", scaled(&torus(2.0, 0.75, 12, 8), 1e-42)),
        ("point", (vec![[0.25, -1.0, 0.5]], vec![[0, 0, 0]])),
        ("origin", (vec![[0.0; 3]], vec![[0, 0, 0]])),
        ("flat", (vec![[0.0; 3], [3.0, 0.0, 0.0], [0.0, 5.0, 0.0]], vec![[0, 1, 2]])),
        (
            "at the end",
            (vec![[1.32e36, 0.0, 0.0], [0.0, -1.32e36, 0.0], [0.0, 0.0, 1.0]], vec![[0, 1, 2]]),
        ),
    ]
}

#[test]
fn every_level_holds_every_point_of_the_surface() {
    for (name, triangles) in shapes() {
        let mesh = mesh(&triangles);
        let bytes = blob(&mesh, 16);
        let triboxes = Triboxes::open(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        let points = samples(&mesh);
        for level in triboxes.levels() {
            let leaves = leaves(triboxes.coarser(level.triboxes));
            assert_eq!(leaves.len(), level.triboxes as usize);
            // What f64 makes of eighths of three corners, and no more.
            let size =
                mesh.positions.iter().flatten().fold(0f64, |most, &x| most.max(f64::from(x).abs()));
            let off = 8.0 * f64::EPSILON * size;
            for &p in &points {
                assert!(is_held(&leaves, p, off), "{name}, {} triboxes: {p:?}", level.triboxes);
            }
        }
    }
}

#[test]
fn every_level_of_a_solid_holds_its_inside() {
    for (name, triangles) in shapes().into_iter().take(5) {
        let mesh = mesh(&triangles);
        let bytes = blob(&mesh, 16);
        let triboxes = Triboxes::open(&bytes).expect("opens");
        assert!(triboxes.is_solid(), "{name}");
        let root = triboxes.node(0).expect("a root");
        let levels: Vec<_> =
            triboxes.levels().map(|level| leaves(triboxes.coarser(level.triboxes))).collect();
        let mut rng = Rng::new(9);
        let (mut inside, mut void) = (0, 0);
        for _ in 0..600 {
            let corner = |of: [f32; 9]| [of[0], of[1], of[2]];
            let p = rng.point_in(corner(root.low), corner(root.high)).map(f64::from);
            let number = winding_number(p, &mesh.positions, &mesh.triangles, 1.0);
            for leaves in &levels {
                let held = is_held(leaves, p, 0.0);
                assert!(held || number.abs() < 0.5, "{name}, {} triboxes: {p:?}", leaves.len());
                inside += usize::from(number.abs() >= 0.5);
                void += usize::from(!held);
            }
        }
        assert!(inside > 100 && (void > 20 || name == "cube"), "{name}: {inside} {void}");
    }
}

#[test]
fn triboxes_hold_the_input_that_may_be_off() {
    let mut mesh = mesh(&torus(2.0, 0.75, 16, 8));
    for (rounding, moved) in [(0.0, 0.01), (0.02, 0.0), (0.005, 0.005), (1e-9, 0.0)] {
        mesh.rounding = rounding;
        let input = meshsweep::mesh::Input { moved, ..mesh.as_input() };
        let (tables, _) =
            tribox::build(input, &TriboxOptions::new(16), Watch::NONE).expect("in the domain");
        let bytes = tables.to_bytes();
        let blob = Blob::open(&bytes).expect("opens");
        let by = rounding + moved;
        assert!(
            f64::from(blob.header().surface_error) * 2f64.powi(blob.header().scale_exponent) >= by
        );
        let triboxes = blob.triboxes().expect("there");
        let mut rng = Rng::new(4);
        for level in triboxes.levels() {
            let leaves = leaves(triboxes.coarser(level.triboxes));
            for p in samples(&mesh).into_iter().step_by(3) {
                let away = rng.direction().map(f64::from);
                let length = away.iter().map(|x| x * x).sum::<f64>().sqrt();
                let moved = [0, 1, 2].map(|k| p[k] + by * away[k] / length);
                assert!(is_held(&leaves, moved, 1e-15), "{by} {moved:?}");
            }
        }
    }
}

#[test]
fn vertices_of_every_node_are_exact_and_distances_are_bounds() {
    for (name, triangles) in shapes().into_iter().take(8) {
        let mesh = mesh(&triangles);
        let bytes = blob(&mesh, 16);
        let triboxes = Triboxes::open(&bytes).expect("opens");
        for node in 0..triboxes.node_count() {
            let tribox = triboxes.node(node).expect("a node");
            assert_eq!(tribox.tightened(), tribox, "{name}");
            let boundary = tribox.boundary();
            for vertex in boundary.vertices {
                let p = vertex.map(f64::from);
                assert!(is_held(&[(tribox.low, tribox.high)], p, 0.0), "{name}: {vertex:?}");
            }
            // Every plane is reached by a vertex, exactly.
            for (k, d) in DIRECTIONS.iter().enumerate() {
                let along = boundary.vertices.iter().map(|v| {
                    d[0] * f64::from(v[0]) + d[1] * f64::from(v[1]) + d[2] * f64::from(v[2])
                });
                let most = along.clone().fold(f64::NEG_INFINITY, f64::max);
                let least = along.fold(f64::INFINITY, f64::min);
                assert_eq!(
                    (least, most),
                    (f64::from(tribox.low[k]), f64::from(tribox.high[k])),
                    "{name}"
                );
            }
        }
        for level in triboxes.levels().take(4) {
            let all = leaves(triboxes.coarser(level.triboxes));
            for (_, tribox) in triboxes.coarser(level.triboxes).leaves() {
                for vertex in tribox.boundary().vertices {
                    // A vertex within another tribox is not on the boundary of the union.
                    if is_held(&all, vertex.map(f64::from), 0f64.next_down()) {
                        continue;
                    }
                    let far = distance_to_mesh(vertex, &mesh.positions, &mesh.triangles);
                    assert!(far.lower <= f64::from(level.distance), "{name}: {far:?} {level:?}");
                }
            }
        }
    }
}
