//! Reading a blob file and opening it.

use crate::failure::Failure;
use meshsweep_core::{Blob, Bvh};
use std::path::Path;

pub fn read(file: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(file).map_err(|error| Failure::Read { file: file.to_owned(), error })
}

pub fn open<'a>(file: &Path, bytes: &'a [u8]) -> Result<Blob<'a>, Failure> {
    Blob::open(bytes).map_err(|error| Failure::open(file, error))
}

/// The box tree alone.
pub fn open_tree<'a>(file: &Path, bytes: &'a [u8]) -> Result<Bvh<'a>, Failure> {
    Bvh::open(bytes).map_err(|error| Failure::open(file, error))
}
