//! From a file or arrays to a model. Options have the names and defaults of [`Builder`].

use crate::error::{BuildError, of_build};
use crate::mesh::{Given, Taken};
use crate::model::Model;
use crate::pool::on_all_cores_until_stopped;
use meshsweep::Builder;
use meshsweep::builder::{Built, For, SdfKind, SdfLayout, Stage};
use meshsweep::mesh::Unit;
use meshsweep::surface::VertexBits;
use meshsweep::tribox::Measure;
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// Options of a build; `None` is the default.
#[derive(Debug, Default, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Options {
    #[pyo3(item("for_"))]
    serve: Vec<String>,
    unit: Option<String>,
    vertex_bits: Option<u32>,
    base_faces: Option<u32>,
    triboxes: Option<u32>,
    tribox_error: Option<f64>,
    orient: Option<String>,
    extrema: bool,
    tight_faces: Option<Vec<u32>>,
    slack: Option<f64>,
    void_percent: Option<f64>,
    margin: Option<f64>,
    effort: Option<f64>,
    tight_for: Vec<String>,
    sdf_bytes: Option<u32>,
    sdf_error: Option<f64>,
    sdf_rel: Option<f64>,
    sdf_kind: Option<String>,
    sdf_layout: Option<String>,
    sdf_margin: Option<f64>,
    frames: Vec<PathBuf>,
    closed: bool,
}

/// The one of `all` with this name.
pub fn named<T: Copy>(
    all: &[T],
    name: fn(T) -> &'static str,
    option: &str,
    word: &str,
) -> PyResult<T> {
    all.iter().copied().find(|&one| name(one) == word).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|&one| name(one)).collect();
        BuildError::new_err(format!("{option}: no {word:?}; there are {}", names.join(", ")))
    })
}

/// The unit with this symbol, if there is one.
pub fn unit_named(word: Option<&str>) -> PyResult<Option<Unit>> {
    word.map(|word| named(&Unit::ALL, Unit::symbol, "unit", word)).transpose()
}

impl Options {
    fn builder<'a>(&self) -> PyResult<Builder<'a>> {
        let bits = match self.vertex_bits {
            None => VertexBits::Auto,
            Some(16) => VertexBits::Grid16,
            Some(24) => VertexBits::Grid24,
            Some(32) => VertexBits::F32,
            Some(other) => {
                let text = format!("vertex_bits: {other} is none of 16, 24 and 32");
                return Err(BuildError::new_err(text));
            }
        };
        let mut builder = Builder::new().vertex_bits(bits).closed(self.closed);
        for word in &self.serve {
            builder = builder.serve(named(&For::ALL, For::name, "for_", word)?);
        }
        if let Some(unit) = unit_named(self.unit.as_deref())? {
            builder = builder.unit(unit);
        }
        if let Some(word) = &self.orient {
            let measures = [Measure::Volume, Measure::Area];
            builder = builder.orient(named(&measures, Measure::name, "orient", word)?);
        }
        if let Some(word) = &self.sdf_kind {
            builder = builder.sdf_kind(named(&SdfKind::ALL, SdfKind::name, "sdf_kind", word)?);
        }
        if let Some(word) = &self.sdf_layout {
            let layouts = &SdfLayout::ALL;
            builder = builder.sdf_layout(named(layouts, SdfLayout::name, "sdf_layout", word)?);
        }
        if !self.tight_for.is_empty() {
            let questions = [For::Closest, For::Segment];
            for word in &self.tight_for {
                named(&questions, For::name, "tight_for", word)?;
            }
            let [closest, segment] =
                questions.map(|of| self.tight_for.iter().any(|word| word == of.name()));
            builder = builder.tight_for(closest, segment);
        }
        if let Some(faces) = &self.tight_faces {
            builder = builder.tight_faces(faces);
        }
        for frame in &self.frames {
            builder = builder.frame_file(frame);
        }
        Ok(builder
            .base_faces(self.base_faces)
            .triboxes(self.triboxes)
            .tribox_error(self.tribox_error)
            .slack(self.slack)
            .void_percent(self.void_percent)
            .margin(self.margin)
            .effort(self.effort)
            .extrema(self.extrema)
            .sdf_bytes(self.sdf_bytes)
            .sdf_error(self.sdf_error)
            .sdf_relative(self.sdf_rel)
            .sdf_margin(self.sdf_margin))
    }

    /// Builds without the interpreter's lock. `progress` gets the name of the stage and the
    /// fraction of the work that is done. An exception of it, or Ctrl-C, ends the build.
    fn build(
        &self,
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
        run: impl FnOnce(Builder<'_>) -> Result<Built, meshsweep::BuildError> + Send,
    ) -> PyResult<Model> {
        let (mut raised, stop) = (None, AtomicBool::new(false));
        let work = || {
            let report = |stage: Stage, fraction| {
                if stop.load(Ordering::Relaxed) {
                    return ControlFlow::Break(());
                }
                let reported = Python::attach(|py| {
                    py.check_signals()?;
                    let call = |to: &Py<PyAny>| to.call1(py, (stage.name(), fraction)).map(drop);
                    progress.as_ref().map_or(Ok(()), call)
                });
                match reported {
                    Ok(()) => ControlFlow::Continue(()),
                    Err(error) => {
                        raised = Some(error);
                        ControlFlow::Break(())
                    }
                }
            };
            self.builder().map(|builder| run(builder.on_progress(report)))
        };
        let built = py.detach(|| on_all_cores_until_stopped(&stop, work))??;
        match (raised, built) {
            (Some(error), Err(_)) => Err(error),
            (_, built) => Model::built(built.map_err(|error| of_build(&error))?),
        }
    }
}

/// The words of `for_`.
#[pyfunction]
pub fn words_of_for() -> Vec<&'static str> {
    For::ALL.map(For::name).to_vec()
}

/// Builds the model of a mesh, or of a CSV file of curves.
#[pyfunction]
pub fn build(
    py: Python<'_>,
    mesh: Given<'_>,
    options: Options,
    progress: Option<Py<PyAny>>,
) -> PyResult<Model> {
    let mesh = mesh.taken()?;
    options.build(py, progress, |builder| match mesh {
        Taken::File(file) => builder.build_file(file),
        Taken::Mesh(mesh) => builder.build(*mesh),
    })
}
