//! Reading a blob file and opening it.

use crate::failure::Failure;
use meshsweep::load::bytes_of;
use meshsweep_core::Blob;
use std::path::Path;

/// Reads and opens a blob. Its bytes live as long as the program, which asks one or two blobs and
/// ends.
pub fn open(file: &Path) -> Result<Blob<'static>, Failure> {
    let bytes = bytes_of(file).map_err(|error| Failure::build(file, error))?;
    Blob::open(bytes.leak()).map_err(|error| Failure::open(file, error))
}
