//! Sentences of `build` and `hull` about the hulls that they make.

use crate::failure::Failure;
use crate::mesh_file::Loaded;
use crate::number::{About, AtMost, Typed};
use crate::unmet::Tightness;
use meshsweep::collapse::Stuck;
use meshsweep::counted::Counted;
use meshsweep::tight::{Report, Start};
use std::io::{self, Write};
use std::path::Path;

/// Refuses hulls that are looser than asked for.
pub fn require_met<'a>(
    file: &Path,
    tightness: Tightness,
    reports: impl ExactSizeIterator<Item = &'a Report>,
) -> Result<(), Failure> {
    let refuse = |unmet| Err(Failure::Unmet { file: file.to_owned(), unmet });
    tightness.unmet(reports).map_or(Ok(()), refuse)
}

/// Says that the hull keeps its margin, if it has one. `of` names what the hull encloses.
pub fn write_margin(out: &mut dyn Write, margin: Option<f64>, of: &str) -> io::Result<()> {
    margin.filter(|&margin| margin > 0.0).map_or(Ok(()), |margin| {
        writeln!(out, "  all points within {} of the {of} are inside", Typed(margin))
    })
}

/// Says why there is no void, if there is none.
pub fn write_no_void<E: std::fmt::Display>(
    out: &mut dyn Write,
    void: &Result<f64, E>,
) -> io::Result<()> {
    match void {
        Ok(_) => Ok(()),
        Err(why) => writeln!(out, "  {why}; there is no volume to measure void against"),
    }
}

/// Says whether the mesh's volume is sure, how the hull began if not as the progressive hull, and
/// which cavities it fills.
pub fn write_start(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    if report.crosses {
        writeln!(
            out,
            "  the mesh crosses or touches itself: its volume may count places more than once, \
             so that the true void may be larger"
        )?;
    }
    if let Start::VoxelClosure { edge, .. } = report.start {
        writeln!(
            out,
            "  the hull began as a voxel closure: the outside of the voxels of edge {} that the \
             mesh meets",
            About(edge)
        )?;
    }
    if report.start == Start::Box {
        writeln!(out, "  the hull began as the mesh's box")?;
    }
    if report.filled > 0 {
        writeln!(
            out,
            "  {} filled: a cavity, or a connected component inside another",
            Counted(report.filled, "shell")
        )?;
    }
    Ok(())
}

/// Says what was repaired and moved in a mesh, if anything was.
pub fn write_repairs(out: &mut dyn Write, file: &Path, loaded: &Loaded) -> io::Result<()> {
    if !loaded.report.is_clean() {
        writeln!(out, "{}\n  {}", file.display(), loaded.report)?;
    }
    loaded.write_unit(out)?;
    if loaded.moved > 0.0 {
        writeln!(out, "vertices of the mesh moved to the grid by up to {}", AtMost(loaded.moved))?;
    }
    Ok(())
}

/// Says how far the points of triangles without area lie off the surface, if any do.
pub fn write_wires(out: &mut dyn Write, off: f64) -> io::Result<()> {
    if off <= 0.0 {
        return Ok(());
    }
    writeln!(
        out,
        "  triangles without area lie up to {} off the surface: hulls may leave them out by as \
         much",
        AtMost(off)
    )
}

/// Why a progressive hull has more faces than `wanted`.
pub fn why_stuck(wanted: u32, stuck: &Stuck) -> String {
    format!(
        "stopped before {wanted} faces, for no edge may collapse: {} by topology or valence, {} \
         because no vertex is outside all planes, {} by compactness or normals; --max-valence, \
         --compactness and --max-normal-deviation relax the conditions",
        stuck.topology, stuck.no_vertex, stuck.shape
    )
}
