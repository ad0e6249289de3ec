//! A search that is kept gives what a fresh one gives, and no interval of it is wrong, whatever
//! interrupts it and however its point moves.

use super::scenes::{Scene, scenes, scratch};
use meshsweep_core::{Budget, CurveClosest, Ended, QueryError};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::curves::{circle, tool_path};

fn holds(scene: &Scene, p: [f32; 3], near: &CurveClosest) {
    let truth = scene.truth(p);
    let (lower, upper) = (f64::from(near.distance.lower), f64::from(near.distance.upper));
    assert!(lower <= truth.upper && truth.lower <= upper, "{} {p:?} {near:?}", scene.name);
    assert!(scene.distance(p, near.segment).lower <= upper, "{} {p:?} {near:?}", scene.name);
}

/// All but the work and the safe motion.
fn answer(near: &CurveClosest) -> impl PartialEq + std::fmt::Debug + use<> {
    (near.distance, near.point, near.segment, near.t, near.ended)
}

#[test]
fn a_search_in_small_steps_ends_like_one_that_is_not_interrupted() {
    for scene in scenes() {
        let curve = scene.curve();
        for p in scene.points(20, 31) {
            let fresh = curve.closest_point(p, Budget::EXACT, &mut scratch(400)).expect("finite");
            for steps in [1, 2, 7] {
                let mut memory = scratch(curve.sweep_entries());
                let mut sweep = curve.sweep(p, &mut memory).expect("finite");
                let (mut opened, mut widths) = (0, vec![f32::INFINITY]);
                let last = loop {
                    let near = sweep.closest_point(Budget::EXACT.with_steps(steps)).expect("one");
                    holds(&scene, p, &near);
                    assert!(near.work.opened <= steps);
                    opened += near.work.opened;
                    let width = near.distance.upper - near.distance.lower;
                    widths.push(width);
                    if near.ended != Ended::Steps {
                        break near;
                    }
                    // It goes on: every call opens what the budget lets it.
                    assert_eq!(near.work.opened, steps, "{} {p:?}", scene.name);
                };
                assert_eq!(answer(&last), answer(&fresh), "{} {p:?} {steps}", scene.name);
                // Nothing is opened twice.
                assert!(opened <= curve.header().nodes(), "{} {opened}", scene.name);
                let lowest = |pair: &[f32]| pair[1] <= pair[0];
                assert!(widths.windows(2).all(lowest), "{} {p:?} {widths:?}", scene.name);
                assert_eq!(sweep.closest_point(Budget::EXACT).expect("one").work.opened, 0);
            }
        }
    }
}

#[test]
fn a_search_in_small_steps_with_short_memory_ends_also_after_a_motion() {
    let mut rng = Rng::new(33);
    for scene in scenes() {
        let curve = scene.curve();
        let most = 4 * curve.header().nodes() + 8;
        for (from, to) in scene.points(12, 34).into_iter().zip(scene.points(12, 35)) {
            let (entries, steps) = (4 + rng.below(13), 2 + rng.below(7) as u32);
            let mut memory = scratch(entries);
            let mut sweep = curve.sweep(from, &mut memory).expect("finite");
            sweep.closest_point(Budget::EXACT.with_steps(steps)).expect("one");
            sweep.move_to(to).expect("finite");
            let mut opened = 0;
            loop {
                let near = sweep.closest_point(Budget::EXACT.with_steps(steps)).expect("one");
                holds(&scene, to, &near);
                opened += near.work.opened;
                if near.ended != Ended::Steps {
                    break;
                }
                assert!(opened < most, "{} {to:?}: {entries} entries, {steps}", scene.name);
            }
        }
    }
}

#[test]
fn a_moved_search_gives_the_bits_of_a_fresh_one_with_any_memory() {
    let mut rng = Rng::new(32);
    for scene in scenes() {
        let curve = scene.curve();
        let all = curve.sweep_entries();
        for (round, start) in scene.points(10, 33).into_iter().enumerate() {
            for entries in [1, 3, curve.scratch_entries(), 40, all] {
                let mut memory = scratch(entries);
                let mut sweep = curve.sweep(start, &mut memory).expect("finite");
                let mut p = start;
                for tick in 0..12 {
                    // Small steps, a large one, and one to far away and back.
                    let size = scene.size() * [1e-4, 1e-2, 0.3, 1e9][(tick * tick + round) % 4];
                    let before = p;
                    p = p.map(|x| x + size * rng.range(-1.0, 1.0));
                    if !p.iter().all(|x| x.is_finite()) {
                        continue;
                    }
                    sweep.move_to(p).expect("finite");
                    let near = sweep.closest_point(Budget::EXACT).expect("one");
                    holds(&scene, p, &near);
                    let fresh =
                        curve.closest_point(p, Budget::EXACT, &mut scratch(400)).expect("finite");
                    if near.ended == Ended::Exact {
                        assert_eq!(answer(&near), answer(&fresh), "{} {p:?}", scene.name);
                    } else {
                        assert!(near.ended == Ended::Scratch && entries < all, "{near:?}");
                    }
                    if size > 1e6 * scene.size() {
                        p = before;
                        sweep.move_to(p).expect("finite");
                    }
                }
            }
        }
    }
}

#[test]
fn safe_motions_and_tolerances_of_a_kept_search_hold() {
    let mut rng = Rng::new(34);
    for scene in scenes() {
        let curve = scene.curve();
        let mut memory = scratch(curve.sweep_entries());
        for start in scene.points(10, 35) {
            let mut sweep = curve.sweep(start, &mut memory).expect("finite");
            let mut p = start;
            for tick in 0..12u32 {
                let budget = match tick % 4 {
                    1 => Budget::EXACT.with_relative(0.2),
                    2 => Budget::EXACT.with_absolute(0.01 * scene.size()),
                    3 => Budget::EXACT.with_steps(tick),
                    _ => Budget::EXACT,
                };
                let near = sweep.closest_point(budget).expect("one");
                holds(&scene, p, &near);
                let width = near.distance.upper - near.distance.lower;
                let tolerable =
                    near.distance.upper <= near.distance.lower * 1.2 || width <= budget.absolute;
                assert!(near.ended != Ended::Tolerance || tolerable, "{near:?}");
                let way = rng.direction();
                let step = 0.999 * near.safe_motion.min(scene.size());
                let moved: [f32; 3] = std::array::from_fn(|k| p[k] + step * way[k]);
                let length: f64 =
                    (0..3).map(|k| (f64::from(moved[k]) - f64::from(p[k])).powi(2)).sum();
                if step > 0.0 && length.sqrt() < f64::from(near.safe_motion) {
                    let others = scene.segments.iter().filter(|(_, name)| *name != near.segment);
                    let others = meshsweep_host_tests::oracle::distance_to_segments(
                        moved,
                        others.map(|(ends, _)| *ends),
                    );
                    let still = scene.distance(moved, near.segment);
                    assert!(still.lower <= others.upper, "{} {p:?} {near:?}", scene.name);
                }
                p = p.map(|x| x + 0.01 * scene.size() * rng.range(-1.0, 1.0));
                sweep.move_to(p).expect("finite");
            }
        }
    }
}

/// Prints the runs that a step takes, with `--nocapture`.
#[test]
fn small_motions_beside_a_tool_path_open_few_runs() {
    let scene = Scene::new("tool path", &[tool_path(2000)], true);
    let curve = scene.curve();
    for (part, most) in [(1e-4, 0.1), (1e-3, 0.4)] {
        let mut memory = scratch(256);
        let mut p = [60.0, 40.0, 9.0];
        let mut sweep = curve.sweep(p, &mut memory).expect("finite");
        let [mut kept, mut fresh] = [[0u32; 2]; 2];
        for tick in 0..500 {
            // There and back along the path.
            let way = if tick / 100 % 2 == 0 { 1.0 } else { -1.0 };
            p[0] += way * part * 144.0;
            sweep.move_to(p).expect("finite");
            let near = sweep.closest_point(Budget::EXACT).expect("one");
            assert_eq!(near.ended, Ended::Exact);
            let alone = curve.closest_point(p, Budget::EXACT, &mut scratch(400)).expect("finite");
            assert_eq!(answer(&near), answer(&alone));
            let add = |sum: [u32; 2], of: &CurveClosest| {
                [sum[0] + of.work.opened, sum[1] + of.work.exact]
            };
            (kept, fresh) = (add(kept, &near), add(fresh, &alone));
        }
        println!("steps of {part}: opened and exact, kept {kept:?}, fresh {fresh:?}");
        assert!(f64::from(kept[0]) < most * f64::from(fresh[0]), "{part}: {kept:?} {fresh:?}");
    }
}

#[test]
fn wrong_questions_are_refused_and_far_ones_answered() {
    let scene = Scene::new("circle", &[circle(40)], true);
    let curve = scene.curve();
    let nan = [0.0, f32::NAN, 0.0];
    assert_eq!(curve.sweep(nan, &mut scratch(9)).err(), Some(QueryError::NotFinite));
    assert_eq!(curve.sweep([0.0; 3], &mut []).err(), Some(QueryError::NoScratch));
    let mut memory = scratch(curve.sweep_entries());
    let mut sweep = curve.sweep([0.0; 3], &mut memory).expect("finite");
    assert_eq!(sweep.move_to([f32::INFINITY; 3]), Err(QueryError::NotFinite));
    let negative = Budget::EXACT.with_absolute(-1.0);
    assert_eq!(sweep.closest_point(negative), Err(QueryError::Tolerance));
    for p in [[1e9, 0.0, 0.0], [f32::MAX, -f32::MAX, f32::MAX], [0.3, 0.1, 0.0]] {
        sweep.move_to(p).expect("finite");
        let near = sweep.closest_point(Budget::EXACT).expect("one");
        holds(&scene, p, &near);
        let fresh = curve.closest_point(p, Budget::EXACT, &mut scratch(99)).expect("finite");
        assert_eq!(answer(&near), answer(&fresh));
    }
}
