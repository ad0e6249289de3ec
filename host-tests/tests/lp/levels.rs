//! The programs in one and two variables, each against all candidates tried one by one.

use glam::{DVec2, DVec3};
use meshsweep::lp::{HalfSpace, Interval, Outcome, minimise_on_line, minimise_on_plane};
use meshsweep_host_tests::oracle::lp::random::Random;

use super::ORDERS;

const EPS: f64 = 1e-6;
const FLOOR: HalfSpace = HalfSpace { normal: DVec3::Z, offset: 0.0 };
const WALL: HalfSpace = HalfSpace { normal: DVec3::Y, offset: 0.0 };

#[test]
fn interval_keeps_the_tightest_bounds() {
    let mut interval = Interval::ALL;
    assert_eq!(interval.nearest(7.0), Some(7.0));
    interval.clip(1.0, -2.0);
    interval.clip(0.5, -2.0);
    assert_eq!((interval.nearest(-9.0), interval.nearest(9.0)), (Some(-2.0), Some(9.0)));
    interval.clip(-0.5, -1.0);
    interval.clip(-1.0, -3.0);
    assert_eq!((interval.nearest(9.0), interval.nearest(0.0)), (Some(2.0), Some(0.0)));
}

#[test]
fn empty_interval_has_no_point_but_a_middle() {
    let mut interval = Interval::ALL;
    interval.clip(1.0, 2.0);
    interval.clip(-1.0, -1.0);
    assert_eq!(interval.nearest(0.0), None);
    assert_eq!(interval.nearest_or_middle(0.0), 1.5);
}

/// On the x axis: the constraint `a·x >= b`, with a unit normal whose other part points anywhere.
fn on_axis(random: &mut Random, rate: f64, bound: f64) -> HalfSpace {
    let turn = random.within(0.0, core::f64::consts::TAU);
    let rest = (1.0 - rate * rate).sqrt();
    HalfSpace { normal: DVec3::new(rate, rest * turn.cos(), rest * turn.sin()), offset: bound }
}

#[test]
fn program_on_a_line_is_cut_off_at_the_nearest_bound() {
    let mut random = Random::new(30);
    let mut outcomes = [0; 3];
    for _ in 0..20_000 {
        let slope = random.pick(&[-1.0, 0.0, 1.0]);
        let (mut lower, mut upper) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut constraints = Vec::new();
        for _ in 0..random.below(5) {
            let (rate, bound) =
                (random.within(0.1, 1.0) * random.pick(&[-1.0, 1.0]), random.within(-1.0, 0.3));
            if rate > 0.0 {
                lower = lower.max(bound / rate)
            } else {
                upper = upper.min(bound / rate)
            }
            constraints.push(on_axis(&mut random, rate, bound));
        }
        let outcome = minimise_on_line(DVec3::X * slope, [FLOOR, WALL], &constraints, EPS);
        let open =
            (slope < 0.0 && upper == f64::INFINITY) || (slope > 0.0 && lower == f64::NEG_INFINITY);
        match outcome {
            Outcome::Infeasible => assert!(lower > upper),
            Outcome::Unbounded => assert!(open && lower <= upper),
            Outcome::Optimal(point) => {
                let wanted = (-slope / EPS).clamp(lower, upper);
                assert!(
                    !open && point.distance(DVec3::X * wanted) < 1e-14 * (1.0 + wanted.abs()),
                    "{point}"
                );
            }
        }
        outcomes[match outcome {
            Outcome::Optimal(_) => 0,
            Outcome::Infeasible => 1,
            Outcome::Unbounded => 2,
        }] += 1;
    }
    assert!(outcomes.iter().all(|&count| count > 1000), "{outcomes:?}");
}

#[test]
fn line_of_parallel_planes_is_infeasible() {
    assert_eq!(minimise_on_line(DVec3::X, [FLOOR, FLOOR], &[], EPS), Outcome::Infeasible);
    let zero = HalfSpace { normal: DVec3::ZERO, offset: 0.0 };
    assert_eq!(minimise_on_line(DVec3::X, [zero, FLOOR], &[], EPS), Outcome::Infeasible);
    assert_eq!(minimise_on_line(DVec3::X, [FLOOR, zero], &[], EPS), Outcome::Infeasible);
}

#[test]
fn constraint_parallel_to_the_line_holds_everywhere_or_nowhere() {
    let ceiling = |offset| HalfSpace { normal: -DVec3::Z, offset };
    let solve = |offset| minimise_on_line(DVec3::ZERO, [FLOOR, WALL], &[ceiling(offset)], EPS);
    assert_eq!(solve(-1.0), Outcome::Optimal(DVec3::ZERO));
    assert_eq!(solve(0.0), Outcome::Optimal(DVec3::ZERO));
    assert_eq!(solve(1e-3), Outcome::Infeasible);
}

/// The least value over all crossings of two lines that satisfy everything; infinite if there is
/// none.
fn least_crossing(objective: DVec2, lines: &[(DVec2, f64)]) -> f64 {
    let mut least = f64::INFINITY;
    for (idx, (n, d)) in lines.iter().enumerate() {
        for (m, e) in &lines[..idx] {
            let crossing = (n.perp() * *e - m.perp() * *d) / n.perp_dot(*m);
            if lines.iter().all(|(n, d)| n.dot(crossing) >= d - 1e-9) {
                least = least.min(objective.dot(crossing));
            }
        }
    }
    least
}

#[test]
fn program_on_a_plane_finds_the_least_crossing() {
    let mut random = Random::new(31);
    let mut outcomes = [0; 3];
    for idx in 0..20_000 {
        let turned =
            |random: &mut Random| DVec2::from_angle(random.within(0.0, core::f64::consts::TAU));
        let lines: Vec<(DVec2, f64)> = (0..3 + random.below(6))
            .map(|_| (turned(&mut random), random.within(-1.0, 0.3)))
            .collect();
        // Any height of the plane, and constraints that lean by any angle: on the plane they are
        // the same lines.
        let height = random.within(-1.0, 1.0);
        let floor = HalfSpace { offset: height, ..FLOOR };
        let mut constraints: Vec<HalfSpace> = lines
            .iter()
            .map(|(n, d)| {
                let (lean, up) = DVec2::from_angle(random.within(-1.2, 1.2)).into();
                HalfSpace { normal: (*n * lean).extend(up), offset: d * lean + up * height }
            })
            .collect();
        let objective = turned(&mut random);
        let least = least_crossing(objective, &lines);
        let order = ORDERS[idx % ORDERS.len()];
        let outcome = minimise_on_plane(objective.extend(0.0), floor, &mut constraints, EPS, order);
        match outcome {
            Outcome::Infeasible => assert!(least == f64::INFINITY, "{idx}: {least}"),
            Outcome::Unbounded => {
                // Some ray descends: turn the objective's opposite as little as the lines allow.
                let rays =
                    lines.iter().flat_map(|(n, _)| [n.perp(), -n.perp()]).chain([-objective]);
                let descends = |ray: DVec2| {
                    objective.dot(ray) < 0.0 && lines.iter().all(|(n, _)| n.dot(ray) >= -1e-12)
                };
                assert!(rays.into_iter().any(descends), "{idx}: no ray");
            }
            Outcome::Optimal(point) => {
                assert_eq!(point.z, height);
                let value = objective.dot(point.truncate());
                let bound = EPS * (1.0 + point.length_squared());
                assert!((value - least).abs() <= bound, "{idx}: {value} instead of {least}");
            }
        }
        outcomes[match outcome {
            Outcome::Optimal(_) => 0,
            Outcome::Infeasible => 1,
            Outcome::Unbounded => 2,
        }] += 1;
    }
    assert!(outcomes.iter().all(|&count| count > 1000), "{outcomes:?}");
}
