//! How far two meshes are from each other, as `meshsweep hausdorff` says.

use crate::build::unit_named;
use crate::error::{in_python, refused};
use crate::mesh::{Given, Taken};
use crate::pool::{Stop, run_detached};
use meshsweep::hausdorff::{Attained, Direction, Ended, Precision, Refused, hausdorff as measure};
use meshsweep::load::{Loaded, require_same_unit};
use meshsweep::mesh::Unit;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::panic::resume_unwind;
use std::path::Path;

/// Bounds of the distance. Names are those of `Hausdorff`.
#[derive(IntoPyObject)]
pub struct Bounds {
    lower: f64,
    upper: f64,
    /// Points of the first and the second mesh, and their triangles.
    ends: Option<[([f64; 3], u32); 2]>,
    is_backward: Option<bool>,
    stopped_by: &'static str,
    pieces: usize,
    unit: Option<&'static str>,
    rounding: [f64; 2],
    warnings: Vec<String>,
}

/// The names of both meshes in messages.
const NAMES: [&str; 2] = ["a", "b"];

/// A refusal that names the mesh.
fn of_mesh(name: &str, error: &impl std::fmt::Display) -> PyErr {
    refused(&format!("{name}: {error}"))
}

/// Bounds the distance of two meshes. Of one direction with `is_one_sided`. The precision is
/// relative and absolute, or a limit.
#[pyfunction]
pub fn hausdorff(
    py: Python<'_>,
    meshes: [Given<'_>; 2],
    is_one_sided: bool,
    precision: (f64, f64, Option<f64>),
    unit: Option<String>,
) -> PyResult<Bounds> {
    let ([a, b], (relative, absolute, at_most)) = (meshes, precision);
    let (meshes, unit) = ([a.taken()?, b.taken()?], unit_named(unit.as_deref())?);
    let direction = if is_one_sided { Direction::Forward } else { Direction::Both };
    let precision = Precision { relative, absolute, at_most };
    py.detach(|| run_detached(move |stop| of_two(meshes, unit, direction, &precision, stop)))
}

/// Loads both meshes and bounds their distance. Ctrl-C sets `stop`, which ends either.
///
/// # Errors
/// A mesh that is refused; meshes of different units; Ctrl-C.
fn of_two(
    meshes: [Taken; 2],
    unit: Option<Unit>,
    direction: Direction,
    precision: &Precision,
    stop: &Stop,
) -> PyResult<Bounds> {
    let load = |(mesh, name): (Taken, &str)| {
        let source = mesh.read(unit).map_err(|error| of_mesh(name, &error))?;
        let loaded = source.repaired().map_err(|error| of_mesh(name, &error))?;
        match stop.is_set() {
            true => Err(PyKeyboardInterrupt::new_err("the distance is not known")),
            false => Ok(loaded),
        }
    };
    let [a, b] = meshes;
    let loaded = [load((a, NAMES[0]))?, load((b, NAMES[1]))?];
    let [first, second] = &loaded;
    require_same_unit([(Path::new("a"), first.unit), (Path::new("b"), second.unit)])
        .map_err(|error| refused(&error))?;
    let mut progress = |_: f64, _: f64| {
        if stop.is_set() {
            // The search returns no error, so a panic ends it. `resume_unwind` reports none, and
            // after Ctrl-C there is no receiver.
            resume_unwind(Box::new("stopped"));
        }
    };
    let found = measure(&first.mesh, &second.mesh, direction, precision, &mut progress)
        .map_err(|Refused { is_second, error }| of_mesh(NAMES[usize::from(is_second)], &error))?;
    let warnings = |(loaded, name): (&Loaded, &str)| {
        let doubts = loaded.report.doubts();
        doubts.map(|said| format!("{name}: {}", in_python(&said))).collect::<Vec<_>>()
    };
    Ok(Bounds {
        lower: found.lower,
        upper: found.upper,
        ends: found.attained.as_ref().map(ends),
        is_backward: found.attained.map(|at| at.is_backward),
        stopped_by: match found.ended {
            Ended::Precision => "precision",
            Ended::Rounding => "rounding",
            Ended::Pieces => "piece_limit",
        },
        pieces: found.pieces,
        unit: first.unit.or(second.unit).map(Unit::symbol),
        rounding: [first.report.rounding, second.report.rounding],
        warnings: loaded.iter().zip(NAMES).flat_map(warnings).collect(),
    })
}

/// The points and triangles of the first and of the second mesh.
fn ends(at: &Attained) -> [([f64; 3], u32); 2] {
    let (from, to) = ((at.from, at.from_triangle), (at.to, at.to_triangle));
    if at.is_backward { [to, from] } else { [from, to] }
}
