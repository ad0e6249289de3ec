//! What `hull` says of the mesh.

use meshsweep::load::Loaded;
use meshsweep::number::AtMost;
use std::io::{self, Write};
use std::path::Path;

/// Says what was repaired and moved in a mesh, if anything was.
pub fn write_repairs(out: &mut dyn Write, file: &Path, loaded: &Loaded) -> io::Result<()> {
    if !loaded.report.is_clean() {
        writeln!(out, "{}\n  {}", file.display(), loaded.report)?;
    }
    loaded.unit_note().map_or(Ok(()), |note| writeln!(out, "  {note}"))?;
    if loaded.moved > 0.0 {
        writeln!(out, "vertices of the mesh moved to the grid by up to {}", AtMost(loaded.moved))?;
    }
    Ok(())
}
