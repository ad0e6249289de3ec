//! What a blob takes and holds: sections, limits, levels, and the time of each stage that made it.

use meshsweep::hull::Built;
use meshsweep_core::Hull;
use meshsweep_core::{Blob, ScratchEntry};
use meshsweep_xtask::table::{Table, fixed, row};

/// Stages of a whole build.
pub fn build_times(built: &Built) -> Table {
    let report = &built.report;
    let title = "Whole build, default options";
    let columns = [
        "base faces",
        "collapse s",
        "cover s",
        "certify s",
        "programs",
        "ns/program",
        "bytes",
        "stuck",
    ];
    let mut table = Table::new("build", title, &columns);
    let collapse = report.collapse_time.as_secs_f64();
    table.push(row![
        report.base_faces,
        fixed(collapse, 2),
        fixed(report.sweep_time.as_secs_f64(), 2),
        fixed(report.certify_time.as_secs_f64(), 2),
        report.programs,
        fixed(collapse * 1.0e9 / report.programs.max(1) as f64, 0),
        built.bytes.len(),
        report.stuck.map(|stuck| format!("{stuck:?}")),
    ]);
    table
}

/// Bytes of each section.
pub fn sections(blob: &Blob<'_>) -> Table {
    let mut table =
        Table::new("sections", "Bytes of the blob", &["section", "bytes", "bytes/triangle"]);
    let triangles = f64::from(blob.header().surface_triangles.max(1));
    for section in blob.sections() {
        table.push(row![
            section.kind.name(),
            section.bytes,
            fixed(f64::from(section.bytes) / triangles, 2)
        ]);
    }
    let total = blob.bytes().len();
    table.push(row!["all, with header", total, fixed(total as f64 / triangles, 2)]);
    table.note(format!("coordinates as {:?}", blob.header().vertex_format));
    table
}

/// Capacities and counts.
pub fn limits(model: &Hull<'_>) -> Table {
    let columns =
        ["splits", "queue entries", "queue bytes", "front words", "front bytes", "longest chain"];
    let mut table = Table::new("capacities", "Memory that no query outgrows", &columns);
    table.push(row![
        model.header().splits,
        model.scratch_entries(),
        model.scratch_entries() * size_of::<ScratchEntry>(),
        model.refined_words(),
        2 * model.refined_words() * size_of::<u32>(),
        model.header().dependency_depth,
    ]);
    table
}

/// What the independent checker proved from the bytes alone.
///
/// # Errors
/// The first claim of the blob that does not hold.
pub fn proofs(bytes: &[u8]) -> Result<Table, String> {
    let columns = ["splits", "planes", "by integers", "violations", "triangles", "cover pairs"];
    let mut table =
        Table::new("proofs", "Proved again from the blob alone, by exact predicates", &columns);
    let report = meshsweep_host_tests::check::check_blob(bytes)?;
    table.push(row![
        report.splits,
        report.planes,
        report.exact_planes,
        0usize,
        report.triangles,
        report.covered
    ]);
    table.note(
        "planes: faces that the vertex of a coarser hull lies on or outside; by integers: not decided by f64",
    );
    Ok(table)
}

/// The level table.
pub fn levels(model: &Hull<'_>) -> Table {
    let columns = ["level", "faces", "splits", "hull to surface", "surface to hull", "void %"];
    let mut table = Table::new("levels", "Levels; distances certified, of the diagonal", &columns);
    let [low, high] = model.header().surface_box.map(glam::Vec3::from_array);
    let diagonal = f64::from((high - low).length());
    for (index, level) in model.levels().enumerate() {
        table.push(row![
            index,
            level.faces,
            level.splits,
            fixed(f64::from(level.hull_to_surface) / diagonal, 6),
            fixed(f64::from(level.surface_to_hull) / diagonal, 6),
            fixed(100.0 * f64::from(level.void_ratio), 2),
        ]);
    }
    table
}
