//! Mesh files for commands that build no blob.

use crate::failure::Failure;
use meshsweep::BuildError;
use meshsweep::load::{Loaded, Source, require_same_unit};
use meshsweep::mesh::{KeyFrame, Unit};
use meshsweep::surface::VertexBits;
use meshsweep_core::internal::format::layout::MAGIC;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Reads any triangle soup, without repairs. All loading is in the wanted unit, if one is.
pub fn read(file: &Path, unit: Option<Unit>) -> Result<Source, Failure> {
    Source::of_file(file, unit).map_err(|error| Failure::build(file, error))
}

/// Reads and repairs any triangle soup.
pub fn load(file: &Path, unit: Option<Unit>) -> Result<Loaded, Failure> {
    let loaded = read(file, unit)?.repaired();
    loaded.map_err(|error| Failure::build(file, error))
}

/// Reads, moves to the hull's grid, and repairs any triangle soup.
pub fn load_snapped(file: &Path, bits: VertexBits, unit: Option<Unit>) -> Result<Loaded, Failure> {
    let loaded = Source::of_file(file, unit).and_then(|source| source.on_grid(bits));
    loaded.map_err(|error| Failure::build(file, error))
}

/// As [`load_snapped`]; refuses meshes that are not closed and manifold.
pub fn load_solid(file: &Path, bits: VertexBits, unit: Option<Unit>) -> Result<Loaded, Failure> {
    let loaded = load_snapped(file, bits, unit)?;
    loaded.require_solid().map_err(|error| solid_wanted(file, error))?;
    Ok(loaded)
}

/// Reads and repairs a solid that deforms, and applies its repairs to its key frames.
pub fn load_deformable(
    file: &Path,
    frames: &[PathBuf],
    unit: Option<Unit>,
) -> Result<(Loaded, Vec<KeyFrame>), Failure> {
    let frames = frames.iter().map(|frame| Source::of_file(frame, unit));
    let loaded = Source::of_file(file, unit).and_then(|source| source.deformable(frames));
    loaded.map_err(|error| solid_wanted(file, error))
}

/// Without the remedy of another blob, where none is built.
fn solid_wanted(file: &Path, error: BuildError) -> Failure {
    let error = match error {
        BuildError::NotSolid { file, error } => BuildError::Mesh { file, error },
        error => error,
    };
    Failure::build(file, error)
}

/// Whether the file is a blob. A file that cannot be read counts as none; reading it later says
/// why.
pub fn is_blob(path: &Path) -> bool {
    let mut head = [0; MAGIC.len()];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut head));
    read.is_ok() && head == MAGIC
}

/// Refuses two meshes in different units.
pub fn refuse_units(meshes: [(&Path, Option<Unit>); 2]) -> Result<(), Failure> {
    require_same_unit(meshes).map_err(|error| Failure::Usage { what: error.to_string() })
}
