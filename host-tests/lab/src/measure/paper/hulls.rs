//! Progressive hulls by the builder's loop, and by the paper's (paper 000, Tables 1 and 2).

use glam::DVec3;
use meshsweep::collapse::{Conditions, Engine};
use meshsweep::surface::{VertexBits, store};
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::figures::{HULL_FACES, Model, STRATEGIES};
use crate::measure::stopwatch::Stopwatch;

/// The builder's own conditions and the paper's, by their names in tables.
const LOOPS: [(Conditions, &str); 2] =
    [(Conditions::STANDARD, "ours"), (Conditions::PAPER, "paper's")];

/// A hull of one of [`HULL_FACES`].
struct Run {
    conditions: &'static str,
    /// Of [`STRATEGIES`].
    strategy: usize,
    /// Of [`HULL_FACES`].
    size: usize,
    faces: usize,
    seconds: f64,
    programs: u64,
    /// Of the mesh's volume.
    void: f64,
}

/// Collapses to each size, once with each strategy and each loop.
fn runs(subject: &Subject, sizes: usize) -> Vec<Run> {
    let stored = store(&subject.mesh, VertexBits::Auto);
    let triangles = &subject.mesh.triangles;
    let volume = volume(&stored.positions, triangles);
    let mut runs = Vec::new();
    for (conditions, name) in LOOPS {
        for (strategy, (priority, _)) in STRATEGIES.into_iter().enumerate() {
            let begun = Stopwatch::start();
            let mut engine =
                Engine::new(&stored.positions, triangles, conditions, priority, stored.grid);
            for (size, &faces) in HULL_FACES.iter().enumerate().take(sizes) {
                if faces >= triangles.len() {
                    continue;
                }
                // Whether it got there shows in the faces.
                let _ = engine.run(faces, |_| true);
                runs.push(Run {
                    conditions: name,
                    strategy,
                    size,
                    faces: engine.face_count(),
                    seconds: begun.seconds(),
                    programs: engine.programs(),
                    void: engine.added_volume() / volume,
                });
            }
        }
    }
    runs
}

/// Table 1: from the mesh in memory to 2,000 faces.
pub fn times(subject: &Subject) -> Table {
    let columns = [
        "loop",
        "strategy",
        "faces",
        "programs",
        "programs, of the 1st",
        "seconds",
        "time, of the 1st",
        "paper s",
        "paper, of the 1st",
    ];
    let title = "Hulls of 2,000 faces, beside paper 000, Table 1";
    let mut table = Table::new("hull_times", title, &columns);
    let paper = Model::of(&subject.name);
    let runs = runs(subject, 1);
    for pair in runs.chunks(STRATEGIES.len()) {
        let Some(first) = pair.first() else { continue };
        for run in pair {
            let theirs = |of: fn([u32; 2], usize) -> Cell| {
                paper.map_or(Cell::Empty, |model| of(model.seconds, run.strategy))
            };
            table.push(row![
                run.conditions,
                STRATEGIES[run.strategy].1,
                run.faces,
                run.programs,
                fixed(run.programs as f64 / first.programs.max(1) as f64, 3),
                fixed(run.seconds, 2),
                fixed(run.seconds / first.seconds, 3),
                theirs(|seconds, strategy| seconds[strategy].into()),
                theirs(|[first, second], strategy| {
                    let seconds = if strategy == 0 { first } else { second };
                    fixed(f64::from(seconds) / f64::from(first), 3)
                }),
            ]);
        }
    }
    table.note(
        "seconds of processor time from the mesh in memory; the paper's machine: Pentium III, \
         800 MHz",
    );
    noted(table, subject)
}

/// Table 2: void at 2,000 and 200 faces.
pub fn void(subject: &Subject) -> Table {
    let columns =
        ["loop", "strategy", "asked", "faces", "void %", "paper void %", "of the paper's"];
    let title = "Void of hulls, beside paper 000, Table 2";
    let mut table = Table::new("hull_void", title, &columns);
    let paper = Model::of(&subject.name);
    for run in runs(subject, HULL_FACES.len()) {
        let theirs = paper.map(|model| model.void[run.size][run.strategy]);
        table.push(row![
            run.conditions,
            STRATEGIES[run.strategy].1,
            HULL_FACES[run.size],
            run.faces,
            fixed(100.0 * run.void, 2),
            theirs.map_or(Cell::Empty, |void| fixed(void, 2)),
            theirs.map_or(Cell::Empty, |void| fixed(100.0 * run.void / void, 2)),
        ]);
    }
    noted(table, subject)
}

fn noted(mut table: Table, subject: &Subject) -> Table {
    table.note("the paper's loop: costs evaluated at once, no edge put back, Seidel's order");
    table
        .note("both: valence 12, compactness 0.8, normals within 45 degrees, as the paper's tests");
    let remark = Model::of(&subject.name).and_then(|of| of.remark(subject.mesh.triangles.len()));
    if let Some(remark) = remark {
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
