//! From a mesh, or its file, to a clean mesh with a report of its repairs.
//!
//! ```text
//! file ─ Source (one unit) ─ grid of a hull ─ repair ─ Loaded ─ closed, if a hull is wanted
//! ```

mod content;

use crate::clock::Instant;
use crate::error::BuildError;
use crate::mesh::{
    FORMATS, Input, KeyFrame, Mesh, MeshError, RawMesh, RepairReport, Unit, key_frame, read_bytes,
    repair_moved, require_closed_manifold, require_deformable,
};
use crate::surface::{VertexBits, snap};
use content::Content;
use meshsweep_core::internal::format::layout::MAGIC;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A mesh that a blob can be built from.
#[derive(Clone, Debug)]
#[non_exhaustive]
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
    file: PathBuf,
    /// Time of reading and repairing.
    pub time: Duration,
}

/// What told a unit.
#[derive(Clone, Copy, Debug)]
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
    #[must_use]
    pub fn input(&self) -> Input<'_> {
        let Self { mesh, moved, input_triangles, .. } = self;
        Input { mesh, moved: *moved, input_triangles: *input_triangles }
    }

    /// How far a point of the file's surface may be from the mesh, in its unit.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.input().error_up()
    }

    /// Whether the unit of the mesh comes from its file, and not from the caller.
    #[must_use]
    pub fn is_in_own_unit(&self) -> bool {
        self.unit.is_some() && matches!(self.told, Told::File | Told::Format)
    }

    /// Tells the unit, if it is known.
    #[must_use]
    pub fn unit_note(&self) -> Option<String> {
        let unit = self.unit?;
        Some(match self.told {
            Told::File => format!("unit: {unit} (as the file tells)"),
            Told::Format => format!("unit: {unit} (the format's default)"),
            Told::Option => format!("unit: {unit} (by --unit)"),
            Told::Scaled(from) => format!("unit: {unit} (by --unit), scaled from {from}"),
        })
    }

    /// Refuses a mesh that is not closed and manifold.
    ///
    /// # Errors
    /// [`BuildError::NotSolid`].
    pub fn require_solid(&self) -> Result<(), BuildError> {
        require_closed_manifold(&self.mesh).map_err(|error| BuildError::NotSolid {
            file: self.file.clone(),
            error: Box::new(self.report.explain(error)),
        })
    }
}

/// A mesh as read, in the unit that is wanted.
#[derive(Clone, Debug)]
pub struct Source {
    raw: RawMesh,
    told: Told,
    started: Instant,
}

impl Source {
    /// Reads a file.
    ///
    /// # Errors
    /// [`BuildError::Unreadable`]; [`BuildError::Mesh`], also for a blob, and for a mesh whose
    /// content is not of the kind that its name says.
    pub fn of_file(file: &Path, unit: Option<Unit>) -> Result<Self, BuildError> {
        let started = Instant::now();
        Ok(Self { started, ..Self::of_bytes(file, bytes_of(file)?, unit)? })
    }

    /// Takes the content of a file, whose name tells the format by its extension. Nothing is opened
    /// but the files that glTF names beside it.
    ///
    /// # Errors
    /// Those of [`of_file`](Self::of_file), but for reading.
    pub fn of_bytes(file: &Path, bytes: Vec<u8>, unit: Option<Unit>) -> Result<Self, BuildError> {
        let started = Instant::now();
        if bytes.starts_with(&MAGIC) {
            return Err(refused(file, MeshError::Blob { file: file.to_owned() }));
        }
        let looks_like = Content::of(&bytes);
        let raw = read_bytes(file, bytes).map_err(|error| {
            let extension = file.extension().and_then(|e| e.to_str()).unwrap_or_default();
            let other = looks_like.filter(|it| !it.extension.eq_ignore_ascii_case(extension));
            let misnamed = |Content { name, extension }| {
                let file = file.to_owned();
                MeshError::Misnamed { file, content: name, extension }
            };
            refused(file, other.map_or(error, misnamed))
        })?;
        Ok(Self { started, ..Self::of(raw, unit)? })
    }

    /// Takes a mesh in memory.
    ///
    /// # Errors
    /// [`BuildError::Mesh`]: there are no coordinates for it in that unit.
    pub fn of(raw: RawMesh, unit: Option<Unit>) -> Result<Self, BuildError> {
        let (file, started) = (raw.file.clone(), Instant::now());
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
        scaled.map(|raw| Self { raw, told, started }).map_err(|error| refused(&file, error))
    }

    /// The mesh as read, in the unit that is wanted.
    #[must_use]
    pub fn raw(&self) -> &RawMesh {
        &self.raw
    }

    /// Repairs any triangle soup.
    ///
    /// # Errors
    /// [`BuildError::Mesh`].
    pub fn repaired(&self) -> Result<Loaded, BuildError> {
        self.loaded(0.0, None)
    }

    /// Moves vertices to the hull's grid, and repairs any triangle soup.
    ///
    /// # Errors
    /// [`BuildError::Mesh`].
    pub fn on_grid(&self, bits: VertexBits) -> Result<Loaded, BuildError> {
        let raw = &self.raw;
        let mut places = raw.positions.clone();
        let mut moved = snap(&mut places, bits);
        if moved > 0.0 && raw.decimal {
            // Reading rounded the decimals to f64, by half a unit in the last place per axis.
            // Repair cannot see that any more.
            let largest = places.iter().flatten().fold(0f64, |m, x| m.max(x.abs()));
            moved += 2.0 * f64::EPSILON * largest;
        }
        self.loaded(moved, Some(&places))
    }

    /// Repairs a mesh that deforms, and applies its repairs to its key frames. With `is_solid` it
    /// has to be closed.
    ///
    /// # Errors
    /// [`BuildError::NotSolid`], [`BuildError::Mesh`]; the first error of `frames`.
    pub fn deformable(
        &self,
        frames: impl Iterator<Item = Result<Self, BuildError>>,
        is_solid: bool,
    ) -> Result<(Loaded, Vec<KeyFrame>), BuildError> {
        let started = self.started;
        let loaded = self.repaired()?;
        if is_solid {
            loaded.require_solid()?;
        }
        let (raw, file) = (&self.raw, &self.raw.file);
        require_deformable(raw, &loaded.mesh).map_err(|error| refused(file, error))?;
        let keys = frames.map(|frame| {
            let key = frame?.raw;
            let of_frame = |error| refused(&key.file, error);
            require_same_unit([(file, raw.unit), (&key.file, key.unit)]).map_err(of_frame)?;
            key_frame(raw, &loaded.mesh, &key).map_err(of_frame)
        });
        let keys = keys.collect::<Result<_, _>>()?;
        Ok((Loaded { time: started.elapsed(), ..loaded }, keys))
    }

    fn loaded(&self, moved: f64, places: Option<&[[f64; 3]]>) -> Result<Loaded, BuildError> {
        let &Self { ref raw, told, started } = self;
        let (file, input_triangles, unit) = (raw.file.clone(), raw.triangles.len(), raw.unit);
        let (mesh, report) = repair_moved(raw, places).map_err(|error| refused(&file, error))?;
        let time = started.elapsed();
        Ok(Loaded { mesh, report, moved, input_triangles, unit, told, file, time })
    }
}

/// The bytes of a file.
///
/// # Errors
/// [`BuildError::Unreadable`].
pub fn bytes_of(file: &Path) -> Result<Vec<u8>, BuildError> {
    std::fs::read(file).map_err(|error| BuildError::Unreadable {
        file: file.to_owned(),
        kind: error.kind(),
        reason: error.to_string(),
    })
}

fn refused(file: &Path, error: MeshError) -> BuildError {
    BuildError::Mesh { file: file.to_owned(), error: Box::new(error) }
}

/// Whether the file's name ends as that of a mesh.
#[must_use]
pub fn is_named_as_mesh(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|extension| {
        FORMATS.into_iter().any(|mesh| mesh.eq_ignore_ascii_case(extension))
    })
}

/// Refuses two meshes in different units.
///
/// # Errors
/// [`MeshError::Units`].
pub fn require_same_unit(meshes: [(&Path, Option<Unit>); 2]) -> Result<(), MeshError> {
    match meshes {
        [(first, Some(a)), (second, Some(b))] if a != b => {
            let files = [first, second].map(Path::to_owned);
            Err(MeshError::Units { files, units: [a, b].map(Unit::symbol) })
        }
        _ => Ok(()),
    }
}
