//! Five million triangles, and meshes too far away for a grid.

use crate::named::extreme;
use crate::scene::{Kind, Scene, wide};
use meshsweep::bvh::{TreeOptions, build, is_too_far_for_grid};
use meshsweep::mesh::{RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, ScratchEntry};
use meshsweep_host_tests::generate::corpus::{IDENTITY, add};
use meshsweep_host_tests::generate::{Rng, torus, transformed, uv_sphere};
use meshsweep_host_tests::oracle::distance_to_mesh;

#[test]
#[ignore = "five million triangles take minutes and gigabytes; smaller meshes show the same"]
fn five_million_triangles_are_served_and_every_interval_contains_the_truth() {
    let (positions, triangles) = uv_sphere(2000, 1251);
    assert!(triangles.len() >= 5_000_000 - 4000, "{}", triangles.len());
    let (mesh, _) = repair(RawMesh::from_f32(&positions, &triangles)).expect("a sphere");
    let (tables, report) =
        build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds");
    let bytes = tables.to_bytes();
    let tree = Bvh::open(&bytes).expect("opens");
    let each = bytes.len() as f64 / triangles.len() as f64;
    println!("{} triangles, {each:.2} bytes each, built in {:?}", triangles.len(), report.time);
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let (mut rng, mut work, mut widest) = (Rng::new(5), 0, 0f32);
    for i in 0..24 {
        let t = triangles[rng.below(triangles.len())];
        // At the centre the oracle would look at all of them in 106 bits.
        let at = [positions[t[0] as usize], [0.3, 0.2, 0.1], positions[t[1] as usize]][i % 3];
        let p = add(at, rng.direction(), [0.0, 1e-3, 0.5, 100.0][i % 4]);
        let truth = distance_to_mesh(p, &positions, &triangles);
        let near = tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
        let (lower, upper) = (f64::from(near.distance.lower), f64::from(near.distance.upper));
        assert!(lower <= truth.upper && truth.lower <= upper, "{p:?} {near:?} {truth:?}");
        work += near.work.bounds;
        widest = widest.max(near.distance.upper - near.distance.lower);
    }
    println!("{} nodes a query, intervals up to {widest:e} wide", work / 24);
}

#[test]
fn a_mesh_too_far_for_a_grid_is_known_and_f32_vertices_keep_its_intervals_narrow() {
    let ring = torus(2.0, 0.75, 6, 4);
    for (shift, is_too_far) in [(0.0, false), (8.0, false), (1e3, false), (8e4, true), (8e6, true)]
    {
        let away = transformed(&ring, IDENTITY, [shift, 0.0, 0.0]);
        let (mesh, _) = repair(RawMesh::from_f32(&away.0, &away.1)).expect("a ring");
        assert_eq!(is_too_far_for_grid(&mesh), is_too_far, "{shift}");
    }
    for name in ["ten_thousand_diagonals_away", "ten_thousand_diagonals_along_one_axis"] {
        let mesh = extreme(name).mesh;
        let scene = Scene::new(name, &wide(mesh), Kind::F32);
        let (tree, mut stack) = (scene.tree(), scene.stack());
        for p in scene.points(40, 3) {
            let near = tree.closest_point(p, Budget::EXACT, &mut stack).expect("a point");
            let width = near.distance.upper - near.distance.lower;
            // The diagonal is 8.
            assert!(width <= 1e-4 + 4e-6 * near.distance.upper, "{name}: {p:?} {near:?}");
        }
    }
}
