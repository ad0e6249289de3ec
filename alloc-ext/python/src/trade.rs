//! The trade of a mesh or of curves, measured.

use crate::build::{named, unit_named};
use crate::error::{BuildError, of_build, of_query};
use crate::mesh::{Given, Taken};
use crate::pool::on_all_cores;
use meshsweep::builder::{Builder, For};
use meshsweep::curve::Polyline;
use meshsweep::mesh::Unit;
use meshsweep::trade as of;
use meshsweep::trade::{Board, Points, Question, Trade, pareto};
use pyo3::prelude::*;
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

/// Where to ask.
#[derive(FromPyObject)]
pub enum At {
    Word(String),
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
    closed: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Measured> {
    let question = match named(&[For::Closest, For::Segment], For::name, "for_", word)? {
        For::Segment => Question::FirstHit,
        _ => Question::ClosestPoint,
    };
    let kind = |kind: Points| match kind {
        Points::Far => "far",
        Points::Near => "near",
        Points::Path => "path",
    };
    let places = match at {
        At::Word(word) => Places::Made(named(&Points::ALL, kind, "at", &word)?, count),
        At::Points(points) => Places::Given(points),
    };
    let (mesh, unit) = (mesh.taken()?, unit_named(unit.as_deref())?);
    let raised = Mutex::new(None);
    let tell = |done: usize, of: usize| {
        let Some(progress) = &progress else { return };
        Python::attach(|py| {
            let part = done as f64 / of.max(1) as f64;
            if let (Err(error), Ok(mut raised)) =
                (progress.call1(py, ("measuring", part)), raised.lock())
            {
                raised.get_or_insert(error);
            }
        });
    };
    let measured = py.detach(|| {
        on_all_cores(|| match mesh.is_curve() {
            true => of_curves(mesh.polylines(closed)?.as_slice(), question, places, &tell),
            false => of_mesh(mesh, unit, question, places, &tell),
        })
    })??;
    match raised.into_inner() {
        Ok(Some(error)) => Err(error),
        _ => Ok(told(&measured)),
    }
}

/// Points of a kind, so many, or the caller's own.
enum Places {
    Made(Points, usize),
    Given(Vec<[f32; 3]>),
}

impl Places {
    fn kind(&self) -> Option<Points> {
        match self {
            Places::Made(kind, _) => Some(*kind),
            Places::Given(_) => None,
        }
    }

    fn points(self, make: impl FnOnce(Points, usize) -> Vec<[f32; 3]>) -> PyResult<Vec<[f32; 3]>> {
        let points = match self {
            Places::Made(kind, count) => make(kind, count),
            Places::Given(points) => points,
        };
        match points.is_empty() {
            true => Err(BuildError::new_err("there is nothing to ask at")),
            false => Ok(points),
        }
    }
}

fn of_mesh(
    mesh: Taken,
    unit: Option<Unit>,
    question: Question,
    places: Places,
    tell: &(dyn Fn(usize, usize) + Sync),
) -> PyResult<Trade> {
    let source = mesh.source(unit)?;
    let loaded = source.repaired().map_err(|error| of_build(&error))?;
    let (mesh, kind) = (&loaded.mesh, places.kind());
    let (points, settings) = match question {
        Question::FirstHit => (
            places.points(|kind, count| of::segments(mesh, kind, count))?,
            of::standard_of_segments(),
        ),
        _ => (
            places.points(|kind, count| of::points(mesh, kind, count))?,
            of::standard(of::diagonal(mesh), mesh.triangles.len(), kind),
        ),
    };
    of::measure(&source, &loaded, &points, &settings, tell).map_err(|error| of_query(None, error))
}

fn of_curves(
    polylines: &[Polyline],
    question: Question,
    places: Places,
    tell: &(dyn Fn(usize, usize) + Sync),
) -> PyResult<Trade> {
    if question == Question::FirstHit {
        return Err(BuildError::new_err("for_: segments are asked of meshes, not of curves"));
    }
    let kind = places.kind();
    let points = places.points(|kind, count| of::points_of_curves(polylines, kind, count))?;
    let plain = Builder::new().build_curves(polylines).map_err(|error| of_build(&error))?;
    let is_fence = plain.blob().curve().is_ok_and(|curve| curve.check_fence().is_ok());
    let diagonal = of::diagonal_of_curves(polylines);
    let settings = of::standard_of_curves(diagonal, is_fence, kind);
    of::measure_curves(polylines, &points, &settings, tell).map_err(|error| of_query(None, error))
}

fn told(trade: &Trade) -> Measured {
    let best = pareto(&trade.rows);
    let row = |(index, row): (usize, &of::Row)| {
        let boards = Board::ALL.iter().zip(row.boards);
        let instructions = boards.filter_map(|(board, found)| {
            let found = found?;
            Some(Instructions {
                cpu: board.name(),
                mean: found.mean,
                most: found.most,
                at_most: found.at_most(),
                error: found.error,
                stack: found.stack,
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
