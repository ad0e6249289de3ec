//! Work and time of linear programs in both orders of insertion, on stars and on large programs:
//! `cargo bench -p meshsweep-lab --bench lp [-- MESH]`. Stars of a build are those of MESH, or of
//! `fixtures/bracket.stl`.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use meshsweep::collapse::{Conditions, Connectivity, Engine, Priority};
use meshsweep::lp::{Order, minimise_counted};
use meshsweep::surface::{VertexBits, store};
use meshsweep_host_tests::oracle::lp::Program;
use meshsweep_host_tests::oracle::lp::programs::Family;
use meshsweep_host_tests::oracle::lp::random::Random;
use meshsweep_host_tests::oracle::lp::stars::{Star, of_faces};
use meshsweep_host_tests::workload::Subject;

/// Random stars of a kind, and most stars of a level.
const PROGRAMS: usize = 2000;
/// Solves behind every time, in at least [`PASSES`] passes.
const SOLVED_PLANES: usize = 2_000_000;
const PASSES: usize = 11;

fn main() {
    let mesh = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let bracket = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/bracket.stl");
    let mesh = mesh.unwrap_or_else(|| bracket.to_owned());
    println!(
        "{:<22} {:>6} {:>8} {:>16} {:>16} {:>14} {:>14}",
        "", "eps", "planes", "violated, tests", "shuffled, tests", "violated", "shuffled"
    );
    for star in Star::ALL {
        let mut random = Random::new(1);
        let programs: Vec<Program> = (0..PROGRAMS).map(|_| star.program(&mut random)).collect();
        for eps in [1e-3, 1e-6] {
            report(&format!("{star:?}"), eps, &programs);
        }
    }
    for (faces, programs) in recorded(Path::new(&mesh)) {
        report(&format!("build, {faces} faces"), Conditions::STANDARD.second_term, &programs);
    }
    for (family, large) in Family::LARGE {
        for count in [10, 100, 1000, 10_000] {
            report(&format!("{family:?}"), 1e-6, &[large(&mut Random::new(1), count)]);
        }
    }
}

/// The stars of all edges that a build may collapse, at the start and at each fourth part of the
/// faces, thinned to [`PROGRAMS`].
fn recorded(mesh: &Path) -> Vec<(usize, Vec<Program>)> {
    let subject = Subject::load(mesh).expect("a closed mesh");
    let stored = store(&subject.mesh, VertexBits::Auto);
    let mut engine = Engine::new(
        &stored.positions,
        &subject.mesh.triangles,
        Conditions::STANDARD,
        Priority::Program,
        stored.grid,
    );
    let mut levels = Vec::new();
    let mut target = subject.mesh.triangles.len();
    while target >= 100 && engine.run(target, |_| true).is_none() {
        let positions = engine.positions();
        let triangles: Vec<[u32; 3]> = engine.faces().collect();
        let mut mesh = Connectivity::new(positions.len(), &triangles);
        let (mut star, mut programs) = (Vec::new(), Vec::new());
        for [a, b] in mesh.edges() {
            if mesh.collapsible_star(a, b, Conditions::STANDARD.max_valence, &mut star) {
                let corners = |&t: &u32| mesh.corners[t as usize].map(|v| positions[v as usize]);
                let faces: Vec<_> = star.iter().map(corners).collect();
                let middle = (positions[a as usize] + positions[b as usize]) / 2.0;
                programs.push(of_faces(&faces, middle));
            }
        }
        let each = programs.len().div_ceil(PROGRAMS).max(1);
        levels.push((triangles.len(), programs.into_iter().step_by(each).collect()));
        target /= 4;
    }
    levels
}

/// One line: means over `programs`, and over seeds.
fn report(name: &str, eps: f64, programs: &[Program]) {
    let planes = programs.iter().map(|p| p.constraints.len()).sum::<usize>();
    let passes = (SOLVED_PLANES / planes).max(PASSES);
    let violated = measure(programs, eps, passes, |_| Order::MostViolated);
    let shuffled = measure(programs, eps, passes, Order::Shuffled);
    println!(
        "{name:<22} {eps:>6.0e} {:>8.1} {:>16.1} {:>16.1} {:>11.0} ns {:>11.0} ns",
        planes as f64 / programs.len() as f64,
        violated.0,
        shuffled.0,
        violated.1,
        shuffled.1,
    );
}

/// Mean tests and mean nanoseconds a program; copying the constraints is in the time.
///
/// Of the passes' times the median counts: each pass has its seed, and seeds differ.
fn measure(
    programs: &[Program],
    eps: f64,
    passes: usize,
    order: impl Fn(u64) -> Order,
) -> (f64, f64) {
    let mut buffer = Vec::new();
    let (mut tests, mut times) = (0, Vec::new());
    for seed in 0..passes as u64 {
        let order = black_box(order(seed));
        let start = Instant::now();
        for program in programs {
            buffer.clear();
            buffer.extend_from_slice(&program.constraints);
            let solved = minimise_counted(black_box(program.objective), &mut buffer, eps, order);
            tests += black_box(solved).1.tests;
        }
        times.push(start.elapsed().as_nanos() as f64 / programs.len() as f64);
    }
    times.sort_by(f64::total_cmp);
    (tests as f64 / (passes * programs.len()) as f64, times[times.len() / 2])
}
