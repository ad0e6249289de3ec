//! Mesh files for commands that build no blob.

use crate::args::ReadArgs;
use crate::failure::Failure;
use meshsweep::BuildError;
use meshsweep::load::{Loaded, Source, require_same_unit};
use meshsweep::mesh::{KeyFrame, Unit};
use meshsweep::surface::VertexBits;
use meshsweep_core::internal::format::layout::MAGIC;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The standard input, as an argument.
const STDIN: &str = "-";

/// The mesh's name in messages: a file's own; of the standard input `stdin.` and its format.
pub fn named(file: &Path, args: &ReadArgs) -> Result<PathBuf, Failure> {
    match args.format {
        _ if file.as_os_str() != STDIN => Ok(file.to_owned()),
        Some(format) => Ok(PathBuf::from(format!("stdin.{format}"))),
        None => Err(Failure::Usage {
            what: "-: what does the standard input hold? Give --format, as --format stl".to_owned(),
        }),
    }
}

/// Refuses `--format` without a mesh from the standard input, and two of them.
pub fn check_format(files: &[&Path], args: &ReadArgs) -> Result<(), Failure> {
    let from_stdin = files.iter().filter(|file| file.as_os_str() == STDIN).count();
    let what = match (from_stdin, args.format) {
        (0, Some(_)) => "--format is for a mesh from the standard input, which is named -",
        (2.., _) => "-: the standard input is one mesh; name a file for the other",
        _ => return Ok(()),
    };
    Err(Failure::Usage { what: what.to_owned() })
}

/// The content of the standard input, if the file stands for it.
pub fn stdin_bytes(file: &Path) -> Result<Option<Vec<u8>>, Failure> {
    if file.as_os_str() != STDIN {
        return Ok(None);
    }
    let mut bytes = Vec::new();
    let read = std::io::stdin().read_to_end(&mut bytes);
    read.map_err(|error| Failure::read(file, &error))?;
    Ok(Some(bytes))
}

/// Reads any triangle soup, without repairs. All loading is in the wanted unit, if one is.
pub fn read(file: &Path, args: &ReadArgs) -> Result<Source, Failure> {
    let name = named(file, args)?;
    let source = match stdin_bytes(file)? {
        Some(bytes) => Source::of_bytes(&name, bytes, args.unit),
        None => Source::of_file(file, args.unit),
    };
    source.map_err(|error| Failure::build(&name, error))
}

/// Reads and repairs any triangle soup.
pub fn load(file: &Path, args: &ReadArgs) -> Result<Loaded, Failure> {
    let loaded = read(file, args)?.repaired();
    loaded.map_err(|error| Failure::build(file, error))
}

/// Reads, moves to the hull's grid, and repairs any triangle soup.
pub fn load_snapped(file: &Path, bits: VertexBits, args: &ReadArgs) -> Result<Loaded, Failure> {
    let loaded = read(file, args)?.on_grid(bits);
    loaded.map_err(|error| Failure::build(file, error))
}

/// As [`load_snapped`]; refuses meshes that are not closed and manifold.
pub fn load_solid(file: &Path, bits: VertexBits, args: &ReadArgs) -> Result<Loaded, Failure> {
    let loaded = load_snapped(file, bits, args)?;
    loaded.require_solid().map_err(|error| solid_wanted(file, error))?;
    Ok(loaded)
}

/// Repairs a mesh that deforms, and applies its repairs to its key frames. With `is_solid` it has
/// to be closed.
pub fn deformable(
    source: &Source,
    frames: &[PathBuf],
    unit: Option<Unit>,
    is_solid: bool,
) -> Result<(Loaded, Vec<KeyFrame>), Failure> {
    let frames = frames.iter().map(|frame| Source::of_file(frame, unit));
    let file = &source.raw().file;
    source.deformable(frames, is_solid).map_err(|error| solid_wanted(file, error))
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
