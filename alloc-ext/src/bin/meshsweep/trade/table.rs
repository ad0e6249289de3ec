//! Rows of a measurement as text and as JSON.

use super::measured::Measured;
use crate::mesh_report::write_rounding;
use meshsweep::counted::Counted;
use meshsweep::load::Loaded;
use meshsweep::number::AtMost;
use meshsweep::trade::{
    Board, COMB_OF_NEEDLES, Instructions, MANY_NEEDLES, Question, Row, Spread, pareto,
};
use meshsweep_core::SdfLayout;
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::Path;

/// Headings of the columns after structure and dials, each with its width.
const COLUMNS: [(&str, usize); 11] = [
    ("error", 11),
    ("median", 11),
    ("found low", 11),
    ("found up", 11),
    ("M4F mean", 9),
    ("M4F most", 9),
    ("M0 mean", 9),
    ("flash", 8),
    ("scratch", 7),
    ("stack", 5),
    ("host ns", 8),
];

/// The column of segments and of curves, and its place among the columns.
const UNDECIDED: (usize, (&str, usize)) = (2, ("undecided", 9));

/// Whether a table has a column of what is undecided.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shown {
    Undecided,
    Plain,
}

impl Shown {
    fn of(question: Question) -> Self {
        if question == Question::FirstHit { Self::Undecided } else { Self::Plain }
    }
}

/// Headings of a table.
pub(super) fn columns(shown: Shown) -> Vec<(&'static str, usize)> {
    let mut columns = COLUMNS.to_vec();
    if shown == Shown::Undecided {
        columns.insert(UNDECIDED.0, UNDECIDED.1);
    }
    columns
}

pub fn write(
    out: &mut dyn Write,
    mesh: &Path,
    loaded: &Loaded,
    measured: &Measured,
) -> io::Result<()> {
    let Measured { trade, diagonal, question, points, kind } = measured;
    writeln!(
        out,
        "{}: {}, diagonal {}; {} {kind}",
        mesh.display(),
        Counted(loaded.mesh.triangles.len(), "triangle"),
        AtMost(*diagonal),
        Counted(*points, noun(*question)),
    )?;
    write_rounding(out, mesh, &loaded.report)?;
    loaded.unit_note().map_or(Ok(()), |note| writeln!(out, "  {note}"))?;
    let best = pareto(&trade.rows);
    let of =
        |rows: &mut dyn Iterator<Item = &Row>| rows.map(|row| row.name().len()).max().unwrap_or(0);
    let width = of(&mut trade.rows.iter());
    writeln!(
        out,
        "\nnothing else has as small an error, as few instructions of a Cortex-M4F and as little \
         flash"
    )?;
    let shown = Shown::of(*question);
    let columns = columns(shown);
    write_rows(out, best.iter().filter_map(|&i| trade.rows.get(i)), &columns, width)?;
    writeln!(out, "\nall")?;
    write_rows(out, trade.rows.iter(), &columns, width)?;
    if !trade.missing.is_empty() {
        writeln!(out, "\nnot built")?;
    }
    for missing in &trade.missing {
        let reason = missing.reason.to_string();
        let reason: Vec<&str> = reason.lines().map(str::trim).collect();
        writeln!(out, "  {}: {}", missing.recipe.name(), reason.join("; "))?;
    }
    write_notes(out, *question, &trade.rows)?;
    write_needles(out, "", trade.needles)
}

fn write_rows<'r>(
    out: &mut dyn Write,
    rows: impl Iterator<Item = &'r Row>,
    columns: &[(&str, usize)],
    width: usize,
) -> io::Result<()> {
    let named = |name: &str, dials: &str| format!("{name:<width$}  {dials:<22}");
    let headings: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    write_line(out, &named("structure", "dials"), columns, &headings)?;
    rows.into_iter().try_for_each(|row| {
        let name = named(&row.name(), &dials(row));
        write_line(out, &name, columns, &cells(row, Shown::of(row.setting.question)))
    })
}

/// The dials of a row, and of how many points the field is enough.
fn dials(row: &Row) -> String {
    let dials = row.setting.dials();
    match row.by_field {
        Some(part) => format!("{dials}: alone {:.1} %", 100.0 * part),
        None => dials,
    }
}

/// A line of a table: a name, and a cell under each heading.
pub(super) fn write_line(
    out: &mut dyn Write,
    name: &str,
    columns: &[(&str, usize)],
    cells: &[impl AsRef<str>],
) -> io::Result<()> {
    write!(out, "  {name}")?;
    for (cell, (_, width)) in cells.iter().zip(columns) {
        write!(out, " {:>width$}", cell.as_ref())?;
    }
    writeln!(out)
}

pub(super) fn cells(row: &Row, shown: Shown) -> Vec<String> {
    let most = |spread: Option<Spread>| {
        spread.map_or("-".to_owned(), |spread| AtMost(spread.most).to_string())
    };
    let median = |spread: Option<Spread>| {
        spread.map_or("-".to_owned(), |spread| AtMost(spread.median).to_string())
    };
    let [m4f, m0] = row.boards;
    let count = |count: Option<f64>| count.map_or("-".to_owned(), |x| format!("{x:.0}"));
    let mut cells = vec![
        most(row.guaranteed),
        median(row.guaranteed),
        // A verdict has no interval.
        most(Some(row.found_lower).filter(|_| !is_verdict(row))),
        most(row.found_upper),
        count(m4f.map(|board| board.mean)),
        count(m4f.map(|board| board.most)),
        count(m0.map(|board| board.mean)),
        row.flash.to_string(),
        row.scratch.to_string(),
        row.stack[0].to_string(),
        count(Some(row.nanoseconds)),
    ];
    if shown == Shown::Undecided {
        cells.insert(UNDECIDED.0, row.undecided.to_string());
    }
    cells
}

/// Whether the answers of a row are verdicts, without intervals.
fn is_verdict(row: &Row) -> bool {
    matches!(row.setting.question, Question::Within(_))
}

/// What a place of a question is.
const fn noun(question: Question) -> &'static str {
    match question {
        Question::FirstHit => "segment",
        _ => "point",
    }
}

fn write_notes(out: &mut dyn Write, question: Question, rows: &[Row]) -> io::Result<()> {
    let (width, found) = match question {
        Question::FirstHit => (
            "error, median: width of the interval of a segment's free length, which is how far it \
             goes before it\nmeets the mesh, the largest and the median of these segments, in the \
             mesh's unit; of other segments\nit may be wider, and holds. undecided: segments that \
             are proved neither clear nor to meet the mesh.\n",
            "found: the free length in f64 less the lower end, and the upper\nend less it, the \
             largest.",
        ),
        _ => (
            "error, median: width of the interval that holds, the largest and the median of these \
             points, in\nthe mesh's unit; at other points it may be wider, and holds. ",
            "found: the distance in f64 less the\nlower end, and the upper end less that distance, \
             the largest.",
        ),
    };
    writeln!(
        out,
        "\n{width}{found}\nM4F, M0: instructions of a Cortex-M4F and a Cortex-M0, predicted; most \
         is of these {}s,\nmeshsweep worst finds more; of a distance field it is of any point. \
         flash: bytes of the blob.\nscratch: bytes, memory kept between queries among them. stack: \
         bytes of a Cortex-M4F's, at most.\nhost ns: of this machine, on one thread.",
        noun(question)
    )?;
    write_predicted(out, rows)
}

/// Says how well instructions are predicted.
pub(super) fn write_predicted(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    let mut said: Vec<String> = Vec::new();
    let mut not_counted: Vec<String> = Vec::new();
    let tell = |all: &mut Vec<String>, line: String| {
        if !all.contains(&line) {
            all.push(line);
        }
    };
    for row in rows {
        let setting = row.setting;
        for (board, found) in Board::ALL.iter().zip(row.boards) {
            let Some(found) = found else { continue };
            let line = format!(
                "  {}, {}: {:.0} % (median {:.0} %)",
                board.name(),
                row.search.name(),
                100.0 * found.error,
                100.0 * found.typical
            );
            tell(&mut said, line);
        }
        if !setting.is_counted() {
            let is_of_scratch = setting.entries.is_some();
            let kind = if is_of_scratch { setting.to_string() } else { setting.recipe.name() };
            tell(&mut not_counted, kind);
        }
    }
    said.sort();
    if !said.is_empty() {
        writeln!(out, "a mean of the fit's meshes and of its tests was predicted within")?;
    }
    said.iter().try_for_each(|line| writeln!(out, "{line}"))?;
    if not_counted.is_empty() {
        return Ok(());
    }
    writeln!(out, "of unknown error, as none of their kind was counted")?;
    not_counted.iter().try_for_each(|kind| writeln!(out, "  {kind}"))
}

/// Says that instructions of a mesh of many needles are doubtful.
pub(super) fn write_needles(out: &mut dyn Write, indent: &str, part: f64) -> io::Result<()> {
    if part < MANY_NEEDLES {
        return Ok(());
    }
    let [m4f, m0] = COMB_OF_NEEDLES;
    writeln!(
        out,
        "{indent}{:.0} % of the triangles are needles, fifty times as long as high: they take more \
         instructions than\n{indent}predicted, of a comb of needles {m4f} times as many on a \
         Cortex-M4F and {m0} times on a Cortex-M0",
        100.0 * part
    )
}

pub fn write_json(out: &mut dyn Write, loaded: &Loaded, measured: &Measured) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, &as_json(loaded, measured))?;
    writeln!(out)
}

/// All rows, and the points that they were measured at.
pub fn as_json(loaded: &Loaded, measured: &Measured) -> Value {
    let Measured { trade, diagonal, question, points, kind } = measured;
    let best = pareto(&trade.rows);
    let of = |(i, row): (usize, &Row)| {
        let mut fields = of_row(row);
        fields["pareto"] = json!(best.contains(&i));
        fields
    };
    let rows: Vec<Value> = trade.rows.iter().enumerate().map(of).collect();
    let missing = trade.missing.iter().map(|missing| {
        json!({ "structure": missing.recipe.name(), "reason": missing.reason.to_string() })
    });
    json!({
        "question": noun(*question),
        "points": points,
        "kind": kind,
        "diagonal": diagonal,
        "rounding": loaded.report.rounding,
        "pareto": best,
        "needles": trade.needles,
        "rows": rows,
        "not_built": missing.collect::<Vec<_>>(),
    })
}

/// A row.
pub fn of_row(row: &Row) -> Value {
    let spread = |spread: Spread| json!({ "most": spread.most, "median": spread.median });
    let [nodes, triangles, exact, splits] = row.work;
    let work = json!({ "nodes": nodes, "triangles": triangles, "exact": exact, "splits": splits });
    json!({
        "structure": row.name(),
        "layout": row.layout.map(SdfLayout::name),
        "build": row.build(),
        "dials": row.setting.dials(),
        "guaranteed": row.guaranteed.map(spread),
        "found_lower": (!is_verdict(row)).then(|| spread(row.found_lower)),
        "found_upper": row.found_upper.map(spread),
        "undecided": (row.setting.question != Question::ClosestPoint).then_some(row.undecided),
        "instructions": of_boards(row.boards, row.stack),
        "flash": row.flash,
        "scratch_bytes": row.scratch,
        "host_ns": row.nanoseconds,
        "work": work,
        "by_field": row.by_field,
    })
}

/// Instructions of the boards, in the order of [`Board::ALL`].
pub(super) fn of_boards(boards: [Option<Instructions>; 2], stack: [u32; 2]) -> Value {
    let all = Board::ALL.iter().zip(boards).zip(stack);
    let boards = all.filter_map(|((board, found), stack)| {
        let found = found?;
        Some(json!({
            "cpu": board.name(),
            "mean": found.mean,
            "most": found.most,
            "at_most": found.at_most(),
            "error": found.error,
            "typical": found.typical,
            "stack": stack,
        }))
    });
    Value::Array(boards.collect())
}
