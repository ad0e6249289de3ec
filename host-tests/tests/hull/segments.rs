//! Segments against exact predicates: nothing is missed, false hits are touches, and every
//! degenerate case is defined.

use super::scenes::{all, exact, options};
use meshsweep_core::{
    Budget, Ended, FirstHit, Hit, Hull, OuterSearch, QueryError, RefinedHull, ScratchEntry,
    TriangleHit,
};
use meshsweep_host_tests::generate::corpus::IDENTITY;
use meshsweep_host_tests::generate::{
    Rng, cube, groove_block, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::oracle::{Contact, contacts, gap_to_triangle};
use meshsweep_host_tests::scene::Scene;
use proptest::prelude::*;
use std::sync::LazyLock;

type Segment = ([f32; 3], [f32; 3]);

fn ask(model: &Hull<'_>, (a, b): Segment, stop: &Budget, queue: usize) -> FirstHit {
    model
        .first_hit(a, b, *stop, &mut vec![ScratchEntry::EMPTY; queue])
        .expect("a segment in the domain")
}

fn truth(scene: &Scene, (a, b): Segment) -> Vec<Contact> {
    contacts(a, b, &scene.positions, &scene.triangles)
}

/// A miss by no more than this is a touch: 1e-12 of the lengths in play, times the aspect ratio
/// where triangles are needles.
fn touch(scene: &Scene, (a, b): Segment) -> f64 {
    let lengths = a.iter().chain(&b).fold(scene.reach(), |m, x| m.max(f64::from(x.abs())));
    let aspect = if scene.name == "needle comb" { 65_536.0 } else { 1.0 };
    1e-12 * aspect * lengths + surface_error(&scene.model()) * (1.0 + 1e-6)
}

fn surface_error(model: &Hull<'_>) -> f64 {
    f64::from(model.header().surface_error) * model.scale()
}

/// Segments of every kind: across, short, from and to the surface, through vertices, along edges,
/// in a face's plane.
fn segments(scene: &Scene, count: usize, rng: &mut Rng) -> Vec<Segment> {
    let mut all = Vec::with_capacity(count);
    for i in 0..count {
        let t = rng.below(scene.triangles.len()) as u32;
        let [u, v, w] = scene.corners(t);
        let on = scene.on_triangle(t, rng);
        let beyond = |from: [f32; 3], through: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|k| through[k] + (through[k] - from[k]))
        };
        let outside = scene.around(3.0, rng);
        all.push(match i % 10 {
            0 => (scene.around(2.0, rng), scene.around(2.0, rng)),
            1 => (outside, beyond(outside, on)),
            2 => (outside, on),
            3 => (on, outside),
            4 => (outside, beyond(outside, u)),
            5 => (u, v),
            6 => (beyond(v, u), beyond(u, v)),
            7 => (beyond(v, w), beyond(w, u)),
            8 => (scene.around(1.0, rng), scene.around(1.0, rng)),
            _ => {
                let near = scene.around(1.0, rng);
                (
                    near,
                    std::array::from_fn(|k| near[k] + 0.05 * scene.size() * rng.range(-1.0, 1.0)),
                )
            }
        });
    }
    all
}

fn check_first(scene: &Scene, segment: Segment, answer: &FirstHit, contacts: &[Contact]) {
    let say = || format!("{}: {segment:?}: {answer:?}, {contacts:?}", scene.name);
    let first = contacts.iter().map(|c| c.t_upper).fold(f64::INFINITY, f64::min);
    let first_lower = contacts.first().map_or(f64::INFINITY, |c| c.t_lower);
    assert!(f64::from(answer.t.lower) <= first, "clear where it is not: {}", say());
    if surface_error(&scene.model()) > 0.0 {
        return;
    }
    if contacts.is_empty() {
        if let Some(hit) = answer.hit {
            let corners = scene.corners(hit.triangle.expect("a whole blob"));
            let gap = gap_to_triangle(segment.0, segment.1, corners);
            assert!(gap <= touch(scene, segment), "false hit by {gap:e}: {}", say());
        }
    } else if answer.ended == Ended::Exact
        || (answer.ended == Ended::Resolution && surface_error(&scene.model()) == 0.0)
    {
        let hit = answer.hit.unwrap_or_else(|| panic!("missed: {}", say()));
        let gap = gap_to_triangle(
            segment.0,
            segment.1,
            scene.corners(hit.triangle.expect("a whole blob")),
        );
        assert!(gap <= touch(scene, segment), "names a triangle that is {gap:e} away: {}", say());
        assert!(answer.t.lower <= hit.t && hit.t <= answer.t.upper, "{}", say());
        // A touch before the first true contact may bound `upper` from below its parameter.
        assert!(first_lower <= f64::from(answer.t.upper) || gap > 0.0, "{}", say());
    }
}

#[test]
fn first_hit_never_misses_and_never_invents() {
    let (mut hits, mut proved) = (0, 0);
    for scene in exact() {
        let model = scene.model();
        let mut rng = Rng::new(21);
        for segment in segments(scene, 300, &mut rng) {
            let contacts = truth(scene, segment);
            let answer = ask(&model, segment, &Budget::EXACT, 4096);
            assert!(matches!(answer.ended, Ended::Exact | Ended::Resolution), "{answer:?}");
            check_first(scene, segment, &answer, &contacts);
            hits += usize::from(!contacts.is_empty());
            proved += usize::from(answer.hit.is_some() && answer.ended == Ended::Exact);
        }
    }
    // The others go through vertices and edges, or end on the surface.
    assert!(hits > 1500 && proved > 1000, "{hits} segments hit, {proved} certainly");
}

#[test]
fn on_a_moved_surface_a_hit_is_within_its_error() {
    for scene in all().iter().filter(|s| surface_error(&s.model()) > 0.0) {
        let model = scene.model();
        let mut rng = Rng::new(26);
        for segment in segments(scene, 300, &mut rng) {
            let contacts = truth(scene, segment);
            let answer = ask(&model, segment, &Budget::EXACT, 4096);
            check_first(scene, segment, &answer, &contacts);
            if let Some(hit) = answer.hit {
                let corners = scene.corners(hit.triangle.expect("a whole blob"));
                let gap = gap_to_triangle(segment.0, segment.1, corners);
                let allowed = 2.0 * surface_error(&model) + 1e-6 * scene.reach();
                assert!(
                    gap <= allowed,
                    "{}: {segment:?}: {answer:?} is {gap:e} away, {allowed:e} allowed",
                    scene.name
                );
            }
        }
    }
}

#[test]
fn stopping_early_or_short_memory_never_says_clear() {
    for scene in all() {
        let model = scene.model();
        let capacity = model.scratch_entries();
        let mut rng = Rng::new(22);
        for segment in segments(scene, 60, &mut rng) {
            let contacts = truth(scene, segment);
            for steps in [0, 1, 5, 30] {
                let answer = ask(&model, segment, &Budget::EXACT.with_steps(steps), 64);
                check_first(scene, segment, &answer, &contacts);
            }
            let exact = ask(&model, segment, &Budget::EXACT, 10_000);
            for length in [1, 2, 5, capacity, capacity + 1, capacity + 12, capacity + 50] {
                let answer = ask(&model, segment, &Budget::EXACT, length);
                check_first(scene, segment, &answer, &contacts);
                if length >= capacity {
                    assert_eq!(answer.ended, exact.ended);
                    assert_ne!(answer.ended, Ended::Scratch);
                    assert_eq!(
                        (answer.hit, answer.t.lower),
                        (exact.hit, exact.t.lower),
                        "{}: {segment:?}",
                        scene.name
                    );
                }
            }
        }
    }
}

#[test]
fn all_hits_are_exactly_the_triangles_that_meet_the_segment() {
    for scene in exact() {
        let model = scene.model();
        let mut rng = Rng::new(23);
        for segment in segments(scene, 200, &mut rng) {
            let contacts = truth(scene, segment);
            let mut hits = vec![TriangleHit::EMPTY; scene.triangles.len()];
            let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
            let found = model
                .all_hits(segment.0, segment.1, &mut hits, Budget::EXACT, &mut queue)
                .expect("in the domain");
            let hits = &hits[..found.stored];
            // Touches are not proved.
            let is_whole = matches!(found.ended, Ended::Exact | Ended::Resolution);
            assert!(
                is_whole && found.dropped == 0 && found.is_complete,
                "{}: {found:?}",
                scene.name
            );
            assert!(hits.is_sorted_by(|x, y| x.hit.t <= y.hit.t), "{}: {hits:?}", scene.name);
            let named: Vec<u32> =
                hits.iter().map(|h| h.hit.triangle.expect("a whole blob")).collect();
            for contact in &contacts {
                assert!(
                    named.contains(&contact.triangle),
                    "{}: {segment:?} misses {contact:?}",
                    scene.name
                );
            }
            for (TriangleHit { hit, is_certain }, &triangle) in hits.iter().zip(&named) {
                let is_met = contacts.iter().any(|contact| contact.triangle == triangle);
                assert!(is_met || !is_certain, "{}: {segment:?}: {hit:?}", scene.name);
                let gap = gap_to_triangle(segment.0, segment.1, scene.corners(triangle));
                assert!(
                    gap <= touch(scene, segment),
                    "{}: {segment:?}: {hit:?} is {gap:e} away",
                    scene.name
                );
                let known = contacts.iter().find(|c| c.triangle == triangle && !c.coplanar);
                if let Some(c) = known.filter(|_| surface_error(&model) == 0.0) {
                    let width = c.t_upper - c.t_lower;
                    let off = (f64::from(hit.t) - 0.5 * (c.t_lower + c.t_upper)).abs();
                    // Where segment and triangle are nearly parallel the crossing is
                    // ill-conditioned in f64.
                    let steep = crossing_angle(segment, scene.corners(triangle));
                    let lengths = touch(scene, segment) / length(segment).max(f64::MIN_POSITIVE);
                    assert!(
                        off <= width + 1.2e-7 + lengths / steep,
                        "{}: {segment:?}: {hit:?} {c:?}",
                        scene.name
                    );
                }
            }
            let mut unique = named.clone();
            unique.sort_unstable();
            unique.dedup();
            assert_eq!(unique.len(), named.len(), "{}: a triangle twice", scene.name);
        }
    }
}

fn length((a, b): Segment) -> f64 {
    (0..3).map(|k| (f64::from(b[k]) - f64::from(a[k])).powi(2)).sum::<f64>().sqrt()
}

/// Sine of the angle between segment and triangle.
fn crossing_angle(segment: Segment, [u, v, w]: [[f32; 3]; 3]) -> f64 {
    let sub = |p: [f32; 3], q: [f32; 3]| {
        glam::DVec3::from(p.map(f64::from)) - glam::DVec3::from(q.map(f64::from))
    };
    let normal =
        sub(v, u).normalize_or_zero().cross(sub(w, u).normalize_or_zero()).normalize_or_zero();
    normal.dot(sub(segment.1, segment.0).normalize_or_zero()).abs()
}

#[test]
fn hits_that_do_not_fit_are_counted_and_the_first_are_kept() {
    let scene = Scene::hull("torus", torus(2.0, 0.75, 24, 12), &options(40));
    let model = scene.model();
    let mut rng = Rng::new(24);
    let mut queue = vec![ScratchEntry::EMPTY; 512];
    for segment in segments(&scene, 300, &mut rng) {
        let mut whole = [TriangleHit::EMPTY; 600];
        let all = model
            .all_hits(segment.0, segment.1, &mut whole, Budget::EXACT, &mut queue)
            .expect("in the domain");
        for room in 0..4 {
            let mut few = [TriangleHit::EMPTY; 4];
            let found = model
                .all_hits(segment.0, segment.1, &mut few[..room], Budget::EXACT, &mut queue)
                .expect("in the domain");
            assert_eq!(found.stored, room.min(all.stored));
            assert_eq!(found.stored + found.dropped as usize, all.stored);
            assert_eq!(few[..found.stored], whole[..found.stored]);
        }
    }
}

/// Platis & Theoharis 2003, Figure 5: a segment inside a slot that the hull bridges crosses no hull
/// face on its way.
#[test]
fn paper_000_figure_5_segment_below_the_hull_is_found() {
    let scene = Scene::hull("groove block", groove_block(), &options(12));
    let model = scene.model();
    let segment = ([15.0, 20.0, 8.0], [15.0, 20.0, 14.0]);
    let truth = truth(&scene, segment);
    assert!(!truth.is_empty() && (truth[0].t_lower - 4.0 / 6.0).abs() < 1e-6);
    let first = ask(&model, segment, &Budget::EXACT, 512);
    let hit = first.hit.expect("the overhang");
    assert!((hit.point[2] - 12.0).abs() < 1e-5 && !first.is_clear(), "{first:?}");
    let mut listed = [TriangleHit::EMPTY; 16];
    let mut hits = [Hit::EMPTY; 16];
    let mut queue = [ScratchEntry::EMPTY; 512];
    let found = model
        .all_hits(segment.0, segment.1, &mut listed, Budget::EXACT, &mut queue)
        .expect("in the domain");
    assert_eq!(found.stored, truth.len());
    let mut refined = RefinedHull::<256>::new();
    let (search, exact) = (OuterSearch::First, Budget::EXACT);
    let outer = model
        .outer_hits(segment.0, segment.1, search, &mut refined, &mut hits, exact, &mut queue)
        .expect("in the domain");
    assert!(
        outer.starts_inside && outer.t.lower == 0.0,
        "the hull cannot promise anything: {outer:?}"
    );
}

#[test]
fn a_start_on_the_surface_hits_at_zero_and_a_start_inside_hits_the_way_out() {
    let scene = Scene::hull("cube", cube(4), &options(12));
    let model = scene.model();
    let on = ask(&model, ([1.0, 0.3, 0.2], [3.0, 0.3, 0.2]), &Budget::EXACT, 64);
    assert_eq!((on.t.lower, on.hit.map(|h| h.t)), (0.0, Some(0.0)));
    let out = ask(&model, ([0.0, 0.3, 0.2], [4.0, 0.3, 0.2]), &Budget::EXACT, 64);
    assert_eq!(out.hit.map(|h| h.t), Some(0.25));
    let inside = ask(&model, ([0.0, 0.3, 0.2], [0.5, 0.3, 0.2]), &Budget::EXACT, 64);
    assert!(inside.is_clear() && inside.hit.is_none());
}

#[test]
fn zero_length_segments_hit_where_their_point_is_on_the_surface() {
    let scene = Scene::hull("cube", cube(4), &options(12));
    let model = scene.model();
    for (p, hits) in [
        ([1.0, 0.3, 0.2], true),
        ([1.0, 1.0, 1.0], true),
        ([0.9, 0.3, 0.2], false),
        ([3.0; 3], false),
    ] {
        let answer = ask(&model, (p, p), &Budget::EXACT, 64);
        assert_eq!((answer.hit.is_some(), answer.is_clear()), (hits, !hits), "{p:?}");
    }
}

#[test]
fn ends_up_to_2_to_the_40_sizes_away_are_answered_and_farther_ones_refused() {
    let scene = Scene::hull("cube", cube(2), &options(12));
    let model = scene.model();
    let far = |exponent: i32| 2f32.powi(exponent);
    // The frame's unit is 2 here: its largest coordinate lies in [½, 1).
    for exponent in [10, 20, 39] {
        let x = far(exponent);
        let through = ([-x, 0.25, 0.125], [x, 0.25, 0.125]);
        let answer = ask(&model, through, &Budget::EXACT, 64);
        check_first(&scene, through, &answer, &truth(&scene, through));
        assert!(answer.hit.is_some());
        let past = ([-x, 0.75 * x, 0.0], [x, 0.75 * x, 0.0]);
        assert!(ask(&model, past, &Budget::EXACT, 64).is_clear());
    }
    let mut queue = [ScratchEntry::EMPTY; 64];
    let mut hits = [TriangleHit::EMPTY; 4];
    for p in [[far(42), 0.0, 0.0], [0.0, -far(43), 0.0], [0.0, 0.0, f32::MAX]] {
        for (a, b) in [(p, [0.0; 3]), ([0.0; 3], p)] {
            assert_eq!(
                model.first_hit(a, b, Budget::EXACT, &mut queue),
                Err(QueryError::OutOfDomain)
            );
            assert_eq!(
                model.all_hits(a, b, &mut hits, Budget::EXACT, &mut queue),
                Err(QueryError::OutOfDomain)
            );
        }
    }
}

#[test]
fn nan_infinity_no_queue_and_bad_tolerances_are_typed_errors() {
    let scene = Scene::hull("cube", cube(2), &options(12));
    let model = scene.model();
    let mut queue = [ScratchEntry::EMPTY; 64];
    let good = [0.0; 3];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for (a, b) in [([bad, 0.0, 0.0], good), (good, [0.0, bad, 0.0])] {
            assert_eq!(
                model.first_hit(a, b, Budget::EXACT, &mut queue),
                Err(QueryError::NotFinite)
            );
            assert_eq!(
                model.all_hits(a, b, &mut [], Budget::EXACT, &mut queue),
                Err(QueryError::NotFinite)
            );
        }
    }
    assert_eq!(model.first_hit(good, good, Budget::EXACT, &mut []), Err(QueryError::NoScratch));
    assert_eq!(
        model.all_hits(good, good, &mut [], Budget::EXACT, &mut []),
        Err(QueryError::NoScratch)
    );
    let stop = Budget::EXACT.with_absolute(f32::NAN);
    assert_eq!(model.first_hit(good, good, stop, &mut queue), Err(QueryError::Tolerance));
}

#[test]
fn scaling_mesh_and_segment_by_a_power_of_two_changes_no_parameter() {
    let mesh = rough_sphere(2, 0.3, 5);
    let plain = Scene::hull("plain", mesh.clone(), &options(40));
    for exponent in [-80, 3, 90] {
        let factor = 2f32.powi(exponent);
        let scene = Scene::hull("scaled", scaled(&mesh, factor), &options(40));
        let mut rng = Rng::new(25);
        for (a, b) in segments(&plain, 200, &mut rng) {
            let one = ask(&plain.model(), (a, b), &Budget::EXACT, 256);
            let [c, d] = [a, b].map(|p| p.map(|x| x * factor));
            let other = ask(&scene.model(), (c, d), &Budget::EXACT, 256);
            assert_eq!(
                (one.t.lower, one.t.upper, one.work),
                (other.t.lower, other.t.upper, other.work)
            );
            assert_eq!(one.hit.map(|h| (h.t, h.triangle)), other.hit.map(|h| (h.t, h.triangle)));
        }
    }
}

/// Built once: the build takes far longer than a question.
static CUBE: LazyLock<Scene> = LazyLock::new(|| Scene::hull("cube", cube(2), &options(12)));

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lattice_segments_agree_with_exact_predicates_on_a_cube(
        a in prop::array::uniform3(-6i8..=6),
        b in prop::array::uniform3(-6i8..=6),
    ) {
        // Lattice ends meet faces, edges and vertices all the time.
        let scene = &*CUBE;
        let segment = (a.map(|x| f32::from(x) / 4.0), b.map(|x| f32::from(x) / 4.0));
        let answer = ask(&scene.model(), segment, &Budget::EXACT, 64);
        check_first(scene, segment, &answer, &truth(scene, segment));
        prop_assert_eq!(answer.hit.is_some(), !truth(scene, segment).is_empty());
    }
}

#[test]
fn a_segment_that_ends_a_rounding_before_the_surface_is_not_said_to_hit_for_certain() {
    let scene = Scene::hull("cube", cube(1), &options(12));
    let (model, before) = (scene.model(), 1.0 + f32::EPSILON);
    let rounding = ([3.0, 0.1, 0.2], [before, 0.1, 0.2]);
    assert!(ask(&model, rounding, &Budget::EXACT, 64).is_clear());
    // 1e-20 beside the cube's face, as f32 tells at the origin.
    let shifted = transformed(&cube(1), IDENTITY, [-1.0, 0.0, 0.0]);
    let scene = Scene::hull("cube at the origin", shifted, &options(12));
    let touch = ([3.0, 0.1, 0.2], [1e-20, 0.1, 0.2]);
    let answer = ask(&scene.model(), touch, &Budget::EXACT, 64);
    assert_eq!((answer.ended, answer.t.upper), (Ended::Resolution, 1.0), "{answer:?}");
    let through = ([3.0, 0.1, 0.2], [-0.25, 0.1, 0.2]);
    let answer = ask(&scene.model(), through, &Budget::EXACT, 64);
    assert_eq!(answer.ended, Ended::Exact);
    assert!(answer.t.upper < 0.93, "{answer:?}");
}
