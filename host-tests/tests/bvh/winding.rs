//! Winding numbers of closed, open and dirty meshes.

use glam::Vec3;
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::internal::geom::{SeenCorner, SolidAngles};
use meshsweep_core::{
    Budget, BuildFor, Bvh, Ended, Interval, QueryError, ScratchEntry, Side, Undecided,
    WindingNumber,
};
use meshsweep_host_tests::generate::corpus::{add, solids, soups};
use meshsweep_host_tests::generate::{
    EXTREME_SCALES, Rng, Triangles, bracket, icosphere, joined, rough_sphere, scaled, torus,
    transformed, uv_sphere,
};
use meshsweep_host_tests::oracle::winding_number;
use meshsweep_host_tests::scene::Scene;

const UPRIGHT: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn ask(tree: &Bvh<'_>, point: [f32; 3], budget: Budget) -> WindingNumber {
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    tree.winding_number(point, budget, &mut stack).expect("answers")
}

fn width(number: Interval) -> f64 {
    f64::from(number.upper) - f64::from(number.lower)
}

/// The number in f64 and a bound of its error, if f64 can tell at this distance.
fn truth(scene: &Scene, point: [f32; 3]) -> Option<(f64, f64)> {
    let size = f64::from(scene.size());
    let distance = scene.truth(point).lower / size;
    let error = 1e-12 + 1e-14 * scene.triangles.len() as f64 / (distance * distance);
    let number =
        || winding_number(point.map(f64::from), &scene.positions, &scene.triangles, scene.reach());
    (error < 1e-3).then(|| (number(), error))
}

fn holds(scene: &Scene, point: [f32; 3], found: &WindingNumber) -> bool {
    let Some((number, error)) = truth(scene, point) else { return true };
    let Interval { lower, upper } = found.number;
    let side = if number > 0.5 { Side::Inside } else { Side::Outside };
    let side_may_differ = (number - 0.5).abs() <= error || matches!(found.side, Side::Undecided(_));
    f64::from(lower) <= number + error
        && number - error <= f64::from(upper)
        && (side_may_differ || found.side == side)
}

#[test]
fn the_interval_contains_the_number_of_every_mesh_with_every_budget() {
    let mut rng = Rng::new(71);
    for (name, mesh) in solids().into_iter().chain(soups()) {
        let scene = Scene::both(name, mesh);
        for point in scene.points(24, &mut rng) {
            for tree in scene.trees() {
                let narrow = Budget::EXACT.with_absolute(1e-3);
                let steps = [0, 1, 3, 20].map(|steps| Budget::EXACT.with_steps(steps));
                for budget in [Budget::EXACT, narrow].into_iter().chain(steps) {
                    let found = ask(&tree, point, budget);
                    assert!(holds(&scene, point, &found), "{found:?}");
                    assert!(found.work.opened <= budget.steps);
                }
            }
        }
    }
}

#[test]
fn the_number_of_moved_vertices_and_places_is_that_of_the_input() {
    let mut rng = Rng::new(72);
    for (name, mesh, by) in [
        ("torus", torus(2.0, 0.75, 20, 10), 1e-3),
        ("bracket", bracket(), 2e-2),
        ("rough sphere", rough_sphere(3, 0.2, 7), 1e-2),
    ] {
        let scene = Scene::moved(name, mesh, by, 5);
        for point in scene.points(200, &mut rng) {
            for tree in scene.trees() {
                let found = ask(&tree, point, Budget::EXACT);
                assert!(holds(&scene, point, &found), "{found:?}");
                // The place of the point is as uncertain once more.
                let unsure = tree.with_error(by).expect("an error");
                let elsewhere = add(point, rng.direction(), 0.99 * by);
                let found = ask(&unsure, elsewhere, Budget::EXACT);
                assert!(holds(&scene, point, &found), "{found:?}");
            }
        }
    }
}

#[test]
fn points_off_a_closed_surface_are_decided_and_points_on_it_are_not() {
    let mut rng = Rng::new(73);
    let (mut decided, mut open) = (0, 0);
    for (name, mesh) in
        [("bracket", bracket()), ("torus", torus(2.0, 0.75, 40, 20)), ("ball", icosphere(4))]
    {
        let scene = Scene::both(name, mesh);
        for _ in 0..200 {
            // No other point of the surface is surely an f32.
            let at = scene.vertex(&mut rng);
            let off = add(scene.on_surface(&mut rng), rng.direction(), 0.02 * scene.size());
            for tree in scene.trees() {
                let found = ask(&tree, at, Budget::EXACT);
                assert_eq!(found.side, Side::Undecided(Undecided::Resolution), "{at:?} {found:?}");
                assert_eq!(found.ended, Ended::Resolution);
                if scene.truth(off).lower < 4e-3 * f64::from(scene.size()) {
                    continue;
                }
                match ask(&tree, off, Budget::EXACT).ended {
                    Ended::Exact => decided += 1,
                    _ => open += 1,
                }
            }
        }
    }
    assert!(decided > 900 && open * 100 <= decided, "{decided} decided, {open} not");
}

/// A mesh without some of its triangles.
fn without((positions, triangles): &Triangles, dropped: impl Fn(usize) -> bool) -> Triangles {
    let kept = triangles.iter().enumerate().filter(|(number, _)| !dropped(*number));
    (positions.clone(), kept.map(|(_, triangle)| *triangle).collect())
}

#[test]
fn a_mesh_with_holes_has_an_inside_and_an_outside() {
    let scene = Scene::both("sieve", without(&icosphere(4), |number| number % 7 == 3));
    for tree in scene.trees() {
        assert!(!tree.is_closed());
        let mut rng = Rng::new(74);
        for _ in 0..200 {
            let way = rng.direction();
            let inside = ask(&tree, way.map(|x| 0.9 * x), Budget::EXACT);
            assert_eq!((inside.side, inside.ended), (Side::Inside, Ended::Exact));
            let outside = ask(&tree, way.map(|x| 1.1 * x), Budget::EXACT);
            assert_eq!((outside.side, outside.ended), (Side::Outside, Ended::Exact));
        }
    }
}

#[test]
fn parts_that_overlap_are_united_and_counted() {
    let ball = icosphere(3);
    let two = joined(&ball, &transformed(&ball, UPRIGHT, [1.0, 0.0, 0.0]));
    let scene = Scene::both("two balls", two);
    let narrow = Budget::EXACT.with_absolute(0.05);
    for tree in scene.trees() {
        for (x, number) in [(-0.5, 1.0), (0.5, 2.0), (1.5, 1.0), (2.5, 0.0), (-1.5, 0.0)] {
            let found = ask(&tree, [x, 0.0, 0.0], narrow);
            assert_eq!(found.ended, Ended::Tolerance, "{x} {found:?}");
            assert!(width(found.number) <= 0.05);
            let middle = 0.5 * (f64::from(found.number.lower) + f64::from(found.number.upper));
            assert!((middle - number).abs() < 0.02, "{x} {found:?}");
            let side = if number > 0.5 { Side::Inside } else { Side::Outside };
            assert_eq!(found.side, side);
        }
    }
}

#[test]
fn half_of_a_ball_is_seen_from_its_middle_as_half() {
    let (positions, mut triangles) = uv_sphere(24, 12);
    triangles.retain(|triangle| triangle.iter().all(|&v| positions[v as usize][2] > -1e-6));
    let half = (positions, triangles);
    let scene = Scene::both("bowl", half);
    for tree in scene.trees() {
        let wide = ask(&tree, [0.0; 3], Budget::EXACT);
        assert!(wide.number.lower < 0.5 && 0.5 < wide.number.upper, "{wide:?}");
        assert_eq!(wide.side, Side::Undecided(Undecided::Resolution));
        assert!(width(wide.number) < 0.05, "{wide:?}");
    }
}

#[test]
fn steps_are_kept_to_and_said_and_enough_of_them_end_the_search() {
    let scene = Scene::both("rough sphere", rough_sphere(4, 0.1, 3));
    let mut rng = Rng::new(75);
    let mut cut_short = 0;
    for _ in 0..20 {
        let point = add(scene.on_surface(&mut rng), rng.direction(), 0.05 * scene.size());
        for tree in scene.trees() {
            for steps in [0, 1, 2, 4, 8, 16, u32::MAX] {
                let found = ask(&tree, point, Budget::EXACT.with_steps(steps));
                assert!(holds(&scene, point, &found), "{found:?}");
                assert!(found.work.opened <= steps);
                if found.ended == Ended::Steps {
                    assert_eq!(found.side, Side::Undecided(Undecided::Steps));
                    assert!(found.work.opened == steps && steps < u32::MAX, "{found:?}");
                    cut_short += 1;
                }
            }
        }
    }
    assert!(cut_short > 100, "{cut_short}");
}

#[test]
fn too_little_scratch_memory_leaves_an_interval_that_holds() {
    let scene = Scene::both("bracket", bracket());
    let mut rng = Rng::new(76);
    let mut cut_short = 0;
    for point in scene.points(100, &mut rng) {
        for tree in scene.trees() {
            for entries in 1..6 {
                let mut stack = vec![ScratchEntry::EMPTY; entries];
                let found = tree.winding_number(point, Budget::EXACT, &mut stack).unwrap();
                assert!(holds(&scene, point, &found), "{found:?}");
                cut_short += usize::from(found.side == Side::Undecided(Undecided::Scratch));
            }
        }
    }
    assert!(cut_short > 100, "{cut_short}");
}

#[test]
fn a_power_of_two_changes_no_bit_of_the_number() {
    // Without coordinates that would leave f32's normal range.
    let mesh = bracket();
    let scene = Scene::both("bracket", mesh.clone());
    for factor in EXTREME_SCALES {
        let large = Scene::both("scaled bracket", scaled(&mesh, factor));
        let mut rng = Rng::new(77);
        for point in scene.points(60, &mut rng) {
            for (tree, other) in scene.trees().iter().zip(&large.trees()) {
                let one = ask(tree, point, Budget::EXACT);
                let two = ask(other, point.map(|x| x * factor), Budget::EXACT);
                assert_eq!(one, two);
            }
        }
    }
}

#[test]
fn far_points_are_outside_without_looking_at_triangles() {
    let scene = Scene::both("torus", torus(2.0, 0.75, 20, 10));
    for tree in scene.trees() {
        for far in [1e4, 1e8, 1e15, 1e20, 1e30, f32::MAX] {
            for point in [[far, 0.0, 0.0], [-far, far, far]] {
                let found = ask(&tree, point, Budget::EXACT);
                assert_eq!((found.side, found.ended), (Side::Outside, Ended::Exact), "{far}");
                assert!(width(found.number) < 1e-3 && found.work.triangles == 0, "{found:?}");
            }
        }
        // But not if the point may be anywhere.
        let unsure = tree.with_error(1e12).expect("an error");
        let found = ask(&unsure, [1e12, 0.0, 0.0], Budget::EXACT);
        assert_eq!(found.side, Side::Undecided(Undecided::Resolution));
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let scene = Scene::both("torus", torus(2.0, 0.75, 16, 8));
    let tree = scene.bvh();
    let mut stack = [ScratchEntry::EMPTY; 64];
    let mut refusal = |point, budget, entries| {
        tree.winding_number(point, budget, &mut stack[..entries]).map(|_| ())
    };
    assert_eq!(refusal([0.0, f32::NAN, 0.0], Budget::EXACT, 64), Err(QueryError::NotFinite));
    let negative = Budget::EXACT.with_absolute(-1.0);
    assert_eq!(refusal([0.0; 3], negative, 64), Err(QueryError::Tolerance));
    assert_eq!(refusal([0.0; 3], Budget::EXACT, 0), Err(QueryError::NoScratch));
    let plain = Scene::tree("torus", torus(2.0, 0.75, 16, 8), false);
    let found = plain.bvh().winding_number([0.0; 3], Budget::EXACT, &mut stack);
    assert_eq!(found, Err(QueryError::NotServed { build_for: BuildFor::Winding }));
}

/// The solid angle of one triangle, and the bound of its error.
fn angle(corners: [[f32; 3]; 3], moved: f32) -> (f64, f64) {
    let mut angles = SolidAngles::NONE;
    angles.add(corners.map(|corner| SeenCorner::new(corner.into())), moved);
    let (sum, error) = angles.sum();
    (f64::from(sum), f64::from(error))
}

/// The same in f64, by the angles of the spherical triangle (Girard).
fn girard(corners: [[f32; 3]; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| Vec3::from_array(v).as_dvec3());
    let planes = [a.cross(b), b.cross(c), c.cross(a)];
    let between = |i: usize, j: usize| {
        let (m, n) = (planes[i], planes[j]);
        std::f64::consts::PI - m.cross(n).length().atan2(m.dot(n))
    };
    let excess = between(0, 1) + between(1, 2) + between(2, 0) - std::f64::consts::PI;
    excess.copysign(a.dot(b.cross(c)))
}

#[test]
fn an_angle_is_within_its_bound_of_girard_s_also_when_corners_move() {
    let mut rng = Rng::new(78);
    let (mut worst, mut worst_moved) = (0f64, 0f64);
    for round in 0..20_000 {
        let size = [1.0, 0.1, 10.0, 1e-3][round % 4];
        let at = rng.direction().map(|x| x * rng.range(0.1, 4.0));
        let corner = |rng: &mut Rng| {
            let along = rng.direction();
            [0, 1, 2].map(|k| at[k] + size * along[k])
        };
        let corners = [corner(&mut rng), corner(&mut rng), corner(&mut rng)];
        let truth = girard(corners);
        let (sum, error) = angle(corners, 0.0);
        // Girard's formula loses digits in small triangles.
        let own = 1e-14 / (size * size) as f64 + 1e-13;
        assert!((sum - truth).abs() <= error + own, "{corners:?} {sum} {truth} {error}");
        if error < 1.0 && own < 0.1 * error {
            worst = worst.max((sum - truth).abs() / error);
        }
        let by = [1e-2, 1e-4][round / 4 % 2];
        let moved = corners.map(|v| add(v, rng.direction(), 0.999 * by));
        let (sum, error) = angle(moved, by);
        assert!((sum - truth).abs() <= error + own, "{corners:?} {moved:?} {sum} {truth} {error}");
        if error < 1.0 && own < 0.1 * error {
            worst_moved = worst_moved.max((sum - truth).abs() / error);
        }
    }
    // So a bound of a twentieth would be noticed.
    assert!(worst > 0.05 && worst_moved > 0.25, "{worst} {worst_moved}");
}

#[test]
fn any_number_of_angles_is_counted_past_every_turn() {
    let mut rng = Rng::new(79);
    for _ in 0..50 {
        let mut angles = SolidAngles::NONE;
        let mut truth = 0.0;
        for _ in 0..rng.below(300) {
            let corners = [(); 3].map(|()| rng.direction());
            let own = girard(corners);
            // Mostly one way, so that the sum goes far.
            let corners = if own < 0.0 && rng.below(4) > 0 {
                [corners[0], corners[2], corners[1]]
            } else {
                corners
            };
            truth += girard(corners);
            angles.add(corners.map(|corner| SeenCorner::new(corner.into())), 0.0);
        }
        let (sum, error) = angles.sum();
        assert!((f64::from(sum) - truth).abs() <= f64::from(error), "{sum} {truth} {error}");
        assert!(error < 1.0);
    }
}

#[test]
fn the_signed_distance_of_a_mesh_with_holes_has_the_side_of_the_number() {
    let (positions, triangles) = without(&icosphere(3), |number| number % 7 == 3);
    let mesh = Mesh::new(positions, triangles);
    let options = TreeOptions::default().with_winding(true);
    let bytes = build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes();
    let tree = Bvh::open(&bytes).expect("opens");
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let mut rng = Rng::new(80);
    for _ in 0..300 {
        let point = rng.direction().map(|x| 1.5 * x * rng.unit_f32());
        let found =
            tree.signed_distance_by_winding(point, Budget::EXACT, &mut stack).expect("answers");
        let near = tree.closest_point(point, Budget::EXACT, &mut stack).expect("answers");
        assert_eq!(found.side, ask(&tree, point, Budget::EXACT).side);
        assert_eq!((found.closest.point, found.closest.triangle), (near.point, near.triangle));
        let Interval { lower, upper } = near.distance;
        let signed = match found.side {
            Side::Inside => Interval::new(-upper, -lower),
            Side::Outside => Interval::new(lower, upper),
            _ => Interval::new(-upper, upper),
        };
        assert_eq!(found.distance, signed);
    }
    let far =
        tree.signed_distance_by_winding([9.0; 3], Budget::EXACT, &mut stack).expect("answers");
    assert_eq!((far.side, far.closest.ended), (Side::Outside, Ended::Exact));
    let no_steps = Budget::EXACT.with_steps(0);
    let found = tree.signed_distance_by_winding([0.1; 3], no_steps, &mut stack).expect("answers");
    assert_eq!(
        (found.side, found.closest.ended),
        (Side::Undecided(Undecided::Steps), Ended::Steps)
    );
    let plain = Scene::tree("torus", torus(2.0, 0.75, 16, 8), false);
    let refused = plain.bvh().signed_distance_by_winding([0.0; 3], Budget::EXACT, &mut stack);
    assert_eq!(refused, Err(QueryError::NotServed { build_for: BuildFor::Winding }));
}

/// On the grid the triangles are points; the input's have an area.
#[test]
fn far_away_the_number_of_collapsed_triangles_is_contained() {
    let mut mesh: Triangles = (Vec::new(), Vec::new());
    let leg = 5e-6;
    for corner in 0..8u32 {
        let at = [0, 1, 2].map(|k| if corner >> k & 1 == 0 { 0.25 } else { 1.0 });
        let first = mesh.0.len() as u32;
        mesh.0.extend([at, add(at, [1.0, 0.0, 0.0], leg), add(at, [0.0, 1.0, 0.0], leg)]);
        mesh.1.push([first, first + 1, first + 2]);
    }
    let scene = Scene::both("crumbs", mesh);
    for tree in scene.trees() {
        for height in [1e3, 4e6, 1e7, 1e8, 1e12] {
            let point = [0.0, 0.0, height];
            let Interval { lower, upper } = ask(&tree, point, Budget::EXACT).number;
            let truth =
                winding_number(point.map(f64::from), &scene.positions, &scene.triangles, 1.0);
            assert!(f64::from(lower) <= truth && truth <= f64::from(upper), "{height} {truth:e}");
        }
    }
}
