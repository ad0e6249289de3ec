//! Scale, rotation, and the order of triangles: answers follow.

use crate::checks::{holds, intervals_are_narrow, wrong_intervals};
use crate::named::extreme;
use crate::scene::{Kind, Raw, Scene, wide};
use meshsweep::bvh::TreeOptions;
use meshsweep::curve::{self, CurveOptions, Polyline};
use meshsweep::hull::{self, BuildOptions, Levels};
use meshsweep::mesh::Input;
use meshsweep::progress::Watch;
use meshsweep::tight::{self, ChainOptions};
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::{
    Budget, Bvh, Curve, DeformableHull, Facing, Hull, MovedVertex, ScratchEntry, TightHulls,
    Triboxes,
};
use meshsweep_host_tests::generate::extremes::extreme_points;
use meshsweep_host_tests::generate::{Rng, Triangles, scaled, transformed};

/// 2^60 and 2^-60.
const SCALES: [f32; 2] = [(1u128 << 60) as f32, 1.0 / (1u128 << 60) as f32];

const NAMES: [&str; 3] = ["four_triangles", "a_sphere", "needles_of_aspect_1e8"];

/// Points whose multiples are normal numbers.
fn points(mesh: &Triangles) -> Vec<[f32; 3]> {
    let mut points = extreme_points(mesh);
    let is_normal = |x: &f32| *x == 0.0 || (1e-13..1e13).contains(&x.abs());
    points.retain(|p| p.iter().all(is_normal));
    assert!(points.len() > 10);
    points
}

/// What a question answers: lengths, and what has no unit.
type Answer = (Vec<f32>, Vec<f32>);

/// Asks of a mesh and of its multiples; lengths must be the same multiples, the rest the same.
fn scales(ask: impl Fn(&Raw, &[[f32; 3]], f32) -> Vec<Answer>) {
    for name in NAMES {
        let mesh = extreme(name).mesh;
        let points = points(&mesh);
        let plain = ask(&wide(mesh.clone()), &points, 1.0);
        assert!(!plain.is_empty());
        for by in SCALES {
            let multiples: Vec<_> = points.iter().map(|p| p.map(|x| x * by)).collect();
            let large = ask(&wide(scaled(&mesh, by)), &multiples, by);
            for ((p, (lengths, rest)), (others, same)) in points.iter().zip(&plain).zip(&large) {
                let wanted: Vec<f32> = lengths.iter().map(|x| x * by).collect();
                assert_eq!((&wanted, rest), (others, same), "{name} × {by:e}: {p:?}");
            }
        }
    }
}

fn input(scene: &Scene) -> Input<'_> {
    Input { mesh: &scene.mesh, moved: scene.moved, input_triangles: scene.corners.len() }
}

fn stack(entries: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; entries]
}

fn number(triangle: Option<u32>) -> f32 {
    triangle.map_or(-1.0, |triangle| triangle as f32)
}

fn closest(answer: &meshsweep_core::ClosestPoint) -> Answer {
    let [x, y, z] = answer.point;
    let lengths = vec![answer.distance.lower, answer.distance.upper, x, y, z];
    (lengths, vec![number(answer.triangle)])
}

#[test]
fn scaling_by_a_power_of_two_scales_every_bit_of_the_box_tree() {
    for kind in [Kind::Grid, Kind::F32] {
        let options = TreeOptions::default().with_winding(true);
        scales(|raw, points, _| {
            let scene = Scene::with("", raw, kind, &options);
            let (tree, mut memory) = (scene.tree(), stack(Bvh::OVERLAP_ENTRIES));
            let mut answers = Vec::new();
            for (i, &p) in points.iter().enumerate() {
                let near = tree.closest_point(p, Budget::EXACT, &mut memory).expect("a point");
                let (lengths, mut rest) = closest(&near);
                let number = tree.winding_number(p, Budget::EXACT, &mut memory).expect("a point");
                rest.extend([number.number.lower, number.number.upper]);
                let next = points[(i + 1) % points.len()];
                let hit = tree.first_hit(p, next, Facing::Both, Budget::EXACT, &mut memory);
                // Some ends are too far away.
                rest.extend(hit.map_or([-1.0; 2], |hit| [hit.t.lower, hit.t.upper]));
                answers.push((lengths, rest));
            }
            answers
        });
    }
}

#[test]
fn scaling_by_a_power_of_two_scales_every_bit_of_a_sweep_and_of_a_hull_that_moves() {
    scales(|raw, points, by| {
        let scene = Scene::new("", raw, Kind::F32);
        let options = BuildOptions { base_faces: 4, ..BuildOptions::default() };
        let sweep = options.with_levels(Levels::Sweep);
        let built = hull::build(input(&scene), &sweep, Watch::NONE).expect("builds").0.to_bytes();
        let model = Hull::open(&built).expect("opens");
        let mut memory = stack(model.scratch_entries());
        let mut answers = Vec::new();
        for (i, &p) in points.iter().enumerate() {
            let near = model.closest_point(p, Budget::EXACT, &mut memory).expect("a point");
            let (lengths, mut rest) = closest(&near);
            let next = points[(i + 1) % points.len()];
            let hit = model.first_hit(p, next, Budget::EXACT, &mut memory).expect("a segment");
            rest.extend([hit.t.lower, hit.t.upper, number(hit.hit.and_then(|hit| hit.triangle))]);
            answers.push((lengths, rest));
        }
        let deform = options.with_levels(Levels::Deform(&[]));
        if let Ok((sections, _)) = hull::build(input(&scene), &deform, Watch::NONE) {
            let built = sections.to_bytes();
            let hull = DeformableHull::open(&built).expect("opens");
            let mut records = vec![MovedVertex::EMPTY; hull.vertex_records()];
            let mut moved = hull.moved(&mut records).expect("enough");
            let place = |v: u32| {
                let [x, y, z] = raw.0[v as usize].map(|x| x as f32);
                [1.25 * x, y - 0.5 * by, z]
            };
            moved.update(place).expect("in the domain");
            let mut memory = stack(hull.rest().scratch_entries());
            for (&p, (lengths, rest)) in points.iter().zip(&mut answers) {
                let near = moved.closest_point(p, Budget::EXACT, &mut memory).expect("a point");
                let (more, also) = closest(&near);
                lengths.extend(more);
                rest.extend(also);
            }
        }
        answers
    });
}

#[test]
fn scaling_by_a_power_of_two_scales_every_bit_of_triboxes_and_curves() {
    scales(|raw, points, _| {
        let scene = Scene::new("", raw, Kind::F32);
        let bytes = {
            let options = TriboxOptions::new(8);
            let built = tribox::build(input(&scene), &options, Watch::NONE);
            built.expect("in the domain").0.to_bytes()
        };
        let triboxes = Triboxes::open(&bytes).expect("opens");
        let sides = scene.corners.iter();
        let sides =
            sides.map(|t| Polyline { points: t.to_vec(), is_closed: true, ..Polyline::default() });
        let options = CurveOptions::default();
        let curves = curve::build(&sides.collect::<Vec<_>>(), &options, Watch::NONE);
        let bytes = curves.expect("curves").0.to_bytes();
        let curve = Curve::open(&bytes).expect("opens");
        let mut memory = stack(triboxes.scratch_entries() + curve.scratch_entries());
        let ask = |&p: &[f32; 3]| {
            let bound = triboxes.distance(p, Budget::EXACT, &mut memory).expect("a point");
            let near = curve.closest_point(p, Budget::EXACT, &mut memory).expect("a point");
            let [x, y, z] = near.point;
            let lengths = vec![
                bound.lower,
                near.distance.lower,
                near.distance.upper,
                x,
                y,
                z,
                near.safe_motion,
            ];
            (lengths, vec![near.t, near.segment.polyline as f32])
        };
        points.iter().map(ask).collect()
    });
}

#[test]
fn scaling_by_a_power_of_two_scales_every_bit_of_tight_hulls() {
    let mesh = extreme("four_triangles").mesh;
    let points = points(&mesh);
    let ask = |by: f32| -> Vec<Answer> {
        let scene = Scene::new("", &wide(scaled(&mesh, by)), Kind::Grid);
        let options = ChainOptions::of_faces(&[20]).with_effort(0.001);
        let bytes =
            tight::build(input(&scene), &options, Watch::NONE).expect("builds").0.to_bytes();
        let hulls = TightHulls::open(&bytes).expect("opens");
        let hull = hulls.get(0).expect("a hull");
        let mut memory = stack(hull.bvh().header().stack_entries as usize);
        let ask = |p: &[f32; 3]| {
            let p = p.map(|x| x * by);
            let answer = hull.closest_point(p, Budget::EXACT, &mut memory).expect("a point");
            let (lengths, rest) = closest(&answer);
            (lengths.iter().map(|x| x / by).collect(), rest)
        };
        points.iter().map(ask).collect()
    };
    let plain = ask(1.0);
    SCALES.iter().for_each(|&by| assert_eq!(plain, ask(by), "{by:e}"));
}

/// Turned by a quarter about each axis, which is exact, and by a third of a turn about (1, 1, 1).
const TURNS: [[[f32; 3]; 3]; 3] = [
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
];

#[test]
fn a_turned_mesh_has_the_distances_of_the_mesh() {
    for name in ["a_sphere", "slivers_of_aspect_1e8", "an_open_mesh"] {
        let mesh = extreme(name).mesh;
        let plain = Scene::new(name, &wide(mesh.clone()), Kind::F32);
        for turn in TURNS {
            let turned = transformed(&mesh, turn, [0.0; 3]);
            let scene = Scene::new(name, &wide(turned), Kind::Grid);
            let options = BuildOptions { levels: Levels::Sweep, ..BuildOptions::default() };
            let built = hull::build(input(&scene), &options, Watch::NONE).expect("builds");
            let built = built.0.to_bytes();
            let model = Hull::open(&built).expect("opens");
            let (tree, mut memory) = (scene.tree(), stack(model.scratch_entries() + 64));
            for p in extreme_points(&mesh) {
                let (asked, _) = transformed(&(vec![p], Vec::new()), turn, [0.0; 3]);
                let truth = plain.nearest(p);
                let of_tree = tree.closest_point(asked[0], Budget::EXACT, &mut memory);
                let of_sweep = model.closest_point(asked[0], Budget::EXACT, &mut memory);
                for answer in [of_tree, of_sweep].map(|answer| answer.expect("a point")) {
                    assert!(holds(&truth, p, answer.distance), "{name}: {p:?} {answer:?}");
                }
            }
        }
    }
}

#[test]
fn the_order_of_triangles_and_of_their_corners_does_not_change_distances() {
    let rng = &mut Rng::new(12);
    for name in ["a_sphere", "a_lattice_of_equal_distances", "coplanar_triangles_that_overlap"] {
        let (positions, mut triangles) = extreme(name).mesh;
        let points = extreme_points(&(positions.clone(), triangles.clone()));
        for _ in 0..4 {
            for i in (1..triangles.len()).rev() {
                triangles.swap(i, rng.below(i + 1));
                triangles[i].rotate_left(rng.below(3));
            }
            for kind in [Kind::Grid, Kind::F32] {
                // Both intervals hold the same distance, and neither is wider than rounding.
                let scene = Scene::new(name, &wide((positions.clone(), triangles.clone())), kind);
                assert_eq!(wrong_intervals(&scene, &points), [""; 0]);
                intervals_are_narrow(&scene, &points);
            }
        }
    }
}
