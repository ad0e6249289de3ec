//! Exceptions, with the words of the Rust library where they are those of Python.

use meshsweep::builder::{For, SdfKind};
use meshsweep_core::QueryError as Refused;
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

/// Options of the program that have another name here; `-` is `_` in all.
const OPTIONS: [(&str, &str); 7] = [
    ("for", "for_"),
    ("base", "base_faces"),
    ("tight", "tight_faces"),
    ("void", "void_percent"),
    ("sdf", "sdf_bytes"),
    ("extrema", "extrema=True"),
    ("closed", "closed=True"),
];

/// A message with the names of this package in place of those of the program.
pub fn in_python(message: &impl ToString) -> String {
    let message =
        message.to_string().replace("(memory)", "the mesh").replace("--sdf bytes", "--sdf");
    let mut parts = message.split("--");
    let mut said = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        if !said.is_empty() && !said.ends_with([' ', '\n', '(', '"']) {
            // Of the name of a file.
            said.push_str("--");
            said.push_str(part);
            continue;
        }
        let end = part.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(part.len());
        let (option, rest) = part.split_at(end);
        let name = OPTIONS.iter().find(|(of_program, _)| *of_program == option);
        said.push_str(
            &name.map_or_else(|| option.replace('-', "_"), |(_, name)| (*name).to_owned()),
        );
        let value = rest.strip_prefix(' ').unwrap_or_default();
        let end = value.find(|c: char| !c.is_ascii_lowercase() && c != ',').unwrap_or(value.len());
        let value = value[..end].trim_end_matches(',');
        let is_value = match option {
            "for" => value.split(',').all(|word| For::ALL.iter().any(|one| one.name() == word)),
            "sdf-kind" => SdfKind::ALL.iter().any(|kind| kind.name() == value),
            _ => false,
        };
        if is_value {
            said.push_str(&format!("=\"{value}\"{}", &rest[1 + value.len()..]));
        } else {
            said.push_str(rest);
        }
    }
    said
}

/// A build that was refused, or that Ctrl-C ended.
pub fn of_build(error: &meshsweep::BuildError) -> PyErr {
    match error {
        meshsweep::BuildError::Cancelled => PyKeyboardInterrupt::new_err(error.to_string()),
        _ => refused(error),
    }
}

/// A mesh, an option or a blob to cut that is refused.
pub fn refused(error: &impl ToString) -> PyErr {
    BuildError::new_err(in_python(error))
}

/// Bytes that do not open.
pub fn of_open(error: meshsweep_core::OpenError) -> PyErr {
    BlobError::new_err(error.to_string())
}

/// A question that is refused, of a row if one is to blame.
pub fn of_query(row: Option<usize>, error: Refused) -> PyErr {
    let text = match error {
        Refused::NotRigid => "the pose's matrix is no rotation, or it is a mirror".to_owned(),
        Refused::OutOfDomain => {
            "a point, a segment's end or a model is too far away: clip segments first".to_owned()
        }
        _ => in_python(&error),
    };
    let text = row.map_or_else(|| text.clone(), |row| format!("row {row}: {text}"));
    match error {
        Refused::NotServed { .. } => NotServedError::new_err(text),
        _ => QueryError::new_err(text),
    }
}

/// A structure that the blob does not have.
pub fn missing(what: &str, word: &str) -> PyErr {
    NotServedError::new_err(format!(
        "the blob has no {what}: build it with for_=\"{word}\" among its words"
    ))
}
