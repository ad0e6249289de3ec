//! From a mesh file to a closed manifold mesh, and what had to be done for it.

use super::failure::Failure;
use meshsweep_alloc::mesh::{self, Mesh, RawMesh, RepairReport};
use meshsweep_alloc::precision::{VertexBits, snap};
use meshsweep_core::blob::layout::MAGIC;
use std::path::Path;
use std::time::{Duration, Instant};

/// A mesh that a hull can be built of.
pub struct Solid {
    /// Closed and manifold.
    pub mesh: Mesh,
    /// What was mended.
    pub report: RepairReport,
    /// Distance that no vertex was moved more than to reach the grid, file's unit.
    pub moved: f64,
    /// Triangles of the file.
    pub input_triangles: usize,
    /// Reading and repairing.
    pub time: Duration,
}

/// Reads, moves to the grid, repairs and checks.
pub fn load(file: &Path, bits: VertexBits) -> Result<Solid, Failure> {
    let started = Instant::now();
    let bytes = std::fs::read(file).map_err(|error| Failure::Read { file: file.to_owned(), error })?;
    if bytes.starts_with(&MAGIC) {
        return Err(Failure::BlobForMesh { file: file.to_owned() });
    }
    let raw = mesh::read_bytes(file, bytes).map_err(|error| Failure::mesh(file, error))?;
    close(file, raw, bits, started)
}

fn close(file: &Path, mut raw: RawMesh, bits: VertexBits, started: Instant) -> Result<Solid, Failure> {
    let input_triangles = raw.triangles.len();
    let mut moved = snap(&mut raw.positions, bits);
    if moved > 0.0 && raw.decimal {
        // The decimals were rounded to f64 first, which repair no longer sees: half a unit in the last place per axis.
        let largest = raw.positions.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
        moved += 2.0 * f64::EPSILON * largest;
    }
    let (mesh, report) = mesh::repair(raw).map_err(|error| Failure::mesh(file, error))?;
    mesh::require_closed_manifold(&mesh).map_err(|error| Failure::mesh(file, report.explain(error)))?;
    Ok(Solid { mesh, report, moved, input_triangles, time: started.elapsed() })
}
