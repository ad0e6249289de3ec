//! Where things are.

use std::env;
use std::path::{Path, PathBuf};

/// The repository's root.
pub fn root() -> PathBuf {
    // This crate's folder is `host-tests/xtask`.
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_path_buf()
}

/// The firmware's workspace.
pub fn firmware() -> PathBuf {
    root().join("host-tests/firmware")
}

/// Where builds go.
pub fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// Where tools are kept that are fetched once for all checkouts.
pub fn tools() -> Result<PathBuf, String> {
    if let Some(folder) = env::var_os("MESHSWEEP_TOOLS") {
        return Ok(PathBuf::from(folder));
    }
    let cache = env::var_os("XDG_CACHE_HOME")
        .map(PathBuf::from)
        .or_else(|| env::var_os("HOME").map(|home| Path::new(&home).join(".cache")));
    cache
        .map(|folder| folder.join("meshsweep-tools"))
        .ok_or_else(|| "no HOME: set MESHSWEEP_TOOLS to a folder for downloaded tools".to_owned())
}
