//! A sweep that follows a mesh as it deforms, and segments against it. No interval of any question
//! loses the truth, which is found by brute force.

use super::deform::{between, build, memory, motion, place, point, wide};
use glam::DVec3;
use meshsweep_core::internal::hull::Geometry;
use meshsweep_core::{
    Budget, ClosestPoint, DeformableHull, Ended, Interval, QueryError, ScratchEntry, Sweep,
    TriangleHit,
};
use meshsweep_host_tests::generate::{Rng, Triangles, icosphere, rough_sphere, torus};
use meshsweep_host_tests::oracle::{contacts, gap_to_triangle, wide_distance_sq};

/// Frames of a motion.
const FRAMES: usize = 1000;

/// The distance of each triangle.
pub fn distances(p: [f32; 3], positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let corner = |&vertex: &u32| positions[vertex as usize].to_array();
    let distance = |[a, b, c]: &[u32; 3]| {
        wide_distance_sq(p.map(f64::from), [corner(a), corner(b), corner(c)]).sqrt()
    };
    triangles.iter().map(distance).collect()
}

/// Fails unless the interval contains the distance, up to rounding of the oracle.
fn holds(interval: Interval, truth: f64, scale: f64) {
    let (lower, upper) = (f64::from(interval.lower), f64::from(interval.upper));
    let slack = 1e-13 * scale;
    assert!(lower <= truth + slack && truth - slack <= upper, "{truth:e} is not in {interval:?}");
}

/// Asks a sweep for the closest point, in small steps or at once, and for lists of triangles.
pub fn ask<'a, G: Geometry<'a>>(
    sweep: &mut Sweep<'_, G>,
    frame: usize,
    distances: &[f64],
    scale: f64,
) -> ClosestPoint {
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let budget = match frame % 5 {
        0 => Budget::EXACT.with_steps(3),
        1 => Budget::EXACT.with_relative(0.2),
        _ => Budget::EXACT,
    };
    let mut near = sweep.closest_point(budget).expect("answers");
    holds(near.distance, least, scale);
    let mut calls = 0;
    while matches!(near.ended, Ended::Steps | Ended::Tolerance) {
        near = sweep.closest_point(Budget::EXACT.with_steps(7)).expect("answers");
        holds(near.distance, least, scale);
        calls += 1;
        assert!(calls < 10_000, "the search does not end");
    }
    assert_eq!(near.ended, Ended::Exact);
    if frame % 10 == 9 {
        list(sweep, distances, least * 1.2 + 0.05, scale);
    }
    near
}

/// The nearest triangles, one after another, until all within a distance have come.
pub fn list<'a, G: Geometry<'a>>(
    sweep: &mut Sweep<'_, G>,
    distances: &[f64],
    within: f64,
    scale: f64,
) {
    let mut order: Vec<f64> = distances.to_vec();
    order.sort_by(f64::total_cmp);
    let mut is_given = vec![false; distances.len()];
    for nearest in &order {
        let Some(found) = sweep.next_triangle(Budget::EXACT).expect("answers") else { break };
        assert_eq!(found.ended, Ended::Exact);
        assert!(f64::from(found.distance.lower) <= nearest + 1e-13 * scale, "{found:?}");
        if f64::from(found.distance.lower) > within {
            break;
        }
        let number = found.triangle.expect("whole") as usize;
        assert!(!std::mem::replace(&mut is_given[number], true), "{number} came twice");
        holds(found.distance, distances[number], scale);
    }
    for (number, distance) in distances.iter().enumerate() {
        assert!(is_given[number] || *distance >= within * (1.0 - 1e-6), "{number} is missing");
    }
}

fn meshes() -> [Triangles; 2] {
    [torus(0.8, 0.3, 24, 12), rough_sphere(2, 0.3, 5)]
}

pub fn entries(count: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; count]
}

/// A point that goes along, and jumps now and then.
fn next(p: [f32; 3], frame: usize, positions: &[DVec3], rng: &mut Rng) -> [f32; 3] {
    if frame % 100 == 50 {
        return point(positions, rng, frame % 200 == 50);
    }
    p.map(|x| x + [0.0, 1e-4, 1e-2][frame % 3] * rng.range(-1.0, 1.0))
}

#[test]
fn no_question_to_a_mesh_that_moves_freely_loses_the_truth() {
    let mut spared = 0;
    for (index, mesh) in meshes().iter().enumerate() {
        let built = build(mesh, &[]);
        let hull = DeformableHull::open(&built).expect("just built");
        let (mut records, mut scratch) = (memory(&hull), entries(hull.rest().sweep_entries()));
        let mut other = entries(hull.rest().scratch_entries());
        let mut rng = Rng::new(131 + index as u64);
        let mut p = [1.5, 0.2, -0.4];
        let moved = hull.moved(&mut records).expect("enough records");
        let mut sweep = moved.sweep(p, &mut scratch).expect("finite");
        let mut t = 0.0;
        for frame in 0..FRAMES {
            t += 2.0 / FRAMES as f64 * [1.0, 1e-3, 1.9, 1e-5][frame / 20 % 4];
            let positions = motion(&mesh.0, t);
            let slack = [0.0, 0.01, 0.3][frame / 30 % 3];
            sweep.update_within(slack, |vertex| positions[vertex as usize]).expect("near");
            assert!(sweep.hull().motion() <= slack * 1.001);
            p = next(p, frame, &wide(&positions), &mut rng);
            sweep.move_to(p).expect("finite");
            let distances = distances(p, &wide(&positions), &mesh.1);
            let near = ask(&mut sweep, frame, &distances, 3.0);
            let fresh = sweep.hull().closest_point(p, Budget::EXACT, &mut other).expect("finite");
            assert_eq!((near.triangle, near.point), (fresh.triangle, fresh.point), "{frame}");
            let early = Budget::EXACT.with_steps(frame as u32 % 40).with_relative(0.1);
            let early = sweep.hull().closest_point(p, early, &mut other).expect("finite");
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            holds(early.distance, least, 3.0);
            spared += usize::from(near.work.opened < fresh.work.opened);
        }
    }
    assert!(spared > FRAMES, "only {spared} answers took fewer splits");
}

#[test]
fn no_question_to_a_mesh_between_key_frames_loses_the_truth() {
    let mut spared = 0;
    for (index, mesh) in meshes().iter().enumerate() {
        let keys: Vec<_> = (1..6).map(|key| motion(&mesh.0, f64::from(key) / 3.0)).collect();
        let built = build(mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        let mut scratch = entries(hull.rest().sweep_entries());
        let mut other = entries(hull.rest().scratch_entries());
        let mut rng = Rng::new(141 + index as u64);
        let (mut p, mut frame) = ([1.5, 0.2, -0.4], 0f32);
        let rest = hull.at_frame(frame).expect("a frame");
        let mut sweep = rest.sweep(p, &mut scratch).expect("finite");
        for step in 0..FRAMES {
            let by = 0.005 * [1.0, 1e-2, -0.3, 1.9][step / 20 % 4];
            frame = match step % 250 {
                // Onto a key, far away, and back.
                100 => frame.round(),
                150 => 5.0 - frame,
                151 => 5.0,
                _ => (frame + by).clamp(0.0, 5.0),
            };
            sweep.move_to_frame(frame).expect("a frame");
            let positions = between(&mesh.0, &keys, frame);
            p = next(p, step, &positions, &mut rng);
            sweep.move_to(p).expect("finite");
            let distances = distances(p, &positions, &mesh.1);
            let near = ask(&mut sweep, step, &distances, 3.0);
            let at = hull.at_frame(frame).expect("a frame");
            let fresh = at.closest_point(p, Budget::EXACT, &mut other).expect("finite");
            assert_eq!((near.triangle, near.point), (fresh.triangle, fresh.point), "{step}");
            spared += usize::from(near.work.opened < fresh.work.opened);
        }
    }
    assert!(spared > FRAMES, "only {spared} answers took fewer splits");
}

#[test]
fn small_motions_of_a_mesh_are_answered_in_constant_time() {
    let mesh = rough_sphere(3, 0.2, 7);
    let keys = [motion(&mesh.0, 0.5), motion(&mesh.0, 1.0)];
    let built = build(&mesh, &keys);
    let hull = DeformableHull::open(&built).expect("just built");
    let (mut records, mut scratch) = (memory(&hull), entries(hull.rest().sweep_entries()));
    let p = [1.1, 1.7, 0.4];
    let moved = hull.moved(&mut records).expect("enough records");
    let mut sweep = moved.sweep(p, &mut scratch).expect("finite");
    let mut constant = 0;
    for frame in 0..500 {
        let positions = motion(&mesh.0, 1e-4 * f64::from(frame));
        sweep.update_within(0.05, |vertex| positions[vertex as usize]).expect("near");
        let near = sweep.closest_point(Budget::EXACT).expect("answers");
        constant += usize::from(near.work.opened == 0);
    }
    assert!(constant > 300, "free motion: {constant}");
    let rest = hull.at_frame(0.5).expect("a frame");
    let mut sweep = rest.sweep(p, &mut scratch).expect("finite");
    let mut constant = 0;
    for frame in 0..500 {
        sweep.move_to_frame(0.5 + 2e-4 * frame as f32).expect("a frame");
        let near = sweep.closest_point(Budget::EXACT).expect("answers");
        constant += usize::from(near.work.opened == 0);
    }
    assert!(constant > 300, "key frames: {constant}");
}

/// Segments between points near the mesh.
fn segment(positions: &[DVec3], rng: &mut Rng) -> [[f32; 3]; 2] {
    [point(positions, rng, false), point(positions, rng, true)]
}

#[test]
fn no_segment_against_a_mesh_that_moves_freely_misses_a_hit() {
    let (mut hits, mut proved, mut clear) = (0, 0, 0);
    for (index, mesh) in meshes().iter().enumerate() {
        let built = build(mesh, &[]);
        let hull = DeformableHull::open(&built).expect("just built");
        let (mut records, mut scratch) = (memory(&hull), entries(hull.rest().scratch_entries()));
        let mut moved = hull.moved(&mut records).expect("enough records");
        let mut rng = Rng::new(151 + index as u64);
        let mut found = [TriangleHit::EMPTY; 64];
        for frame in 0..FRAMES {
            let positions = motion(&mesh.0, 2.0 * frame as f64 / FRAMES as f64);
            let slack = [0.0, 0.02, 0.5][frame / 20 % 3];
            moved.update_within(slack, |vertex| positions[vertex as usize]).expect("near");
            let [a, b] = segment(&wide(&positions), &mut rng);
            let truth = contacts(a, b, &positions, &mesh.1);
            let first = moved.first_hit(a, b, Budget::EXACT, &mut scratch).expect("near");
            let least = truth.iter().map(|c| c.t_upper).fold(f64::INFINITY, f64::min);
            assert!(f64::from(first.t.lower) <= least, "{first:?}: {truth:?}");
            let all = moved.all_hits(a, b, &mut found, Budget::EXACT, &mut scratch).expect("near");
            let listed = &found[..all.stored];
            for contact in &truth {
                let number = Some(contact.triangle);
                assert!(listed.iter().any(|hit| hit.hit.triangle == number), "{contact:?}");
            }
            for hit in listed {
                let number = hit.hit.triangle.expect("whole") as usize;
                let corners = mesh.1[number].map(|vertex| positions[vertex as usize]);
                assert!(gap_to_triangle(a, b, corners) <= 1e-11, "{hit:?}");
            }
            if truth.is_empty() {
                clear += usize::from(first.is_clear());
            } else {
                let number = first.hit.expect("it hits").triangle.expect("whole") as usize;
                let corners = mesh.1[number].map(|vertex| positions[vertex as usize]);
                assert!(gap_to_triangle(a, b, corners) <= 1e-11, "{first:?}");
                assert!(truth[0].t_lower <= f64::from(first.t.upper), "{first:?}: {truth:?}");
                hits += 1;
                proved += usize::from(first.ended == Ended::Exact);
            }
            let early = Budget::EXACT.with_steps(frame as u32 % 30);
            let early = moved.first_hit(a, b, early, &mut scratch).expect("near");
            assert!(f64::from(early.t.lower) <= least, "{early:?}: {truth:?}");
        }
    }
    assert!(hits > 300 && clear > 300 && proved * 10 > hits * 9, "{hits} {proved} {clear}");
}

#[test]
fn no_segment_between_key_frames_misses_a_hit() {
    let (mut hits, mut clear) = (0, 0);
    for (index, mesh) in meshes().iter().enumerate() {
        let keys: Vec<_> = (1..6).map(|key| motion(&mesh.0, f64::from(key) / 3.0)).collect();
        let built = build(mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        let mut scratch = entries(hull.rest().scratch_entries());
        let mut rng = Rng::new(161 + index as u64);
        let mut found = [TriangleHit::EMPTY; 64];
        for step in 0..=FRAMES {
            let frame = 5.0 * step as f32 / FRAMES as f32;
            let at = hull.at_frame(frame).expect("a frame");
            let positions = between(&mesh.0, &keys, frame);
            let [a, b] = segment(&positions, &mut rng);
            // Single precision misplaces a vertex by less than the interval does.
            let single: Vec<_> = positions.iter().map(|p| p.as_vec3().to_array()).collect();
            let truth = contacts(a, b, &single, &mesh.1);
            let first = at.first_hit(a, b, Budget::EXACT, &mut scratch).expect("near");
            let all = at.all_hits(a, b, &mut found, Budget::EXACT, &mut scratch).expect("near");
            for contact in &truth {
                let number = Some(contact.triangle);
                let mut listed = found[..all.stored].iter();
                assert!(listed.any(|hit| hit.hit.triangle == number), "{contact:?}");
                assert!(f64::from(first.t.lower) <= contact.t_upper, "{first:?}: {contact:?}");
            }
            hits += usize::from(!truth.is_empty());
            clear += usize::from(first.is_clear());
        }
    }
    assert!(hits > 300 && clear > 300, "{hits} {clear}");
}

#[test]
fn bad_slacks_and_refused_updates_are_typed_errors() {
    let mesh = icosphere(1);
    let built = build(&mesh, &[]);
    let hull = DeformableHull::open(&built).expect("just built");
    let (mut records, mut scratch) = (memory(&hull), entries(200));
    let mut moved = hull.moved(&mut records).expect("enough records");
    for slack in [-1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(moved.update_within(slack, |_| [0.0; 3]), Err(QueryError::Tolerance));
    }
    place(&mut moved, &mesh.0);
    assert_eq!(moved.motion(), 0.0);
    let p = [3.0, 0.0, 0.0];
    let mut sweep = moved.sweep(p, &mut scratch).expect("finite");
    let near = sweep.closest_point(Budget::EXACT).expect("answers");
    let refused = sweep.update_within(1.0, |_| [f32::NAN; 3]);
    assert!(matches!(refused, Err(QueryError::VertexOutOfDomain { .. })));
    assert_eq!(sweep.closest_point(Budget::EXACT), Err(QueryError::NoPose));
    assert_eq!(sweep.next_triangle(Budget::EXACT), Err(QueryError::NoPose));
    let (a, b) = (p, [0.0; 3]);
    let no_hit = sweep.hull().first_hit(a, b, Budget::EXACT, &mut entries(99));
    assert_eq!(no_hit.map(|_| ()), Err(QueryError::NoPose));
    sweep.update_within(1.0, |vertex| mesh.0[vertex as usize]).expect("near");
    let again = sweep.closest_point(Budget::EXACT).expect("answers");
    assert_eq!((near.distance, near.triangle), (again.distance, again.triangle));
    assert!(sweep.into_hull().closest_point(p, Budget::EXACT, &mut entries(99)).is_ok());
    let at = hull.at_frame(0.0).expect("a frame");
    let mut frames = at.sweep(p, &mut scratch).expect("finite");
    assert_eq!(frames.move_to_frame(0.5), Err(QueryError::NoFrame { frames: 1 }));
    assert_eq!(frames.closest_point(Budget::EXACT).map(|near| near.distance), Ok(near.distance));
}
