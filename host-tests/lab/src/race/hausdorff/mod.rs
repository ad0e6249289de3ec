//! Hausdorff distances of two meshes: the library's branch and bound, two published ways, and CGAL.
//!
//! ```text
//! samples (closest points) ─ search (largest bound first) ─┬─ bisector (Guéziec 2000)
//!                                                          └─ cascade  (Sacht & Jacobson 2024)
//! cgal    (a child process) ─ report (the table)
//! ```
//! The two ways share nothing with the library but the box tree that names the closest triangle.
//! All have the same precision, so their intervals have to overlap.

mod bisector;
mod cascade;
mod cgal;
mod report;
mod samples;
mod search;

use std::path::Path;
use std::time::Instant;

use glam::DVec3;
use meshsweep::hausdorff::{Direction, Precision, hausdorff};
use meshsweep::mesh::Mesh;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::Table;

use crate::measure::stopwatch::Stopwatch;
use cgal::Cgal;

/// Precision, as a part of the diagonal of the box about both meshes.
const PRECISION: f64 = 1e-6;

/// Rounds, of which the fastest counts. One that takes longer than `LONG` is not repeated.
const ROUNDS: usize = 3;
const LONG: f64 = 20.0;

/// Whose farthest points count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Forward = 0,
    Backward = 1,
    Both = 2,
}

impl Side {
    /// The meshes whose points are asked.
    const fn sources(self) -> &'static [usize] {
        match self {
            Self::Forward => &[0],
            Self::Backward => &[1],
            Self::Both => &[0, 1],
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Forward => "first to second",
            Self::Backward => "second to first",
            Self::Both => "symmetric",
        }
    }
}

/// One answer, and the work of it.
#[derive(Clone, Copy, Debug)]
struct Answer {
    lower: f64,
    upper: f64,
    seconds: f64,
    tree_seconds: Option<f64>,
    pieces: Option<usize>,
    asked: Option<usize>,
}

impl Answer {
    fn overlaps(&self, other: &Self) -> bool {
        self.lower <= other.upper && other.lower <= self.upper
    }
}

/// Who answers.
enum Engine {
    /// The library's search.
    Ours,
    Bisectors,
    Cascade,
    Cgal(Cgal),
}

impl Engine {
    const fn name(&self) -> &'static str {
        match self {
            Self::Ours => "branch and bound (ours)",
            Self::Bisectors => "spiral and bisectors",
            Self::Cascade => "cascading bounds",
            Self::Cgal(_) => "CGAL, bounded error",
        }
    }

    fn ask(&mut self, meshes: &[Subject; 2], side: Side, precision: f64) -> Result<Answer, String> {
        let pair = [&meshes[0].mesh, &meshes[1].mesh];
        let found = match self {
            Self::Ours => return ours(pair, side, precision),
            Self::Cgal(cgal) => {
                let (value, seconds) = cgal.distance(side, precision)?;
                let (lower, upper) = (value - precision, value + precision);
                let (tree_seconds, pieces, asked) = (None, None, None);
                return Ok(Answer { lower, upper, seconds, tree_seconds, pieces, asked });
            }
            Self::Bisectors => {
                timed(|| search::search(&bisector::Bisectors, pair, side, precision))
            }
            Self::Cascade => timed(|| search::search(&cascade::Cascade, pair, side, precision)),
        };
        let (search::Found { lower, upper, pieces, asked, tree_seconds }, seconds) = found?;
        let tree_seconds = Some(tree_seconds);
        let (pieces, asked) = (Some(pieces), Some(asked));
        Ok(Answer { lower, upper, seconds, tree_seconds, pieces, asked })
    }
}

fn timed<T>(run: impl FnOnce() -> Result<T, String>) -> Result<(T, f64), String> {
    let watch = Stopwatch::start();
    let answer = run()?;
    Ok((answer, watch.seconds()))
}

fn ours([first, second]: [&Mesh; 2], side: Side, precision: f64) -> Result<Answer, String> {
    let precision = Precision { relative: 0.0, absolute: precision, at_most: None };
    let (from, to, direction) = match side {
        Side::Forward => (first, second, Direction::Forward),
        Side::Backward => (second, first, Direction::Forward),
        Side::Both => (first, second, Direction::Both),
    };
    let (found, seconds) = timed(|| {
        hausdorff(from, to, direction, &precision, |_, _| ())
            .map_err(|refused| refused.error.to_string())
    })?;
    // The search builds its trees itself: the same ones are built again.
    let (_, tree_seconds) = timed(|| {
        side.sources().iter().try_for_each(|&from| {
            samples::tree([first, second][1 - from], [first, second][from]).map(drop)
        })
    })?;
    let vertices: usize =
        side.sources().iter().map(|&from| [first, second][from].positions.len()).sum();
    Ok(Answer {
        lower: found.lower,
        upper: found.upper,
        seconds,
        tree_seconds: Some(tree_seconds),
        pieces: Some(found.pieces),
        asked: Some(vertices + found.pieces),
    })
}

/// Diagonal of the box about both meshes.
fn diagonal(meshes: &[Subject; 2]) -> f64 {
    let [a, b] = [0, 1].map(|k| meshes[k].bounds.map(|p| DVec3::from_array(p.map(f64::from))));
    (a[1].max(b[1]) - a[0].min(b[0])).length()
}

/// Answers of each side: of each engine the fastest. `pool` has one thread: all work is on the
/// thread whose time is measured.
fn laps(
    pool: &rayon::ThreadPool,
    meshes: &[Subject; 2],
    engines: &mut [Engine],
    side: Side,
    precision: f64,
) -> Result<Vec<Answer>, String> {
    let mut best: Vec<Option<Answer>> = vec![None; engines.len()];
    for _ in 0..ROUNDS {
        for (engine, best) in engines.iter_mut().zip(&mut best) {
            if best.is_some_and(|best| best.seconds > LONG) {
                continue;
            }
            let answer = pool.install(|| engine.ask(meshes, side, precision))?;
            if best.is_none_or(|best| answer.seconds < best.seconds) {
                *best = Some(answer);
            }
        }
    }
    Ok(best.into_iter().flatten().collect())
}

/// Races all on two mesh files.
///
/// # Errors
/// A file is no mesh, or is refused.
pub fn race(first: &Path, second: &Path) -> Result<Table, String> {
    let meshes = [Subject::load_any(first)?, Subject::load_any(second)?];
    let diagonal = diagonal(&meshes);
    let precision = PRECISION * diagonal;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| error.to_string())?;
    let mut engines = vec![Engine::Ours, Engine::Bisectors, Engine::Cascade];
    let missing = match Cgal::new(&meshes) {
        Ok(cgal) => {
            engines.push(Engine::Cgal(cgal));
            None
        }
        Err(reason) => Some(reason),
    };
    let mut table = report::table(&meshes);
    for side in [Side::Forward, Side::Backward, Side::Both] {
        let answers = laps(&pool, &meshes, &mut engines, side, precision)?;
        report::side(&mut table, side, &engines, &answers, diagonal);
    }
    let begun = Instant::now();
    ours([&meshes[0].mesh, &meshes[1].mesh], Side::Both, precision)?;
    report::notes(&mut table, begun.elapsed().as_secs_f64(), missing);
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::{Answer, Engine, Side};
    use meshsweep::mesh::Mesh;
    use meshsweep_host_tests::generate::torus;
    use meshsweep_host_tests::workload::Subject;

    const PRECISE: f64 = 1e-3;

    #[test]
    fn all_ways_agree_on_two_tori() {
        let subject = |minor, sides| {
            let (positions, triangles) = torus(2.0, minor, sides, 9);
            Subject::of("torus", Mesh::new(positions, triangles))
        };
        let meshes = [subject(0.5, 14), subject(0.6, 9)];
        for side in [Side::Forward, Side::Backward, Side::Both] {
            let answers = [Engine::Ours, Engine::Bisectors, Engine::Cascade]
                .map(|mut engine| engine.ask(&meshes, side, PRECISE).expect("answers"));
            let is_close = |a: &Answer| a.upper - a.lower <= PRECISE && a.lower > 0.1;
            assert!(answers.iter().all(is_close), "{side:?} {answers:?}");
            let agrees = |a: &Answer| answers.iter().all(|b| a.overlaps(b));
            assert!(answers.iter().all(agrees), "{side:?} {answers:?}");
        }
    }
}
