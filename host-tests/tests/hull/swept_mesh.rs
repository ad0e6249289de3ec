//! The mesh that a sweep ends with: closed, around the part, of triangles of the surface near the
//! point, and the least that the tables allow.

use super::deform::{between, build, memory, motion, place};
use super::scenes::{all, exact, options};
use glam::DVec3;
use meshsweep::check::canonical;
use meshsweep_core::internal::hull::format::SplitIdx;
use meshsweep_core::{
    Budget, DeformableHull, Ended, Focus, Hull, HullFace, QueryError, RefinedHull, ScratchEntry,
    VertIdx,
};
use meshsweep_host_tests::generate::{Rng, rough_sphere, torus};
use meshsweep_host_tests::oracle::replayed::{Inside, Replayed};
use meshsweep_host_tests::oracle::{distance_to_triangle, wide_distance_sq};
use meshsweep_host_tests::scene::Scene;
use std::collections::{BTreeMap, BTreeSet};

/// Splits of a refined hull that holds all of each scene.
const ALL: usize = 4096;

type Corners = [[f32; 3]; 3];

/// Radii of the triangles of all levels, input units, by their corners in order.
fn radii(hull: &Hull<'_>) -> BTreeMap<[u32; 3], f64> {
    let mut radii = BTreeMap::new();
    let mut put = |corners: [VertIdx; 3], number: u32| {
        let radius = f64::from(hull.radius(number).expect("in range")) * hull.scale();
        radii.insert(canonical(corners.map(|v| v.0)), radius);
    };
    for number in 0..hull.header().base_triangles {
        put(hull.base_triangle(number).expect("in range"), number);
    }
    for split in (0..hull.split_count()).map(|s| hull.split(SplitIdx(s)).expect("in range")) {
        for slot in 0..split.fine_len() {
            put(split.fine(slot).expect("in range"), split.first_triangle + slot as u32);
        }
    }
    radii
}

fn corners(hull: &Hull<'_>, triangle: [u32; 3]) -> Corners {
    triangle.map(|v| hull.vertex(VertIdx(v)).expect("in range"))
}

/// Performs all splits that remove faces within a distance, again and again, until none is left.
fn refine(
    hull: Hull<'_>,
    radii: &BTreeMap<[u32; 3], f64>,
    p: [f32; 3],
    distance: f64,
) -> BTreeSet<u32> {
    let mut state = Replayed::new(hull);
    let mut is_far = BTreeSet::new();
    loop {
        let mut wanted = BTreeSet::new();
        for triangle in state.triangles() {
            let Some(split) = hull.removed_by(triangle.map(VertIdx)) else { continue };
            if !is_far.contains(&triangle) {
                let away = distance_to_triangle(p, corners(&hull, triangle)).lower;
                if away - radii[&triangle] <= distance {
                    wanted.insert(split.0);
                } else {
                    is_far.insert(triangle);
                }
            }
        }
        if wanted.is_empty() {
            return state.performed().clone();
        }
        wanted.into_iter().for_each(|split| state.perform(split));
    }
}

/// The splits that made a hull's faces, and those that they require.
fn performed<'t>(hull: Hull<'t>, faces: &[HullFace]) -> Replayed<'t> {
    let mut state = Replayed::new(hull);
    for vertex in faces.iter().flat_map(|face| face.corners) {
        if let Some(split) = hull.made_by(vertex) {
            state.perform(split.0);
        }
    }
    state
}

fn named(faces: &[HullFace]) -> BTreeSet<[u32; 3]> {
    faces.iter().map(|face| canonical(face.corners.map(|v| v.0))).collect()
}

fn entries(count: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; count]
}

#[test]
fn the_mesh_of_a_sweep_is_closed_around_the_part_and_the_least_that_the_tables_allow() {
    let mut coarser = 0;
    for scene in all() {
        let (hull, points) = (scene.model(), Inside::new(scene.model()));
        let (radii, mut rng) = (radii(&hull), Rng::new(201));
        let mut refined = Box::new(RefinedHull::<ALL>::new());
        let mut scratch = entries(hull.sweep_entries());
        for round in 0..6 {
            let p = scene.around([1.0, 1.5, 6.0][round % 3], &mut rng);
            let mut sweep = hull.sweep(p, &mut scratch).expect("finite");
            let near = sweep.closest_point(Budget::EXACT).expect("finite");
            let distance = near.distance.upper;
            let mesh = refined.sweep_to(sweep.hull(), p, distance).expect("near");
            assert_eq!(mesh.error_left, 0.0);
            let faces: Vec<_> = refined.faces(&hull).collect();
            let state = performed(hull, &faces);
            assert_eq!(named(&faces), state.triangles().into_iter().collect(), "{}", scene.name);
            assert_eq!(faces.len(), mesh.faces as usize);
            assert_eq!([state.performed().len(), refined.splits()], [mesh.splits as usize; 2]);
            state.assert_encloses(&points);
            // What certainly has to be performed is, and nothing that certainly has not.
            let (distance, size) = (f64::from(distance), f64::from(scene.size()));
            let slack = 1e-5 * (size + distance);
            let least = refine(hull, &radii, p, distance - slack);
            let most = refine(hull, &radii, p, distance + slack);
            assert!(least.is_subset(state.performed()), "{}: {p:?}", scene.name);
            assert!(state.performed().is_subset(&most), "{}: {p:?}", scene.name);
            coarser += usize::from(faces.len() * 2 < hull.triangle_count() as usize);
        }
    }
    assert!(coarser > 30, "{coarser}");
}

/// Whether a mesh has a triangle of these corners, from whichever corner on.
fn has(faces: &[(bool, Corners)], wanted: Corners) -> bool {
    let [a, b, c] = wanted;
    faces.iter().any(|&(_, held)| [[a, b, c], [b, c, a], [c, a, b]].contains(&held))
}

/// Faces, each with whether it is a triangle of the surface.
fn placed(hull: &Hull<'_>, faces: &[HullFace]) -> Vec<(bool, Corners)> {
    let is_surface = |face: &HullFace| hull.removed_by(face.corners).is_none();
    let at = |face: &HullFace| corners(hull, face.corners.map(|v| v.0));
    faces.iter().map(|face| (is_surface(face), at(face))).collect()
}

#[test]
fn triangles_within_the_distance_are_faces_and_other_faces_stand_for_what_is_farther() {
    let (mut near_faces, mut coarse_faces) = (0, 0);
    for scene in exact() {
        let hull = scene.model();
        let mut refined = Box::new(RefinedHull::<ALL>::new());
        let (mut scratch, mut rng) = (entries(hull.scratch_entries()), Rng::new(202));
        for round in 0..8 {
            let p = scene.around(1.3, &mut rng);
            let near = hull.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
            let within = near.distance.upper + [0.0, 0.05][round % 2] * scene.size();
            refined.sweep_to(&hull, p, within).expect("near");
            let faces: Vec<_> = refined.faces(&hull).collect();
            let placed = placed(&hull, &faces);
            let nearest = near.triangle.expect("a whole blob");
            assert!(has(&placed, scene.corners(nearest)), "{}: {p:?}", scene.name);
            for triangle in 0..scene.triangles.len() as u32 {
                let corners = scene.corners(triangle);
                if distance_to_triangle(p, corners).upper <= f64::from(within) {
                    assert!(has(&placed, corners), "{}: {p:?} {triangle}", scene.name);
                    near_faces += 1;
                }
            }
            for (face, &(is_surface, corners)) in faces.iter().zip(&placed) {
                if !is_surface {
                    let radius = f64::from(face.radius) * hull.scale();
                    let away = distance_to_triangle(p, corners).upper;
                    assert!(away - radius > f64::from(within), "{}: {p:?}", scene.name);
                    coarse_faces += 1;
                }
            }
        }
    }
    assert!(near_faces > 300 && coarse_faces > 3000, "{near_faces} {coarse_faces}");
}

#[test]
fn an_interrupted_sweep_has_a_coarser_mesh_that_its_successors_refine() {
    let scene = &all()[2];
    let hull = scene.model();
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    let (mut scratch, mut rng) = (entries(hull.sweep_entries()), Rng::new(203));
    let mut grew = 0;
    for _ in 0..20 {
        let p = scene.around(1.5, &mut rng);
        let mut sweep = hull.sweep(p, &mut scratch).expect("finite");
        let mut before: Option<BTreeSet<u32>> = None;
        let mut known = 0f32;
        loop {
            let near = sweep.closest_point(Budget::EXACT.with_steps(10)).expect("finite");
            let is_done = near.ended == Ended::Exact;
            // The best of the lower ends so far.
            known = known.max(if is_done { near.distance.upper } else { near.distance.lower });
            refined.sweep_to(sweep.hull(), p, known).expect("near");
            let faces: Vec<_> = refined.faces(&hull).collect();
            let now = performed(hull, &faces).performed().clone();
            if let Some(before) = before {
                assert!(before.is_subset(&now));
                grew += usize::from(before.len() < now.len());
            }
            if is_done {
                break;
            }
            before = Some(now);
        }
    }
    assert!(grew > 20, "{grew}");
}

#[test]
fn a_mesh_that_deforms_has_its_near_triangles_as_faces_of_a_closed_mesh() {
    let mut near_faces = 0;
    for (index, mesh) in [torus(0.8, 0.3, 24, 12), rough_sphere(2, 0.3, 5)].iter().enumerate() {
        let keys: Vec<_> = (1..4).map(|key| motion(&mesh.0, f64::from(key) / 3.0)).collect();
        let built = build(mesh, &keys);
        let part = DeformableHull::open(&built).expect("just built");
        let (mut records, hull) = (memory(&part), part.rest());
        let mut moved = part.moved(&mut records).expect("enough records");
        let mut refined = Box::new(RefinedHull::<ALL>::new());
        let mut rng = Rng::new(211 + index as u64);
        for step in 0..60 {
            let p: [f32; 3] = std::array::from_fn(|_| rng.range(-2.0, 2.0));
            let frame = step as f32 / 20.0;
            let at = part.at_frame(frame).expect("a frame");
            let free = motion(&mesh.0, f64::from(frame) / 2.0);
            place(&mut moved, &free);
            let between = between(&mesh.0, &keys, frame);
            let free: Vec<_> = free.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
            let mut ask = |positions: &[DVec3], is_free: bool| {
                let at_vertex = |v| if is_free { moved.vertex(v) } else { at.vertex(v) };
                let away = |t: &[u32; 3]| {
                    let corners = t.map(|v| positions[v as usize].to_array());
                    wide_distance_sq(p.map(f64::from), corners).sqrt()
                };
                let least = mesh.1.iter().map(away).fold(f64::INFINITY, f64::min);
                let within = (least + 0.1) as f32;
                if is_free {
                    refined.sweep_to(&&moved, p, within).expect("near");
                } else {
                    refined.sweep_to(&at, p, within).expect("near");
                }
                let faces: Vec<_> = refined.faces(&hull).collect();
                let state = performed(hull, &faces);
                assert_eq!(named(&faces), state.triangles().into_iter().collect());
                assert!(faces.len() <= mesh.1.len());
                let placed: Vec<[DVec3; 3]> = faces
                    .iter()
                    .filter(|face| hull.removed_by(face.corners).is_none())
                    .map(|face| face.corners.map(|v| at_vertex(v).expect("in range")))
                    .map(|corners| corners.map(|p| DVec3::from(p.map(f64::from))))
                    .collect();
                for triangle in mesh.1.iter().filter(|t| away(t) < f64::from(within) - 1e-5) {
                    let wanted = triangle.map(|v| positions[v as usize]);
                    let is_it = |held: &[DVec3; 3]| {
                        (0..3).any(|k| (0..3).all(|i| held[i].distance(wanted[(i + k) % 3]) < 1e-5))
                    };
                    assert!(placed.iter().any(is_it), "{step} {is_free} {p:?}");
                    near_faces += 1;
                }
            };
            ask(&between, false);
            ask(&free, true);
        }
    }
    assert!(near_faces > 1000, "{near_faces}");
}

#[test]
fn an_open_mesh_has_its_near_triangles_as_faces() {
    let (positions, mut triangles) = rough_sphere(3, 0.2, 7);
    triangles.retain(|t| t.iter().all(|&v| positions[v as usize][2] < 0.5));
    let scene = Scene::sweep("bowl", (positions, triangles), &options(24));
    let hull = scene.model();
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    let mut rng = Rng::new(204);
    let mut near_faces = 0;
    for _ in 0..40 {
        let p = scene.around(1.3, &mut rng);
        let within = (scene.truth(p).upper + 0.1) as f32;
        let mesh = refined.sweep_to(&hull, p, within).expect("near");
        let faces: Vec<_> = refined.faces(&hull).collect();
        assert_eq!((faces.len(), mesh.error_left), (mesh.faces as usize, 0.0));
        assert!(faces.iter().all(|face| face.radius.is_finite()));
        let placed = placed(&hull, &faces);
        for triangle in 0..scene.triangles.len() as u32 {
            let corners = scene.corners(triangle);
            if distance_to_triangle(p, corners).upper <= f64::from(within) {
                assert!(has(&placed, corners), "{p:?} {triangle}");
                near_faces += 1;
            }
        }
    }
    assert!(near_faces > 100, "{near_faces}");
}

fn with_memory_for<const SPLITS: usize>() -> f32 {
    let scene = &all()[2];
    let (hull, points) = (scene.model(), Inside::new(scene.model()));
    let mut refined = Box::new(RefinedHull::<SPLITS>::new());
    let p = scene.on_surface(&mut Rng::new(205));
    refined.update(&hull, &Focus::Everywhere, 0.1, &mut []).expect("in domain");
    let mesh = refined.sweep_to(&hull, p, 0.3).expect("near");
    let faces: Vec<_> = refined.faces(&hull).collect();
    assert_eq!(mesh.splits as usize, refined.splits());
    performed(hull, &faces).assert_encloses(&points);
    mesh.error_left
}

#[test]
fn short_memory_gives_a_closed_mesh_and_says_what_is_left() {
    assert!(with_memory_for::<0>() > 0.0);
    assert!(with_memory_for::<1>() > 0.0);
    assert!(with_memory_for::<40>() > 0.0);
    assert_eq!(with_memory_for::<ALL>(), 0.0);
}

#[test]
fn a_point_or_a_distance_that_is_none_is_a_typed_error_and_changes_nothing() {
    let hull = all()[0].model();
    let mut refined = Box::new(RefinedHull::<ALL>::new());
    refined.update(&hull, &Focus::Everywhere, 0.01, &mut []).expect("in domain");
    let splits = refined.splits();
    for (p, distance, refusal) in [
        ([0.0, f32::NAN, 0.0], 1.0, QueryError::NotFinite),
        ([1e30; 3], 1.0, QueryError::OutOfDomain),
        ([0.0; 3], -1.0, QueryError::Tolerance),
        ([0.0; 3], f32::NAN, QueryError::Tolerance),
        ([0.0; 3], f32::INFINITY, QueryError::Tolerance),
    ] {
        assert_eq!(refined.sweep_to(&hull, p, distance), Err(refusal));
        assert_eq!(refined.splits(), splits);
    }
    let far = refined.sweep_to(&hull, [1e6; 3], 0.0).expect("near enough");
    assert_eq!((far.splits, far.faces), (0, hull.header().base_triangles));
}
