//! From a mesh file to a clean mesh, closed or not, and what had to be done for it.

use super::failure::Failure;
use meshsweep::mesh::{self, Mesh, RawMesh, RepairReport};
use meshsweep::precision::{VertexBits, snap};
use meshsweep_core::blob::layout::MAGIC;
use std::io::Read;
use std::path::Path;
use std::time::{Duration, Instant};

/// A mesh that a blob can be built of.
pub struct Loaded {
    /// Repaired.
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

/// Reads and repairs any triangle soup.
pub fn load(file: &Path) -> Result<Loaded, Failure> {
    let started = Instant::now();
    repaired(file, read(file)?, 0.0, started)
}

/// Reads, moves to the hull's grid, and repairs any triangle soup.
pub fn load_snapped(file: &Path, bits: VertexBits) -> Result<Loaded, Failure> {
    let started = Instant::now();
    let (raw, moved) = read_snapped(file, bits)?;
    repaired(file, raw, moved, started)
}

/// A file's mesh on the hull's grid, and how far its vertices were moved for it.
fn read_snapped(file: &Path, bits: VertexBits) -> Result<(RawMesh, f64), Failure> {
    let mut raw = read(file)?;
    let mut moved = snap(&mut raw.positions, bits);
    if moved > 0.0 && raw.decimal {
        // The decimals were rounded to f64 first, which repair no longer sees: half a unit in the
        // last place per axis.
        let largest = raw.positions.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
        moved += 2.0 * f64::EPSILON * largest;
    }
    Ok((raw, moved))
}

/// Reads, moves to the hull's grid, repairs, and refuses what is not closed and manifold; the
/// refusal says what can be had `instead`.
pub fn load_solid(
    file: &Path,
    bits: VertexBits,
    instead: Option<&'static str>,
) -> Result<Loaded, Failure> {
    let loaded = load_snapped(file, bits)?;
    match mesh::require_closed_manifold(&loaded.mesh) {
        Ok(()) => Ok(loaded),
        Err(error) => {
            let error = Box::new(loaded.report.explain(error));
            Err(Failure::NotSolid { file: file.to_owned(), error, instead })
        }
    }
}

/// Whether the file is a blob. One that cannot be read is none here; whoever reads it next says
/// why.
pub fn is_blob(path: &Path) -> bool {
    let mut head = [0; MAGIC.len()];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut head));
    read.is_ok() && head == MAGIC
}

fn read(file: &Path) -> Result<RawMesh, Failure> {
    let bytes =
        std::fs::read(file).map_err(|error| Failure::Read { file: file.to_owned(), error })?;
    if bytes.starts_with(&MAGIC) {
        return Err(Failure::BlobForMesh { file: file.to_owned() });
    }
    let looks_like = content(&bytes);
    mesh::read_bytes(file, bytes).map_err(|error| {
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or_default();
        match looks_like.filter(|kind| !kind.eq_ignore_ascii_case(extension)) {
            Some(content) => Failure::Misnamed { file: file.to_owned(), content },
            None => Failure::Mesh { file: file.to_owned(), error },
        }
    })
}

/// The kind of mesh file that the first bytes give away, as its extension.
fn content(bytes: &[u8]) -> Option<&'static str> {
    let begins = |with: &[u8]| {
        bytes
            .strip_prefix(with)
            .is_some_and(|rest| rest.starts_with(b"\n") || rest.starts_with(b"\r"))
    };
    if begins(b"ply") {
        return Some("ply");
    }
    let head = bytes.get(..bytes.len().min(1000)).unwrap_or_default();
    let holds = |word: &[u8]| head.windows(word.len()).any(|at| at == word);
    if head.starts_with(b"solid") && holds(b"facet normal") {
        return Some("stl");
    }
    (head.starts_with(b"v ") || holds(b"\nv ")).then_some("obj")
}

fn repaired(file: &Path, raw: RawMesh, moved: f64, started: Instant) -> Result<Loaded, Failure> {
    let input_triangles = raw.triangles.len();
    let (mesh, report) =
        mesh::repair(raw).map_err(|error| Failure::Mesh { file: file.to_owned(), error })?;
    Ok(Loaded { mesh, report, moved, input_triangles, time: started.elapsed() })
}

#[cfg(test)]
mod tests {
    use super::content;

    #[test]
    fn content_gives_the_kind_away() {
        assert_eq!(content(b"ply\r\nformat ascii 1.0\n"), Some("ply"));
        assert_eq!(content(b"solid x\n  facet normal 0 0 1\n"), Some("stl"));
        assert_eq!(content(b"# made by hand\nv 1 2 3\n"), Some("obj"));
        assert_eq!(content(b"some prose\n"), None);
        assert_eq!(content(b"plywood"), None);
        assert_eq!(content(b""), None);
    }
}
