//! What commands say of the mesh that they read.

use meshsweep::load::Loaded;
use meshsweep::mesh::{Found, Place, RepairReport, Unit};
use meshsweep::number::AtMost;
use serde_json::{Map, Value, json};
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

/// What JSON says of a mesh, beside other fields: its file, triangles and unit, how far rounding
/// and a grid moved its vertices, and its repairs.
pub fn fields(file: &Path, loaded: &Loaded) -> Map<String, Value> {
    let report = &loaded.report;
    let place = |&Place { triangle, vertex, at }: &Place| json!({ "triangle": triangle, "vertex": vertex, "at": at });
    let findings = report.findings().into_iter().filter(|found| found.finding.count > 0);
    let finding = |Found { key, finding, .. }: Found<'_>| {
        let places: Vec<Value> = finding.places.iter().map(place).collect();
        (key.to_owned(), json!({ "count": finding.count, "places": places }))
    };
    let repairs = json!({
        "is_clean": report.is_clean(),
        "vertices_read": report.vertices_read,
        "triangles_read": report.triangles_read,
        "vertices": report.vertices_kept,
        "components": report.component_count,
        "doubts": report.doubts().collect::<Vec<_>>(),
        "findings": findings.map(finding).collect::<Map<_, _>>(),
    });
    let fields = [
        ("mesh", json!(file.display().to_string())),
        ("triangles", json!(loaded.mesh.triangles.len())),
        ("unit", json!(loaded.unit.map(Unit::symbol))),
        ("rounding", json!(report.rounding)),
        ("moved", json!(loaded.moved)),
        ("repairs", repairs),
    ];
    fields.map(|(name, value)| (name.to_owned(), value)).into_iter().collect()
}
