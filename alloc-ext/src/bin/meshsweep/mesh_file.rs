//! From a mesh file to a clean mesh, closed or not, with a report of the repairs.

use crate::failure::Failure;
use meshsweep::mesh::{self, Input, KeyFrame, Mesh, RawMesh, RepairReport};
use meshsweep::surface::{VertexBits, snap};
use meshsweep_core::internal::format::layout::MAGIC;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A mesh that a blob can be built from.
pub struct Loaded {
    /// Repaired.
    pub mesh: Mesh,
    /// The repairs.
    pub report: RepairReport,
    /// Largest distance that a vertex moved to reach the grid, in the file's unit.
    pub moved: f64,
    /// Triangles of the file.
    pub input_triangles: usize,
    /// Time of reading and repairing.
    pub time: Duration,
}

impl Loaded {
    /// The mesh as the builders take it.
    pub fn input(&self) -> Input<'_> {
        let Self { mesh, moved, input_triangles, .. } = self;
        Input { mesh, moved: *moved, input_triangles: *input_triangles }
    }

    /// A margin that the file's vertices keep too, before they were rounded and moved.
    pub fn widened(&self, margin: Option<f64>) -> f64 {
        let moved = (self.moved + self.mesh.rounding) * (1.0 + 4.0 * f64::EPSILON);
        margin.filter(|&margin| margin > 0.0).map_or(0.0, |margin| margin + moved)
    }
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

/// A file's mesh on the hull's grid, and the largest distance that a vertex moved.
fn read_snapped(file: &Path, bits: VertexBits) -> Result<(RawMesh, f64), Failure> {
    let mut raw = read(file)?;
    let mut moved = snap(&mut raw.positions, bits);
    if moved > 0.0 && raw.decimal {
        // Reading rounded the decimals to f64, by half a unit in the last place per axis. Repair
        // cannot see that any more.
        let largest = raw.positions.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
        moved += 2.0 * f64::EPSILON * largest;
    }
    Ok((raw, moved))
}

/// Reads, moves to the hull's grid, repairs, and refuses meshes that are not closed and manifold.
/// The refusal says what can be had `instead`.
pub fn load_solid(
    file: &Path,
    bits: VertexBits,
    instead: Option<&'static str>,
) -> Result<Loaded, Failure> {
    solid(file, load_snapped(file, bits)?, instead)
}

/// Reads and repairs a solid that deforms, and applies its repairs to its key frames.
pub fn load_deformable(
    file: &Path,
    frames: &[PathBuf],
    instead: Option<&'static str>,
) -> Result<(Loaded, Vec<KeyFrame>), Failure> {
    let started = Instant::now();
    let raw = read(file)?;
    let loaded = solid(file, repaired(file, raw.clone(), 0.0, started)?, instead)?;
    let refused = |file: &Path| {
        let file = file.to_owned();
        |error| Failure::Mesh { file, error }
    };
    mesh::require_deformable(&raw, &loaded.mesh).map_err(refused(file))?;
    let keys = frames.iter().map(|frame| {
        let key = mesh::key_frame(&raw, &loaded.mesh, &read(frame)?);
        key.map_err(refused(frame))
    });
    let keys = keys.collect::<Result<_, _>>()?;
    Ok((Loaded { time: started.elapsed(), ..loaded }, keys))
}

fn solid(file: &Path, loaded: Loaded, instead: Option<&'static str>) -> Result<Loaded, Failure> {
    match mesh::require_closed_manifold(&loaded.mesh) {
        Ok(()) => Ok(loaded),
        Err(error) => {
            let error = Box::new(loaded.report.explain(error));
            Err(Failure::NotSolid { file: file.to_owned(), error, instead })
        }
    }
}

/// Whether the file's name ends as that of a mesh.
pub fn is_named_as_mesh(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|extension| {
        ["stl", "ply", "obj"].into_iter().any(|mesh| mesh.eq_ignore_ascii_case(extension))
    })
}

/// Whether the file is a blob. A file that cannot be read counts as none; reading it later says
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

/// The kind of mesh file by the first bytes, as an extension.
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
