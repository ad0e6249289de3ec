//! A segment out of a solid leaves it: through a face, an edge or a vertex.

use meshsweep_core::{Budget, Facing, ScratchEntry, TriangleHit};
use meshsweep_host_tests::generate::corpus::add;
use meshsweep_host_tests::generate::{Rng, cube, icosphere, rough_sphere, scaled, uv_sphere};
use meshsweep_host_tests::scene::Scene;

type Point = [f32; 3];

/// Solids that can be seen from the origin as a whole.
fn stars() -> Vec<Scene> {
    let meshes = [
        ("cube", cube(4)),
        ("icosphere", icosphere(3)),
        ("rough sphere", rough_sphere(3, 0.3, 4)),
        ("sphere of meridians", uv_sphere(32, 16)),
        ("rough sphere × 1e-30", scaled(&rough_sphere(2, 0.3, 4), 1e-30)),
        ("rough sphere × 1e30", scaled(&rough_sphere(2, 0.3, 4), 1e30)),
    ];
    meshes.into_iter().map(|(name, mesh)| Scene::both(name, mesh)).collect()
}

/// From `inside` through every vertex, edge and centre of the mesh to the outside.
fn targets(scene: &Scene) -> Vec<Point> {
    let mean = |points: &[Point]| -> Point {
        std::array::from_fn(|k| points.iter().map(|p| p[k]).sum::<f32>() / points.len() as f32)
    };
    let corners = (0..scene.triangles.len()).map(|t| scene.corners(t as u32));
    let edges = corners.flat_map(|[u, v, w]| [mean(&[u, v]), mean(&[v, w]), mean(&[u, v, w])]);
    scene.positions.iter().copied().chain(edges).collect()
}

#[test]
fn no_segment_out_of_a_solid_slips_through() {
    let mut stack = vec![ScratchEntry::EMPTY; 1024];
    let mut hits = vec![TriangleHit::EMPTY; 64];
    for scene in stars() {
        let rng = &mut Rng::new(9);
        let size = scene.size();
        for tree in scene.trees() {
            for (i, target) in targets(&scene).into_iter().enumerate() {
                let inside =
                    if i % 2 == 0 { [0.0; 3] } else { add([0.0; 3], rng.direction(), 0.05 * size) };
                let out = std::array::from_fn(|k| inside[k] + 3.0 * (target[k] - inside[k]));
                let name = || format!("{} {target:?} from {inside:?}", scene.name);
                for (a, b) in [(inside, out), (out, inside)] {
                    let hit = tree
                        .first_hit(a, b, Facing::Both, Budget::EXACT, &mut stack)
                        .expect("answers");
                    assert!(hit.hit.is_some() && !hit.is_clear(), "{}: {hit:?}", name());
                    let all = tree
                        .all_hits(a, b, Facing::Both, &mut hits, Budget::EXACT, &mut stack)
                        .expect("answers");
                    assert!(all.stored > 0, "{}: {all:?}", name());
                    // A solid is left through a back and entered through a front.
                    let facing = if a == inside { Facing::Back } else { Facing::Front };
                    let hit =
                        tree.first_hit(a, b, facing, Budget::EXACT, &mut stack).expect("answers");
                    assert!(hit.hit.is_some(), "{facing:?} {}: {hit:?}", name());
                }
            }
        }
    }
}
