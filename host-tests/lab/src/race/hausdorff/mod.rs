//! Hausdorff distances of two meshes: the library's branch and bound, Guéziec's way, and CGAL.
//!
//! ```text
//! samples (closest points) ─ bisector (bounds) ─ search (largest bound first)
//! cgal    (a child process) ─ engine (all of them, the library) ─ report (the table)
//! ```
//! Guéziec's way shares nothing with the library but the box tree that names the closest triangle.
//! All have the same precision, so their intervals have to overlap.

mod bisector;
mod cgal;
mod engine;
mod report;
mod samples;
mod search;
mod side;

use std::path::Path;
use std::time::Instant;

use glam::DVec3;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::Table;

use cgal::Cgal;
use engine::{Engine, PRECISION, ours};
use side::Side;

use super::on_one_thread;
use crate::measure::stopwatch::rounds;

/// Diagonal of the box about both meshes.
fn diagonal(meshes: &[Subject; 2]) -> f64 {
    let [a, b] = [0, 1].map(|k| meshes[k].bounds.map(|p| DVec3::from_array(p.map(f64::from))));
    (a[1].max(b[1]) - a[0].min(b[0])).length()
}

/// Races all on two mesh files.
///
/// # Errors
/// A file is no mesh, or is refused.
pub fn race(first: &Path, second: &Path) -> Result<Table, String> {
    let meshes = [Subject::load_any(first)?, Subject::load_any(second)?];
    let diagonal = diagonal(&meshes);
    let precision = PRECISION * diagonal;
    let mut engines = vec![Engine::Ours, Engine::Bisectors];
    let missing = Cgal::new(&meshes).map(|cgal| engines.push(Engine::Cgal(cgal))).err();
    let mut table = report::table(&meshes);
    for side in [Side::Forward, Side::Backward, Side::Both] {
        let ask = |engine: &mut Engine| on_one_thread(|| engine.ask(&meshes, side, precision));
        let answers = rounds(&mut engines, ask, |answer| answer.seconds)?;
        report::side(&mut table, side, &engines, &answers, diagonal);
    }
    let begun = Instant::now();
    ours([&meshes[0].mesh, &meshes[1].mesh], Side::Both, precision)?;
    report::notes(&mut table, begun.elapsed().as_secs_f64(), missing);
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::engine::{Answer, Engine};
    use super::side::Side;
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
            let answers = [Engine::Ours, Engine::Bisectors]
                .map(|mut engine| engine.ask(&meshes, side, PRECISE).expect("answers"));
            let is_close = |a: &Answer| a.upper - a.lower <= PRECISE && a.lower > 0.1;
            assert!(answers.iter().all(is_close), "{side:?} {answers:?}");
            let agrees = |a: &Answer| answers.iter().all(|b| a.overlaps(b));
            assert!(answers.iter().all(agrees), "{side:?} {answers:?}");
        }
    }
}
