//! The target for mesh files.

use meshsweep::mesh::{FORMATS, Unit, read_bytes, repair};
use std::path::PathBuf;

/// Reads a file whose format the first byte tells, scales and repairs it.
pub fn mesh(data: &[u8]) {
    let Some((kind, bytes)) = data.split_first() else { return };
    let name = PathBuf::from("a").with_extension(FORMATS[usize::from(*kind) % FORMATS.len()]);
    // Refusals are right; panics are not.
    let _ =
        read_bytes(&name, bytes.to_vec()).and_then(|raw| raw.in_unit(Unit::In)).and_then(repair);
}
