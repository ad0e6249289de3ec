//! Every interval contains the true distance, and every verdict is true.

use super::shapes::Shape;
use meshsweep_core::internal::geom::convex_gap;
use meshsweep_core::{Budget, Bvh, Ended, ScratchEntry, SolidDistance, Verdict};
use meshsweep_host_tests::generate::corpus::{IDENTITY, mixed, slivers};
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, cube, needle_comb, rough_sphere, scaled, torus, two_parts,
};
use meshsweep_host_tests::oracle::{Bounded, distance_of_moved_triangles};
use meshsweep_host_tests::scene::Scene;

#[derive(Debug, Default)]
struct Tally {
    apart: usize,
    meets: usize,
    open: usize,
}

pub fn ask(tree: &Bvh<'_>, shape: &Shape, budget: Budget) -> SolidDistance {
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    tree.solid_distance(&shape.solid(), budget, &mut stack).expect("answers")
}

/// Whether an interval contains a distance less a radius.
pub fn contains(found: &SolidDistance, truth: Bounded, radius: f32) -> bool {
    let rest = |x: f64| (x - f64::from(radius)).max(0.0);
    f64::from(found.distance.lower) <= rest(truth.upper)
        && rest(truth.lower) <= f64::from(found.distance.upper)
}

fn holds(scene: &Scene, shape: &Shape, tally: &mut Tally) {
    let truth = shape.truth(scene);
    let [low, high] = [truth.lower, truth.upper].map(|x| (x - f64::from(shape.radius)).max(0.0));
    for tree in scene.trees() {
        let found = ask(&tree, shape, Budget::EXACT);
        assert!(contains(&found, truth, shape.radius), "{shape:?} {found:?} {truth:?}");
        assert_eq!(found.ended, Ended::Exact);
        let corners = shape.corners.iter().flatten().fold(0f64, |m, x| m.max(f64::from(x.abs())));
        let size = corners + scene.reach();
        let width = f64::from(found.distance.upper) - f64::from(found.distance.lower);
        let error = f64::from(tree.surface_error());
        assert!(width <= 2.0 * error + 1e-6 * size, "{shape:?} {found:?} {truth:?}");
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        for distance in [0.0, 0.5 * low, low, high, 2.0 * high, 0.01 * size] {
            let distance = distance as f32;
            let within = tree
                .solid_within(&shape.solid(), distance, Budget::EXACT, &mut stack)
                .expect("answers");
            match within.verdict {
                Verdict::Yes => {
                    assert!(low <= f64::from(distance), "{shape:?} {within:?} {truth:?}")
                }
                Verdict::No => {
                    assert!(high > f64::from(distance), "{shape:?} {within:?} {truth:?}")
                }
                _ => {
                    let doubt = 2.0 * error + 1e-6 * size;
                    assert!(
                        (f64::from(distance) - low).abs() <= doubt,
                        "{shape:?} {within:?} {truth:?}"
                    );
                }
            }
            match within.verdict {
                Verdict::Yes => tally.meets += 1,
                Verdict::No => tally.apart += 1,
                _ => tally.open += 1,
            }
        }
    }
}

fn check(name: &str, mesh: Triangles, count: usize, seed: u64) {
    let scene = Scene::both(name, mesh);
    let mut rng = Rng::new(seed);
    let mut tally = Tally::default();
    for kind in 0..count {
        let at = match kind / 5 % 3 {
            0 => scene.around(2.0, &mut rng),
            1 => scene.on_surface(&mut rng),
            _ => scene.vertex(&mut rng),
        };
        holds(&scene, &Shape::random(kind, at, scene.size(), &mut rng), &mut tally);
    }
    assert!(tally.apart > count / 2 && tally.meets > count / 4, "{name}: {tally:?}");
}

#[test]
fn distances_of_solids_from_solids_are_those_of_the_input() {
    check("torus", torus(2.0, 0.75, 16, 8), 60, 1);
    check("rough sphere", rough_sphere(2, 0.4, 3), 60, 2);
    check("cube", cube(2), 60, 3);
    check("bracket", bracket(), 30, 4);
    check("parts", two_parts(), 30, 5);
}

#[test]
fn distances_from_needles_slivers_and_soups_are_those_of_the_input() {
    check("needles", needle_comb(), 45, 6);
    for along in [false, true] {
        check("slivers", slivers(60, 8, along), 45, 8);
    }
    check("mixed", mixed(80, 10), 45, 10);
}

#[test]
fn scale_and_a_far_origin_do_not_matter() {
    for (factor, seed) in [(1e-30, 11), (1e-6, 12), (1e6, 13), (1e30, 14)] {
        check("scaled", scaled(&torus(2.0, 0.75, 12, 8), factor), 30, seed);
    }
    let (mut positions, triangles) = rough_sphere(1, 0.3, 2);
    positions.iter_mut().for_each(|p| *p = [p[0] + 1e4, p[1] - 2e4, p[2] + 3e3]);
    check("far origin", (positions, triangles), 30, 15);
}

#[test]
fn vertices_that_were_moved_speak_of_the_input() {
    for (by, seed) in [(1e-2f32, 16), (1e-4, 17)] {
        let scene = Scene::moved("moved", torus(2.0, 0.75, 16, 8), by, seed);
        let mut rng = Rng::new(seed);
        let mut tally = Tally::default();
        for kind in 0..30 {
            let at = scene.around(1.2, &mut rng);
            holds(&scene, &Shape::random(kind, at, scene.size(), &mut rng), &mut tally);
        }
        assert!(tally.apart > 10 && tally.meets > 10, "{tally:?}");
    }
}

/// A plane far from the origin, so that heights of corners nearly cancel.
#[test]
fn distances_next_to_the_truth_are_never_said_to_be_clear() {
    let mut rng = Rng::new(21);
    let mut asked = 0;
    for _ in 0..40 {
        let base = rng.point_in([3e5; 3], [8e5; 3]);
        let mut near = |size: f32| {
            let d = rng.point_in([-size; 3], [size; 3]);
            [0, 1, 2].map(|k| base[k] + d[k])
        };
        let corners = [near(6.0), near(6.0), near(6.0)];
        let lower = corners.map(|p| [p[0] - 0.625, p[1] - 0.4375, p[2] + 0.6875]);
        let positions = [corners, lower].concat();
        let scene = Scene::both("two triangles", (positions, vec![[0, 1, 2], [3, 4, 5]]));
        let [_, tree] = scene.trees();
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        for _ in 0..60 {
            let shape = Shape::sphere(near(6.0), 0.0);
            let truth = shape.truth(&scene);
            let at = truth.lower as f32;
            for distance in [at, at.next_up(), at.next_down().max(0.0)] {
                let found = tree.solid_within(&shape.solid(), distance, Budget::EXACT, &mut stack);
                let found = found.expect("answers");
                let (wide, verdict) = (f64::from(distance), found.verdict);
                assert!(verdict != Verdict::No || truth.upper > wide, "{shape:?} {truth:?}");
                assert!(verdict != Verdict::Yes || truth.lower <= wide, "{shape:?} {truth:?}");
                asked += 1;
            }
        }
    }
    assert!(asked > 5000);
}

/// Edges against edges, in one plane and not: their differences are corners of a parallelogram.
#[test]
fn the_distance_of_a_triangle_and_a_segment_or_a_triangle_is_narrow() {
    let mut rng = Rng::new(22);
    for number in 0..150_000 {
        let mut point = || {
            let [x, y, z] = rng.point_in([0.0; 3], [1.0; 3]).map(f64::from);
            if number % 3 == 0 { [x, y, 0.25 * x - 0.5 * y] } else { [x, y, z] }
        };
        let (triangle, solid) = ([point(), point(), point()], [point(), point(), point()]);
        let count = 2 + number % 2;
        let gap = convex_gap(&solid[..count], &triangle);
        assert!(gap.upper - gap.lower < 1e-6, "{solid:?} {triangle:?} {gap:?}");
        let narrow = |t: [[f64; 3]; 3]| t.map(|p| p.map(|x| x as f32));
        if number % 3 != 0 && gap.lower > 0.0 && number % 16 == 1 {
            let degenerate = if count == 2 { [solid[0], solid[1], solid[1]] } else { solid };
            let (a, b) = (narrow(triangle), narrow(degenerate));
            let truth = distance_of_moved_triangles(a, b, &IDENTITY, [0.0; 3]);
            assert!(gap.lower <= truth.upper && truth.lower <= gap.upper, "{gap:?} {truth:?}");
        }
    }
}

/// A box around the whole model meets nothing: only surfaces count, but the solid is filled.
#[test]
fn a_solid_that_holds_the_mesh_meets_it() {
    let scene = Scene::both("sphere", rough_sphere(2, 0.4, 3));
    let shape = Shape::cuboid([-5.0; 3], [5.0; 3], 0.0);
    for tree in scene.trees() {
        let found = ask(&tree, &shape, Budget::EXACT);
        assert_eq!([found.distance.lower, found.distance.upper], [0.0; 2], "{found:?}");
    }
}
