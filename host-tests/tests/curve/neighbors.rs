//! The nearest segments and all within a distance are those of a search that looks at every
//! segment.

use super::scenes::{Scene, scenes, scratch};
use meshsweep_core::{Budget, Curve, CurveNeighbor, Ended, Interval, KNearest, QueryError};
use meshsweep_host_tests::generate::curves::circle;
use meshsweep_host_tests::oracle::Bounded;

/// The true distances of all segments, sorted by their lower ends.
fn truths(scene: &Scene, p: [f32; 3]) -> Vec<Bounded> {
    let mut all: Vec<Bounded> =
        scene.segments.iter().map(|(_, name)| scene.distance(p, *name)).collect();
    all.sort_by(|a, b| a.lower.total_cmp(&b.lower));
    all
}

fn contains(interval: Interval, truth: Bounded) -> bool {
    f64::from(interval.lower) <= truth.upper && truth.lower <= f64::from(interval.upper)
}

/// Each answer is about its segment, none is named twice, and they are in order.
fn assert_sound(scene: &Scene, p: [f32; 3], found: &[CurveNeighbor]) {
    for (index, near) in found.iter().enumerate() {
        let truth = scene.distance(p, near.segment());
        assert!(contains(near.distance(), truth), "{} {p:?} {near:?} {truth:?}", scene.name);
        assert!((0.0..=1.0).contains(&near.t()));
        let others = &found[index + 1..];
        assert!(others.iter().all(|other| other.segment() != near.segment()), "{near:?} twice");
        assert!(others.iter().all(|other| other.distance().upper >= near.distance().upper));
    }
}

fn nearest(
    curve: &Curve<'_>,
    p: [f32; 3],
    count: usize,
    budget: Budget,
    entries: usize,
) -> (KNearest, Vec<CurveNeighbor>) {
    let mut out = vec![CurveNeighbor::EMPTY; count];
    let found = curve.nearest(p, &mut out, budget, &mut scratch(entries)).expect("finite");
    out.truncate(found.stored);
    (found, out)
}

#[test]
fn the_nearest_are_no_farther_than_all_others_with_any_budget_and_scratch() {
    for scene in scenes() {
        let curve = scene.curve();
        let (enough, all) = (curve.scratch_entries(), scene.segments.len());
        for p in scene.points(12, 21) {
            let truths = truths(&scene, p);
            let error = 2.0 * f64::from(curve.surface_error()) + 1e-40;
            for count in [1, 2, 7, all, all + 3] {
                let (exact, near) = nearest(&curve, p, count, Budget::EXACT, enough);
                assert_eq!((exact.stored, exact.ended), (count.min(all), Ended::Exact));
                assert_sound(&scene, p, &near);
                // The k-th is no farther than the true k-th but for storage and rounding.
                for (near, truth) in near.iter().zip(&truths) {
                    let upper = truth.upper * (1.0 + 1e-6) + 2.0 * error;
                    assert!(f64::from(near.distance().lower) <= upper, "{} {p:?}", scene.name);
                }
                let others = scene.segments.iter().map(|(_, name)| *name);
                let others = others.filter(|name| near.iter().all(|near| near.segment() != *name));
                let rest = others.map(|name| scene.distance(p, name).upper);
                let rest = rest.fold(f64::INFINITY, f64::min);
                assert!(f64::from(exact.rest_lower) <= rest, "{} {p:?} {exact:?}", scene.name);
                assert_eq!(exact.rest_lower == f32::INFINITY, count >= all);
                // More memory changes no bit, less memory and fewer steps no proof.
                let (wide, same) = nearest(&curve, p, count, Budget::EXACT, 500);
                assert_eq!((wide.rest_lower.is_finite(), same), (count < all, near.clone()));
                for (budget, entries) in [(Budget::EXACT, 1), (Budget::EXACT.with_steps(5), enough)]
                {
                    let (cut, near) = nearest(&curve, p, count, budget, entries);
                    assert_sound(&scene, p, &near);
                    let others = scene.segments.iter().map(|(_, name)| *name);
                    let others =
                        others.filter(|name| near.iter().all(|near| near.segment() != *name));
                    let rest = others.map(|name| scene.distance(p, name).upper);
                    let rest = rest.fold(f64::INFINITY, f64::min);
                    assert!(f64::from(cut.rest_lower) <= rest, "{} {p:?} {cut:?}", scene.name);
                }
            }
            let (first, near) = nearest(&curve, p, 1, Budget::EXACT, enough);
            let closest = curve.closest_point(p, Budget::EXACT, &mut scratch(enough)).expect("one");
            assert_eq!((near[0].segment(), first.stored), (closest.segment, 1), "{}", scene.name);
        }
    }
}

#[test]
fn all_within_a_distance_are_stored_or_counted() {
    for scene in scenes() {
        let curve = scene.curve();
        let (enough, all) = (curve.scratch_entries(), scene.segments.len());
        for p in scene.points(12, 22) {
            let truths = truths(&scene, p);
            let near = truths[0].upper as f32;
            for distance in [0.0, near, 1.5 * near + 0.1 * scene.size(), 4.0 * near + scene.size()]
            {
                let ask = |room: usize, budget: Budget, entries: usize| {
                    let mut out = vec![CurveNeighbor::EMPTY; room];
                    let memory = &mut scratch(entries);
                    let found = curve.all_within(p, distance, &mut out, budget, memory);
                    let found = found.expect("finite");
                    out.truncate(found.stored);
                    assert_sound(&scene, p, &out);
                    (found, out)
                };
                let (found, out) = ask(all, Budget::EXACT, enough);
                let told = || format!("{} {p:?} {distance} {found:?}", scene.name);
                assert_eq!((found.dropped, found.ended), (0, Ended::Exact), "{}", told());
                assert!(found.certain <= found.stored, "{}", told());
                for (index, near) in out.iter().enumerate() {
                    assert!(near.distance().lower <= distance, "{}", told());
                    assert_eq!(near.distance().upper <= distance, index < found.certain);
                }
                // Whatever is missing is farther.
                for (_, name) in &scene.segments {
                    if out.iter().all(|near| near.segment() != *name) {
                        let truth = scene.distance(p, *name);
                        assert!(truth.upper > f64::from(distance), "{} {truth:?}", told());
                    }
                }
                let (few, some) = ask(3, Budget::EXACT, 300);
                assert_eq!(few.stored + few.dropped as usize, found.stored, "{}", told());
                let places = |out: &[CurveNeighbor]| -> Vec<_> {
                    out.iter().map(|near| near.segment()).collect()
                };
                assert_eq!(places(&some), places(&out[..few.stored]), "{}", told());
                let (none, _) = ask(0, Budget::EXACT, enough);
                assert_eq!(none.dropped as usize, found.stored, "{}", told());
                ask(all, Budget::EXACT, 1);
                ask(all, Budget::EXACT.with_steps(4), enough);
            }
        }
    }
}

#[test]
fn wrong_questions_are_refused_and_far_ones_answered() {
    let scene = Scene::new("circle", &[circle(40)], true);
    let curve = scene.curve();
    let mut out = [CurveNeighbor::EMPTY; 5];
    let exact = Budget::EXACT;
    let nan = [f32::NAN, 0.0, 0.0];
    assert_eq!(curve.nearest(nan, &mut out, exact, &mut scratch(9)), Err(QueryError::NotFinite));
    assert_eq!(curve.nearest([0.0; 3], &mut out, exact, &mut []), Err(QueryError::NoScratch));
    for distance in [-1.0, f32::NAN, f32::INFINITY] {
        let refused = curve.all_within([0.0; 3], distance, &mut out, exact, &mut scratch(9));
        assert_eq!(refused, Err(QueryError::Tolerance));
    }
    let none = curve.nearest([0.0; 3], &mut [], exact, &mut scratch(9)).expect("nothing");
    assert_eq!((none.stored, none.rest_lower), (0, 0.0));
    for p in [[1e9, 0.0, 0.0], [f32::MAX, -f32::MAX, f32::MAX]] {
        let found = curve.nearest(p, &mut out, exact, &mut scratch(1)).expect("finite");
        assert_sound(&scene, p, &out[..found.stored]);
        let truth = scene.truth(p);
        assert!(found.stored == 5 && f64::from(found.rest_lower) <= truth.upper);
        let all = curve.all_within(p, 1e8, &mut out, exact, &mut scratch(1)).expect("finite");
        assert_eq!((all.stored, all.dropped), (0, 0));
        let all = curve.all_within(p, f32::MAX, &mut out, exact, &mut scratch(1)).expect("finite");
        assert_eq!(all.stored + all.dropped as usize, 40);
    }
}
