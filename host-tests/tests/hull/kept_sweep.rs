//! A sweep that is kept: interrupted, moved, or asked for triangle after triangle, it answers like
//! a fresh one.

use super::scenes::{all, options};
use meshsweep::cut::cut;
use meshsweep_core::{Budget, ClosestPoint, Ended, Hull, QueryError, ScratchEntry};
use meshsweep_host_tests::generate::{Rng, icosphere, rough_sphere};
use meshsweep_host_tests::oracle::{distance_to_mesh, distance_to_triangle};
use meshsweep_host_tests::scene::Scene;

fn fresh(model: &Hull<'_>, p: [f32; 3]) -> ClosestPoint {
    let mut scratch = vec![ScratchEntry::EMPTY; 4096];
    model.closest_point(p, Budget::EXACT, &mut scratch).expect("finite")
}

fn contains_truth(scene: &Scene, p: [f32; 3], answer: &ClosestPoint) {
    let truth = distance_to_mesh(p, &scene.positions, &scene.triangles);
    let holds = f64::from(answer.distance.lower) <= truth.upper
        && truth.lower <= f64::from(answer.distance.upper);
    assert!(holds, "{}: {p:?}: {answer:?} does not contain {truth:?}", scene.name);
}

/// A path of small and large steps.
fn path(scene: &Scene, count: usize, rng: &mut Rng) -> Vec<[f32; 3]> {
    let mut p = scene.around(1.5, rng);
    (0..count)
        .map(|i| {
            let step = scene.size() * [1e-5, 1e-4, 1e-3, 1e-2, 0.1][i / 7 % 5];
            p = std::array::from_fn(|k| p[k] + step * rng.range(-1.0, 1.0));
            if i % 50 == 49 {
                p = scene.around(1.5, rng);
            }
            p
        })
        .collect()
}

#[test]
fn a_moved_sweep_names_the_triangle_of_a_fresh_one() {
    let mut spared = 0;
    for scene in all() {
        let model = scene.model();
        let mut scratch = vec![ScratchEntry::EMPTY; 8192];
        let mut rng = Rng::new(51);
        let path = path(scene, 150, &mut rng);
        let mut sweep = model.sweep(path[0], &mut scratch).expect("finite");
        for p in path {
            sweep.move_to(p).expect("finite");
            let (kept, new) =
                (sweep.closest_point(Budget::EXACT).expect("answers"), fresh(&model, p));
            assert_eq!(
                (kept.triangle, kept.point, kept.ended),
                (new.triangle, new.point, new.ended),
                "{}: {p:?}: {kept:?} {new:?}",
                scene.name
            );
            contains_truth(scene, p, &kept);
            spared += usize::from(kept.work.opened < new.work.opened);
        }
    }
    assert!(spared > 1000, "only {spared} answers took fewer splits");
}

/// Bounds that are beyond the nearest triangle by less than the rounding of a key are seldom: only
/// long walks meet them. A sweep that put them back unchanged would not end.
#[test]
fn a_sweep_ends_on_a_long_walk_of_small_steps() {
    for scene in all() {
        let model = scene.model();
        let mut scratch = vec![ScratchEntry::EMPTY; 512];
        let mut rng = Rng::new(54);
        let (from, to) = (scene.around(1.5, &mut rng), scene.around(1.5, &mut rng));
        let mut sweep = model.sweep(from, &mut scratch).expect("finite");
        let place = |i: u32| {
            let part = i as f32 / 6000.0;
            std::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
        };
        for p in (0..=6000).map(place) {
            sweep.move_to(p).expect("finite");
            sweep.closest_point(Budget::EXACT).expect("answers");
        }
        contains_truth(scene, to, &sweep.closest_point(Budget::EXACT).expect("answers"));
    }
}

#[test]
fn any_memory_and_any_budget_give_an_interval_that_holds() {
    let mut short = 0;
    for scene in all() {
        let model = scene.model();
        for (entries, steps) in [(1, u32::MAX), (2, 9), (16, 5), (48, u32::MAX), (200, 1)] {
            let mut scratch = vec![ScratchEntry::EMPTY; entries];
            let mut rng = Rng::new(52);
            let path = path(scene, 60, &mut rng);
            let mut sweep = model.sweep(path[0], &mut scratch).expect("finite");
            for p in path {
                sweep.move_to(p).expect("finite");
                let stop = Budget::EXACT.with_steps(steps).with_relative(0.01);
                let answer = sweep.closest_point(stop).expect("answers");
                contains_truth(scene, p, &answer);
                short += usize::from(answer.ended == Ended::Scratch);
            }
        }
    }
    assert!(short > 100, "only {short} answers lacked memory");
}

#[test]
fn a_sweep_in_small_steps_ends_like_one_that_is_not_interrupted() {
    for scene in all() {
        let model = scene.model();
        let mut scratch = vec![ScratchEntry::EMPTY; 8192];
        let mut rng = Rng::new(53);
        for p in scene.points(12, &mut rng) {
            let mut sweep = model.sweep(p, &mut scratch).expect("finite");
            let mut lower = 0f32;
            let mut calls = 0;
            let answer = loop {
                let answer = sweep.closest_point(Budget::EXACT.with_steps(7)).expect("answers");
                contains_truth(scene, p, &answer);
                calls += 1;
                if answer.ended != Ended::Steps {
                    break answer;
                }
                lower = lower.max(answer.distance.lower);
                assert!(calls < 100_000, "{}: {p:?} does not end", scene.name);
            };
            let whole = fresh(&model, p);
            assert_eq!((answer.triangle, answer.ended), (whole.triangle, whole.ended));
            assert!(lower <= whole.distance.upper, "{}: {p:?}", scene.name);
        }
    }
}

#[test]
fn triangles_come_by_rising_distance_and_each_comes_once() {
    for scene in all() {
        let model = scene.model();
        let mut scratch = vec![ScratchEntry::EMPTY; 60_000];
        let mut rng = Rng::new(54);
        for p in scene.points(3, &mut rng) {
            let mut sweep = model.sweep(p, &mut scratch).expect("finite");
            let mut seen = vec![false; scene.triangles.len()];
            let mut last = 0f32;
            while let Some(found) = sweep.next_triangle(Budget::EXACT).expect("answers") {
                assert_eq!(found.ended, Ended::Exact, "{}: {found:?}", scene.name);
                let number = found.triangle.expect("a whole blob");
                assert!(!std::mem::replace(&mut seen[number as usize], true));
                assert!(found.distance.lower >= last, "{}: {found:?} after {last}", scene.name);
                last = found.distance.lower;
                let truth = distance_to_triangle(p, scene.corners(number));
                let holds = f64::from(found.distance.lower) <= truth.upper
                    && truth.lower <= f64::from(found.distance.upper);
                assert!(holds, "{}: {p:?}: {found:?} {truth:?}", scene.name);
            }
            assert!(seen.into_iter().all(|seen| seen), "{}: {p:?}", scene.name);
        }
    }
}

#[test]
fn a_list_that_ends_early_says_how_near_the_rest_may_be() {
    let scene = Scene::hull("rough sphere", rough_sphere(3, 0.2, 7), &options(40));
    let model = scene.model();
    let p = [1.7, 0.3, -0.4];
    let mut all: Vec<f64> = (0..scene.triangles.len() as u32)
        .map(|t| distance_to_triangle(p, scene.corners(t)).upper)
        .collect();
    all.sort_by(f64::total_cmp);
    for (entries, steps) in [(20, u32::MAX), (4096, 30), (4096, 0)] {
        let mut scratch = vec![ScratchEntry::EMPTY; entries];
        let mut sweep = model.sweep(p, &mut scratch).expect("finite");
        let mut given = 0;
        loop {
            let stop = Budget::EXACT.with_steps(steps);
            let found = sweep.next_triangle(stop).expect("answers").expect("more are left");
            if found.ended != Ended::Exact {
                assert!(found.triangle.is_none(), "{found:?}");
                assert!(f64::from(found.distance.lower) <= all[given], "{found:?}");
                break;
            }
            given += 1;
        }
    }
}

#[test]
fn a_moved_sweep_on_a_cut_blob_contains_the_truth() {
    let scene = Scene::hull("rough sphere", rough_sphere(3, 0.2, 7), &options(40));
    let bytes = cut(&scene.model(), 2).expect("three levels").to_bytes();
    let model = Hull::open(&bytes).expect("opens");
    let mut scratch = vec![ScratchEntry::EMPTY; 2048];
    let mut rng = Rng::new(55);
    let path = path(&scene, 200, &mut rng);
    let mut sweep = model.sweep(path[0], &mut scratch).expect("finite");
    for p in path {
        sweep.move_to(p).expect("finite");
        let answer = sweep.closest_point(Budget::EXACT).expect("answers");
        contains_truth(&scene, p, &answer);
        assert_eq!((answer.ended, answer.triangle), (Ended::Resolution, None));
    }
}

#[test]
fn bad_questions_are_typed_errors_and_leave_the_sweep_whole() {
    let scene = Scene::hull("rough sphere", rough_sphere(2, 0.2, 7), &options(40));
    let model = scene.model();
    let mut scratch = vec![ScratchEntry::EMPTY; 512];
    assert_eq!(model.sweep([0.0; 3], &mut []).err(), Some(QueryError::NoScratch));
    let bad = [f32::NAN, 0.0, 0.0];
    assert_eq!(model.sweep(bad, &mut scratch).err(), Some(QueryError::NotFinite));
    let mut sweep = model.sweep([3.0, 0.0, 0.0], &mut scratch).expect("finite");
    assert_eq!(sweep.move_to(bad), Err(QueryError::NotFinite));
    let stop = Budget::EXACT.with_absolute(-1.0);
    assert_eq!(sweep.closest_point(stop), Err(QueryError::Tolerance));
    let far = [f32::MAX, 0.0, 1e30];
    sweep.move_to(far).expect("finite");
    contains_truth(&scene, far, &sweep.closest_point(Budget::EXACT).expect("answers"));
    sweep.move_to([3.0, 0.0, 0.0]).expect("finite");
    let answer = sweep.closest_point(Budget::EXACT).expect("answers");
    assert_eq!(answer.triangle, fresh(&model, [3.0, 0.0, 0.0]).triangle);
}

/// Points on a circle about the model, so many diagonals from its middle.
fn orbit(model: &Hull<'_>, diagonals: f64, step: f64, count: usize) -> Vec<[f32; 3]> {
    let [low, high] = model.bounds().map(|corner| corner.map(f64::from));
    let size = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    let place = |i: usize| {
        let (sine, cosine) = (i as f64 * step / diagonals).sin_cos();
        let way = [cosine, 0.8 * sine, 0.6 * sine];
        std::array::from_fn(|k| (0.5 * (low[k] + high[k]) + size * diagonals * way[k]) as f32)
    };
    let is_finite = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
    (0..count).map(place).filter(is_finite).collect()
}

/// How many answers along a path lack memory.
fn short_answers(model: &Hull<'_>, path: &[[f32; 3]], entries: usize) -> usize {
    let mut scratch = vec![ScratchEntry::EMPTY; entries];
    let mut sweep = model.sweep([0.0; 3], &mut scratch).expect("finite");
    let short = path.iter().filter(|&&p| {
        sweep.move_to(p).expect("finite");
        let near = sweep.closest_point(Budget::EXACT).expect("answers");
        near.ended == Ended::Scratch
    });
    short.count()
}

#[test]
fn no_answer_lacks_memory_with_the_entries_that_the_blob_names() {
    for scene in all() {
        let model = scene.model();
        let level = model.header().levels / 2;
        let bytes = cut(&model, level).ok().map(|tables| tables.to_bytes());
        let coarse = bytes.as_ref().map(|bytes| Hull::open(bytes).expect("opens"));
        for model in [Some(model), coarse].into_iter().flatten() {
            for diagonals in [0.001, 0.3, 1.0, 3.0, 10.0, 1000.0] {
                for step in [1e-4, 0.03] {
                    let path = orbit(&model, diagonals, step, 40);
                    let short = short_answers(&model, &path, model.sweep_entries());
                    assert_eq!(short, 0, "{}: {diagonals} diagonals away", scene.name);
                }
            }
            let mut scratch = vec![ScratchEntry::EMPTY; model.sweep_entries()];
            let far = orbit(&model, 1.0, 0.1, 1)[0];
            let mut sweep = model.sweep(far, &mut scratch).expect("finite");
            while let Some(found) = sweep.next_triangle(Budget::EXACT).expect("answers") {
                assert_ne!(found.ended, Ended::Scratch, "{}: {found:?}", scene.name);
            }
        }
    }
}

/// At 1e-4 rad a step the point goes farther than a step is wide near the model, but every point of
/// the model turns by little.
#[test]
fn orbits_far_away_are_answered_in_constant_time() {
    for name in ["torus", "bracket", "rough sphere", "two parts"] {
        let scene = all().iter().find(|scene| scene.name == name).expect("generated");
        let model = scene.model();
        for diagonals in [1.0, 3.0, 10.0, 30.0, 100.0] {
            let path = orbit(&model, diagonals, 1e-4 * diagonals, 500);
            let mut scratch = vec![ScratchEntry::EMPTY; model.sweep_entries()];
            let mut sweep = model.sweep(path[0], &mut scratch).expect("finite");
            let (mut constant, mut opened) = (0, 0);
            for &p in &path {
                sweep.move_to(p).expect("finite");
                let near = sweep.closest_point(Budget::EXACT).expect("answers");
                assert_eq!(near.ended, Ended::Exact);
                assert_eq!(near.triangle, fresh(&model, p).triangle);
                constant += usize::from(near.work.opened == 0);
                opened += near.work.opened;
            }
            assert!(constant > 350, "{name}: {diagonals}: {constant} of 500, {opened} opened");
            contains_truth(scene, path[499], &sweep.closest_point(Budget::EXACT).expect("answers"));
        }
    }
}

/// A short queue keeps less beyond the nearest triangle.
#[test]
fn a_queue_of_an_eighth_still_answers_orbits_in_constant_time() {
    for name in ["bracket", "rough sphere"] {
        let scene = all().iter().find(|scene| scene.name == name).expect("generated");
        let model = scene.model();
        for diagonals in [1.0, 10.0, 100.0] {
            let path = orbit(&model, diagonals, 1e-4 * diagonals, 500);
            let mut scratch = vec![ScratchEntry::EMPTY; model.sweep_entries() / 8];
            let mut sweep = model.sweep(path[0], &mut scratch).expect("finite");
            let (mut constant, mut opened, mut opened_fresh, mut short) = (0, 0, 0, 0);
            for &p in &path {
                sweep.move_to(p).expect("finite");
                let near = sweep.closest_point(Budget::EXACT).expect("answers");
                contains_truth(scene, p, &near);
                let new = fresh(&model, p);
                constant += usize::from(near.work.opened == 0);
                (opened, opened_fresh) =
                    (opened + near.work.opened, opened_fresh + new.work.opened);
                short += usize::from(near.ended == Ended::Scratch);
            }
            let said = format!("{name}: {diagonals}: {constant} {short} {opened} {opened_fresh}");
            assert!(short == 0 && constant > 250 && opened < opened_fresh, "{said}");
        }
    }
}

/// All of the surface is nearly equally far there.
#[test]
fn small_steps_with_a_short_queue_end_and_never_lose_the_distance() {
    let scene = Scene::hull("sphere", icosphere(4), &options(40));
    let model = scene.model();
    for entries in [1, 16, 64] {
        let mut scratch = vec![ScratchEntry::EMPTY; entries];
        let mut sweep = model.sweep([0.0; 3], &mut scratch).expect("a point");
        let budget = Budget::EXACT.with_steps(20);
        let ends = (0..10_000).find(|_| {
            let near = sweep.closest_point(budget).expect("a budget");
            assert!(near.distance.lower <= 1.0 && 0.99 <= near.distance.upper, "{near:?}");
            near.ended != Ended::Steps
        });
        assert!(ends.is_some(), "{entries} entries: no end");
    }
}

#[test]
fn the_middle_of_a_sphere_needs_more_than_a_short_queue() {
    let scene = Scene::hull("sphere", icosphere(4), &options(40));
    let model = scene.model();
    let middle = [[0.0; 3]];
    assert_eq!(short_answers(&model, &middle, model.sweep_entries()), 0);
    assert_eq!(short_answers(&model, &middle, model.sweep_entries() / 2), 0);
    assert_eq!(short_answers(&model, &middle, 16), 1);
}
