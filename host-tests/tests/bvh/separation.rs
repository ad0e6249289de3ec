//! The search of two trees in f32: verdicts next to the true distance of all triangles in 106 bits,
//! with no more steps or memory than were given, and nothing left to f64 where f32 can tell.

use meshsweep_core::{
    Budget, Bvh, Decided, PlacedModel, Pose, Scene as Models, ScratchEntry, Verdict,
};
use meshsweep_host_tests::generate::corpus::slivers;
use meshsweep_host_tests::generate::{
    Rng, Triangles, block, cube, icosphere, inverted, joined, needle_comb, plate, rough_sphere,
    scaled, torus,
};
use meshsweep_host_tests::motion::rotation;
use meshsweep_host_tests::oracle::{Bounded, distance_of_placed, placed};
use meshsweep_host_tests::scene::Scene;

fn stack() -> [ScratchEntry; Bvh::DISTANCE_ENTRIES] {
    [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES]
}

fn truth(scenes: [&Scene; 2], poses: &[Pose; 2]) -> Bounded {
    truth_among(scenes.map(|scene| (scene, scene.triangles.as_slice())), poses)
}

/// The distance of some triangles of each.
fn truth_among(some: [(&Scene, &[[u32; 3]]); 2], poses: &[Pose; 2]) -> Bounded {
    let trees = some.map(|(scene, triangles)| {
        let corner = |v: u32| scene.positions[v as usize];
        placed::Tree::new(triangles.iter().map(|t| t.map(corner)).collect())
    });
    if placed::distance(&trees[0].at(&poses[0]), &trees[1].at(&poses[1])) == 0.0 {
        // The other oracle is for models that do not meet.
        return Bounded { lower: 0.0, upper: 0.0 };
    }
    let [a, b] = some.map(|(scene, triangles)| (scene.positions.as_slice(), triangles));
    distance_of_placed((a, &poses[0]), (b, &poses[1]))
}

/// The triangles that a `Yes` names are as near as was asked.
fn is_witness(
    scenes: [&Scene; 2],
    poses: &[Pose; 2],
    found: &Decided<[u32; 2]>,
    distance: f32,
) -> bool {
    if found.verdict != Verdict::Yes {
        return true;
    }
    let named = found.witness.expect("a `Yes` names two triangles");
    let [i, j] = named.map(|number| number as usize);
    let named =
        [(scenes[0], &scenes[0].triangles[i..=i]), (scenes[1], &scenes[1].triangles[j..=j])];
    truth_among(named, poses).lower <= f64::from(distance)
}

#[derive(Debug, Default)]
struct Tally {
    asked: usize,
    /// Without a distance in f64.
    in_f32: usize,
    clear: usize,
    near: usize,
}

/// Asks about a pair of models on the grid, in the frame of the first and in the world, at
/// distances next to the true one.
fn holds(scenes: [&Scene; 2], poses: &[Pose; 2], tally: &mut Tally) {
    let truth = truth(scenes, poses);
    let [a, b] = scenes.map(|scene| scene.trees()[0]);
    let placed = [PlacedModel::new(a, poses[0]), PlacedModel::new(b, poses[1])];
    let placed: Option<Vec<_>> = placed.into_iter().map(Result::ok).collect();
    let size = a.bounds().iter().flatten().fold(0f32, |most, x| most.max(x.abs()));
    let (below, above) = ((truth.lower as f32).next_down(), (truth.upper as f32).next_up());
    for part in [0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5] {
        for (distance, is_near) in [(above + part * size, true), (below - part * size, false)] {
            if distance < 0.0 {
                continue;
            }
            let mut check = |verdict: Verdict, exact: u32| {
                let wrong = if is_near { Verdict::No } else { Verdict::Yes };
                assert_ne!(verdict, wrong, "{truth:?} {distance:e} {poses:?}");
                tally.asked += 1;
                tally.in_f32 += usize::from(exact == 0);
                tally.clear += usize::from(verdict == Verdict::No);
                tally.near += usize::from(verdict == Verdict::Yes);
            };
            if poses[0] == Pose::IDENTITY {
                let exact = Budget::EXACT;
                let found = a.within_of(&b, poses[1], distance, exact, &mut stack()).expect("asks");
                assert!(is_witness(scenes, poses, &found, distance), "{found:?} {distance:e}");
                check(found.verdict, found.work.exact);
            }
            if let Some(models) = &placed {
                let scene = Models::new(models);
                let found = scene.within(distance, |_, _| true, Budget::EXACT, &mut stack());
                let found = found.expect("asks");
                check(found.verdict, found.work.exact);
            }
        }
    }
}

fn shapes() -> Vec<Triangles> {
    vec![
        torus(2.0, 0.6, 12, 6),
        rough_sphere(1, 0.4, 5),
        block([-3.0, -0.2, -0.1], [4.0, 0.3, 0.2]),
        cube(2),
        needle_comb(),
        slivers(30, 5, true),
        plate([0.1, 0.2], 0.01),
    ]
}

/// Near each other, as a matrix of this kind carries the second.
fn poses(kind: usize, scale: f32, rng: &mut Rng) -> [Pose; 2] {
    let mut rows = rotation(rng);
    let is_any = match kind % 4 {
        1 => {
            rows[2] = rows[2].map(|x| -x);
            true
        }
        2 => {
            rows = [(); 3].map(|()| [(); 3].map(|()| rng.range(-1.2, 1.2)));
            true
        }
        _ => false,
    };
    let translation = rng.direction().map(|x| scale * x * rng.range(0.5, 5.0));
    let second = Pose { rotation: rows, translation, is_affine: is_any };
    if !kind.is_multiple_of(3) {
        return [Pose::IDENTITY, second];
    }
    let base = rng.direction().map(|x| scale * x * [0.0, 3.0, 300.0][rng.below(3)]);
    let first = Pose::rigid(rotation(rng), base);
    let translation = [0, 1, 2].map(|k: usize| base[k] + translation[k]);
    [first, Pose { translation, ..second }]
}

#[test]
fn no_verdict_is_wrong_next_to_the_distance_at_any_scale_and_pose() {
    let mut rng = Rng::new(341);
    let mut tally = Tally::default();
    let shapes = shapes();
    for round in 0..72 {
        let scale = [1.0, 1e-30, 1e30, 1e-3][round % 4];
        let [a, b] =
            [(); 2].map(|()| Scene::both("", scaled(&shapes[rng.below(shapes.len())], scale)));
        holds([&a, &b], &poses(round / 4, scale, &mut rng), &mut tally);
    }
    println!("{tally:?}");
    assert!(tally.in_f32 > tally.asked / 3, "{tally:?}");
    assert!(tally.clear > tally.asked / 10 && tally.near > tally.asked / 4, "{tally:?}");
}

#[test]
fn models_that_touch_cross_or_hold_one_another_are_told_by_their_surfaces() {
    let mut rng = Rng::new(342);
    let mut tally = Tally::default();
    let cubes = [Scene::both("", cube(2)), Scene::both("", scaled(&cube(1), 3.0))];
    let (low, high) = cubes[0].bounds();
    let side = high[0] - low[0];
    for translation in [[side, 0.0, 0.0], [2.0 * side, 0.25 * side, side], [0.0; 3]] {
        let poses = [Pose::IDENTITY, Pose { translation, ..Pose::IDENTITY }];
        holds([&cubes[0], &cubes[0]], &poses, &mut tally);
        holds([&cubes[0], &cubes[1]], &poses, &mut tally);
    }
    let shell = Scene::both("", joined(&scaled(&cube(3), 8.0), &inverted(&icosphere(2))));
    let ball = Scene::both("", scaled(&rough_sphere(2, 0.3, 1), 0.3));
    for _ in 0..6 {
        let place = rng.point_in([-0.3; 3], [0.3; 3]);
        let poses = [Pose::IDENTITY, Pose::rigid(rotation(&mut rng), place)];
        holds([&shell, &ball], &poses, &mut tally);
        holds([&ball, &shell], &poses, &mut tally);
    }
    assert!(tally.clear > 50 && tally.near > 50, "{tally:?}");
}

#[test]
fn few_steps_and_little_memory_change_no_verdict_but_to_undecided() {
    let mut rng = Rng::new(343);
    let shapes = shapes();
    let (mut cut, mut whole) = (0, 0);
    for round in 0..40 {
        let [a, b] = [(); 2].map(|()| Scene::both("", shapes[rng.below(shapes.len())].clone()));
        let poses = poses(round, 1.0, &mut rng);
        let truth = truth([&a, &b], &poses);
        let [a, b] = [&a, &b].map(|scene| scene.trees()[0]);
        let Ok(models) = PlacedModel::new(a, poses[0])
            .and_then(|first| Ok([first, PlacedModel::new(b, poses[1])?]))
        else {
            continue;
        };
        let scene = Models::new(&models);
        for part in [0.5, 0.99, 1.01, 2.0] {
            let distance = truth.upper as f32 * part;
            let exact = scene.within(distance, |_, _| true, Budget::EXACT, &mut stack());
            let exact = exact.expect("asks");
            for steps in [1, 2, 3, 5, 8, 20, 100] {
                for entries in [1, 2, 4, 9, 30, Bvh::DISTANCE_ENTRIES] {
                    let budget = Budget::EXACT.with_steps(steps);
                    let memory = &mut stack()[..entries];
                    let found = scene.within(distance, |_, _| true, budget, memory).expect("asks");
                    assert!(found.work.opened <= steps, "{found:?} {steps}");
                    match found.verdict {
                        Verdict::Undecided(_) => cut += 1,
                        verdict => {
                            assert_eq!(verdict, exact.verdict, "{found:?} {exact:?}");
                            whole += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(cut > 500 && whole > 500, "{cut} {whole}");
}

#[test]
fn an_edge_that_a_matrix_squashes_is_not_taken_for_shorter_than_it_is() {
    let long = (1 << 20) as f32;
    let first = vec![[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0]];
    let second = vec![[0.0; 3], [0.0, long, 0.0], [0.0, 0.0, long]];
    let [a, b] = [first, second].map(|corners| Scene::both("", (corners, vec![[0, 1, 2]])));
    // The matrix takes the long edge nearly across the direction of the gap.
    let across = -0.85 / (1u32 << 29) as f32;
    let rows = [[1.0, across, 0.0], [0.0; 3], [0.0; 3]];
    let mut tally = Tally::default();
    for part in [0.25, 0.5, 1.0, 2.0, 4.0] {
        let rows = rows.map(|[x, y, z]| [x, part * y, z]);
        for ahead in [0.0031, 0.01, 0.1] {
            let pose = Pose::affine(rows, [ahead * part, 0.0, 0.0]);
            holds([&a, &b], &[Pose::IDENTITY, pose], &mut tally);
        }
    }
    assert!(tally.clear > 20 && tally.near > 20, "{tally:?}");
}

/// Triangles whose vertices are on the grid, so that nothing but the search rounds.
fn on_the_grid(rng: &mut Rng, size: f32) -> Triangles {
    let triangles = 1 + rng.below(12);
    let flat = rng.below(4);
    let vertex = |rng: &mut Rng| {
        let mut vertex = [(); 3].map(|()| rng.range(-8000.0, 8000.0).round());
        if let Some(x) = vertex.get_mut(flat) {
            *x = 0.0;
        }
        vertex.map(|x| x * size)
    };
    let corners = (0..3 * triangles).map(|_| vertex(rng)).collect();
    (corners, (0..triangles as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}

#[test]
fn no_verdict_is_wrong_of_models_of_other_sizes_and_matrices_that_squash_or_shear() {
    let mut rng = Rng::new(344);
    let mut tally = Tally::default();
    for round in 0..400 {
        let size = [1.0, 1.0, 4096.0, 1.0 / 4096.0, 1_048_576.0, 1.0 / 1_048_576.0][round % 6];
        let [a, b] = [1.0, size].map(|size| Scene::both("", on_the_grid(&mut rng, size)));
        let mut rows = rotation(&mut rng);
        if round % 3 == 1 {
            rows = rows.map(|row| row.map(|x| x * rng.range(0.0, 1.3)));
        }
        if round % 3 == 2 {
            let squash = [0, 1, 2].map(|_: i32| [1.0, 1e-3, 1e-6, 1e-9, 0.0][rng.below(5)]);
            rows = rows.map(|row| [0, 1, 2].map(|k: usize| row[k] * squash[k]));
        }
        let away = 8000.0 * f32::max(1.0, size) * [0.0, 0.5, 2.0, 300.0][rng.below(4)];
        let translation = rng.direction().map(|x| x * away);
        let second = Pose { rotation: rows, translation, is_affine: round % 3 != 0 };
        holds([&a, &b], &[Pose::IDENTITY, second], &mut tally);
    }
    assert!(tally.clear > 1000 && tally.near > 1000, "{tally:?}");
}
