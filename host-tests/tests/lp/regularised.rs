//! The regularised optimum against exact quadratic programming, and its limit on faces that are
//! optimal throughout.

use glam::DVec3;
use meshsweep::lp::{HalfSpace, Order, Outcome, minimise};
use meshsweep_host_tests::oracle::lp::programs::Family;
use meshsweep_host_tests::oracle::lp::random::Random;
use meshsweep_host_tests::oracle::lp::stars::Star;
use meshsweep_host_tests::oracle::lp::{Program, quadratic};

use super::ORDERS;

/// `eps` as the oracle takes it: two to the minus this.
const EXPONENTS: [u32; 3] = [10, 20, 30];
/// An `eps` so small that it only chooses among equal optima.
const VANISHING: u32 = 400;

fn eps(exponent: u32) -> f64 {
    1.0 / (1u64 << exponent) as f64
}

fn solve(program: &Program, exponent: u32, order: Order) -> Outcome {
    minimise(program.objective, &mut program.constraints.clone(), eps(exponent), order)
}

fn value(program: &Program, exponent: u32, point: DVec3) -> f64 {
    program.objective.dot(point) + eps(exponent) / 2.0 * point.length_squared()
}

/// Distances from the solver's answers, in all orders, to the exact optimum, relative to its
/// distance from the star, ascending.
fn distances(programs: impl Iterator<Item = Program>, exponent: u32) -> Vec<f64> {
    let mut distances = Vec::new();
    for (idx, program) in programs.enumerate() {
        let exact = quadratic::optimum(&program, exponent);
        for order in ORDERS {
            match (solve(&program, exponent, order), exact) {
                (Outcome::Optimal(point), Some(exact)) => {
                    let scale = 1.0 + exact.length();
                    let excess =
                        value(&program, exponent, point) - value(&program, exponent, exact);
                    assert!(
                        excess.abs() <= 1e-9 * scale,
                        "program {idx}: {excess:e} from the optimum, {program:?}"
                    );
                    distances.push(point.distance(exact) / scale);
                }
                (Outcome::Unbounded, Some(exact)) => {
                    assert!(eps(exponent) * exact.length() > 0.99e-5 * program.objective.length());
                }
                (outcome, exact) => assert!(
                    outcome == Outcome::Infeasible && exact.is_none(),
                    "program {idx}: {outcome:?} for {exact:?}"
                ),
            }
        }
    }
    distances.sort_by(f64::total_cmp);
    distances
}

#[test]
fn regularised_optimum_is_the_exact_one() {
    for family in [Family::Around, Family::Bounded, Family::Anything, Family::Box] {
        for exponent in EXPONENTS {
            let mut random = Random::new(7);
            let distances = distances((0..300).map(|_| family.program(&mut random)), exponent);
            let (median, most) = (distances[distances.len() / 2], distances[distances.len() - 1]);
            println!("{family:?}, eps 2^-{exponent}: median {median:.1e}, most {most:.1e}");
            // The objective's rounding, 1e-16, is divided by eps.
            let bound = 1e-13 + 4e-16 / eps(exponent);
            assert!(distances.len() > 100 * ORDERS.len() && median < 1e-15 && most < bound);
        }
    }
}

#[test]
fn regularised_optimum_of_stars_is_the_exact_one() {
    for star in Star::ALL {
        for exponent in EXPONENTS {
            let mut random = Random::new(8);
            let distances =
                distances((0..60).map(|_| star.program(&mut random).representable()), exponent);
            let (median, most) = (distances[distances.len() / 2], distances[distances.len() - 1]);
            println!("{star:?}, eps 2^-{exponent}: median {median:.1e}, most {most:.1e}");
            // Nearly coplanar planes fix a vertex only to the rounding of their offsets, divided by
            // their angle.
            assert!(distances.len() > 50 * ORDERS.len() && median < 1e-6 && most < 1e-5);
        }
    }
}

#[test]
fn optimal_face_is_answered_by_its_point_nearest_to_the_origin() {
    for family in [Family::Face, Family::Box] {
        let mut random = Random::new(9);
        let mut compared = 0;
        for idx in 0..500 {
            let program = family.program(&mut random);
            // If the exact optimum no longer moves at the solver's eps then it has reached the
            // face's nearest point.
            let (limit, here) =
                (quadratic::optimum(&program, VANISHING), quadratic::optimum(&program, 30));
            for order in ORDERS {
                let (Some(limit), Some(here), Outcome::Optimal(point)) =
                    (limit, here, solve(&program, 30, order))
                else {
                    continue;
                };
                if limit.distance(here) < 1e-12 {
                    compared += 1;
                    assert!(
                        point.distance(limit) < 1e-6,
                        "{family:?} {idx} {order:?}: {point} instead of {limit}"
                    );
                }
            }
        }
        println!("{family:?}: {compared}");
        assert!(compared > 250 * ORDERS.len());
    }
}

#[test]
fn flat_star_keeps_its_vertex_at_the_middle() {
    let mut random = Random::new(10);
    for _ in 0..1000 {
        let program = Star::Aligned.program(&mut random);
        for exponent in EXPONENTS {
            for order in ORDERS {
                assert_eq!(solve(&program, exponent, order), Outcome::Optimal(DVec3::ZERO));
            }
        }
    }
}

/// A vertex of well separated planes lies on them to rounding, however far out the pull is.
#[test]
fn vertex_lies_on_its_planes_for_every_eps() {
    let mut random = Random::new(11);
    for _ in 0..10_000 {
        let normals = [random.direction(), random.direction(), random.direction()];
        if normals[0].cross(normals[1]).dot(normals[2]).abs() < 0.1 {
            continue;
        }
        let mut planes =
            normals.map(|normal| HalfSpace { normal, offset: random.within(-1.0, 1.0) });
        let objective = normals.into_iter().sum();
        for eps in [1e-3, 1e-6, 1e-9, 1e-12] {
            let Outcome::Optimal(vertex) =
                minimise(objective, &mut planes, eps, random.pick(&ORDERS))
            else {
                panic!("has a vertex")
            };
            for h in &planes {
                let distance = h.normal.dot(vertex) - h.offset;
                assert!(
                    distance.abs() <= 2e-15 * (1.0 + vertex.length()),
                    "{distance:e} at {vertex}, eps {eps:e}"
                );
            }
        }
    }
}
