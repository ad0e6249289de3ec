//! `meshsweep trade` of curves: what each tolerance and budget promises, finds and costs, and the
//! costliest query that a search finds.

use super::measured::{rows_of, said, say_nothing};
use super::table::{self, Shown};
use crate::args::{At, ReadArgs, TradeArgs};
use crate::failure::Failure;
use crate::mesh_file;
use crate::output::Output;
use crate::progress::SharedBar;
use meshsweep::BuildError;
use meshsweep::builder::Builder;
use meshsweep::counted::Counted;
use meshsweep::curve::read_csv;
use meshsweep::distances::Distances;
use meshsweep::number::AtMost;
use meshsweep::trade::{self, How, Question, Row, Trade};
use meshsweep::worst::{Goal, Question as Asked, Subject, Worst};
use meshsweep_core::{Blob, Curve};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::Path;

/// Columns of the search, after those of every table.
const COLUMNS: [(&str, usize); 3] = [("work", 8), ("worst", 8), ("M4F worst", 9)];

/// Random starts of a search.
const STARTS: usize = 8;

/// A measurement of curves, and what it is of.
pub struct OfCurves {
    pub trade: Trade,
    /// Number of points.
    pub points: usize,
    /// Their kind, in words.
    pub kind: String,
    /// Whether the curves bound an area.
    pub is_fence: bool,
    polylines: usize,
    segments: u32,
    /// Of the curves' box.
    diagonal: f64,
}

/// Measures the standard settings.
pub fn measured(
    named: &Path,
    args: &ReadArgs,
    closed: bool,
    at: &At,
    count: usize,
) -> Result<OfCurves, Failure> {
    let file = mesh_file::named(named, args)?;
    let bytes = match mesh_file::stdin_bytes(named)? {
        Some(bytes) => bytes,
        None => std::fs::read(&file).map_err(|error| Failure::read(&file, &error))?,
    };
    let failed = |error| Failure::build(&file, error);
    let polylines = read_csv(&bytes, closed)
        .map_err(|error| failed(BuildError::Curve { file: file.clone(), error }))?;
    let diagonal = trade::diagonal_of_curves(&polylines);
    let (points, made, kind) = match at {
        At::Made(kind) => {
            let points = trade::points_of_curves(&polylines, *kind, count);
            (points, Some(*kind), said(*kind, "curve"))
        }
        At::File(path) => (rows_of::<3>(path)?, None, format!("of {}", path.display())),
    };
    if points.is_empty() {
        return Err(say_nothing(&file));
    }
    // What cannot be built is refused as by `build`.
    let plain = Builder::new().build_curves(&polylines).map_err(|error| {
        failed(match error {
            BuildError::Curve { error, .. } => BuildError::Curve { file: file.clone(), error },
            other => other,
        })
    })?;
    let (segments, is_fence) = match plain.blob().curve() {
        Ok(curve) => (curve.segment_count(), curve.check_fence().is_ok()),
        Err(error) => return Err(Failure::Search { file, error }),
    };
    let settings = trade::standard_of_curves(diagonal, is_fence, made);
    let bar = SharedBar::new("measuring", "steps");
    let progress = |done, of| bar.show(done, of);
    let trade = trade::measure_curves(&polylines, &points, &settings, &progress)
        .map_err(|error| Failure::Search { file, error })?;
    drop(bar);
    let (points, polylines) = (points.len(), polylines.len());
    Ok(OfCurves { trade, points, kind, is_fence, polylines, segments, diagonal })
}

pub fn run(args: &TradeArgs) -> Result<(), Failure> {
    mesh_file::check_format(&[&args.mesh], &args.read)?;
    if args.report.is_some() || args.read.unit.is_some() || args.asks_segments() {
        let what = "--report, --unit and --for segment are for meshes; leave them out";
        return Err(Failure::Usage { what: what.to_owned() });
    }
    args.threads.start();
    let count = args.points as usize;
    let measured = measured(&args.mesh, &args.read, args.closed, &args.at, count)?;
    let OfCurves { trade, points, kind, polylines, segments, diagonal, .. } = &measured;
    let worst: Vec<Option<Worst>> = trade.rows.iter().map(|row| worst(row, trade)).collect();
    let head = format!(
        "{}: {} of {}, diagonal {}; {} {kind}",
        mesh_file::named(&args.mesh, &args.read)?.display(),
        Counted(*segments, "segment"),
        Counted(*polylines, "polyline"),
        AtMost(*diagonal),
        Counted(*points, "point"),
    );
    Output::stdout().finish(|out| {
        if args.json {
            let all = as_json(trade, &worst);
            let json = json!({ "points": points, "kind": kind, "segments": segments, "rows": all });
            serde_json::to_writer_pretty(&mut *out, &json)?;
            return writeln!(out);
        }
        writeln!(out, "{head}")?;
        write(out, trade, &worst)
    })
}

/// The costliest query of a row's question and budget. `None` of searches that are kept, whose cost
/// depends on the query before.
fn worst(row: &Row, trade: &Trade) -> Option<Worst> {
    let setting = &row.setting;
    let question = match (setting.how, setting.question) {
        (How::Coherent, _) | (_, Question::FirstHit) => return None,
        (_, Question::ClosestPoint) => Asked::Closest,
        (_, Question::Within(_)) => Asked::Within,
        (_, Question::Signed) => Asked::Signed,
    };
    let curve: Curve<'_> = Blob::open(trade.blob(setting.recipe)?).ok()?.curve().ok()?;
    let subject = Subject { question, structure: Distances::Curve(curve) };
    subject.worst_of(Goal::Work, setting.budget, STARTS)
}

fn write(out: &mut dyn Write, trade: &Trade, worst: &[Option<Worst>]) -> io::Result<()> {
    let mut columns = table::columns(Shown::Undecided);
    columns.extend(COLUMNS);
    let name =
        |row: &Row| format!("{:<14}  {:<26}", row.setting.recipe.name(), row.setting.dials());
    let headings: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    table::write_line(out, &format!("{:<14}  {:<26}", "structure", "dials"), &columns, &headings)?;
    for (row, worst) in trade.rows.iter().zip(worst) {
        let mut cells = table::cells(row, Shown::Undecided);
        let count = |count: Option<f64>| count.map_or("-".to_owned(), |x| format!("{x:.0}"));
        let total = worst.as_ref().map(|worst| f64::from(worst.found.work.total()));
        let predicted = worst.as_ref().and_then(|worst| worst.found.instructions);
        cells.push(format!("{:.1}", row.work.iter().sum::<f64>()));
        cells.extend([count(total), count(predicted.map(|[m4f, _]| m4f))]);
        table::write_line(out, &name(row), &columns, &cells)?;
    }
    writeln!(
        out,
        "\nerror, median: width of the interval that holds, the largest and the median of these \
         points, in\nthe curves' unit. undecided: verdicts of within, and sides. found: the \
         distance in f64 from all\nsegments less the lower end, and the upper end less that \
         distance, the largest. M4F, M0:\ninstructions of a Cortex-M4F and a Cortex-M0, predicted; \
         - if no cost was fitted. flash: bytes of\nthe blob. scratch: bytes, memory kept between \
         queries among them. stack: bytes of a Cortex-M4F's,\nat most. host ns: of this machine, \
         on one thread. work: capsules and segments that a mean query\nlooks at, and runs that it \
         opens. worst: the same of the costliest query that hill climbing found,\nof within at any \
         distance; a costlier one may exist, but of steps. A kept search has none."
    )?;
    table::write_predicted(out, &trade.rows)
}

fn as_json(trade: &Trade, worst: &[Option<Worst>]) -> Vec<Value> {
    let of = |(row, worst): (&Row, &Option<Worst>)| {
        let mut fields = table::of_row(row);
        fields["worst"] = json!(worst.as_ref().map(|worst| json!({
            "work": worst.found.work.total(),
            "query": worst.query,
            "m4f_instructions": worst.found.instructions.map(|[m4f, _]| m4f),
            "m0_instructions": worst.found.instructions.map(|[_, m0]| m0),
        })));
        fields
    };
    trade.rows.iter().zip(worst).map(of).collect()
}
