//! The mesh that is measured, and blobs of it.

use std::path::Path;

use meshsweep::collapse::Priority;
use meshsweep::hull::{BuildOptions, build};
use meshsweep::mesh::{Mesh, RepairReport, load_closed, read, repair};
use meshsweep::progress::Watch;

/// A mesh with its name and size.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The file's name without its extension.
    pub name: String,
    /// The mesh after repair.
    pub mesh: Mesh,
    /// Triangles of the file.
    pub triangles_read: usize,
    /// Least and greatest corner of the mesh's box, input units.
    pub bounds: [[f32; 3]; 2],
}

impl Subject {
    /// Reads and repairs a mesh file.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn load(file: &Path) -> Result<Self, String> {
        Ok(Self::new(file, load_closed(file).map_err(|error| error.to_string())?))
    }

    /// Reads and repairs a mesh file that may be open.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn load_any(file: &Path) -> Result<Self, String> {
        let loaded = read(file).and_then(repair).map_err(|error| error.to_string())?;
        Ok(Self::new(file, loaded))
    }

    fn new(file: &Path, (mesh, report): (Mesh, RepairReport)) -> Self {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Self { triangles_read: report.triangles_read, ..Self::of(name, mesh) }
    }

    /// A mesh as it is.
    #[must_use]
    pub fn of(name: impl Into<String>, mesh: Mesh) -> Self {
        let corner = |pick: fn(f32, f32) -> f32, start: f32| {
            std::array::from_fn(|axis| mesh.positions.iter().map(|p| p[axis]).fold(start, pick))
        };
        let bounds = [corner(f32::min, f32::INFINITY), corner(f32::max, f32::NEG_INFINITY)];
        Self { name: name.into(), triangles_read: mesh.triangles.len(), mesh, bounds }
    }

    /// A blob with a base hull of so many faces, all else as the builder's defaults.
    ///
    /// # Errors
    /// The builder's refusal.
    pub fn build(&self, base_faces: usize, priority: Priority) -> Result<Vec<u8>, String> {
        self.build_with(&BuildOptions { base_faces, priority, ..BuildOptions::default() })
    }

    /// A blob.
    ///
    /// # Errors
    /// The builder's refusal.
    pub fn build_with(&self, options: &BuildOptions<'_>) -> Result<Vec<u8>, String> {
        let mesh = self.mesh.as_input();
        let input = meshsweep::mesh::Input { input_triangles: self.triangles_read, ..mesh };
        let built = build(input, options, Watch::NONE).map_err(|error| error.to_string())?;
        Ok(built.0.to_bytes())
    }

    /// Diagonal of the mesh's box, input units.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        let [low, high] = self.bounds;
        (0..3).map(|k| (f64::from(high[k]) - f64::from(low[k])).powi(2)).sum::<f64>().sqrt()
    }
}
