//! What the orders of insertion cost, by counts and not by time. That their answers are the same is
//! shown where answers are.

use meshsweep::lp::{Order, minimise_counted};
use meshsweep_host_tests::oracle::lp::Program;
use meshsweep_host_tests::oracle::lp::programs::Family;
use meshsweep_host_tests::oracle::lp::random::Random;

const EPS: f64 = 1e-6;
const SEEDS: u64 = 200;

/// The bound on expected tests a constraint: see `Work::tests`. Spheres reach it.
const TESTS: f64 = 10.0;
/// How much the mean of [`SEEDS`] may exceed it by chance.
const CHANCE: f64 = 1.05;

fn tests(program: &Program, order: Order) -> u64 {
    let mut constraints = program.constraints.clone();
    let (optimum, work) = minimise_counted(program.objective, &mut constraints, EPS, order);
    assert!(optimum.is_some());
    work.tests
}

/// Mean over seeds of the tests of one program, per constraint.
fn mean_tests(program: &Program) -> f64 {
    let sum: u64 = (0..SEEDS).map(|seed| tests(program, Order::Shuffled(seed))).sum();
    sum as f64 / SEEDS as f64 / program.constraints.len() as f64
}

/// The programs come in the worst order for insertion as they come.
#[test]
fn shuffled_order_takes_linear_work_whatever_the_program() {
    for (family, large) in Family::LARGE {
        for count in [10, 100, 1000, 10_000] {
            let program = large(&mut Random::new(40), count);
            let mean = mean_tests(&program);
            println!("{family:?} {count}: {mean:.2} tests a constraint");
            assert!((1.0..=TESTS * CHANCE).contains(&mean), "{family:?} {count}: {mean}");
        }
    }
}

/// Stars and small programs: the bound holds for the mean of each family, feasible ones alone.
#[test]
fn shuffled_order_takes_linear_work_on_small_programs() {
    for family in Family::RANDOM.into_iter().chain(Family::DEGENERATE) {
        let mut random = Random::new(41);
        let (mut tests, mut constraints) = (0, 0);
        for seed in 0..2000 {
            let mut program = family.program(&mut random);
            let order = Order::Shuffled(seed);
            let (optimum, work) =
                minimise_counted(program.objective, &mut program.constraints, EPS, order);
            if optimum.is_some() {
                tests += work.tests;
                constraints += program.constraints.len();
            }
        }
        println!("{family:?}: {tests} tests of {constraints} constraints");
        assert!(tests as f64 <= TESTS * constraints as f64, "{family:?}");
    }
}

#[test]
fn most_violated_order_takes_few_insertions_on_large_programs() {
    for (family, large) in Family::LARGE {
        let program = large(&mut Random::new(42), 10_000);
        let tests = tests(&program, Order::MostViolated) as f64 / 10_000.0;
        println!("{family:?}: {tests:.2} tests a constraint");
        assert!((1.0..30.0).contains(&tests));
    }
}

/// Each seed names an order, and not all the same.
#[test]
fn seeds_name_orders() {
    let program = Family::Stairs.program(&mut Random::new(43));
    let order = |seed| {
        let mut constraints = program.constraints.clone();
        let order = Order::Shuffled(seed);
        let _ = minimise_counted(program.objective, &mut constraints, EPS, order);
        constraints
    };
    assert!((0..20).all(|seed| order(seed) == order(seed)));
    assert!((1..20).all(|seed| order(seed) != order(0)));
}
