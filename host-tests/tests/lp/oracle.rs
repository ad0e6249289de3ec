//! The solver against exact rational arithmetic, on random and degenerate programs.

use glam::DVec3;
use meshsweep::lp::{HalfSpace, Order, Outcome, minimise};
use meshsweep_host_tests::oracle::lp::programs::Family;
use meshsweep_host_tests::oracle::lp::random::Random;
use meshsweep_host_tests::oracle::lp::{Program, Verdict, is_feasible, quadratic, solve};

use super::ORDERS;

/// A point of the answer may lie this far outside a half-space, times its distance: twice the
/// solver's own tolerance for a violation, or for a contradiction.
const VIOLATION: f64 = 2e-12;
const CONTRADICTION: f64 = 2e-10;
/// Steepest descent to infinity that the solver may overlook.
const DESCENT: f64 = 1.001e-5;

/// Distance beyond which an optimum may be taken for none.
const FAR: f64 = 1e9;

/// How often solver and oracle agreed, and why not otherwise.
#[derive(Debug, Default)]
struct Tally {
    optimal: usize,
    infeasible: usize,
    unbounded: usize,
    /// Feasible, but not within [`FAR`] when every offset grows by 2e-10: called infeasible.
    barely_feasible: usize,
    /// Infeasible, but not when offsets fall by [`CONTRADICTION`], times the point's distance:
    /// called feasible.
    barely_infeasible: usize,
    /// Descends to infinity, but no steeper than [`DESCENT`]: called optimal.
    slow_descent: usize,
    /// Has an optimum, but farther out than [`FAR`], by the rounding of parallel edges: called
    /// unbounded.
    far: usize,
}

fn scale(point: DVec3) -> f64 {
    1.0 + point.abs().element_sum()
}

fn worst_violation(point: DVec3, constraints: &[HalfSpace]) -> f64 {
    constraints.iter().map(|h| h.offset - h.normal.dot(point)).fold(0.0, f64::max)
}

impl Tally {
    fn check(&mut self, program: &Program, verdict: Verdict, eps: f64, order: Order, name: &str) {
        let Program { objective, constraints } = program;
        let outcome = minimise(*objective, &mut constraints.clone(), eps, order);
        match (outcome, verdict) {
            (Outcome::Optimal(x), Verdict::Optimal { value, multipliers, distance }) => {
                let violation = worst_violation(x, constraints);
                assert!(violation <= VIOLATION * scale(x), "{name}: {violation:e} outside at {x}");
                let excess = objective.dot(x) - value;
                let rounding = VIOLATION * scale(x) * (1.0 + multipliers);
                let regularisation = eps / 2.0 * distance * distance;
                assert!(excess >= -rounding, "{name}: {excess:e} below the optimum at {x}");
                assert!(
                    excess <= regularisation + rounding,
                    "{name}: {excess:e} above the optimum at {x}"
                );
                self.optimal += 1;
            }
            (Outcome::Infeasible, Verdict::Infeasible) => self.infeasible += 1,
            (Outcome::Unbounded, Verdict::Unbounded) => self.unbounded += 1,
            (Outcome::Infeasible, Verdict::Optimal { .. } | Verdict::Unbounded) => {
                assert!(!is_feasible(&nearby(constraints), 2f64.powi(-32)), "{name}: is feasible");
                self.barely_feasible += 1;
            }
            (Outcome::Optimal(x), Verdict::Infeasible) => {
                let violation = worst_violation(x, constraints);
                assert!(
                    violation <= CONTRADICTION * scale(x),
                    "{name}: is infeasible, {violation:e} outside at {x}"
                );
                self.barely_infeasible += 1;
            }
            (Outcome::Optimal(_), Verdict::Unbounded) => {
                let slope = descent(program);
                assert!(slope <= DESCENT, "{name}: descends with slope {slope:e}");
                self.slow_descent += 1;
            }
            (Outcome::Unbounded, Verdict::Optimal { distance, .. }) if distance > FAR => {
                self.far += 1
            }
            (outcome, verdict) => panic!("{name}: {outcome:?}, but {verdict:?}"),
        }
    }
}

/// `constraints` and a cube of [`FAR`].
fn nearby(constraints: &[HalfSpace]) -> Vec<HalfSpace> {
    let mut nearby = constraints.to_vec();
    for normal in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
        nearby.push(HalfSpace { normal, offset: -FAR });
    }
    nearby
}

/// Slope of the steepest ray to infinity: the projection of the objective's opposite onto the cone
/// of such rays.
fn descent(program: &Program) -> f64 {
    let mut cone = program.clone();
    cone.constraints.iter_mut().for_each(|h| h.offset = 0.0);
    quadratic::optimum(&cone, 0).map_or(0.0, |ray| ray.length() / program.objective.length())
}

/// One tally for each of [`ORDERS`], of the same programs.
fn run(families: &[Family], count: usize, seed: u64) -> [Tally; ORDERS.len()] {
    let mut tallies = <[Tally; ORDERS.len()]>::default();
    for idx in 0..count {
        let family = families[idx % families.len()];
        let mut random = Random::new(seed + idx as u64);
        let program = family.program(&mut random);
        let eps = random.pick(&[1e-3, 1e-6, 1e-9]);
        let verdict = solve(&program);
        for (tally, order) in tallies.iter_mut().zip(ORDERS) {
            let name = format!("{family:?} {} eps {eps:e} {order:?}", seed + idx as u64);
            tally.check(&program, verdict, eps, order, &name);
        }
    }
    tallies
}

#[test]
fn random_programs_agree_with_exact_arithmetic() {
    for (tally, order) in run(&Family::RANDOM, 10_000, 0).into_iter().zip(ORDERS) {
        println!("{order:?}: {tally:?}");
        assert!(tally.optimal > 5000 && tally.infeasible > 200 && tally.unbounded > 1500);
        assert_eq!((tally.barely_feasible, tally.barely_infeasible, tally.far), (0, 0, 0));
        // Combinations of one or two normals, rounded, are seldom exact combinations.
        assert!(tally.slow_descent < 500);
    }
}

#[test]
fn degenerate_programs_agree_with_exact_arithmetic() {
    let tallies = Family::DEGENERATE
        .into_iter()
        .flat_map(|family| run(&[family], 300, 1_000_000).into_iter().map(move |t| (family, t)));
    for (family, tally) in tallies {
        println!("{family:?}: {tally:?}");
        let Tally {
            optimal,
            infeasible,
            unbounded,
            barely_feasible,
            barely_infeasible,
            slow_descent,
            far,
        } = tally;
        assert!(slow_descent <= 60);
        // The parallel edges of a prism, once rounded, may meet far out.
        let most = if family == Family::Prism { 40 } else { 0 };
        assert!(barely_feasible + far <= most);
        match family {
            Family::Contradiction => assert_eq!(infeasible, 300),
            Family::Unbounded => assert_eq!(unbounded, 300),
            // Planes through one point, each offset rounded, may have no point in common.
            Family::NarrowContradiction | Family::Apex => assert!(barely_infeasible > 50),
            _ => assert!(optimal > 100 && barely_infeasible == 0),
        }
    }
}
