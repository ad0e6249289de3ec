//! From a mesh file to a clean mesh, closed or not, with a report of the repairs.

use crate::failure::{Content, Failure};
use meshsweep::mesh::{self, FORMATS, Input, KeyFrame, Mesh, RawMesh, RepairReport, Unit};
use meshsweep::surface::{VertexBits, snap};
use meshsweep_core::internal::format::layout::MAGIC;
use std::io::{self, Read, Write};
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
    /// The unit of the mesh, if it is known.
    pub unit: Option<Unit>,
    /// What told the unit.
    told: Told,
    /// Time of reading and repairing.
    pub time: Duration,
}

/// What told a unit.
#[derive(Clone, Copy)]
enum Told {
    File,
    /// The file tells none, and its format says which one it is then.
    Format,
    Option,
    /// The option, and the file another unit.
    Scaled(Unit),
}

impl Loaded {
    /// The mesh as the builders take it.
    pub fn input(&self) -> Input<'_> {
        let Self { mesh, moved, input_triangles, .. } = self;
        Input { mesh, moved: *moved, input_triangles: *input_triangles }
    }

    /// Whether the unit of the mesh comes from its file, without `--unit`.
    pub fn is_in_own_unit(&self) -> bool {
        self.unit.is_some() && matches!(self.told, Told::File | Told::Format)
    }

    /// Tells the unit, if it is known.
    pub fn write_unit(&self, out: &mut dyn Write) -> io::Result<()> {
        let Some(unit) = self.unit else { return Ok(()) };
        match self.told {
            Told::File => writeln!(out, "  unit: {unit} (as the file tells)"),
            Told::Format => writeln!(out, "  unit: {unit} (3MF's default)"),
            Told::Option => writeln!(out, "  unit: {unit} (by --unit)"),
            Told::Scaled(from) => writeln!(out, "  unit: {unit} (by --unit), scaled from {from}"),
        }
    }

    /// A margin that the file's vertices keep too, before they were rounded and moved.
    pub fn widened(&self, margin: Option<f64>) -> f64 {
        let moved = (self.moved + self.mesh.rounding) * (1.0 + 4.0 * f64::EPSILON);
        margin.filter(|&margin| margin > 0.0).map_or(0.0, |margin| margin + moved)
    }
}

/// Reads and repairs any triangle soup. All loading is in the wanted unit, if one is.
pub fn load(file: &Path, unit: Option<Unit>) -> Result<Loaded, Failure> {
    let started = Instant::now();
    repaired(file, read(file, unit)?, 0.0, started)
}

/// Reads, moves to the hull's grid, and repairs any triangle soup.
pub fn load_snapped(file: &Path, bits: VertexBits, unit: Option<Unit>) -> Result<Loaded, Failure> {
    let started = Instant::now();
    let (read, moved) = read_snapped(file, bits, unit)?;
    repaired(file, read, moved, started)
}

/// A file's mesh on the hull's grid, and the largest distance that a vertex moved.
fn read_snapped(
    file: &Path,
    bits: VertexBits,
    unit: Option<Unit>,
) -> Result<((RawMesh, Told), f64), Failure> {
    let (mut raw, told) = read(file, unit)?;
    let mut moved = snap(&mut raw.positions, bits);
    if moved > 0.0 && raw.decimal {
        // Reading rounded the decimals to f64, by half a unit in the last place per axis. Repair
        // cannot see that any more.
        let largest = raw.positions.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
        moved += 2.0 * f64::EPSILON * largest;
    }
    Ok(((raw, told), moved))
}

/// Reads, moves to the hull's grid, repairs, and refuses meshes that are not closed and manifold.
/// The refusal says what can be had `instead`.
pub fn load_solid(
    file: &Path,
    bits: VertexBits,
    unit: Option<Unit>,
    instead: Option<&'static str>,
) -> Result<Loaded, Failure> {
    solid(file, load_snapped(file, bits, unit)?, instead)
}

/// Reads and repairs a solid that deforms, and applies its repairs to its key frames.
pub fn load_deformable(
    file: &Path,
    frames: &[PathBuf],
    unit: Option<Unit>,
    instead: Option<&'static str>,
) -> Result<(Loaded, Vec<KeyFrame>), Failure> {
    let started = Instant::now();
    let (raw, told) = read(file, unit)?;
    let loaded = solid(file, repaired(file, (raw.clone(), told), 0.0, started)?, instead)?;
    let refused = |file: &Path| {
        let file = file.to_owned();
        |error| Failure::Mesh { file, error }
    };
    mesh::require_deformable(&raw, &loaded.mesh).map_err(refused(file))?;
    let keys = frames.iter().map(|frame| {
        let (key, _) = read(frame, unit)?;
        refuse_units([(file, raw.unit), (frame, key.unit)])?;
        mesh::key_frame(&raw, &loaded.mesh, &key).map_err(refused(frame))
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
        FORMATS.into_iter().any(|mesh| mesh.eq_ignore_ascii_case(extension))
    })
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
    match meshes {
        [(first, Some(a)), (second, Some(b))] if a != b => {
            let (first, second) = (first.display(), second.display());
            let what = format!("{first} is in {a} and {second} in {b}; choose a unit by --unit");
            Err(Failure::Usage { what })
        }
        _ => Ok(()),
    }
}

fn read(file: &Path, unit: Option<Unit>) -> Result<(RawMesh, Told), Failure> {
    let bytes =
        std::fs::read(file).map_err(|error| Failure::Read { file: file.to_owned(), error })?;
    if bytes.starts_with(&MAGIC) {
        return Err(Failure::BlobForMesh { file: file.to_owned() });
    }
    let looks_like = content(&bytes);
    let raw = mesh::read_bytes(file, bytes).map_err(|error| {
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or_default();
        match looks_like.filter(|content| !content.extension.eq_ignore_ascii_case(extension)) {
            Some(content) => Failure::Misnamed { file: file.to_owned(), content },
            None => Failure::Mesh { file: file.to_owned(), error },
        }
    })?;
    let told = match (raw.unit, unit) {
        (_, None) if raw.unit_by_default => Told::Format,
        (_, None) => Told::File,
        (Some(from), Some(unit)) if from != unit => Told::Scaled(from),
        (_, Some(_)) => Told::Option,
    };
    let scaled = match unit {
        Some(unit) => raw.in_unit(unit),
        None => Ok(raw),
    };
    scaled.map(|raw| (raw, told)).map_err(|error| Failure::Mesh { file: file.to_owned(), error })
}

/// The kind of mesh file by the first bytes, and of binary STL by the size.
fn content(bytes: &[u8]) -> Option<Content> {
    let begins = |with: &[u8]| {
        bytes
            .strip_prefix(with)
            .is_some_and(|rest| rest.starts_with(b"\n") || rest.starts_with(b"\r"))
    };
    let head = bytes.get(..bytes.len().min(1000)).unwrap_or_default();
    let holds = |word: &[u8]| head.windows(word.len()).any(|at| at == word);
    // After a header of 80 bytes, the number of triangles of 50 bytes each.
    let triangles = bytes.get(80..84).and_then(|count| count.try_into().ok());
    let stl_bytes = triangles.map(|count| 84 + 50 * u64::from(u32::from_le_bytes(count)));
    let (name, extension) = if begins(b"ply") {
        ("PLY", "ply")
    } else if bytes.starts_with(b"glTF") {
        // Read under the name of the text form too.
        ("GLB", "glb")
    } else if bytes.starts_with(b"PK\x03\x04") {
        ("3MF", "3mf")
    } else if begins(b"OFF") || begins(b"COFF") || begins(b"NOFF") {
        ("OFF", "off")
    } else if bytes.len() > 84 && stl_bytes == Some(bytes.len() as u64) {
        ("binary STL", "stl")
    } else if head.starts_with(b"solid") && holds(b"facet normal") {
        ("STL", "stl")
    } else if head.starts_with(b"v ") || holds(b"\nv ") {
        ("OBJ", "obj")
    } else {
        return None;
    };
    Some(Content { name, extension })
}

fn repaired(
    file: &Path,
    (raw, told): (RawMesh, Told),
    moved: f64,
    started: Instant,
) -> Result<Loaded, Failure> {
    let (input_triangles, unit) = (raw.triangles.len(), raw.unit);
    let (mesh, report) =
        mesh::repair(raw).map_err(|error| Failure::Mesh { file: file.to_owned(), error })?;
    Ok(Loaded { mesh, report, moved, input_triangles, unit, told, time: started.elapsed() })
}

#[cfg(test)]
mod tests {
    use super::content;

    #[test]
    fn content_gives_the_kind_away() {
        let kind = |bytes: &[u8]| content(bytes).map(|content| content.name);
        assert_eq!(kind(b"ply\r\nformat ascii 1.0\n"), Some("PLY"));
        assert_eq!(kind(b"solid x\n  facet normal 0 0 1\n"), Some("STL"));
        assert_eq!(kind(b"# made by hand\nv 1 2 3\n"), Some("OBJ"));
        assert_eq!(kind(b"some prose\n"), None);
        assert_eq!(kind(b"OFF\n8 6 12\n"), Some("OFF"));
        assert_eq!(kind(b"OFFICE\n"), None);
        assert_eq!(kind(b"glTF\x02\0\0\0"), Some("GLB"));
        assert_eq!(kind(b"plywood"), None);
        assert_eq!(kind(b""), None);
        let mut stl = [0; 134];
        stl[80] = 1;
        assert_eq!(kind(&stl), Some("binary STL"));
        assert_eq!(kind(&stl[..133]), None);
    }
}
