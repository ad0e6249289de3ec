//! What the library costs and yields, measured on a mesh: the numbers of the README, of
//! `core/DESIGN.md` and of `alloc-ext/DESIGN.md`.
//!
//! ```text
//! subject (mesh, builds) ─┬─ paper    (the papers' tables) ─┐
//! workload (queries) ─────┼─ segments (engines) ────────────┤
//! rival (parry3d) ────────┼─ closest                        ├─ table (text and JSON from the same cells)
//! brute (f64 oracle) ─────┼─ storage  (bytes, levels) ──────┤
//!                         ├─ tree     (all of the box tree) ┤
//!                         ├─ overlap  (mesh against mesh) ──┤
//!                         ├─ margins  (rounding, no mesh) ──┤
//!                         ├─ robot    (an arm's own guard) ─┤
//!                         ├─ deform   (hulls that deform) ─┤
//!                         ├─ triboxes (their hierarchies) ──┤
//!                         ├─ field    (distance fields) ────┤
//!                         └─ tight    (tight hulls) ────────┘
//! ```
//! Times are the processor's, of all threads, the fastest of three runs; on a busy machine even so
//! only ratios within one run mean something. Counts are exact.

pub(crate) mod brute;
mod closest;
mod deform;
pub mod field;
mod kept;
pub mod margins;
mod moving_pair;
mod overlap;
pub mod paper;
pub mod rival;
pub mod robot;
mod segments;
pub(crate) mod stopwatch;
mod storage;
mod table_3;
pub mod tight;
mod tree;
pub mod triboxes;

use meshsweep_core::Blob;
use std::path::Path;

use meshsweep::builder::FACES;
use meshsweep::collapse::Priority;
use meshsweep_core::Hull;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Table, fixed, row};

/// Faces of the base hull that most tables are about: the builder's default.
const BASE_FACES: usize = FACES as usize;

/// Measures the box tree of one mesh file, which need not be closed.
///
/// # Errors
/// The file is no mesh, or an answer is wrong.
pub fn measure_tree(file: &Path) -> Result<Vec<Table>, String> {
    let subject = Subject::load_any(file)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend(tree::tables(&subject)?);
    Ok(tables)
}

/// Measures one mesh file, which need not be closed, and itself under random motions: overlap, and
/// distances along paths; of a closed one, depths.
///
/// # Errors
/// The file is no mesh, or an answer is wrong.
pub fn measure_overlap(file: &Path) -> Result<Vec<Table>, String> {
    let subject = Subject::load_any(file)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend(overlap::tables(&subject)?);
    tables.extend(moving_pair::tables(&subject)?);
    Ok(tables)
}

/// Measures the hull hierarchy of one mesh file under motions.
///
/// # Errors
/// The file is no closed manifold mesh, or an answer is wrong.
pub fn measure_deform(file: &Path) -> Result<Vec<Table>, String> {
    let subject = Subject::load(file)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend(deform::tables(&subject)?);
    Ok(tables)
}

/// Measures the stored triboxes of one mesh file, which need not be closed.
///
/// # Errors
/// The file is no mesh, or triboxes deny that meshes meet.
pub fn measure_triboxes(file: &Path) -> Result<Vec<Table>, String> {
    let subject = Subject::load_any(file)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend(triboxes::tables(&subject)?);
    Ok(tables)
}

/// Measures distance fields of one mesh file, which need not be closed, at so many points.
///
/// # Errors
/// The file is no mesh, or an answer is wrong.
pub fn measure_field(file: &Path, queries: usize) -> Result<Vec<Table>, String> {
    let subject = Subject::load_any(file)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend(field::tables(&subject, queries)?);
    Ok(tables)
}

/// Measures tight hulls of one mesh file, which need not be closed, and proves each.
///
/// # Errors
/// The file is no mesh, or a hull is missing or not proved.
pub fn measure_tight(file: &Path) -> Result<Vec<Table>, String> {
    let subject = Subject::load_any(file)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend(tight::tables(&subject)?);
    Ok(tables)
}

/// Measures the hull hierarchy and the box tree of one mesh file; the tables in the order in which
/// they should be read.
///
/// # Errors
/// The file is no closed manifold mesh, or an answer is missing that must be there.
pub fn measure(file: &Path) -> Result<Vec<Table>, String> {
    let subject = Subject::load(file)?;
    let built = subject.build(BASE_FACES, Priority::Program)?;
    let model = open(&built)?;
    let mut tables = vec![subject_table(&subject)];
    tables.extend([
        storage::sections(&Blob::open(&built).map_err(|error| error.to_string())?),
        storage::limits(&model),
    ]);
    tables.push(segments::engines(&subject, &model)?);
    tables.extend(closest::tables(&subject, &model)?);
    tables.push(kept::table(&subject, &model)?);
    tables.push(kept::memory(&model)?);
    tables.push(storage::proofs(&built)?);
    tables.extend(tree::tables(&subject)?);
    Ok(tables)
}

/// What is measured.
fn subject_table(subject: &Subject) -> Table {
    let columns = ["vertices", "triangles", "diagonal"];
    let mut table = Table::new("mesh", format!("== {} ==", subject.name), &columns);
    table.push(row![
        subject.mesh.positions.len(),
        subject.mesh.triangles.len(),
        fixed(subject.diagonal(), 4)
    ]);
    table
}

/// Opens a blob that was built.
fn open(bytes: &[u8]) -> Result<Hull<'_>, String> {
    Hull::open(bytes).map_err(|error| error.to_string())
}
