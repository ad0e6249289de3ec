//! Hausdorff distances of two meshes: the library's branch and bound, and CGAL.
//!
//! ```text
//! cgal (a child process) ─ engine (CGAL, the library) ─ report (the table)
//! ```
//! Both have the same precision, so their intervals have to overlap.

mod cgal;
mod engine;
mod report;
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
    let mut engines = vec![Engine::Ours];
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
