//! What a blob takes: sections, capacities, and what the checker proves of it.

use meshsweep_core::Hull;
use meshsweep_core::{Blob, ScratchEntry};
use meshsweep_xtask::table::{Table, fixed, row};

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
    let columns = ["splits", "queue entries", "queue bytes", "longest chain"];
    let mut table = Table::new("capacities", "Memory that no query outgrows", &columns);
    table.push(row![
        model.header().splits,
        model.scratch_entries(),
        model.scratch_entries() * size_of::<ScratchEntry>(),
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
    let report = meshsweep::check::check_blob(bytes)?;
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
