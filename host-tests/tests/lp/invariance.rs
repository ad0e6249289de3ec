//! What must not change an answer, and what any input may expect.

use glam::DVec3;
use meshsweep::lp::{HalfSpace, Order, Outcome, minimise};
use meshsweep_host_tests::oracle::lp::Program;
use meshsweep_host_tests::oracle::lp::programs::Family;
use meshsweep_host_tests::oracle::lp::random::Random;

use super::ORDERS;

const EPS: f64 = 1e-6;

fn solve(program: &Program) -> Outcome {
    solve_in(program, Order::MostViolated)
}

fn solve_in(program: &Program, order: Order) -> Outcome {
    minimise(program.objective, &mut program.constraints.clone(), EPS, order)
}

fn assert_same(a: Outcome, b: Outcome, program: &Program) {
    match (a, b) {
        (Outcome::Optimal(a), Outcome::Optimal(b)) => {
            let value =
                |point: DVec3| program.objective.dot(point) + EPS / 2.0 * point.length_squared();
            let scale = 1.0 + a.length();
            assert!((value(a) - value(b)).abs() <= 1e-9 * scale, "{a} and {b}: {program:?}");
            assert!(a.distance(b) <= 1e-5 * scale, "{a} and {b}: {program:?}");
        }
        (a, b) => assert_eq!(a, b, "{program:?}"),
    }
}

/// Those whose outcome does not hang on rounding.
const FAMILIES: [Family; 8] = [
    Family::Around,
    Family::Bounded,
    Family::Anything,
    Family::Star,
    Family::Duplicates,
    Family::Contradiction,
    Family::Face,
    Family::Box,
];

#[test]
fn neither_order_nor_duplicates_of_constraints_matter() {
    for (seed, duplicates) in [(20, 0), (21, 5)] {
        for family in FAMILIES {
            let mut random = Random::new(seed);
            for _ in 0..1000 {
                let mut program = family.program(&mut random);
                let before = solve(&program);
                for _ in 0..random.below(duplicates + 1) {
                    let again = random.pick(&program.constraints);
                    program.constraints.push(again);
                }
                random.shuffle(&mut program.constraints);
                for order in ORDERS {
                    assert_same(before, solve_in(&program, order), &program);
                }
            }
        }
    }
}

#[test]
fn constraints_are_permuted_and_not_changed() {
    let mut random = Random::new(23);
    for _ in 0..1000 {
        let mut program = Family::Star.program(&mut random);
        let before = program.constraints.clone();
        let order = random.pick(&ORDERS);
        let _ = minimise(program.objective, &mut program.constraints, EPS, order);
        let key = |h: &HalfSpace| h.normal.to_array().map(f64::to_bits);
        let sorted = |mut all: Vec<HalfSpace>| {
            all.sort_by_key(key);
            all
        };
        assert_eq!(sorted(before), sorted(program.constraints));
    }
}

#[test]
fn any_number_of_constraints_is_solved() {
    let mut random = Random::new(24);
    for count in [0, 1, 2, 3, 4, 64, 1000, 30_000] {
        // Tangent planes of the unit sphere from within: no plane is redundant.
        let tangent = |random: &mut Random| HalfSpace { normal: random.direction(), offset: -1.0 };
        let mut constraints: Vec<HalfSpace> = (0..count).map(|_| tangent(&mut random)).collect();
        match minimise(DVec3::Z, &mut constraints, EPS, random.pick(&ORDERS)) {
            Outcome::Optimal(point) => {
                assert!(count >= 3 && point.z < -1.0 + EPS);
                assert!(
                    constraints
                        .iter()
                        .all(|h| h.normal.dot(point) >= h.offset - 1e-11 * point.length())
                );
            }
            outcome => assert!(count <= 4 && outcome == Outcome::Unbounded, "{count}: {outcome:?}"),
        }
    }
}

#[test]
fn zero_objective_gives_the_point_nearest_to_the_origin() {
    let mut constraints =
        [HalfSpace { normal: DVec3::X, offset: 0.5 }, HalfSpace { normal: DVec3::Y, offset: -0.5 }];
    assert_eq!(
        minimise(DVec3::ZERO, &mut constraints, EPS, Order::MostViolated),
        Outcome::Optimal(DVec3::new(0.5, 0.0, 0.0))
    );
    assert_eq!(
        minimise(DVec3::ZERO, &mut [], EPS, Order::MostViolated),
        Outcome::Optimal(DVec3::ZERO)
    );
}

#[test]
fn numbers_that_are_not_finite_are_infeasible() {
    let plane = HalfSpace { normal: DVec3::Z, offset: 0.0 };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let offset = HalfSpace { offset: bad, ..plane };
        let normal = HalfSpace { normal: DVec3::new(bad, 0.0, 1.0), ..plane };
        assert_eq!(
            minimise(DVec3::Z, &mut [plane, offset], EPS, Order::MostViolated),
            Outcome::Infeasible
        );
        assert_eq!(
            minimise(DVec3::Z, &mut [normal, plane], EPS, Order::MostViolated),
            Outcome::Infeasible
        );
        assert_eq!(
            minimise(DVec3::new(0.0, bad, 1.0), &mut [plane], EPS, Order::MostViolated),
            Outcome::Infeasible
        );
    }
    for eps in [0.0, -1e-6, f64::NAN] {
        assert_eq!(minimise(DVec3::Z, &mut [plane], eps, Order::MostViolated), Outcome::Infeasible);
    }
}

/// Bundles of nearly coplanar planes that meet in one or two points, with a common direction to get
/// away from all.
///
/// A random order may begin with planes of one bundle, and computes their lines of intersection to
/// few digits. Where planes leave no more than a point, that may miss it.
#[test]
fn bundles_of_planes_through_common_points_are_feasible() {
    let mut random = Random::new(25);
    let mut missed = [0; ORDERS.len()];
    for _ in 0..100_000 {
        let (away, point) = (random.direction(), random.direction() * 0.5);
        let mut constraints = Vec::new();
        for _ in 0..2 + random.below(4) {
            let axis = random.direction();
            let axis = (axis * axis.dot(away).signum() + away * 0.3).normalize();
            for _ in 0..1 + random.below(5) {
                let spread = 10f64.powf(random.within(-12.0, -4.0));
                let normal = (axis + random.direction() * spread).normalize();
                let through = point * random.pick(&[1.0, 1.0, -1.0]);
                constraints.push(HalfSpace { normal, offset: normal.dot(through) });
            }
        }
        let objective: DVec3 = constraints.iter().map(|h| h.normal * random.within(0.0, 1.0)).sum();
        for (order, missed) in ORDERS.into_iter().zip(&mut missed) {
            match minimise(objective.normalize(), &mut constraints.clone(), EPS, order) {
                Outcome::Optimal(vertex) => {
                    let slack = 2e-12 * (1.0 + vertex.length());
                    assert!(constraints.iter().all(|h| h.normal.dot(vertex) >= h.offset - slack));
                }
                Outcome::Infeasible => *missed += 1,
                Outcome::Unbounded => panic!("{order:?}: {constraints:?}"),
            }
        }
    }
    println!("{missed:?} of 100,000");
    assert_eq!(missed[0], 0, "{:?}", ORDERS[0]);
    assert!(missed[1..].iter().all(|&missed| missed <= 100), "{missed:?}");
}
