//! A hull hierarchy against a triangle and against another one: the exact predicates on the input,
//! and the box tree.

use super::scenes::{all, options};
use meshsweep::cut::cut;
use meshsweep::hull::BuildOptions;
use meshsweep::surface::VertexBits;
use meshsweep_core::{
    Budget, Bvh, Decided, Ended, Hull, Pose, QueryError, ScratchEntry, TrianglePair, Undecided,
    Verdict,
};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, groove_block, icosphere, needle_comb, rough_sphere, scaled,
    torus, transformed, two_parts,
};
use meshsweep_host_tests::motion::{Tally, motions, placed, rotation, truth};
use meshsweep_host_tests::scene::Scene;

type Corners = [[f32; 3]; 3];

fn scratch(a: &Hull<'_>, b: &Hull<'_>) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; a.overlap_entries(b)]
}

fn ask(a: &Hull<'_>, b: &Hull<'_>, pose: &Pose) -> Decided<[u32; 2]> {
    a.overlap(b, *pose, Budget::EXACT, &mut scratch(a, b)).expect("answers")
}

/// Holds an answer and the list of all pairs to the exact pairs.
fn holds(a: &Scene, b: &Scene, pose: &Pose, tally: &mut Tally) {
    let truth = truth(a, b, pose);
    let (first, second) = (a.model(), b.model());
    let say = format!("{}, {}, {pose:?}", a.name, b.name);
    let answer = ask(&first, &second, pose);
    tally.hold(&answer, &truth, &say);
    let mut pairs = vec![TrianglePair::EMPTY; truth.len() + 10_000];
    let found = first
        .all_overlaps(&second, *pose, &mut pairs, Budget::EXACT, &mut scratch(&first, &second))
        .expect("answers");
    assert_eq!(found.dropped, 0);
    let pairs = &pairs[..found.stored];
    let mut listed: Vec<[u32; 2]> = pairs.iter().map(|pair| pair.triangles).collect();
    listed.sort_unstable();
    assert!(listed.is_sorted_by(|x, y| x < y), "{say}: a pair is listed twice");
    for pair in &truth {
        assert!(listed.binary_search(pair).is_ok(), "{say}: {pair:?} is missing");
    }
    for pair in pairs.iter().filter(|pair| pair.is_certain) {
        assert!(truth.contains(&pair.triangles), "{say}: {pair:?} do not meet");
    }
    let is_certain = |pair: &TrianglePair| pair.is_certain;
    let ended = if pairs.iter().all(is_certain) { Ended::Exact } else { Ended::Resolution };
    assert_eq!(found.ended, ended, "{say}");
    assert_eq!(answer.verdict == Verdict::No, pairs.is_empty(), "{say}");
    assert_eq!(answer.verdict == Verdict::Yes, pairs.iter().any(is_certain), "{say}");
}

fn check(a: &Scene, b: &Scene, count: usize, seed: u64) -> Tally {
    let mut tally = Tally::default();
    for pose in motions(a, b, count, seed) {
        holds(a, b, &pose, &mut tally);
    }
    assert!(tally.apart > 0 && tally.meets > 0, "{}, {}: {tally:?}", a.name, b.name);
    tally
}

fn hull(name: &str, mesh: Triangles) -> Scene {
    Scene::hull(name, mesh, &options(40))
}

#[test]
fn moved_solids_meet_exactly_where_their_input_does() {
    let pairs = [
        (hull("torus", torus(2.0, 0.75, 20, 10)), hull("torus", torus(2.0, 0.75, 20, 10)), 40),
        (hull("sphere", icosphere(2)), hull("rough sphere", rough_sphere(2, 0.4, 3)), 40),
        (hull("cube", cube(1)), hull("cube", cube(4)), 60),
        (hull("needles", needle_comb()), hull("cube", cube(3)), 30),
        (hull("grooves", groove_block()), hull("parts", two_parts()), 20),
        (hull("bracket", bracket()), hull("rough sphere", rough_sphere(2, 0.8, 7)), 16),
    ];
    for (seed, (a, b, count)) in (1..).zip(pairs) {
        assert_eq!(check(&a, &b, count, seed).open, 0, "{}, {}", a.name, b.name);
    }
}

#[test]
fn models_of_very_different_size_are_told_apart() {
    let a = hull("torus", torus(2.0, 0.75, 16, 8));
    for (factor, seed) in [(1.0 / 64.0, 12), (37.0, 13), (1.0 / 65_536.0, 14), (1e-9, 15)] {
        let b = hull("small", scaled(&rough_sphere(1, 0.3, 4), factor));
        let mut tally = Tally::default();
        for pose in motions(&a, &b, 20, seed) {
            holds(&a, &b, &pose, &mut tally);
            holds(&b, &a, &pose, &mut tally);
        }
        // The small one beside a vertex of the large one, so that it is met.
        for vertex in [5, 17, 40] {
            let pose = placed(&b, IDENTITY, a.positions[vertex]);
            holds(&a, &b, &pose, &mut tally);
        }
        assert!(tally.apart > 0 && tally.meets + tally.open > 0, "{factor}: {tally:?}");
    }
}

#[test]
fn extreme_scales_and_far_origins_change_no_answer() {
    for scale in [1e30, 1e-30] {
        let a = hull("scaled", scaled(&torus(2.0, 0.75, 12, 8), scale));
        let b = hull("scaled", scaled(&rough_sphere(1, 0.5, 1), scale));
        assert_eq!(check(&a, &b, 20, 2).open, 0);
    }
    let far = [1e6, -1.5e6, 2e6];
    let a = hull("far", transformed(&scaled(&torus(2.0, 0.75, 16, 8), 64.0), IDENTITY, far));
    let b = hull("near", scaled(&rough_sphere(2, 0.5, 1), 64.0));
    let mut tally = Tally::default();
    let mut rng = Rng::new(4);
    for _ in 0..20 {
        let offset = rng.point_in([-250.0; 3], [250.0; 3]);
        let place = std::array::from_fn(|k| far[k] + offset[k]);
        holds(&a, &b, &placed(&b, rotation(&mut rng), place), &mut tally);
        holds(&b, &a, &placed(&a, rotation(&mut rng), offset), &mut tally);
    }
    assert!(tally.meets > 0 && tally.apart > 0, "{tally:?}");
}

#[test]
fn matrices_need_not_be_rotations() {
    let (a, b) = (hull("torus", torus(2.0, 0.75, 16, 8)), hull("rough", rough_sphere(2, 0.5, 1)));
    let matrices = [
        [[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
        [[1.5, 0.7, 0.0], [-0.4, 0.6, 1.1], [0.2, 2.0, -1.0]],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.2, 0.0]],
        [[1e-20, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0; 3]; 3],
    ];
    let mut rng = Rng::new(5);
    let mut tally = Tally::default();
    for matrix in matrices {
        for _ in 0..8 {
            let place = rng.point_in([-4.0, -4.0, -2.0], [4.0, 4.0, 2.0]);
            holds(&a, &b, &Pose { is_affine: true, ..placed(&b, matrix, place) }, &mut tally);
        }
    }
    assert!(tally.meets > 0 && tally.apart > 0, "{tally:?}");
}

#[test]
fn surfaces_that_touch_are_open_and_a_model_inside_another_is_apart() {
    let shifted = |by| Pose::rigid(IDENTITY, by);
    let scene = Scene::hull("cube", cube(2), &options(12));
    let model = scene.model();
    for by in [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [2.0, -2.0, 2.0], [0.5, 2.0, 0.25]] {
        let answer = ask(&model, &model, &shifted(by));
        assert_eq!(answer.verdict, Verdict::Undecided(Undecided::Resolution), "{by:?}");
    }
    for gap in [1e-3f32, 1e-6] {
        let by = |x| shifted([0.125, x, 0.0625]);
        assert_eq!(ask(&model, &model, &by(2.0 + gap)).verdict, Verdict::No);
        assert_eq!(ask(&model, &model, &by(2.0 - gap)).verdict, Verdict::Yes);
    }
    let (shell, core) = (hull("shell", icosphere(3)), hull("core", torus(0.4, 0.2, 12, 8)));
    let mut tally = Tally::default();
    for by in [[0.05, 0.0, -0.1], [0.2, -0.1, 0.0]] {
        holds(&shell, &core, &shifted(by), &mut tally);
    }
    assert_eq!(tally.apart, 2);
    for translation in [[f32::MAX, 0.0, 0.0], [0.0, -1e30, 1e30], [0.0, 0.0, 2.01]] {
        assert_eq!(ask(&model, &model, &shifted(translation)).verdict, Verdict::No);
    }
}

#[test]
fn moved_vertices_are_answered_for_the_input() {
    let bits = |vertex_bits| BuildOptions { vertex_bits, ..options(40) };
    let grid = bits(VertexBits::Grid16);
    let a = Scene::hull("rough, 16 bits", rough_sphere(3, 0.2, 7), &grid);
    let b = Scene::hull("torus, 16 bits", torus(2.0, 0.75, 20, 10), &grid);
    assert!(a.model().surface_error() > 0.0);
    check(&a, &b, 40, 8);
    // Nearer than the surface errors: open, in both directions.
    let vertex = a.positions.iter().copied().max_by(|p, q| p[0].total_cmp(&q[0])).expect("one");
    let most = b.positions.iter().fold(f32::MAX, |least, p| least.min(p[0]));
    let by = vertex[0] - most + 0.5 * a.model().surface_error();
    let pose = Pose::rigid(IDENTITY, [by, 0.0, 0.0]);
    let answer = ask(&a.model(), &b.model(), &pose);
    assert_ne!(answer.verdict, Verdict::Yes);
}

#[test]
fn hulls_and_box_trees_never_contradict_each_other() {
    let (torus, sphere) = (torus(2.0, 0.75, 20, 10), rough_sphere(2, 0.4, 3));
    let hulls = [hull("torus", torus.clone()), hull("sphere", sphere.clone())];
    let trees = [Scene::both("torus", torus), Scene::both("sphere", sphere)];
    let mut decided = 0;
    for pose in motions(&hulls[0], &hulls[1], 300, 31) {
        let by_hull = ask(&hulls[0].model(), &hulls[1].model(), &pose).verdict;
        for (a, b) in trees[0].trees().iter().zip(trees[1].trees()) {
            let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
            let by_tree = a.overlap(&b, pose, Budget::EXACT, &mut stack).expect("answers").verdict;
            let both = [by_hull, by_tree];
            if both.iter().all(|verdict| !matches!(verdict, Verdict::Undecided(_))) {
                assert_eq!(by_hull, by_tree, "{pose:?}");
                decided += 1;
            }
        }
    }
    assert!(decided > 500, "{decided}");
}

/// The blob cut after each of its levels, the finest last.
fn cut_blobs(scene: &Scene) -> Vec<Vec<u8>> {
    let levels = scene.model().levels().count() as u32;
    (0..levels).map(|level| cut(&scene.model(), level).expect("cuts").to_bytes()).collect()
}

#[test]
fn cut_blobs_are_never_wrongly_apart_and_never_certain_to_meet() {
    let (a, b) = (hull("torus", torus(2.0, 0.75, 20, 10)), hull("rough", rough_sphere(2, 0.4, 3)));
    let poses: Vec<_> = motions(&a, &b, 40, 17);
    let (mut apart, mut open) = (0, 0);
    for bytes in &cut_blobs(&a) {
        let model = Hull::open(bytes).expect("opens");
        if !model.is_cut() {
            continue;
        }
        for pose in &poses {
            let meets = !truth(&a, &b, pose).is_empty();
            let answer = ask(&model, &b.model(), pose);
            let mut pairs = [TrianglePair::EMPTY; 4];
            let all = model
                .all_overlaps(
                    &b.model(),
                    *pose,
                    &mut pairs,
                    Budget::EXACT,
                    &mut scratch(&model, &model),
                )
                .expect("answers");
            assert_eq!((answer.witness, all.stored), (None, 0));
            if answer.verdict == Verdict::No {
                assert!(!meets, "wrongly apart: {pose:?}");
                assert_eq!(all.ended, Ended::Exact);
                apart += 1;
            } else {
                assert_eq!(answer.verdict, Verdict::Undecided(Undecided::Resolution));
                assert_eq!(all.ended, Ended::Resolution);
                open += 1;
            }
        }
    }
    assert!(apart > 30 && open > 30, "{apart} {open}");
}

#[test]
fn the_named_memory_is_enough_and_less_is_never_a_wrong_answer() {
    let (a, b) = (hull("bracket", bracket()), hull("rough", rough_sphere(3, 0.6, 1)));
    let (first, second) = (a.model(), b.model());
    let (mut short, mut stopped) = (0, 0);
    for scale in [1.0, 40.0] {
        let b = hull("rough", scaled(&rough_sphere(3, 0.6, 1), scale));
        let second = b.model();
        for pose in motions(&a, &b, 30, 6) {
            let full = ask(&first, &second, &pose);
            assert!(!matches!(full.verdict, Verdict::Undecided(_)));
            for entries in [1, 4, 16, 48] {
                let mut stack = vec![ScratchEntry::EMPTY; entries];
                let answer =
                    first.overlap(&second, pose, Budget::EXACT, &mut stack).expect("answers");
                if answer.verdict == Verdict::Undecided(Undecided::Scratch) {
                    short += 1;
                } else {
                    assert_eq!(answer.verdict, full.verdict);
                }
            }
            for steps in [0, 1, 5, 100] {
                let budget = Budget::EXACT.with_steps(steps);
                let mut stack = scratch(&first, &second);
                let answer = first.overlap(&second, pose, budget, &mut stack).expect("answers");
                assert!(answer.work.opened <= steps);
                if answer.verdict == Verdict::Undecided(Undecided::Steps) {
                    stopped += 1;
                } else {
                    assert_eq!((answer.verdict, answer.witness), (full.verdict, full.witness));
                }
            }
        }
    }
    assert!(short > 20 && stopped > 20, "{short} {stopped}");
    let mut empty: [ScratchEntry; 0] = [];
    let none = first.overlap(&second, Pose::IDENTITY, Budget::EXACT, &mut empty);
    assert_eq!(none, Err(QueryError::NoScratch));
}

#[test]
fn poses_that_cannot_be_answered_are_refused() {
    let scene = Scene::hull("cube", cube(2), &options(12));
    let tiny = Scene::hull("tiny", scaled(&cube(2), 1e-20), &options(12));
    let (model, small) = (scene.model(), tiny.model());
    let refused = |a: &Hull<'_>, b: &Hull<'_>, pose: Pose| {
        a.overlap(b, pose, Budget::EXACT, &mut scratch(a, b)).expect_err("refused")
    };
    for bad in [f32::NAN, f32::INFINITY] {
        let mut pose = Pose::IDENTITY;
        pose.translation[1] = bad;
        assert_eq!(refused(&model, &model, pose), QueryError::NotFinite);
        pose = Pose::IDENTITY;
        pose.rotation[2][0] = bad;
        assert_eq!(refused(&model, &model, pose), QueryError::NotFinite);
    }
    let mut stretched = Pose::IDENTITY;
    stretched.rotation[0][0] = 2.5;
    assert_eq!(refused(&model, &model, stretched), QueryError::PoseOutOfDomain);
    assert_eq!(refused(&model, &small, Pose::IDENTITY), QueryError::PoseOutOfDomain);
    assert_eq!(refused(&small, &model, Pose::IDENTITY), QueryError::PoseOutOfDomain);
}

fn triangle_scene(corners: Corners) -> Scene {
    Scene::of_mesh("triangle", (corners.to_vec(), vec![[0, 1, 2]]))
}

fn ask_triangle(model: &Hull<'_>, corners: Corners) -> Decided<u32> {
    let mut stack = vec![ScratchEntry::EMPTY; model.scratch_entries() + 20];
    model.meets_triangle(corners, Budget::EXACT, &mut stack).expect("answers")
}

/// Triangles across the model, inside it, beside it, on its surface, next to nothing and beyond it.
fn triangles(scene: &Scene, count: usize, seed: u64) -> Vec<Corners> {
    let mut rng = Rng::new(seed);
    let size = scene.size();
    (0..count)
        .map(|i| {
            let near = scene.around(1.2, &mut rng);
            let mut beside = |by: f32| near.map(|x| x + by * size * rng.range(-1.0, 1.0));
            match i % 6 {
                0 => [near, beside(0.05), beside(0.05)],
                1 => [near, beside(0.5), beside(0.01)],
                2 => [near, beside(1e-3), beside(1e-3)],
                3 => [beside(3.0), beside(3.0), beside(3.0)],
                // A segment, which has no area.
                4 => {
                    let end = beside(0.7);
                    [near, end, end]
                }
                _ => scene.corners(rng.below(scene.triangles.len()) as u32),
            }
        })
        .collect()
}

#[test]
fn a_triangle_meets_the_surface_exactly_where_it_does() {
    let mut tally = Tally::default();
    for scene in all() {
        let model = scene.model();
        // Far from the origin random corners are rounded to the surface.
        let is_exact =
            model.surface_error() == 0.0 && scene.reach() < 1e3 * f64::from(scene.size());
        for (i, corners) in triangles(scene, 48, 41).into_iter().enumerate() {
            let truth = truth(scene, &triangle_scene(corners), &Pose::IDENTITY);
            let answer = ask_triangle(&model, corners);
            let say = format!("{}: {corners:?}: {answer:?}", scene.name);
            let truth: Vec<u32> = truth.iter().map(|&[triangle, _]| triangle).collect();
            tally.hold(&answer, &truth, &say);
            // In general position only an inexact mesh leaves it open.
            let is_open = matches!(answer.verdict, Verdict::Undecided(_));
            assert!(!is_open || !is_exact || i % 6 == 5, "{say}");
        }
    }
    assert!(tally.apart > 100 && tally.meets > 100 && tally.open > 30, "{tally:?}");
}

#[test]
fn triangles_of_any_size_and_triangles_without_area_are_defined() {
    let scene = Scene::hull("cube", cube(4), &options(12));
    let model = scene.model();
    let verdict = |corners| ask_triangle(&model, corners).verdict;
    let open = Verdict::Undecided(Undecided::Resolution);
    // Points.
    assert_eq!(verdict([[0.3, 0.2, 0.1]; 3]), Verdict::No);
    assert_eq!(verdict([[1.0, 0.2, 0.1]; 3]), open);
    assert_eq!(verdict([[1.5, 0.2, 0.1]; 3]), Verdict::No);
    assert_eq!(verdict([[f32::from_bits(1), 0.0, 0.0]; 3]), Verdict::No);
    // Segments, the corners in any order.
    let (inside, outside) = ([0.3, 0.2, 0.1], [1.7, 0.2, 0.1]);
    for corners in
        [[inside, inside, outside], [inside, outside, outside], [outside, inside, outside]]
    {
        assert_eq!(verdict(corners), Verdict::Yes);
        assert_eq!(verdict(corners.map(|p| p.map(|x| 0.5 * x))), Verdict::No);
    }
    // A segment through a face, and a point on its middle.
    assert_eq!(verdict([inside, [1.0, 0.2, 0.1], outside]), Verdict::Yes);
    // A floor of any size through the solid, and one below it.
    for exponent in 0..=38 {
        let far = 2f32.powi(exponent);
        let floor = |z: f32| [[-far, -far, z], [3.0 * far, -far, z], [-far, 3.0 * far, z]];
        let [through, below] = [floor(0.3), floor(-1.5)].map(verdict);
        assert_eq!(below, Verdict::No, "2^{exponent}");
        assert!(through != Verdict::No, "2^{exponent}");
        assert!(through == Verdict::Yes || exponent > 25, "2^{exponent}: {through:?}");
    }
    let mut stack = [ScratchEntry::EMPTY; 64];
    let mut refused = |x: f32| {
        let corners = [inside, outside, [x, 0.0, 0.0]];
        model.meets_triangle(corners, Budget::EXACT, &mut stack).expect_err("refused")
    };
    assert_eq!(refused(f32::NAN), QueryError::NotFinite);
    assert_eq!(refused(f32::NEG_INFINITY), QueryError::NotFinite);
    assert_eq!(refused(1e30), QueryError::OutOfDomain);
    assert_eq!(refused(2f32.powi(41)), QueryError::OutOfDomain);
    let none = model.meets_triangle([inside; 3], Budget::EXACT, &mut []);
    assert_eq!(none, Err(QueryError::NoScratch));
}

#[test]
fn on_a_cut_blob_a_triangle_is_never_wrongly_apart() {
    let scene = hull("rough", rough_sphere(3, 0.4, 3));
    let asked = triangles(&scene, 60, 43);
    let (mut apart, mut open) = (0, 0);
    for bytes in &cut_blobs(&scene) {
        let model = Hull::open(bytes).expect("opens");
        if !model.is_cut() {
            continue;
        }
        for &corners in &asked {
            let answer = ask_triangle(&model, corners);
            assert_eq!(answer.witness, None);
            if answer.verdict == Verdict::No {
                let truth = truth(&scene, &triangle_scene(corners), &Pose::IDENTITY);
                assert!(truth.is_empty(), "{corners:?}");
                apart += 1;
            } else {
                assert_eq!(answer.verdict, Verdict::Undecided(Undecided::Resolution));
                open += 1;
            }
        }
    }
    assert!(apart > 30 && open > 30, "{apart} {open}");
}
