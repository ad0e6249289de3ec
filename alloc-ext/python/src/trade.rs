//! The trade of a mesh, measured.

use crate::build::{named, unit_named};
use crate::error::{BuildError, of_build, of_query};
use crate::mesh::Given;
use crate::pool::aside;
use meshsweep::builder::For;
use meshsweep::trade as of;
use meshsweep::trade::{Board, Points, Trade};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

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
    dials: String,
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

/// What was measured, what was not built and why, and the part of needles.
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

/// Measures the standard settings of a question.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "they are those of Python")]
pub fn trade(
    py: Python<'_>,
    mesh: Given<'_>,
    word: &str,
    at: At,
    count: usize,
    unit: Option<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Measured> {
    let word = named(&[For::Closest, For::Segment], For::name, "for_", word)?;
    let name = |kind: Points| match kind {
        Points::Far => "far",
        Points::Near => "near",
        Points::Path => "path",
    };
    let (kind, own) = match at {
        At::Kind(word) => (Some(named(&Points::ALL, name, "at", &word)?), Vec::new()),
        At::Points(points) => (None, points),
    };
    let (mesh, unit) = (mesh.taken()?, unit_named(unit.as_deref())?);
    let measure = move |stop: &AtomicBool| {
        let raised = Mutex::new(None);
        let tell = |done: usize, of: usize| {
            let told = Python::attach(|py| {
                if stop.load(Ordering::Relaxed) {
                    return Err(PyKeyboardInterrupt::new_err("the trade is not complete"));
                }
                let told = ("measuring", done as f64 / of.max(1) as f64);
                progress.as_ref().map_or(Ok(()), |progress| progress.call1(py, told).map(drop))
            });
            if let Err(error) = told {
                if let Ok(mut raised) = raised.lock() {
                    raised.get_or_insert(error);
                }
                // The measurements have no other way out. No panic is reported.
                resume_unwind(Box::new("stopped"));
            }
        };
        let source = mesh.source(unit)?;
        let loaded = source.repaired().map_err(|error| of_build(&error))?;
        let mesh = &loaded.mesh;
        let points = match (kind, word) {
            (None, _) => own,
            (Some(kind), For::Segment) => of::segments(mesh, kind, count),
            (Some(kind), _) => of::points(mesh, kind, count),
        };
        if points.is_empty() {
            return Err(BuildError::new_err("there is nothing to ask at"));
        }
        let settings = match word {
            For::Segment => of::standard_of_segments(),
            _ => of::standard(of::diagonal(mesh), mesh.triangles.len(), kind),
        };
        let measure = || of::measure(&source, &loaded, &points, &settings, &tell);
        let measured = catch_unwind(AssertUnwindSafe(measure));
        match (raised.into_inner(), measured) {
            (Ok(Some(error)), _) => Err(error),
            (_, Ok(measured)) => measured.map_err(|error| of_query(None, error)),
            (_, Err(panic)) => resume_unwind(panic),
        }
    };
    py.detach(|| aside(measure)).map(|measured| told(&measured))
}

fn told(trade: &Trade) -> Measured {
    let best = of::pareto(&trade.rows);
    let row = |(index, row): (usize, &of::Row)| {
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
            dials: row.setting.dials(),
            build: row.build(),
            error: row.guaranteed.map(|spread| spread.most),
            median_error: row.guaranteed.map(|spread| spread.median),
            undecided: row.undecided,
            instructions: instructions.collect(),
            flash: row.flash,
            scratch: row.scratch,
            nanoseconds: row.nanoseconds,
            is_best: best.contains(&index),
        }
    };
    let missing = trade.missing.iter();
    Measured {
        rows: trade.rows.iter().enumerate().map(row).collect(),
        not_built: missing
            .map(|missing| (missing.recipe.name(), missing.reason.to_string()))
            .collect(),
        needles: trade.needles,
    }
}
