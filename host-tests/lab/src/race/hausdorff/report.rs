//! The table of a race.

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

use super::engine::{Answer, Engine, PRECISION};
use super::side::Side;

/// Without rows.
pub fn table(meshes: &[Subject; 2]) -> Table {
    let [first, second] = meshes
        .each_ref()
        .map(|subject| format!("{}, {} triangles", subject.name, subject.mesh.triangles.len()));
    let columns = [
        "distance",
        "engine",
        "lower",
        "upper",
        "width / diagonal",
        "answer",
        "s",
        "trees, s",
        "time / ours",
        "pieces",
        "closest points",
    ];
    Table::new("hausdorff", format!("== {first} and {second} =="), &columns)
}

/// Adds the rows of a side. The first engine is ours.
pub fn side(table: &mut Table, side: Side, engines: &[Engine], answers: &[Answer], diagonal: f64) {
    let Some(ours) = answers.first() else { return };
    for (engine, answer) in engines.iter().zip(answers) {
        let width = (answer.upper - answer.lower) / diagonal;
        let is_close = width <= PRECISION || matches!(engine, Engine::Cgal(_));
        let verdict = match (answer.overlaps(ours), is_close) {
            (false, _) => "wrong",
            (true, false) => "too wide",
            (true, true) => "agrees",
        };
        let count = |count: Option<usize>| count.map_or(Cell::Empty, Cell::from);
        table.push(row![
            side.name(),
            engine.name(),
            format!("{:.9}", answer.lower),
            format!("{:.9}", answer.upper),
            scientific(width),
            verdict,
            fixed(answer.seconds, 3),
            answer.tree_seconds.map_or(Cell::Empty, |seconds| fixed(seconds, 3)),
            fixed(answer.seconds / ours.seconds, 2),
            count(answer.pieces),
            count(answer.asked),
        ]);
    }
}

/// Says how to read it.
pub fn notes(table: &mut Table, wall: f64, missing: Option<String>) {
    let threads = rayon::current_num_threads();
    table.note(format!(
        "to {PRECISION:.0e} of the diagonal of both; s: the processor's, one thread, box trees \
         included; ours, symmetric, on {threads} threads by the clock: {wall:.3} s"
    ));
    table.note(
        "CGAL's bounds: its answer and the error that it warrants; agrees: the interval meets ours",
    );
    table.note("pieces: of triangles, bounded; ours counts only those that cuts made");
    if let Some(reason) = missing {
        table.note(format!("without CGAL: {reason}"));
    }
}
