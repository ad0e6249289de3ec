//! Sides of solids and cavities that are thinner than the surface error: on a grid their walls may
//! change places.

use super::scenes::{STACK, stack};
use meshsweep::bvh::{TreeOptions, TreeReport, build};
use meshsweep::check::check_tree;
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Side};
use meshsweep_host_tests::generate::{Rng, Triangles, cube, inverted, joined, plate, scaled};
use meshsweep_host_tests::scene::Scene;

/// Thicker plates keep their sides in f32, some hundredths away.
const DECIDABLE_THICKNESS: f32 = 5e-5;

/// Asks for sides at points clear of the surface that are all on one side. Returns how many are
/// decided.
fn ask(scene: &Scene, tree: &Bvh<'_>, points: &[[f32; 3]], side: Side) -> usize {
    let mut decided = 0;
    for &p in points {
        let answer = tree.signed_distance(p, Budget::EXACT, &mut stack(STACK)).expect("a point");
        if !matches!(answer.side, Side::Undecided(_)) {
            assert_eq!(answer.side, side, "{}: {p:?}: {answer:?}", scene.name);
            decided += 1;
        }
    }
    decided
}

fn assert_most(decided: usize, of: usize) {
    assert!(decided > of * 9 / 10, "{decided} of {of}");
}

/// Points beside a plate, some hundredths away.
fn beside(slope: [f32; 2], rng: &mut Rng) -> Vec<[f32; 3]> {
    let mut point = || {
        let [x, y] = [rng.range(0.0, 1.0), rng.range(0.0, 1.0)];
        let off = rng.range(0.01, 0.06) * if rng.below(2) == 0 { 1.0 } else { -1.0 };
        [x, y, slope[0] * x + slope[1] * y + off]
    };
    (0..200).map(|_| point()).collect()
}

fn built(mesh: &Triangles) -> (Vec<u8>, TreeReport) {
    let mesh = Mesh::new(mesh.0.clone(), mesh.1.clone());
    let (sections, report) =
        build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds");
    let bytes = sections.to_bytes();
    check_tree(&bytes, &mesh).expect("proved");
    (bytes, report)
}

#[test]
fn beside_plates_thinner_than_the_grid_no_side_is_wrong_and_nearly_all_keep_theirs() {
    let mut rng = Rng::new(71);
    let mut kept = 0;
    for i in 0..48 {
        let slope = match i {
            0 => [0.011_321_485, -0.099_946_38],
            _ => [rng.range(-0.2, 0.2), rng.range(-0.2, 0.2)],
        };
        let thickness = [1e-6, 3e-6, 1e-5, 2e-4][i % 4];
        let mesh = plate(slope, thickness);
        let points = beside(slope, &mut rng);
        for single in [false, true] {
            let scene = Scene::tree("plate", mesh.clone(), single);
            let decided = ask(&scene, &scene.bvh(), &points, Side::Outside);
            assert!(decided == 0 || scene.bvh().has_sides());
            if thickness > DECIDABLE_THICKNESS {
                assert_most(decided, points.len());
            }
        }
        kept += usize::from(built(&mesh).1.sides.is_none());
    }
    assert!(kept > 44, "{kept} plates of 48 keep their sides on the grid");
}

#[test]
fn beside_cavities_thinner_than_the_grid_no_point_is_said_to_be_outside() {
    let mut rng = Rng::new(72);
    for i in 0..12 {
        let slope = [rng.range(-0.2, 0.2), rng.range(-0.2, 0.2)];
        let thickness = [1e-6, 1e-5, 1e-4][i % 3];
        let cavity = inverted(&plate(slope, thickness));
        let mesh = joined(&scaled(&cube(16), 2.0), &cavity);
        let points = beside(slope, &mut rng);
        let scene = Scene::tree("cavity", mesh.clone(), false);
        let decided = ask(&scene, &scene.bvh(), &points, Side::Inside);
        if thickness > DECIDABLE_THICKNESS {
            assert_most(decided, points.len());
        }
        let (bytes, report) = built(&mesh);
        assert_eq!(report.sides, None, "{slope:?} {thickness}");
        ask(&scene, &Bvh::open(&bytes).expect("opens"), &points, Side::Inside);
    }
}

#[test]
fn beside_tetrahedra_that_are_nearly_flat_no_side_is_wrong() {
    let mut rng = Rng::new(73);
    let (mut kept, mut lost) = (0, 0);
    for i in 0..400 {
        let height = 10f32.powi(-4 - i % 5);
        let mut corners: Vec<[f32; 3]> = (0..3).map(|_| rng.point_in([0.0; 3], [1.0; 3])).collect();
        let edge = |a: usize, b: usize| [0, 1, 2].map(|k| corners[b][k] - corners[a][k]);
        let (e, g) = (edge(0, 1), edge(0, 2));
        let normal =
            [0, 1, 2].map(|k| e[(k + 1) % 3] * g[(k + 2) % 3] - e[(k + 2) % 3] * g[(k + 1) % 3]);
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        let middle = [0, 1, 2].map(|k| corners.iter().map(|c| c[k]).sum::<f32>() / 3.0);
        corners.push([0, 1, 2].map(|k| middle[k] + height / length * normal[k]));
        let mesh = (corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let scene = Scene::tree("tetrahedron", mesh, false);
        let points: Vec<[f32; 3]> = (0..60).map(|_| rng.point_in([-1.0; 3], [2.0; 3])).collect();
        // Farther than twice the height: certainly outside.
        let far = |p: &[f32; 3]| scene.truth(*p).lower > f64::from(2.0 * height);
        let points: Vec<[f32; 3]> = points.into_iter().filter(far).collect();
        let decided = ask(&scene, &scene.bvh(), &points, Side::Outside);
        if scene.bvh().has_sides() {
            kept += decided;
        } else {
            assert_eq!(decided, 0);
            lost += 1;
        }
    }
    assert!(kept > 5000 && lost > 50, "{kept} sides, {lost} trees without");
}
