//! The blobs that the images carry.

use std::fs;
use std::path::PathBuf;

use crate::boards::Flash;
use crate::stand_in;
use crate::workspace;

/// Writes the blob for flash of a size; its path.
pub fn make(flash: Flash) -> Result<PathBuf, String> {
    let (name, content) = match flash {
        Flash::Small => ("small", stand_in::torus(4, 2)),
        Flash::Large => ("large", stand_in::torus(5, 3)),
    };
    let folder = workspace::target().join("blobs");
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let path = folder.join(name).with_extension("msw");
    // Written only if it changed, so that cargo does not build again.
    if fs::read(&path).ok().as_ref() != Some(&content) {
        fs::write(&path, &content).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    Ok(path)
}
