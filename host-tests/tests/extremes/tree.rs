//! Every question to the box tree, on a grid and with f32 vertices.

use crate::checks::{
    bits_are_kept_on_a_path, bits_do_not_depend_on_the_way, hits_are_true, intervals_are_narrow,
    neighbors_are_complete, verdicts_are_true, wrong_intervals,
};
use crate::scene::{Kind, Scene, wide};
use meshsweep::bvh::TreeOptions;
use meshsweep_core::{Budget, Bvh, Pose, ScratchEntry, Side, Solid, Verdict};
use meshsweep_host_tests::generate::extremes::{Extreme, extreme_points};
use meshsweep_host_tests::generate::{Triangles, cube, scaled};
use meshsweep_host_tests::oracle::exact::{Corners, distance_compared, first_meeting, meet};
use meshsweep_host_tests::oracle::{distance_of_meshes, winding_number};
use std::cmp::Ordering::{Greater, Less};

pub fn scenes(extreme: &Extreme) -> [Scene; 2] {
    let (raw, options) = (wide(extreme.mesh.clone()), TreeOptions::default().with_winding(true));
    [Kind::Grid, Kind::F32].map(|kind| Scene::with(extreme.name, &raw, kind, &options))
}

fn distances(extreme: &Extreme) {
    let points = extreme_points(&extreme.mesh);
    for scene in scenes(extreme) {
        let wrong = wrong_intervals(&scene, &points);
        assert!(wrong.is_empty(), "{} intervals are wrong:\n{}", wrong.len(), wrong.join("\n"));
        intervals_are_narrow(&scene, &points);
        verdicts_are_true(&scene, &points, &mut [0; 3]);
        neighbors_are_complete(&scene, &points);
    }
}

fn ways(extreme: &Extreme) {
    let points = extreme_points(&extreme.mesh);
    for scene in scenes(extreme) {
        bits_do_not_depend_on_the_way(&scene, &points);
        for ends in points.chunks_exact(2).step_by(3) {
            bits_are_kept_on_a_path(&scene, [ends[0], ends[1]]);
        }
    }
}

/// From each point to the next, to the one after that, and to itself.
pub fn segments(points: &[[f32; 3]]) -> Vec<[[f32; 3]; 2]> {
    let count = points.len();
    let ends = |i: usize| [1, 2, 5].map(|by| [points[i], points[(i + by) % count]]);
    (0..count).flat_map(ends).chain(points.iter().step_by(3).map(|&p| [p; 2])).collect()
}

fn hits(extreme: &Extreme) {
    let segments = segments(&extreme_points(&extreme.mesh));
    for scene in scenes(extreme) {
        hits_are_true(&scene, &segments, &mut [0; 3]);
    }
}

/// The winding number about a point off the mesh, where f64 can tell it.
fn number(extreme: &Extreme, p: [f32; 3], scene: &Scene) -> Option<f64> {
    let (positions, triangles) = &extreme.mesh;
    let reach = positions.iter().flatten().fold(0f64, |m, x| m.max(f64::from(x.abs())));
    let is_off = |t: &&Corners| distance_compared(p.map(f64::from), t, 1e-4 * scene.length());
    if scene.nearest(p).iter().any(|t| is_off(t) != Greater) {
        return None;
    }
    Some(winding_number(p.map(f64::from), positions, triangles, reach))
}

fn sides(extreme: &Extreme) {
    for scene in scenes(extreme) {
        let (tree, mut stack) = (scene.tree(), scene.stack());
        for p in extreme_points(&extreme.mesh) {
            let Some(truth) = number(extreme, p, &scene) else { continue };
            let at = || format!("{}: {p:?}, truly {truth}", scene.name);
            let found = tree.winding_number(p, Budget::EXACT, &mut stack).expect("a point");
            let (lower, upper) = (f64::from(found.number.lower), f64::from(found.number.upper));
            // The repair may have wound parts of a soup otherwise.
            let is_as_wound = !extreme.is_solid || (lower - 1e-9 <= truth && truth <= upper + 1e-9);
            assert!(is_as_wound, "{}: {found:?}", at());
            let signed =
                tree.signed_distance_by_winding(p, Budget::EXACT, &mut stack).expect("a point");
            let nearest = tree.signed_distance(p, Budget::EXACT, &mut stack);
            let nearest = nearest.ok().filter(|_| extreme.is_solid).map(|a| a.side);
            let by_number = Some(signed.side).filter(|_| extreme.is_solid);
            for side in [by_number, nearest].into_iter().flatten() {
                match side {
                    Side::Inside => assert!(truth > 0.5, "{}", at()),
                    Side::Outside => assert!(truth < 0.5, "{}", at()),
                    _ => {}
                }
            }
        }
    }
}

/// A cube a quarter as large as a mesh, and places where it meets the mesh, is beside it, and far.
fn others(scene: &Scene) -> (Triangles, Vec<[f32; 3]>) {
    let size = (0.125 * scene.length()).clamp(2e-38, 1e37) as f32;
    let probe = scaled(&cube(1), size);
    let far = [0.0, 0.5, 1.0, 1e3, 1e6];
    let at = |by: f64| -> [f32; 3] {
        let [x, y, z] = scene.corners[0][0];
        let length = scene.length();
        [(x + by * length) as f32, y as f32, (z + 0.3 * by * length) as f32]
    };
    let places = far.into_iter().map(at).filter(|p| p.iter().all(|x| x.is_finite()));
    (probe, places.collect())
}

fn pairs(extreme: &Extreme) {
    const IDENTITY: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (scene, kind) in scenes(extreme).iter().zip([Kind::Grid, Kind::F32]) {
        let (probe, places) = others(scene);
        let other = Scene::new("probe", &wide(probe.clone()), kind);
        let (tree, second) = (scene.tree(), other.tree());
        let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
        for translation in places {
            let at = || format!("{} and a cube at {translation:?}", scene.name);
            let pose = Pose { translation, ..Pose::IDENTITY };
            let moved =
                |t: &Corners| t.map(|p| std::array::from_fn(|k| p[k] + f64::from(translation[k])));
            let cubes: Vec<Corners> = other.corners.iter().map(moved).collect();
            let is_met = scene.corners.iter().any(|t| cubes.iter().any(|c| meet(t, c)));
            if let Ok(found) = tree.overlap(&second, pose, Budget::EXACT, &mut stack) {
                let wrong = match found.verdict {
                    Verdict::Yes => !is_met,
                    Verdict::No => is_met,
                    _ => false,
                };
                assert!(!wrong, "{}: {found:?}, met: {is_met}", at());
            }
            let ours = (extreme.mesh.0.as_slice(), extreme.mesh.1.as_slice());
            let truth = || distance_of_meshes(ours, (&probe.0, &probe.1), &IDENTITY, translation);
            if let Ok(found) = tree.distance_to(&second, pose, Budget::EXACT, &mut stack) {
                let (lower, upper) = (f64::from(found.distance.lower), found.distance.upper);
                let truth = truth();
                let holds = lower <= truth.upper && f64::from(upper) >= truth.lower;
                assert!(holds, "{}: {found:?} {truth:?}", at());
            }
        }
    }
}

/// A ball about each point, and a capsule from one to the next.
fn solids(extreme: &Extreme) {
    let points = extreme_points(&extreme.mesh);
    for scene in scenes(extreme) {
        let (tree, mut stack) = (scene.tree(), vec![ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES]);
        let radius = (0.01 * scene.length()) as f32;
        for (i, &p) in points.iter().enumerate() {
            let ball = [p];
            let solid = Solid::new(&ball, radius).expect("a ball");
            let Ok(found) = tree.solid_distance(&solid, Budget::EXACT, &mut stack) else {
                continue;
            };
            let reach = |x: f32| f64::from(x) + f64::from(radius);
            let truth = scene.nearest(p);
            let compared = |t, x: f64| distance_compared(p.map(f64::from), t, x);
            let is_above = found.distance.lower > 0.0
                && truth.iter().any(|t| compared(t, reach(found.distance.lower)) == Less);
            let is_below = found.distance.upper < f32::INFINITY
                && truth.iter().all(|t| compared(t, reach(found.distance.upper)) == Greater);
            assert!(!is_above && !is_below, "{}: {p:?} {found:?}", scene.name);
            let ends = [p, points[(i + 1) % points.len()]];
            let solid = Solid::new(&ends, 0.0).expect("a segment");
            let Ok(found) = tree.solid_distance(&solid, Budget::EXACT, &mut stack) else {
                continue;
            };
            let [a, b] = ends.map(|p| p.map(f64::from));
            let is_met = scene.corners.iter().any(|t| first_meeting(a, b, t).is_some());
            let wrong = is_met && found.distance.lower > 0.0;
            assert!(!wrong, "{}: {ends:?} {found:?}", scene.name);
        }
    }
}

on_every_extreme!(distances_contain_the_truth, super::distances);
on_every_extreme!(bits_do_not_depend_on_the_way, super::ways);
on_every_extreme!(hits_and_clear_segments_are_true, super::hits);
on_every_extreme!(sides_and_winding_numbers_are_true, super::sides);
on_every_extreme!(overlaps_and_distances_of_pairs_are_true, super::pairs);
on_every_extreme!(distances_of_solids_contain_the_truth, super::solids);
