//! Exceptions, with the words of the Rust library.

use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

create_exception!(meshsweep, MeshsweepError, PyValueError, "Any refusal of this package.");
create_exception!(
    meshsweep,
    BuildError,
    MeshsweepError,
    "The mesh or an option of the build is refused. The message names the defect and its place."
);
create_exception!(meshsweep, BlobError, MeshsweepError, "The bytes are no blob, or are damaged.");
create_exception!(
    meshsweep,
    QueryError,
    MeshsweepError,
    "A question is refused: a number that is not finite, or out of range."
);
create_exception!(
    meshsweep,
    NotServedError,
    MeshsweepError,
    "The blob was not built for the question. The message names the word of `for_` to add."
);

/// A build that was refused, or that Ctrl-C ended.
pub fn of_build(error: &meshsweep::BuildError) -> PyErr {
    match error {
        meshsweep::BuildError::Cancelled => PyKeyboardInterrupt::new_err(error.to_string()),
        _ => BuildError::new_err(error.to_string()),
    }
}

/// Bytes that do not open.
pub fn of_open(error: meshsweep_core::OpenError) -> PyErr {
    BlobError::new_err(error.to_string())
}

/// A question that is refused, of a row if one is to blame.
pub fn of_query(row: Option<usize>, error: meshsweep_core::QueryError) -> PyErr {
    let text = row.map_or_else(|| error.to_string(), |row| format!("row {row}: {error}"));
    match error {
        meshsweep_core::QueryError::NotServed { .. } => NotServedError::new_err(text),
        _ => QueryError::new_err(text),
    }
}

/// A structure that the blob does not have.
pub fn missing(what: &str, word: &str) -> PyErr {
    NotServedError::new_err(format!(
        "the blob has no {what}: build it with for_=\"{word}\" among its words"
    ))
}
