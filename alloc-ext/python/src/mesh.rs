//! A mesh, or the file of curves, as the caller gives it.

use crate::error::{BuildError, of_build};
use meshsweep::curve::{Polyline, read_csv};
use meshsweep::load::{Source, bytes_of};
use meshsweep::mesh::{RawMesh, Unit};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A file, or vertices and triangles.
#[derive(FromPyObject)]
pub enum Given<'py> {
    File(PathBuf),
    Arrays((PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, u32>)),
}

/// The same for work without the interpreter's lock.
pub enum Taken {
    File(PathBuf),
    Mesh(Box<RawMesh>),
}

impl Given<'_> {
    pub fn taken(self) -> PyResult<Taken> {
        Ok(match self {
            Given::File(file) => Taken::File(file),
            Given::Arrays((vertices, triangles)) => {
                let vertices = vertices.as_slice()?.as_chunks::<3>().0.to_vec();
                let triangles = triangles.as_slice()?.as_chunks::<3>().0.to_vec();
                Taken::Mesh(Box::new(RawMesh::from_f64(vertices, triangles)))
            }
        })
    }
}

impl Taken {
    /// Whether it is a file with points of curves.
    pub fn is_curve(&self) -> bool {
        let Taken::File(file) = self else { return false };
        file.extension().is_some_and(|csv| csv.eq_ignore_ascii_case("csv"))
    }

    /// Reads a mesh, without repairs.
    pub fn read(self, unit: Option<Unit>) -> Result<Source, meshsweep::BuildError> {
        match self {
            Taken::File(file) => Source::of_file(&file, unit),
            Taken::Mesh(mesh) => Source::of(*mesh, unit),
        }
    }

    /// The same, with the exception for Python.
    pub fn source(self, unit: Option<Unit>) -> PyResult<Source> {
        self.read(unit).map_err(|error| of_build(&error))
    }

    /// Reads polylines.
    pub fn polylines(self, is_closed: bool) -> PyResult<Vec<Polyline>> {
        let Taken::File(file) = self else {
            return Err(BuildError::new_err("curves are wanted: the name of their .csv file"));
        };
        let bytes = bytes_of(&file).map_err(|error| of_build(&error))?;
        let refused = |error| of_build(&meshsweep::BuildError::Curve { file, error });
        read_csv(&bytes, is_closed).map_err(refused)
    }
}
