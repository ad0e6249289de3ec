//! Corners of the domain, each once a defect.

use super::scenes::options;
use meshsweep::BuildError;
use meshsweep::cut::cut;
use meshsweep::hull::build;
use meshsweep::mesh::{RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep::surface::VertexBits;
use meshsweep_core::{Budget, Ended, Hull, OuterSearch, RefinedHull, ScratchEntry};
use meshsweep_host_tests::generate::{Rng, cube, rough_sphere, transformed, uv_sphere};
use meshsweep_host_tests::scene::Scene;

#[test]
fn every_level_of_a_hull_that_one_base_triangle_stands_for_can_be_cut() {
    for (n, m) in [(5, 6), (4, 8), (3, 12), (6, 7)] {
        let flat = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1e-3]];
        let mesh = transformed(&uv_sphere(n, m), flat, [100.0, 0.0, 0.0]);
        let scene = Scene::hull(format!("disc {n} {m}"), mesh, &options(4));
        let model = scene.model();
        for level in 0..model.header().levels {
            let bytes = cut(&model, level).expect("the level exists").to_bytes();
            let coarse = Hull::open(&bytes);
            assert!(coarse.is_ok(), "{} level {level}: {:?}", scene.name, coarse.err());
        }
    }
}

#[test]
fn a_far_query_is_exact_and_opens_a_small_part_of_the_tree() {
    let scene = Scene::hull("rough", rough_sphere(4, 0.2, 3), &options(100));
    let model = scene.model();
    let triangles = model.header().surface_triangles;
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    for exponent in [3, 5, 7, 9, 11, 13] {
        let far = 10f32.powi(exponent);
        let answer = model
            .closest_point([far, 0.7 * far, -0.3 * far], Budget::EXACT, &mut queue)
            .expect("answers");
        let work = answer.work;
        if far < 1e11 {
            assert_eq!(answer.ended, Ended::Exact);
            assert!(work.exact < triangles / 4, "at {far}: {work:?} of {triangles}");
        }
        assert!(
            answer.distance.upper <= answer.distance.lower.next_up().next_up().next_up(),
            "at {far}: {answer:?}"
        );
    }
}

#[test]
fn a_hull_of_a_moved_surface_is_never_called_clear_by_its_box() {
    let side = [[0.600_011_7, 0.0, 0.0], [0.0, 0.600_011_7, 0.0], [0.0, 0.0, 0.600_011_7]];
    let (positions, triangles) = transformed(&cube(4), side, [0.4, 0.4, 0.4]);
    let (mesh, _) = repair(RawMesh::from_f32(&positions, &triangles)).expect("sound");
    let low = mesh.positions.iter().map(|p| p[0]).fold(f32::INFINITY, f32::min);
    let chosen = meshsweep::hull::BuildOptions { vertex_bits: VertexBits::Grid16, ..options(12) };
    let built = build(mesh.as_input(), &chosen, Watch::NONE).expect("builds");
    let built = built.0.to_bytes();
    let model = Hull::open(&built).expect("opens");
    assert!(model.header().surface_error > 0.0);
    let mut refined = RefinedHull::<256>::new();
    for x in [low, low.next_up(), low.next_down()] {
        let answer = model.outer_hits(
            [x, 0.4, 5.0],
            [x, 0.4, -5.0],
            OuterSearch::First,
            &mut refined,
            &mut [],
            Budget::EXACT,
            &mut [],
        );
        let answer = answer.expect("answers");
        assert!(answer.t.lower <= 1.0 && answer.ended == Ended::Resolution, "{answer:?}");
    }
}

#[test]
fn a_mesh_that_is_mostly_inside_out_is_refused_by_name() {
    // A prism over a figure of eight whose larger loop runs clockwise.
    let outline = [[0.0, 0.0], [4.0, 3.0], [4.0, 0.0], [0.0, 1.0f32]];
    let mut positions: Vec<[f32; 3]> = Vec::new();
    for z in [0.0, 1.0] {
        positions.extend(outline.iter().map(|[x, y]| [*x, *y, z]));
    }
    let mut triangles = vec![[2, 1, 0], [3, 2, 0], [4, 5, 6], [4, 6, 7]];
    for i in 0..4u32 {
        let j = (i + 1) % 4;
        triangles.extend([[i, j, 4 + j], [i, 4 + j, 4 + i]]);
    }
    let (mesh, _) = repair(RawMesh::from_f32(&positions, &triangles)).expect("sound");
    match build(mesh.as_input(), &options(8), Watch::NONE) {
        Err(error @ BuildError::NotPositive { .. }) => {
            assert!(error.to_string().contains("inside out"))
        }
        Ok(built) => {
            assert!(matches!(built.1.kind, meshsweep::hull::Kind::Hulls { volume } if volume > 0.0))
        }
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn tolerance_is_claimed_only_for_intervals_that_meet_it() {
    let mesh = rough_sphere(3, 0.2, 5);
    let grid = meshsweep::hull::BuildOptions { vertex_bits: VertexBits::Grid16, ..options(60) };
    let (exact, moved) =
        (Scene::hull("exact", mesh.clone(), &options(60)), Scene::hull("moved", mesh, &grid));
    let coarse = cut(&exact.model(), 2).expect("three levels").to_bytes();
    let mut rng = Rng::new(11);
    for bytes in [&exact.bytes, &moved.bytes, &coarse] {
        let model = Hull::open(bytes).expect("opens");
        let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
        for _ in 0..500 {
            let point = [0; 3].map(|_| 4.0 * rng.unit_f32() - 2.0);
            for stop in [
                Budget::EXACT.with_relative(0.01),
                Budget::EXACT.with_relative(0.5),
                Budget::EXACT.with_absolute(1e-3),
            ] {
                let answer = model.closest_point(point, stop, &mut queue).expect("answers");
                let (lower, upper) =
                    (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
                let met = upper <= lower * (1.0 + f64::from(stop.relative))
                    || upper - lower <= f64::from(stop.absolute);
                assert!(answer.ended != Ended::Tolerance || met, "{answer:?} {stop:?}");
            }
        }
    }
}
