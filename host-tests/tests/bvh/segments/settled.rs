//! In general position answers are proofs, and the same as brute force gives.

use super::scenes::closed;
use super::truth::{FACINGS, of_facing, truth};
use meshsweep_core::{Budget, Ended, Facing, ScratchEntry};
use meshsweep_host_tests::generate::corpus::add;
use meshsweep_host_tests::generate::{Rng, icosphere};
use meshsweep_host_tests::scene::Scene;

#[test]
fn with_exact_vertices_hits_are_those_of_brute_force() {
    let mut stack = vec![ScratchEntry::EMPTY; 1024];
    let (mut asked, mut open) = (0, 0);
    for (name, mesh) in closed() {
        let scene = Scene::both(name, mesh);
        let [_, tree] = scene.trees();
        let rng = &mut Rng::new(77);
        for i in 0..300 {
            let a = scene.around(1.5, rng);
            let b = if i % 2 == 0 { scene.around(1.5, rng) } else { scene.on_surface(rng) };
            let b = add(b, [b[0] - a[0], b[1] - a[1], b[2] - a[2]], 0.3);
            let met = truth(&scene, a, b);
            for facing in FACINGS {
                let mut wanted = of_facing(&met, facing);
                wanted.sort_by(|x, y| x.t_lower.total_cmp(&y.t_lower));
                let hit = tree.first_hit(a, b, facing, Budget::EXACT, &mut stack).expect("answers");
                asked += 1;
                if hit.ended != Ended::Exact {
                    open += 1;
                    continue;
                }
                let at = || format!("{name}, {facing:?}, {a:?} {b:?}: {hit:?}, met {wanted:?}");
                let Some(first) = wanted.first() else {
                    assert!(hit.hit.is_none(), "{}", at());
                    continue;
                };
                let found = hit.hit.unwrap_or_else(|| panic!("{}", at()));
                let slack = f64::from(hit.t.upper - hit.t.lower);
                let near = wanted.iter().filter(|met| met.t_lower <= first.t_upper + slack);
                assert!(
                    near.into_iter().any(|met| Some(met.triangle) == found.triangle),
                    "{}",
                    at()
                );
                assert!((f64::from(found.t) - first.t_lower).abs() <= slack, "{}", at());
            }
        }
    }
    println!("{open} of {asked} open");
    assert!(open * 100 < asked, "{open} of {asked}");
}

/// The interval of a proved hit is a few roundings wide with f32 vertices, and a few steps of the
/// grid else.
#[test]
fn proved_intervals_are_narrow() {
    let scene = Scene::both("icosphere", icosphere(4));
    let mut stack = vec![ScratchEntry::EMPTY; 1024];
    let [grid, single] = scene.trees();
    for (tree, most) in [(single, 5e-5), (grid, 1e-3)] {
        let rng = &mut Rng::new(3);
        let mut widths = Vec::new();
        for _ in 0..2000 {
            let (a, b) = (add([0.0; 3], rng.direction(), 2.0), add([0.0; 3], rng.direction(), 0.3));
            let hit =
                tree.first_hit(a, b, Facing::Front, Budget::EXACT, &mut stack).expect("answers");
            if hit.ended == Ended::Exact && !hit.is_clear() {
                widths.push(hit.t.upper - hit.t.lower);
            }
        }
        widths.sort_by(f32::total_cmp);
        println!(
            "{} proved, widths {:?}",
            widths.len(),
            [0, 1, 5, 9].map(|i| widths[widths.len() * i / 10])
        );
        println!("{:?}", widths.last());
        assert!(widths.len() > 1950, "{}", widths.len());
        assert!(widths[widths.len() / 2] < most, "{:?}", widths[widths.len() / 2]);
    }
}
