//! All hits where they are many.

use super::truth::{Asker, truth};
use meshsweep_core::{Budget, Facing, ScratchEntry, TriangleHit};
use meshsweep_host_tests::generate::{Triangles, icosphere, joined, scaled};
use meshsweep_host_tests::scene::Scene;

fn shells(count: usize) -> Triangles {
    (1..count).fold(icosphere(1), |all, i| joined(&all, &scaled(&icosphere(1), 1.0 + i as f32)))
}

#[test]
fn every_shell_is_met_twice_and_truncation_says_how_many_are_left() {
    let scene = Scene::both("shells", shells(40));
    let (a, b) = ([-50.0, -3.1, 1.7], [50.0, 2.3, -0.9]);
    let met = truth(&scene, a, b);
    let mut stack = vec![ScratchEntry::EMPTY; 4096];
    let mut hits = vec![TriangleHit::EMPTY; 100];
    for tree in scene.trees() {
        let all = tree
            .all_hits(a, b, Facing::Both, &mut hits, Budget::EXACT, &mut stack)
            .expect("answers");
        assert_eq!((all.stored, all.dropped), (met.len(), 0));
        for (TriangleHit { hit, is_certain }, met) in hits.iter().zip(&met) {
            assert!(*is_certain && hit.triangle == Some(met.triangle), "{hit:?} {met:?}");
            assert!((f64::from(hit.t) - met.t_lower).abs() < 1e-5, "{hit:?} {met:?}");
        }
        let few = tree
            .all_hits(a, b, Facing::Both, &mut hits[..7], Budget::EXACT, &mut stack)
            .expect("answers");
        assert_eq!((few.stored, few.dropped as usize), (7, met.len() - 7));
        let fronts = tree
            .all_hits(a, b, Facing::Front, &mut hits, Budget::EXACT, &mut stack)
            .expect("answers");
        let backs = tree
            .all_hits(a, b, Facing::Back, &mut hits, Budget::EXACT, &mut stack)
            .expect("answers");
        assert_eq!((fronts.stored, backs.stored), (met.len() / 2, met.len() / 2));
    }
    Asker::new().prove(&scene, a, b);
}
