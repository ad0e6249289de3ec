//! Time, void and programs of progressive hulls (paper 000, Tables 1 and 2).

use glam::DVec3;
use meshsweep::collapse::{Conditions, Engine};
use meshsweep::surface::{VertexBits, store};
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::paper::{HULL_FACES, Model, STRATEGIES};
use super::stopwatch::Stopwatch;

/// Collapses to 2,000 and then 200 faces, once with each priority.
pub fn table(subject: &Subject) -> Table {
    let mut table = Table::new(
        "hulls",
        "Hulls beside paper 000, Tables 1 and 2 (its machine: Pentium III, 800 MHz)",
        &[
            "strategy",
            "asked",
            "faces",
            "seconds",
            "paper s",
            "void %",
            "paper void %",
            "programs",
            "ns/program",
        ],
    );
    let stored = store(&subject.mesh, VertexBits::Auto);
    let volume = volume(&stored.positions, &subject.mesh.triangles);
    let paper = Model::of(&subject.name);
    for (strategy, (priority, name)) in STRATEGIES.into_iter().enumerate() {
        let begun = Stopwatch::start();
        let conditions = Conditions::default();
        let mut engine = Engine::new(
            &stored.positions,
            &subject.mesh.triangles,
            conditions,
            priority,
            stored.grid,
        );
        for (size, &faces) in HULL_FACES.iter().enumerate() {
            if faces >= subject.mesh.triangles.len() {
                continue;
            }
            // Whether it got there shows in the faces.
            let _ = engine.run(faces, |_| {});
            let seconds = begun.seconds();
            let progress = engine.progress();
            let paper_seconds = paper.filter(|_| size == 0).map(|model| model.seconds[strategy]);
            table.push(row![
                name,
                faces,
                progress.faces,
                fixed(seconds, 2),
                paper_seconds,
                fixed(100.0 * engine.added_volume() / volume, 2),
                paper.map_or(Cell::Empty, |model| fixed(model.void[size][strategy], 2)),
                progress.programs,
                fixed(seconds * 1.0e9 / progress.programs.max(1) as f64, 0),
            ]);
        }
    }
    table.note("seconds of processor time from the mesh in memory; ns/program is that time over the programs: gathering stars and the queue are in it");
    if let Some(remark) = paper.and_then(|model| model.remark(subject.mesh.triangles.len())) {
        table.note(remark);
    }
    table
}

/// Around a vertex of the mesh, so that nothing cancels on a part far from the origin.
fn volume(positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let origin = positions.first().copied().unwrap_or_default();
    let at = |v: u32| positions[v as usize] - origin;
    triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c)))).sum::<f64>() / 6.0
}
