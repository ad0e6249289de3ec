//! Signed distance.

use super::scenes::{STACK, allowed_width, closed, stack};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::{RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Ended, QueryError, Side, SignedDistance, Undecided};
use meshsweep_host_tests::generate::corpus::{IDENTITY, soups};
use meshsweep_host_tests::generate::{
    Rng, Triangles, cube, icosphere, inverted, joined, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::oracle::winding_number;
use meshsweep_host_tests::scene::Scene;
use proptest::prelude::*;

fn ask(scene: &Scene, p: [f32; 3], stop: &Budget, entries: usize) -> SignedDistance {
    scene.bvh().signed_distance(p, *stop, &mut stack(entries)).expect("a finite question")
}

/// `None` where the point is too near the surface for f64 to tell.
fn number(scene: &Scene, p: [f32; 3]) -> Option<i32> {
    let Scene { positions, triangles, .. } = scene;
    let number = winding_number(p.map(f64::from), positions, triangles, f64::from(scene.size()));
    ((number - number.round()).abs() < 1e-3).then(|| number.round() as i32)
}

/// The side is that of the winding number, whose value on the inside is `inside`; the interval
/// contains the signed distance. Whether there is a side.
fn check(scene: &Scene, p: [f32; 3], inside: i32, answer: &SignedDistance) -> bool {
    let (name, truth) = (&scene.name, scene.truth(p));
    let signed = match (answer.side, number(scene, p)) {
        (Side::Undecided(_), _) => {
            assert_eq!(
                (answer.distance.lower, answer.distance.upper),
                (-answer.closest.distance.upper, answer.closest.distance.upper)
            );
            assert!(
                truth.lower <= f64::from(answer.distance.upper),
                "{name}: {p:?}: {answer:?} {truth:?}"
            );
            return false;
        }
        (side, Some(number)) => {
            let expected = if number == inside { Side::Inside } else { Side::Outside };
            assert_eq!(
                side, expected,
                "{name}: {p:?}: {answer:?}, winding number {number}, {truth:?}"
            );
            if side == Side::Inside {
                (-truth.upper, -truth.lower)
            } else {
                (truth.lower, truth.upper)
            }
        }
        (Side::Inside, None) => (-truth.upper, -truth.lower),
        (_, None) => (truth.lower, truth.upper),
    };
    let holds = f64::from(answer.distance.lower) <= signed.1
        && signed.0 <= f64::from(answer.distance.upper);
    assert!(holds, "{name}: {p:?}: {answer:?} does not contain {signed:?}");
    true
}

#[test]
fn side_is_the_winding_numbers_and_defined_wherever_the_distance_is_clear() {
    for scene in closed() {
        assert!(scene.bvh().header().is_closed());
        let (mut undefined, mut clear) = (0, 0);
        for p in scene.points(240, &mut Rng::new(61)) {
            let answer = ask(scene, p, &Budget::EXACT, STACK);
            let defined = check(scene, p, 1, &answer);
            let truth = scene.truth(p);
            if truth.lower > allowed_width(scene, truth.upper) {
                clear += 1;
                undefined += u32::from(!defined);
                let ended = if defined { Ended::Exact } else { Ended::Resolution };
                assert_eq!(answer.closest.ended, ended);
            }
        }
        // Their triangles have no certain normals, or lie closer together than rounding can tell.
        let hopeless = ["needle comb", "spire"].iter().any(|name| scene.name.starts_with(name));
        assert!(
            clear > 50 && (undefined == 0 || hopeless),
            "{}: {undefined} of {clear}",
            scene.name
        );
    }
}

#[test]
fn centre_of_a_sphere_is_inside() {
    for single in [false, true] {
        for level in [0, 1, 3] {
            let scene = Scene::tree("icosphere", icosphere(level), single);
            assert_eq!(ask(&scene, [0.0; 3], &Budget::EXACT, STACK).side, Side::Inside);
        }
    }
}

#[test]
fn beyond_edges_and_vertices_of_a_cube_all_is_outside() {
    for single in [false, true] {
        for n in [1, 3] {
            let scene = Scene::tree("cube", cube(n), single);
            for x in [-1.000_1, -1.0, -0.999_999_9, -0.5, 0.0, 0.999_99, 1.0, 1.000_000_1, 1.5] {
                for y in [-1.0, -0.999_999, 0.0, 1.0, 1.000_01] {
                    for p in [[2.0, x, y], [x, 2.0, y], [x, y, -1.01], [x, y, 40.0]] {
                        let answer = ask(&scene, p, &Budget::EXACT, STACK);
                        assert_eq!(answer.side, Side::Outside, "{}: {p:?}: {answer:?}", scene.name);
                    }
                }
            }
        }
    }
}

#[test]
fn sharp_edges_and_tips_have_a_side() {
    // Acute everywhere, so that triangles with their backs to the point are as near as those with
    // their fronts.
    for single in [false, true] {
        for scene in
            closed().iter().filter(|s| s.name.contains("spire") || s.name.contains("spiky"))
        {
            let size = scene.size();
            let mut rng = Rng::new(62);
            let mut defined = 0;
            for i in 0..400 {
                let vertex = scene.positions[i % scene.positions.len()];
                let d = rng.direction();
                let p: [f32; 3] = std::array::from_fn(|k| vertex[k] + d[k] * size * 1e-3);
                defined += u32::from(check(scene, p, 1, &ask(scene, p, &Budget::EXACT, STACK)));
            }
            // Near the tip of a spire opposite walls are nearer to each other than rounding tells
            // apart.
            assert!(defined > 250, "{}: {defined} of 400, {single}", scene.name);
        }
    }
}

fn moved(mesh: &Triangles, by: [f32; 3]) -> Triangles {
    transformed(mesh, IDENTITY, by)
}

#[test]
fn an_inverted_mesh_that_no_repair_turned_has_no_sides() {
    for single in [false, true] {
        let scene = Scene::tree("inverted torus", inverted(&torus(2.0, 0.75, 24, 12)), single);
        assert!(!scene.bvh().has_sides());
        let undecided = Side::Undecided(Undecided::Resolution);
        for p in [[40.0, 0.0, 3.0], [2.0, 0.0, 0.0], [1e20, 0.0, 3.0]] {
            assert_eq!(ask(&scene, p, &Budget::EXACT, STACK).side, undecided);
        }
    }
}

#[test]
fn a_cavity_is_outside() {
    let hollow = joined(&icosphere(3), &inverted(&scaled(&icosphere(2), 0.5)));
    for single in [false, true] {
        let scene = Scene::tree("hollow sphere", hollow.clone(), single);
        for p in scene.points(240, &mut Rng::new(64)) {
            check(&scene, p, 1, &ask(&scene, p, &Budget::EXACT, STACK));
        }
        assert_eq!(ask(&scene, [0.0; 3], &Budget::EXACT, STACK).side, Side::Outside);
        assert_eq!(ask(&scene, [0.75, 0.0, 0.0], &Budget::EXACT, STACK).side, Side::Inside);
    }
}

#[test]
fn where_overlapping_parts_cross_sides_are_undecided() {
    let scene = Scene::tree("overlap", joined(&cube(2), &moved(&cube(2), [1.0, 0.0, 0.0])), true);
    // Within the first cube, outside of the second, next to the second's wall at 0.
    let hidden = ask(&scene, [-0.1, 0.0, 0.0], &Budget::EXACT, STACK);
    assert_eq!(hidden.side, Side::Undecided(Undecided::Feature));
    assert_eq!(hidden.closest.ended, Ended::Resolution);
    // Next to the walls at the ends, which cross nothing.
    for (x, side) in [(-1.1, Side::Outside), (-0.9, Side::Inside), (1.9, Side::Inside)] {
        assert_eq!(ask(&scene, [x, 0.5, 0.4], &Budget::EXACT, STACK).side, side);
    }
}

#[test]
fn thin_walls_are_never_guessed() {
    // A plate of one step of the grid, and thinner: seen from afar both faces are equally near.
    for (thickness, single) in [(2e-5, false), (1e-6, true), (1e-7, true)] {
        let (mut positions, triangles) = cube(2);
        positions.iter_mut().for_each(|p| p[2] *= thickness);
        let scene = Scene::tree("plate", (positions, triangles), single);
        let mut rng = Rng::new(65);
        for i in 0..300 {
            let far = 10f32.powi(i % 9 - 4);
            let p = rng.direction().map(|x| x * far);
            check(&scene, p, 1, &ask(&scene, p, &Budget::EXACT, STACK));
        }
    }
}

#[test]
fn open_meshes_and_soups_have_no_side() {
    let (positions, mut triangles) = cube(2);
    triangles.pop();
    let mut meshes = soups();
    meshes.push(("open cube", (positions, triangles)));
    for (name, mesh) in meshes {
        let scene = Scene::tree(name, mesh, false);
        if scene.bvh().header().is_closed() {
            continue;
        }
        for p in scene.points(24, &mut Rng::new(66)) {
            let answer = ask(&scene, p, &Budget::EXACT, STACK);
            assert_eq!(
                (answer.side, answer.closest.ended),
                (Side::Undecided(Undecided::OpenMesh), Ended::Exact)
            );
            check(&scene, p, 1, &answer);
        }
    }
}

#[test]
fn flat_closed_sheets_have_no_side() {
    // Every triangle twice, front to back: closed, and no inside.
    let sheet = vec![[0, 1, 2], [1, 3, 2], [0, 2, 1], [1, 2, 3]];
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.25], [0.0, 1.0, 0.5], [1.0, 1.0, 0.75]];
    for single in [false, true] {
        let scene = Scene::tree("sheet", (positions.clone(), sheet.clone()), single);
        assert!(scene.bvh().header().is_closed());
        for p in scene.points(120, &mut Rng::new(67)) {
            let answer = ask(&scene, p, &Budget::EXACT, STACK);
            assert_ne!(answer.side, Side::Inside, "{p:?}: {answer:?}");
        }
    }
}

#[test]
fn distance_is_the_closest_points() {
    for scene in closed() {
        let tree = scene.bvh();
        for p in scene.points(60, &mut Rng::new(68)) {
            let (signed, closest) = (
                ask(scene, p, &Budget::EXACT, STACK).closest,
                tree.closest_point(p, Budget::EXACT, &mut stack(STACK)).expect("finite"),
            );
            assert_eq!(
                (signed.distance.upper, signed.triangle, signed.point),
                (closest.distance.upper, closest.triangle, closest.point)
            );
            let off = (f64::from(signed.distance.lower) - f64::from(closest.distance.lower)).abs();
            // The plain query lets its certificates fall short by 2^-19 of the distance.
            assert!(off <= 2e-6 * f64::from(signed.distance.upper) + allowed_width(scene, 0.0));
        }
    }
}

#[test]
fn short_stacks_and_few_steps_leave_the_side_open_or_right() {
    let mut undefined = 0;
    for scene in closed() {
        for p in scene.points(24, &mut Rng::new(69)) {
            for (steps, entries) in
                [(u32::MAX, 1), (u32::MAX, 4), (u32::MAX, 12), (0, 9), (3, STACK), (8, STACK)]
            {
                let answer = ask(scene, p, &Budget::EXACT.with_steps(steps), entries);
                undefined += u32::from(!check(scene, p, 1, &answer));
                assert!(answer.closest.work.opened <= steps);
            }
        }
    }
    assert!(undefined > 100, "only {undefined} searches were cut short");
}

#[test]
fn far_points_are_outside() {
    for factor in [1.0, 1e-30, 1e30] {
        for single in [false, true] {
            let scene = Scene::tree("torus", scaled(&torus(2.0, 0.75, 12, 8), factor), single);
            let mut rng = Rng::new(70);
            let mut far = 1.5 * f64::from(scene.size());
            while far < 3e38 {
                let p = rng.direction().map(|x| (f64::from(x) * far) as f32);
                let answer = ask(&scene, p, &Budget::EXACT, STACK);
                check(&scene, p, 1, &answer);
                assert_eq!(answer.side, Side::Outside, "{}: {p:?}: {answer:?}", scene.name);
                far *= 5.0;
            }
        }
    }
}

#[test]
fn bad_questions_are_typed_errors() {
    let scene = Scene::tree("cube", cube(1), false);
    let tree = scene.bvh();
    let nan = [f32::NAN, 0.0, 0.0];
    assert_eq!(
        tree.signed_distance(nan, Budget::EXACT, &mut stack(64)),
        Err(QueryError::NotFinite)
    );
    assert_eq!(tree.signed_distance([0.0; 3], Budget::EXACT, &mut []), Err(QueryError::NoScratch));
    let bad = Budget::EXACT.with_absolute(f32::NAN);
    assert_eq!(tree.signed_distance([0.0; 3], bad, &mut stack(64)), Err(QueryError::Tolerance));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn side_holds_for_any_rough_sphere_and_order_of_triangles(
        seed in 0u64..100_000,
        amplitude in 0f32..0.95,
        single in any::<bool>(),
        p in prop::array::uniform3(-2f32..2.0),
    ) {
        let (positions, mut triangles) = rough_sphere(1, amplitude, seed);
        let scene = Scene::tree("rough sphere", (positions.clone(), triangles.clone()), single);
        let one = ask(&scene, p, &Budget::EXACT, STACK);
        check(&scene, p, 1, &one);
        let mut rng = Rng::new(seed);
        (1..triangles.len()).for_each(|i| triangles.swap(i, rng.below(i + 1)));
        let shuffled = Scene::tree("shuffled", (positions, triangles), single);
        check(&shuffled, p, 1, &ask(&shuffled, p, &Budget::EXACT, STACK));
        for p in scene.points(24, &mut Rng::new(seed)) {
            check(&scene, p, 1, &ask(&scene, p, &Budget::EXACT, STACK));
        }
    }
}

/// A hollow sphere whose wall is thinner than the rounding of its coordinates to f32: repair drops
/// one of the two spheres, and the winding number between them and at the centre is lost.
#[test]
fn a_shell_that_rounding_closes_has_no_sides_and_a_thicker_one_keeps_them() {
    let (positions, triangles) = icosphere(2);
    let shell = |wall: f64| {
        let at = |scale: f64| positions.iter().map(move |p| p.map(|x| f64::from(x) * scale));
        let count = positions.len() as u32;
        let inner = triangles.iter().map(|&[a, b, c]| [a + count, c + count, b + count]);
        let positions = at(1.0).chain(at(1.0 - wall)).collect();
        let raw = RawMesh::from_f64(positions, triangles.iter().copied().chain(inner).collect());
        let (mesh, report) = repair(raw).expect("a mesh");
        let bytes = build(mesh.as_input(), &TreeOptions::default(), Watch::NONE)
            .expect("builds")
            .0
            .to_bytes();
        let tree = Bvh::open(&bytes).expect("opens");
        let ask = |p| tree.signed_distance(p, Budget::EXACT, &mut stack(64)).expect("finite").side;
        (report.opposite_duplicate.count, ask([0.0; 3]), ask([3.0, 0.0, 0.0]))
    };
    let open = Side::Undecided(Undecided::OpenMesh);
    assert_eq!(shell(1e-12), (triangles.len(), open, open));
    assert_eq!(shell(0.25), (0, Side::Outside, Side::Outside));
}
