//! The Rust half of the Python package `meshsweep`. Rows of NumPy arrays come in, records go
//! out; `python/meshsweep` gives them names.

mod build;
mod engine;
mod error;
mod frames;
mod hausdorff;
mod hulls;
mod mesh;
mod model;
mod pairs;
mod points;
mod pool;
mod record;
mod rounding;
mod rows;
mod segments;
mod solids;
mod trade;
mod triboxes;
mod verify;
mod views;

use pyo3::prelude::*;

#[pymodule]
mod _meshsweep {
    #[pymodule_export]
    use crate::build::{build, words_of_for};
    #[pymodule_export]
    use crate::error::{BlobError, BuildError, MeshsweepError, NotServedError, QueryError};
    #[pymodule_export]
    use crate::hausdorff::hausdorff;
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::trade::{choose, trade};
    #[pymodule_export]
    use crate::verify::verify;
}
