//! All hits of segments among triangles that share nothing, most of them through a corner or an
//! edge.

use super::truth::truth;
use meshsweep_core::{Budget, Facing, ScratchEntry, TriangleHit};
use meshsweep_host_tests::generate::{Rng, Triangles};
use meshsweep_host_tests::scene::Scene;

type Point = [f32; 3];

fn soup(count: usize, rng: &mut Rng) -> Triangles {
    let corners = (0..3 * count).map(|_| rng.point_in([-1.0; 3], [1.0; 3])).collect();
    (corners, (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
}

/// A segment through a corner, through a point of an edge, or through a triangle.
fn aimed(scene: &Scene, rng: &mut Rng) -> [Point; 2] {
    let triangle = rng.below(scene.triangles.len()) as u32;
    let [u, v, _] = scene.corners(triangle);
    let target = match rng.below(3) {
        0 => u,
        1 => std::array::from_fn(|k| 0.5 * u[k] + 0.5 * v[k]),
        _ => scene.on_triangle(triangle, rng),
    };
    let d = rng.direction();
    [target, target].map(|p| {
        let by = rng.range(0.0, 3.0) * if rng.below(2) == 0 { 1.0 } else { -1.0 };
        std::array::from_fn(|k| p[k] + by * d[k])
    })
}

#[test]
fn a_certain_hit_is_a_hit_and_a_list_without_a_hit_says_that_it_may_lack_one() {
    let rng = &mut Rng::new(169);
    let mut stack = vec![ScratchEntry::EMPTY; 1024];
    let mut hits = vec![TriangleHit::EMPTY; 256];
    // Lists with certain and undecided hits; lists that lack a hit; lists that may.
    let (mut mixed, mut lacking, mut open) = (0, 0, 0);
    for round in 0..200 {
        let scene = Scene::both(&format!("soup {round}"), soup(4 + rng.below(60), rng));
        for _ in 0..20 {
            let [a, b] = aimed(&scene, rng);
            let met: Vec<u32> = truth(&scene, a, b).iter().map(|met| met.triangle).collect();
            for tree in scene.trees() {
                let all = tree
                    .all_hits(a, b, Facing::Both, &mut hits, Budget::EXACT, &mut stack)
                    .expect("answers");
                let listed = &hits[..all.stored];
                let say = || format!("{}: {a:?} {b:?}: {listed:?}, met {met:?}", scene.name);
                let is_met =
                    |listed: &TriangleHit| met.contains(&listed.hit.triangle.expect("whole"));
                assert!(listed.iter().all(|hit| !hit.is_certain || is_met(hit)), "{}", say());
                let has = |triangle| listed.iter().any(|hit| hit.hit.triangle == Some(triangle));
                let lacks = !met.iter().all(|&triangle| has(triangle));
                assert!(!(lacks && all.is_complete), "{}", say());
                let certain = listed.iter().filter(|hit| hit.is_certain).count();
                mixed += usize::from(certain > 0 && certain < listed.len());
                lacking += usize::from(lacks);
                open += usize::from(!all.is_complete);
            }
        }
    }
    assert!(mixed > 500 && lacking > 50 && open < 4000, "{mixed} {lacking} {open}");
}
