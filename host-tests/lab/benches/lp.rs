//! Time per solve on star-like programs: `cargo bench -p meshsweep-lab --bench lp`.

use std::hint::black_box;
use std::time::Instant;

use glam::DVec3;
use meshsweep::lp::{HalfSpace, Outcome, minimise};
use meshsweep_host_tests::oracle::lp::Program;
use meshsweep_host_tests::oracle::lp::random::Random;
use meshsweep_host_tests::oracle::lp::stars::Star;

const PROGRAMS: usize = 2000;
const PASSES: usize = 101;

fn main() {
    println!(
        "{:<10} {:>7} {:>11} {:>14} {:>14} {:>14}",
        "star", "planes", "infeasible", "eps 1e-3", "eps 1e-6", "eps 1e-9"
    );
    for star in Star::ALL {
        let mut random = Random::new(1);
        let programs: Vec<Program> = (0..PROGRAMS).map(|_| star.program(&mut random)).collect();
        let planes =
            programs.iter().map(|p| p.constraints.len()).sum::<usize>() as f64 / PROGRAMS as f64;
        let infeasible = programs
            .iter()
            .filter(|p| {
                minimise(p.objective, &mut p.constraints.clone(), 1e-6) == Outcome::Infeasible
            })
            .count() as f64
            / PROGRAMS as f64;
        let times =
            [1e-3, 1e-6, 1e-9].map(|eps| nanoseconds(&programs, |c, h| minimise(c, h, eps)));
        println!(
            "{:<10} {planes:>7.1} {:>10.1}% {:>11.0} ns {:>11.0} ns {:>11.0} ns",
            format!("{star:?}"),
            100.0 * infeasible,
            times[0],
            times[1],
            times[2]
        );
    }
}

/// Least over the passes, for other load only adds, of the mean time of one solve; copying the
/// constraints included (about 10 ns).
fn nanoseconds(programs: &[Program], solve: impl Fn(DVec3, &mut [HalfSpace]) -> Outcome) -> f64 {
    let mut buffer = Vec::with_capacity(64);
    (0..PASSES)
        .map(|_| {
            let start = Instant::now();
            for program in programs {
                buffer.clear();
                buffer.extend_from_slice(&program.constraints);
                black_box(solve(black_box(program.objective), &mut buffer));
            }
            start.elapsed().as_nanos() as f64 / programs.len() as f64
        })
        .fold(f64::INFINITY, f64::min)
}
