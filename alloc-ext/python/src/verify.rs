//! Proves a blob from its bytes and what it was built from, as `meshsweep verify` does.

use crate::build::unit_named;
use crate::error::{BuildError, of_build};
use crate::mesh::{Given, Taken};
use crate::model::Model;
use crate::pool::{Stop, run_detached};
use meshsweep::check::{
    Against, FilePolyline, Finding, Outcome, verify as prove, verify_file, verify_repair,
};
use meshsweep::curve::{Polyline, Zone};
use meshsweep::load::{Loaded, Source};
use meshsweep::mesh::{KeyFrame, Unit};
use meshsweep::surface::VertexBits;
use meshsweep_core::internal::format::layout::VertexFormat;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Structure, outcome, claim, and what was counted.
type Found = (&'static str, &'static str, String, Vec<(&'static str, usize)>);

/// Proves all that a blob claims of a mesh, its key frames, or curves.
#[pyfunction]
pub fn verify(
    py: Python<'_>,
    model: Py<Model>,
    mesh: Given<'_>,
    unit: Option<String>,
    frames: Vec<PathBuf>,
) -> PyResult<Vec<Found>> {
    let (mesh, unit) = (mesh.taken()?, unit_named(unit.as_deref())?);
    let prove = move |stop: &Stop| of_any(model.get(), mesh, unit, &frames, stop);
    let findings = py.detach(|| run_detached(prove))?;
    let found = |Finding { structure, outcome, words, counts }| {
        let outcome = match outcome {
            Outcome::Proved => "proved",
            Outcome::Failed => "failed",
            Outcome::NotProved => "not proved",
        };
        (structure, outcome, words, counts)
    };
    Ok(findings.into_iter().map(found).collect())
}

fn of_any(
    model: &Model,
    mesh: Taken,
    unit: Option<Unit>,
    frames: &[PathBuf],
    stop: &Stop,
) -> PyResult<Vec<Finding>> {
    let blob = model.blob();
    if blob.curve().is_ok() {
        let filed =
            mesh.polylines(false)?.into_iter().map(|Polyline { points, is_closed, zone }| {
                FilePolyline {
                    is_closed: is_closed || (points.len() > 2 && points.first() == points.last()),
                    is_exclusion: zone == Zone::Exclusion,
                    points,
                }
            });
        return Ok(prove(model.raw(), Against::Curves(&filed.collect::<Vec<_>>())));
    }
    if mesh.is_curve() {
        return Err(BuildError::new_err("the model is of a mesh, and the file holds curves"));
    }
    let source = mesh.source(unit)?;
    let refused = |error| of_build(&error);
    if let Ok(hull) = blob.deformable_hull() {
        let frames = frames.iter().map(|frame| Source::of_file(frame, unit));
        let deformable = source.deformable(frames, hull.rest().encloses());
        let (loaded, keys) = deformable.map_err(refused)?;
        return of_mesh(model.raw(), &source, &loaded, &keys, stop);
    }
    if !frames.is_empty() {
        return Err(BuildError::new_err("frames: the model has no key frames"));
    }
    let found = of_mesh(model.raw(), &source, &source.repaired().map_err(refused)?, &[], stop)?;
    // A hull on a grid may have moved the mesh before its repair.
    let bits = match blob.hull().map(|_| blob.header().vertex_format) {
        Ok(VertexFormat::Grid16) => VertexBits::Grid16,
        Ok(VertexFormat::Grid24) => VertexBits::Grid24,
        _ => return Ok(found),
    };
    if found.iter().all(|finding| finding.outcome == Outcome::Proved) {
        return Ok(found);
    }
    of_mesh(model.raw(), &source, &source.on_grid(bits).map_err(refused)?, &[], stop)
}

/// The findings of three proofs. Looks for Ctrl-C before each.
///
/// # Errors
/// Ctrl-C.
fn of_mesh(
    bytes: &[u8],
    source: &Source,
    loaded: &Loaded,
    keys: &[KeyFrame],
    stop: &Stop,
) -> PyResult<Vec<Finding>> {
    let goes_on = || match stop.is_set() {
        true => Err(PyKeyboardInterrupt::new_err("the proofs are not complete")),
        false => Ok(()),
    };
    goes_on()?;
    let mut findings = vec![verify_repair(source.raw(), loaded.input())];
    goes_on()?;
    findings.extend(prove(bytes, Against::Mesh(loaded.input(), keys)));
    goes_on()?;
    findings.extend(verify_file(bytes, source.raw()));
    Ok(findings)
}
