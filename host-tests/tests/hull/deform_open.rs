//! Meshes that are open, one-sided or crossing, and deform. Every question is answered as of the
//! moved mesh, which is asked by brute force, and nothing answers for a hole.

use super::deform::{between, build_levels, holds, memory, motion, place, point, section, wide};
use super::deform_overlap::{check, coarse};
use super::deform_sweep::{ask, distances, entries, list};
use super::open::{kept, plate, strip, touching_holes_and_a_wall};
use super::scenes::options;
use meshsweep::check::{Against, Outcome, check_blob, verify};
use meshsweep::hull::Levels;
use meshsweep::mesh::{KeyFrame, Mesh};
use meshsweep_core::{Budget, DeformableHull, Ended, SectionKind, TriangleHit};
use meshsweep_host_tests::corrupt::seal;
use meshsweep_host_tests::generate::{Rng, Triangles, cube, rough_sphere, torus};
use meshsweep_host_tests::motion::Tally;
use meshsweep_host_tests::oracle::contacts;
use meshsweep_host_tests::scene::Scene;
use std::collections::BTreeSet;

/// Frames of a motion.
const FRAMES: usize = 150;

fn build(mesh: &Triangles, frames: &[Vec<[f32; 3]>]) -> Vec<u8> {
    build_levels(mesh, frames, |frames| Levels::SweepDeform(frames))
}

/// Without vertices that no triangle has.
fn compact((positions, triangles): Triangles) -> Triangles {
    let used: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
    let rank = |v: u32| used.range(..v).count() as u32;
    let kept = used.iter().map(|&v| positions[v as usize]).collect();
    (kept, triangles.iter().map(|t| t.map(rank)).collect())
}

/// About the origin, of about one unit.
fn meshes() -> [Triangles; 5] {
    let small = |(mut positions, triangles): Triangles, size: f32, middle: f32| {
        positions.iter_mut().flatten().for_each(|x| *x = (*x - middle) / size);
        (positions, triangles)
    };
    [
        kept(&rough_sphere(3, 0.2, 7), |p| p[2] < 0.3),
        kept(&torus(0.8, 0.3, 24, 12), |p| (p[0] * 20.0).sin() < 0.6),
        small(plate(12, |i, j| i % 4 == 2 && j % 3 == 1), 8.0, 6.0),
        small(strip(31), 2.0, 0.0),
        small(touching_holes_and_a_wall(), 4.0, 3.0),
    ]
    .map(compact)
}

fn keys(mesh: &Triangles) -> Vec<Vec<[f32; 3]>> {
    (1..4).map(|key| motion(&mesh.0, f64::from(key) / 3.0)).collect()
}

#[test]
fn no_interval_of_an_open_mesh_that_moves_freely_loses_the_distance() {
    for (index, mesh) in meshes().iter().enumerate() {
        let built = build(mesh, &[]);
        let hull = DeformableHull::open(&built).expect("just built");
        assert!(!hull.rest().encloses());
        let (mut records, mut scratch) = (memory(&hull), entries(hull.rest().sweep_entries()));
        let mut fresh = entries(hull.scratch_entries());
        let moved = hull.moved(&mut records).expect("enough records");
        let mut rng = Rng::new(221 + index as u64);
        let mut p = [1.5, 0.2, -0.4];
        let mut sweep = moved.sweep(p, &mut scratch).expect("finite");
        for frame in 0..FRAMES {
            let positions = motion(&mesh.0, 2.0 * frame as f64 / FRAMES as f64);
            let slack = [0.0, 0.01, 0.3][frame / 10 % 3];
            sweep.update_within(slack, |vertex| positions[vertex as usize]).expect("near");
            let positions = wide(&positions);
            p = if frame % 4 == 0 { point(&positions, &mut rng, frame % 8 == 0) } else { p };
            sweep.move_to(p).expect("finite");
            let away = distances(p, &positions, &mesh.1);
            let near = ask(&mut sweep, frame, &away, 3.0);
            for steps in [u32::MAX, frame as u32 % 40] {
                let budget = Budget::EXACT.with_steps(steps);
                let answer = sweep.hull().closest_point(p, budget, &mut fresh).expect("finite");
                holds(&answer, p, &positions, &mesh.1);
                let is_same = (near.triangle, near.point) == (answer.triangle, answer.point);
                assert!(is_same || answer.ended == Ended::Steps, "{frame}: {near:?} {answer:?}");
            }
        }
    }
}

#[test]
fn no_interval_of_an_open_mesh_between_key_frames_loses_the_distance() {
    for (index, mesh) in meshes().iter().enumerate() {
        let keys = keys(mesh);
        let built = build(mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        let mut scratch = entries(hull.rest().sweep_entries());
        let mut fresh = entries(hull.scratch_entries());
        let mut rng = Rng::new(231 + index as u64);
        let mut p = [1.5, 0.2, -0.4];
        let mut sweep =
            hull.at_frame(0.0).expect("a frame").sweep(p, &mut scratch).expect("finite");
        for step in 0..=FRAMES {
            let frame = 3.0 * step as f32 / FRAMES as f32;
            sweep.move_to_frame(frame).expect("a frame");
            let positions = between(&mesh.0, &keys, frame);
            p = if step % 4 == 0 { point(&positions, &mut rng, step % 8 == 0) } else { p };
            sweep.move_to(p).expect("finite");
            let away = distances(p, &positions, &mesh.1);
            ask(&mut sweep, step, &away, 3.0);
            for steps in [u32::MAX, step as u32 % 40] {
                let budget = Budget::EXACT.with_steps(steps);
                let at = hull.at_frame(frame).expect("a frame");
                let answer = at.closest_point(p, budget, &mut fresh).expect("finite");
                holds(&answer, p, &positions, &mesh.1);
            }
        }
        // All triangles, and none of a hole.
        let away = distances(p, &between(&mesh.0, &keys, 3.0), &mesh.1);
        list(&mut sweep, &away, f64::INFINITY, 3.0);
        assert_eq!(sweep.next_triangle(Budget::EXACT), Ok(None));
    }
}

#[test]
fn segments_hit_the_open_mesh_as_it_moved_and_pass_through_its_holes() {
    let (mut hits, mut clear) = (0, 0);
    for (index, mesh) in meshes().iter().enumerate() {
        let keys = keys(mesh);
        let built = build(mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        let (mut records, mut scratch) = (memory(&hull), entries(hull.scratch_entries()));
        let mut moved = hull.moved(&mut records).expect("enough records");
        let mut rng = Rng::new(241 + index as u64);
        let mut found = [TriangleHit::EMPTY; 64];
        for step in 0..FRAMES {
            // Keys are as exact as free motion.
            let key = step % 4;
            let rest = &mesh.0;
            let positions = if key == 0 { rest } else { &keys[key - 1] };
            place(&mut moved, positions);
            let around = wide(positions);
            let (a, b) = (point(&around, &mut rng, false), point(&around, &mut rng, step % 3 > 0));
            let truth: BTreeSet<_> =
                contacts(a, b, positions, &mesh.1).iter().map(|c| c.triangle).collect();
            let at = hull.at_frame(key as f32).expect("a key");
            for is_free in [false, true] {
                let all = if is_free {
                    moved.all_hits(a, b, &mut found, Budget::EXACT, &mut scratch)
                } else {
                    at.all_hits(a, b, &mut found, Budget::EXACT, &mut scratch)
                };
                let listed = &found[..all.expect("near").stored];
                let numbers: BTreeSet<_> =
                    listed.iter().map(|hit| hit.hit.triangle.expect("whole")).collect();
                assert!(truth.is_subset(&numbers), "{truth:?} {numbers:?}");
                let certain = listed.iter().filter(|hit| hit.is_certain);
                let certain = certain.filter_map(|hit| hit.hit.triangle);
                assert!(certain.into_iter().all(|number| truth.contains(&number)));
            }
            let first = moved.first_hit(a, b, Budget::EXACT, &mut scratch).expect("near");
            assert!(!first.is_clear() || truth.is_empty());
            hits += usize::from(!truth.is_empty());
            clear += usize::from(first.is_clear());
        }
    }
    assert!(hits > 100 && clear > 100, "{hits} {clear}");
}

#[test]
fn an_open_mesh_that_moves_meets_exactly_what_its_vertices_say() {
    let other = Scene::hull("cube", cube(3), &options(12));
    let mut tally = Tally::default();
    for (positions, triangles) in meshes().into_iter().take(3) {
        let mesh = (coarse(&positions), triangles);
        let rest = Scene::of_mesh("rest", mesh.clone());
        let keys = [coarse(&motion(&mesh.0, 0.5))];
        let built = build(&mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        let mut records = memory(&hull);
        let mut scratch = entries(hull.rest().overlap_entries(&other.model()));
        let mut moved = hull.moved(&mut records).expect("enough records");
        for frame in 0..6u32 {
            let positions = coarse(&motion(&mesh.0, 0.2 * f64::from(frame)));
            place(&mut moved, &positions);
            check(&rest, &other, u64::from(frame), &positions, &mut tally, |pose| {
                moved.overlap(&other.model(), pose, Budget::EXACT, &mut scratch).expect("answers")
            });
        }
        let at = hull.at_frame(1.0).expect("a key");
        check(&rest, &other, 9, &keys[0], &mut tally, |pose| {
            at.overlap(&other.model(), pose, Budget::EXACT, &mut scratch).expect("answers")
        });
    }
    assert!(tally.apart > 10 && tally.meets > 10 && tally.open <= 2, "{tally:?}");
}

/// Findings that are not proved.
fn unproved(bytes: &[u8], mesh: &Triangles, keys: &[Vec<[f32; 3]>]) -> Vec<String> {
    let mesh = Mesh::new(mesh.0.clone(), mesh.1.clone());
    let key = |positions: &Vec<[f32; 3]>| KeyFrame { positions: positions.clone(), rounding: 0.0 };
    let keys: Vec<_> = keys.iter().map(key).collect();
    let findings = verify(bytes, Against::Mesh(mesh.as_input(), &keys));
    let open = findings.into_iter().filter(|finding| finding.outcome != Outcome::Proved);
    open.map(|finding| format!("{finding:?}")).collect()
}

#[test]
fn the_checker_proves_an_open_mesh_that_deforms_and_refuses_what_a_hole_must_not_have() {
    for mesh in meshes() {
        let keys = keys(&mesh);
        let bytes = build(&mesh, &keys);
        assert!(check_blob(&bytes).expect("as built").key_pairs > 50);
        assert_eq!(unproved(&bytes, &mesh, &keys), [""; 0]);
        let (partless, centre) = {
            let hull = DeformableHull::open(&bytes).expect("as built").rest();
            let h = hull.header();
            let count = h.base_triangles + h.rings + 2 * h.splits;
            let is_partless = |&n: &u32| hull.radius(n).expect("in range").is_infinite();
            let partless = (0..count).rev().find(is_partless);
            // A vertex that no triangle of the surface has, by its rank among those of the surface.
            let level = hull.levels().last().expect("a level");
            let used: BTreeSet<_> = hull.faces(&level).flat_map(|face| face.corners).collect();
            let is_final = |v: &u32| hull.split_of(meshsweep_core::VertIdx(*v)).is_none();
            let finals = (0..h.vertices).filter(is_final);
            let centre =
                finals.enumerate().find(|(_, v)| !used.contains(&meshsweep_core::VertIdx(*v)));
            (partless.map(|n| (count - n) as usize), centre.map(|(rank, _)| rank))
        };
        let from_end = partless.expect("a hole");
        // A radius of the last key, which ends the section.
        let mut wrong = bytes.clone();
        let at = section(&bytes, SectionKind::KeyFrames).end - from_end;
        assert_eq!(wrong[at], u8::MAX);
        wrong[at] = 7;
        seal(&mut wrong);
        let error = check_blob(&wrong).expect_err("a hole has no radius");
        assert!(error.contains("denies its part"), "{error}");
        let rank = centre.expect("a hole");
        let mut wrong = bytes.clone();
        let width = if mesh.0.len() < 256 { 1 } else { 2 };
        let at = section(&bytes, SectionKind::VertexNumbers).start + 4 + rank * width;
        wrong[at] = if wrong[at] == 0 { 1 } else { 0 };
        seal(&mut wrong);
        let open = unproved(&wrong, &mesh, &keys);
        assert!(open.iter().any(|finding| finding.contains("has the number")), "{open:?}");
    }
}
