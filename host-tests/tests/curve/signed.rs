//! Sides of fences are those of exact winding numbers, and signed distances contain the truth.

use super::scenes::scratch;
use meshsweep::curve::{CurveOptions, Polyline, Zone, build};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Budget, Curve, CurveSignedDistance, Ended, QueryError, ScratchEntry, Side, Undecided,
};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::curves::{circle, closed, fence, open, spiral, walk};
use meshsweep_host_tests::oracle::{Bounded, distance_to_segments, winding_about};

fn stored(polylines: &[Polyline], is_f32: bool) -> Vec<u8> {
    build(polylines, &CurveOptions { is_f32 }, Watch::NONE).expect("a fence").0.to_bytes()
}

/// Whether the zones allow a point. `None`: it lies on a line.
fn allowed(polylines: &[Polyline], p: [f32; 2]) -> Option<bool> {
    let (mut included, mut excluded) = (false, false);
    for polyline in polylines {
        if winding_about(p, &polyline.points)? != 0 {
            match polyline.zone {
                Zone::Exclusion => excluded = true,
                _ => included = true,
            }
        }
    }
    let has_inclusion = polylines.iter().any(|polyline| polyline.zone == Zone::Inclusion);
    Some(!excluded && (included || !has_inclusion))
}

/// The distance to the nearest line, seen along z.
fn truth(polylines: &[Polyline], [x, y]: [f32; 2]) -> Bounded {
    let flat = |[x, y, _]: [f64; 3]| [x, y, 0.0];
    let segments = polylines.iter().flat_map(|Polyline { points, .. }| {
        let ends = points.iter().zip(points.iter().cycle().skip(1));
        ends.map(|(a, b)| [flat(*a), flat(*b)])
    });
    distance_to_segments([x, y, 0.0], segments)
}

/// What is true of a point.
struct Truth {
    distance: Bounded,
    allowed: Option<bool>,
}

impl Truth {
    fn of(polylines: &[Polyline], p: [f32; 2]) -> Truth {
        Truth { distance: truth(polylines, p), allowed: allowed(polylines, p) }
    }
}

/// The answer holds: the interval, and the side if it is decided.
fn assert_holds(truth: &Truth, p: [f32; 2], found: &CurveSignedDistance) {
    let told = || format!("{p:?} {found:?}");
    let &Truth { distance: truth, allowed } = truth;
    let (lower, upper) = (f64::from(found.distance.lower), f64::from(found.distance.upper));
    let near = found.closest.distance;
    match found.side {
        Side::Inside => {
            assert_eq!(allowed, Some(true), "{}", told());
            assert!(lower <= -truth.lower && -truth.upper <= upper && upper < 0.0, "{}", told());
        }
        Side::Outside => {
            assert_eq!(allowed, Some(false), "{}", told());
            assert!(lower <= truth.upper && truth.lower <= upper && lower > 0.0, "{}", told());
        }
        _ => {
            assert_eq!(found.distance.lower, -found.distance.upper, "{}", told());
            assert_eq!(found.distance.upper, near.upper, "{}", told());
            assert!(truth.lower <= upper, "{}", told());
        }
    }
}

/// Whether a side has to be decided: the point is farther away than storage and rounding can tell.
fn is_clear(curve: &Curve<'_>, polylines: &[Polyline], truth: &Truth) -> bool {
    let truth = truth.distance;
    let size = polylines.iter().flat_map(|polyline| polyline.points.iter().flatten());
    let size = size.fold(0f64, |most, x| most.max(x.abs()));
    truth.lower > 2.01 * f64::from(curve.surface_error()) + 1e-13 * (truth.upper + size) + 1e-44
}

/// A fence of random corners. Lattices make corners, repeats, levels and collinear sides.
fn random_fence(rng: &mut Rng, corners: usize, lattice: Option<f64>, scale: f64) -> Polyline {
    let mut at = || {
        let x = rng.unit_f64();
        scale * lattice.map_or(x, |steps| (x * steps).floor() / steps)
    };
    closed((0..corners).map(|_| [at(), at(), 0.0]).collect())
}

/// A place to ask about: anywhere, on a corner, on a side, on the level of a corner, next to a
/// line.
fn place(rng: &mut Rng, polylines: &[Polyline], scale: f64) -> [f32; 2] {
    let points = &polylines[rng.below(polylines.len())].points;
    let first = rng.below(points.len());
    let (a, b) = (points[first], points[(first + 1) % points.len()]);
    let share = [0.5, rng.unit_f64()][rng.below(2)];
    let on = [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
    let any = [0; 2].map(|_| scale * (1.2 * rng.unit_f64() - 0.1));
    let p = match rng.below(8) {
        0 => [a[0], a[1]],
        1 => on,
        2 => [any[0], a[1]],
        3 => [a[0], any[1]],
        4 => on.map(|x| x + scale * 1e-4 * (rng.unit_f64() - 0.5)),
        _ => any,
    };
    p.map(|x| x as f32)
}

#[test]
fn sides_of_ten_thousand_random_fences_are_those_of_winding_numbers() {
    let mut rng = Rng::new(4);
    let mut memory = vec![ScratchEntry::EMPTY; 64];
    let (mut decided, mut inside, mut asked, mut on_line) = (0, 0, 0, 0);
    for fence in 0..10_000 {
        let scale = [1.0, 1e-30, 1e30, 64.0, 1e-3][fence % 5];
        let lattice = [None, Some(4.0), Some(8.0), Some(64.0)][rng.below(4)];
        let zones: Vec<Polyline> = (0..1 + rng.below(3))
            .map(|_| {
                let corners = 2 + rng.below(if fence % 10 == 0 { 90 } else { 9 });
                let zone = [Zone::Inclusion, Zone::Exclusion][rng.below(2)];
                Polyline { zone, ..random_fence(&mut rng, corners, lattice, scale) }
            })
            .collect();
        // All places may be the origin.
        if zones.iter().all(|zone| zone.points.iter().flatten().all(|&x| x == 0.0)) {
            continue;
        }
        let bytes = stored(&zones, rng.below(2) == 0);
        let curve = Curve::open(&bytes).expect("opens");
        for _ in 0..6 {
            let p = place(&mut rng, &zones, scale);
            let found = curve.signed_distance(p, Budget::EXACT, &mut memory).expect("a fence");
            let truth = Truth::of(&zones, p);
            assert_holds(&truth, p, &found);
            let undecided = matches!(found.side, Side::Undecided(_));
            assert!(!(undecided && is_clear(&curve, &zones, &truth)), "{p:?} {found:?} {zones:?}");
            if undecided {
                assert_eq!(found.side, Side::Undecided(Undecided::OnSurface), "{p:?} {found:?}");
                assert_eq!(found.closest.ended, Ended::Resolution);
            }
            asked += 1;
            decided += u32::from(!undecided);
            inside += u32::from(found.side == Side::Inside);
            on_line += u32::from(truth.allowed.is_none());
        }
    }
    // The cases that the test is about do occur.
    assert!(decided > asked / 2 && inside > asked / 10 && on_line > asked / 20);
    assert!(decided - inside > asked / 10, "{asked} {decided} {inside} {on_line}");
}

/// Fences of so many corners that runs stand for their segments.
fn large_fences(rng: &mut Rng) -> Vec<Vec<Polyline>> {
    let excluded = |polyline: Polyline| Polyline { zone: Zone::Exclusion, ..polyline };
    let ring = |corners: usize, middle: f64, radius: f64| {
        let points = circle(corners).points;
        closed(
            points
                .iter()
                .map(|[x, y, _]| [middle + radius * x, middle + radius * y, 0.0])
                .collect(),
        )
    };
    let flat = |polyline: Polyline| {
        closed(polyline.points.iter().map(|[x, y, _]| [*x, *y, 0.0]).collect())
    };
    vec![
        vec![circle(2000)],
        vec![flat(spiral(1500))],
        vec![flat(walk(3000, 3))],
        vec![flat(walk(700, 4)), excluded(flat(walk(900, 5))), flat(walk(65, 6))],
        vec![ring(500, 0.5, 0.5), excluded(ring(300, 0.3, 0.1)), excluded(ring(7, 0.7, 0.2))],
        (0..40).map(|k| ring(9, f64::from(k) * 0.02, 0.03)).collect(),
        vec![random_fence(rng, 400, Some(32.0), 1.0), excluded(ring(64, 0.5, 0.25))],
        vec![excluded(ring(200, 0.5, 0.4))],
    ]
}

#[test]
fn sides_of_large_fences_are_those_of_winding_numbers_with_any_budget_and_scratch() {
    let mut rng = Rng::new(5);
    for zones in large_fences(&mut rng) {
        for is_f32 in [false, true] {
            let bytes = stored(&zones, is_f32);
            let curve = Curve::open(&bytes).expect("opens");
            let [low, high] = curve.bounds();
            let enough = curve.scratch_entries();
            for k in 0..150 {
                let p = if k % 2 == 0 {
                    place(&mut rng, &zones, 1.0)
                } else {
                    let [x, y, _] = rng.point_in(low, high);
                    [x, y]
                };
                let truth = Truth::of(&zones, p);
                let ask = |budget: Budget, entries: usize| {
                    let found = curve.signed_distance(p, budget, &mut scratch(entries));
                    let found = found.expect("a fence");
                    assert_holds(&truth, p, &found);
                    assert!(found.closest.work.opened <= budget.steps, "{found:?}");
                    found
                };
                let exact = ask(Budget::EXACT, enough);
                let undecided = matches!(exact.side, Side::Undecided(_));
                assert!(!(undecided && is_clear(&curve, &zones, &truth)), "{p:?} {exact:?}");
                let best_first = ask(Budget::EXACT, 500);
                assert_eq!((exact.side, exact.distance), (best_first.side, best_first.distance));
                ask(Budget::EXACT, 1);
                ask(Budget::EXACT.with_steps(k), enough);
                ask(Budget::EXACT.with_steps(k / 8), 2);
                let tolerant = ask(Budget::EXACT.with_relative(0.5), enough);
                assert!(undecided || tolerant.side == exact.side, "{exact:?} {tolerant:?}");
                ask(Budget::EXACT.with_absolute(0.05), enough);
            }
        }
    }
}

#[test]
fn the_walk_of_a_large_fence_is_far_shorter_than_the_fence() {
    let bytes = stored(&[circle(20_000)], true);
    let curve = Curve::open(&bytes).expect("opens");
    let mut rng = Rng::new(6);
    for _ in 0..200 {
        let [x, y, _] = rng.point_in([-1.0; 3], [1.0; 3]);
        let budget = Budget::EXACT.with_steps(120);
        let found = curve.signed_distance([x, y], budget, &mut scratch(64)).expect("a fence");
        let is_inside = f64::from(x).hypot(f64::from(y)) < 1.0;
        let side = if is_inside { Side::Inside } else { Side::Outside };
        assert_eq!(found.side, side, "{found:?}");
    }
}

#[test]
fn nested_rings_and_far_points_have_the_side_that_the_zones_say() {
    let zone = |polyline: &Polyline, zone| Polyline { zone, ..polyline.clone() };
    let rings = fence();
    let (outer, post) = (&rings[0], &rings[1]);
    let (inclusion, exclusion) = (Zone::Inclusion, Zone::Exclusion);
    let (inside, outside) = (Side::Inside, Side::Outside);
    // In the field, in the post, and far away from both.
    let places = [[50.0, 8.0], [30.0, 24.0], [-1e30, 1e30]];
    for (zones, sides) in [
        ([inclusion, inclusion], [inside, inside, outside]),
        ([inclusion, exclusion], [inside, outside, outside]),
        ([exclusion, inclusion], [outside, outside, outside]),
        ([exclusion, exclusion], [outside, outside, inside]),
    ] {
        let polylines = [zone(outer, zones[0]), zone(post, zones[1])];
        let bytes = stored(&polylines, false);
        let curve = Curve::open(&bytes).expect("opens");
        assert_eq!([0, 1, 2].map(|k| curve.zone(k)), [Some(zones[0]), Some(zones[1]), None]);
        let mut memory = scratch(64);
        let asked =
            places.map(|p| curve.signed_distance(p, Budget::EXACT, &mut memory).expect("a fence"));
        assert_eq!(asked.map(|found| found.side), sides, "{zones:?}");
        for (found, p) in asked.iter().zip(places) {
            assert_holds(&Truth::of(&polylines, p), p, found);
        }
    }
}

#[test]
fn a_plane_of_any_height_answers_alike_and_nothing_else_is_a_fence() {
    let at = |z: f64| vec![[0.0, 0.0, z], [4.0, 0.0, z], [4.0, 4.0, z], [0.0, 4.0, z]];
    let ask = |polylines: &[Polyline], p: [f32; 2], budget: Budget, entries: usize| {
        let bytes = stored(polylines, false);
        let curve = Curve::open(&bytes).expect("opens");
        curve.signed_distance(p, budget, &mut scratch(entries))
    };
    let [flat, raised] = [0.0, 300.0].map(|z| {
        let found = ask(&[closed(at(z))], [1.0, 2.0], Budget::EXACT, 9).expect("a fence");
        assert_eq!(found.closest.point, [0.0, 2.0, z as f32]);
        assert!(found.distance.lower <= -1.0 && -1.0 <= found.distance.upper);
        found
    });
    assert_eq!((flat.side, raised.side), (Side::Inside, Side::Inside));
    let exact = Budget::EXACT;
    let mut tilted = at(0.0);
    tilted[2][2] = 1.0;
    let refused = ask(&[closed(tilted)], [1.0; 2], exact, 9);
    assert_eq!(refused, Err(QueryError::NotPlanar));
    assert!(refused.unwrap_err().to_string().contains("same z"));
    let refused = ask(&[closed(at(0.0)), open(at(0.0))], [1.0; 2], exact, 9);
    assert_eq!(refused, Err(QueryError::OpenPolyline { polyline: 1 }));
    assert!(refused.unwrap_err().to_string().contains("polyline 1 is not closed"));
    let whole = [closed(at(0.0))];
    assert_eq!(ask(&whole, [f32::NAN, 0.0], exact, 9), Err(QueryError::NotFinite));
    assert_eq!(ask(&whole, [0.0, f32::INFINITY], exact, 9), Err(QueryError::NotFinite));
    assert_eq!(ask(&whole, [0.0; 2], exact, 0), Err(QueryError::NoScratch));
    let negative = exact.with_absolute(-1.0);
    assert_eq!(ask(&whole, [0.0; 2], negative, 9), Err(QueryError::Tolerance));
    // Steps that do not reach the side leave it undecided.
    let none = ask(&whole, [1.0, 2.0], exact.with_steps(0), 9).expect("an interval");
    assert_eq!(none.side, Side::Undecided(Undecided::Steps));
    assert!(none.distance.lower <= -1.0 && 1.0 <= none.distance.upper);
}
