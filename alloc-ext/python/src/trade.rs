//! The trade of a mesh, measured, and the setting of it that meets limits.

use crate::build::{named, unit_named};
use crate::error::{BuildError, in_python, of_build, of_query, refused};
use crate::mesh::Given;
use crate::model::Model;
use crate::pool::{Stop, run_detached};
use meshsweep::builder::{Builder, For};
use meshsweep::curve::Polyline;
use meshsweep::trade as of;
use meshsweep::trade::{Board, Cpu, Limits, Points, Question, Setting, Trade};
use meshsweep_core::QueryError;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;

/// Predicted instructions of a processor.
#[derive(IntoPyObject)]
struct Instructions {
    cpu: &'static str,
    mean: f64,
    most: f64,
    at_most: f64,
    error: f64,
    stack: u32,
}

/// A setting. Its names are those of `TradeRow`.
#[derive(IntoPyObject)]
struct Row {
    structure: String,
    budget: String,
    build: String,
    error: Option<f64>,
    median_error: Option<f64>,
    undecided: usize,
    instructions: Vec<Instructions>,
    flash: usize,
    scratch: usize,
    nanoseconds: f64,
    is_best: bool,
}

/// What was measured, what was not built and why, and the fraction of triangles that are needles.
#[derive(IntoPyObject)]
pub struct Measured {
    rows: Vec<Row>,
    not_built: Vec<(String, String)>,
    needles: f64,
}

/// The caller's own points, or a kind of them.
#[derive(FromPyObject)]
pub enum At {
    Kind(String),
    Points(Vec<[f32; 3]>),
}

/// What is measured: settings of a question to a mesh or curves, at points or segments.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Wanted<'py> {
    mesh: Given<'py>,
    #[pyo3(item("for_"))]
    word: String,
    at: At,
    count: usize,
    unit: Option<String>,
    closed: bool,
    progress: Option<Py<PyAny>>,
}

/// What a device allows; `None` limits nothing.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Device {
    flash: Option<usize>,
    ram: Option<usize>,
    error: Option<f64>,
    rate: Option<f64>,
    /// A processor, and its clock in Hz.
    cpu: Option<(String, f64)>,
}

/// The setting that was chosen, and another one.
#[derive(IntoPyObject)]
pub struct Chosen {
    first: Row,
    second: Option<Row>,
    needles: f64,
}

/// Measures the standard settings of a question.
#[pyfunction]
pub fn trade(py: Python<'_>, wanted: Wanted<'_>) -> PyResult<Measured> {
    let trade = wanted.measured(py)?;
    let (best, missing) = (best(&trade), trade.missing.iter());
    Ok(Measured {
        rows: trade.rows.iter().map(|row| row_of(row, &best)).collect(),
        not_built: missing
            .map(|missing| (missing.recipe.name(), in_python(&missing.reason)))
            .collect(),
        needles: trade.needles,
    })
}

/// The model of the setting that meets a device's limits.
#[pyfunction]
pub fn choose(py: Python<'_>, wanted: Wanted<'_>, device: Device) -> PyResult<(Model, Chosen)> {
    let limits = device.limits()?;
    let mut trade = wanted.measured(py)?;
    // Of curves one of several questions is meant: whether a fence allows a point, if it is one.
    let is_fence = trade.rows.iter().any(|row| row.setting.question == Question::Signed);
    trade.rows.retain(|row| match row.setting.question {
        Question::Signed => true,
        Question::Within(_) => false,
        _ => !is_fence,
    });
    let unmet = |unmet: of::Unmet| refused(&unmet);
    let of::Choice { first, second, built, .. } = limits.choose(&trade).map_err(unmet)?;
    let best = best(&trade);
    let (first, second) = (row_of(&first, &best), second.map(|second| row_of(&second, &best)));
    let chosen = Chosen { first, second, needles: trade.needles };
    Ok((Model::built(built)?, chosen))
}

impl Device {
    fn limits(self) -> PyResult<Limits> {
        let Self { flash, ram, error, rate, cpu } = self;
        let cpu = cpu.map(|(name, hertz)| {
            // A Cortex-M7 runs the instructions of a Cortex-M4F, in no more cycles each.
            let name = named(&["m4f", "m7", "m0"], |name| name, "cpu", &name)?;
            let board = if name == "m0" { Board::CortexM0 } else { Board::CortexM4F };
            PyResult::Ok(Cpu { board, hertz })
        });
        Ok(Limits { flash, ram, error, rate, cpu: cpu.transpose()? })
    }
}

impl Wanted<'_> {
    /// Measures without the interpreter's lock.
    fn measured(self, py: Python<'_>) -> PyResult<Trade> {
        let Self { mesh, word, at, count, unit, closed, progress } = self;
        let word = named(&[For::Closest, For::Segment], For::name, "for_", &word)?;
        let (kind, own) = match at {
            At::Kind(word) => (Some(named(&Points::ALL, Points::name, "at", &word)?), Vec::new()),
            At::Points(points) => (None, points),
        };
        let (mesh, unit) = (mesh.taken()?, unit_named(unit.as_deref())?);
        let measure = move |stop: &Stop| {
            let reporting = (stop, progress.as_ref());
            if mesh.is_curve() {
                if word == For::Segment {
                    return Err(BuildError::new_err("for_: curves are measured for closest"));
                }
                let lines = mesh.polylines(closed)?;
                let points = kind.map_or(own, |kind| of::points_of_curves(&lines, kind, count));
                let settings = settings_of_curves(&lines, kind)?;
                return until_stopped(reporting, &points, |report| {
                    of::measure_curves(&lines, &points, &settings, report)
                });
            }
            let source = mesh.source(unit)?;
            let loaded = source.repaired().map_err(|error| of_build(&error))?;
            let mesh = &loaded.mesh;
            let points = match (kind, word) {
                (None, _) => own,
                (Some(kind), For::Segment) => of::segments(mesh, kind, count),
                (Some(kind), _) => of::points(mesh, kind, count),
            };
            let settings = match word {
                For::Segment => of::standard_of_segments(),
                _ => of::standard(of::diagonal(mesh), mesh.triangles.len(), kind),
            };
            until_stopped(reporting, &points, |report| {
                of::measure(&source, &loaded, &points, &settings, report)
            })
        };
        py.detach(|| run_detached(measure))
    }
}

/// The standard settings of curves: of sides too, if they are a fence.
fn settings_of_curves(lines: &[Polyline], kind: Option<Points>) -> PyResult<Vec<Setting>> {
    // What cannot be built is refused as by `build`.
    let plain = Builder::new().build_curves(lines).map_err(|error| of_build(&error))?;
    let is_fence = plain.blob().curve().is_ok_and(|curve| curve.check_fence().is_ok());
    Ok(of::standard_of_curves(of::diagonal_of_curves(lines), is_fence, kind))
}

/// Gets the number of steps that are done, and that of all steps.
type Report<'a> = dyn Fn(usize, usize) + Sync + 'a;

/// Measures at points, and reports to `progress`. An exception of `progress` ends the work, and so
/// does `stop`.
fn until_stopped(
    (stop, progress): (&Stop, Option<&Py<PyAny>>),
    points: &[[f32; 3]],
    measure: impl FnOnce(&Report<'_>) -> Result<Trade, QueryError>,
) -> PyResult<Trade> {
    if points.is_empty() {
        return Err(BuildError::new_err("there is nothing to ask at"));
    }
    let raised = Mutex::new(None);
    let report = |done: usize, of: usize| {
        let stage = ("measuring", done as f64 / of.max(1) as f64);
        let reported = match progress {
            _ if stop.is_set() => None,
            None => Some(Ok(())),
            Some(progress) => stop.attach(|py| progress.call1(py, stage).map(drop)),
        };
        let stopped = || Err(PyKeyboardInterrupt::new_err("the trade is not complete"));
        let reported = reported.unwrap_or_else(stopped);
        if let Err(error) = reported {
            if let Ok(mut raised) = raised.lock() {
                raised.get_or_insert(error);
            }
            // The measurements return no error, so a panic ends them. `resume_unwind` reports none.
            resume_unwind(Box::new("stopped"));
        }
    };
    let measured = catch_unwind(AssertUnwindSafe(|| measure(&report)));
    match (raised.into_inner(), measured) {
        (Ok(Some(error)), _) => Err(error),
        (_, Ok(measured)) => measured.map_err(|error| of_query(None, error)),
        (_, Err(panic)) => resume_unwind(panic),
    }
}

/// The rows that nothing else beats.
fn best(trade: &Trade) -> Vec<&of::Row> {
    of::pareto(&trade.rows).into_iter().filter_map(|index| trade.rows.get(index)).collect()
}

fn row_of(row: &of::Row, best: &[&of::Row]) -> Row {
    let boards = Board::ALL.iter().zip(row.boards).zip(row.stack);
    let instructions = boards.filter_map(|((board, found), stack)| {
        let found = found?;
        Some(Instructions {
            cpu: board.name(),
            mean: found.mean,
            most: found.most,
            at_most: found.at_most(),
            error: found.error,
            stack,
        })
    });
    Row {
        structure: row.name(),
        budget: row.setting.dials(),
        build: row.build(),
        error: row.guaranteed.map(|spread| spread.most),
        median_error: row.guaranteed.map(|spread| spread.median),
        undecided: row.undecided,
        instructions: instructions.collect(),
        flash: row.flash,
        scratch: row.scratch,
        nanoseconds: row.nanoseconds,
        is_best: best.contains(&row),
    }
}
