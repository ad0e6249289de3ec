//! What commands say of the mesh that they read.

use meshsweep::load::Loaded;
use meshsweep::mesh::RepairReport;
use meshsweep::number::AtMost;
use std::io::{self, Write};
use std::path::Path;

/// Says what was repaired and moved in a mesh, if anything was.
pub fn write_repairs(out: &mut dyn Write, file: &Path, loaded: &Loaded) -> io::Result<()> {
    if loaded.report.is_clean() {
        write_rounding(out, file, &loaded.report)?;
    } else {
        writeln!(out, "{}\n  {}", file.display(), loaded.report)?;
    }
    loaded.unit_note().map_or(Ok(()), |note| writeln!(out, "  {note}"))?;
    if loaded.moved > 0.0 {
        writeln!(out, "vertices of the mesh moved to the grid by up to {}", AtMost(loaded.moved))?;
    }
    Ok(())
}

/// Says how far vertices of a mesh moved when they were rounded, if any did. JSON has the number as
/// `rounding`.
pub fn write_rounding(out: &mut dyn Write, file: &Path, report: &RepairReport) -> io::Result<()> {
    let note = report.rounding_note();
    note.map_or(Ok(()), |note| writeln!(out, "{}: {note}", file.display()))
}
