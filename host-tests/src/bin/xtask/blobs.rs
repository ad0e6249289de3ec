//! The blobs that the images carry: the builder's, in every coordinate format, whole and cut.

use std::fs;
use std::path::{Path, PathBuf};

use meshsweep_alloc::emit::cut;
use meshsweep_alloc::hull::{BuildOptions, build};
use meshsweep_alloc::mesh::Mesh;
use meshsweep_alloc::precision::VertexBits;
use meshsweep_core::Model;
use meshsweep_host_tests::generate::{Triangles, bracket, torus};

use crate::boards::Flash;
use crate::workspace;

/// A blob of the images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blob {
    /// A torus of 480 triangles: fits the smallest part with the code.
    Torus,
    /// The bracket of 1,948 triangles.
    Bracket,
    /// The torus on a 16-bit grid.
    Grid16,
    /// The torus on a 24-bit grid.
    Grid24,
    /// The torus, cut after the level that follows the base hull.
    Cut,
}

impl Blob {
    /// The blob whose costs are reported for a part with so much flash.
    pub const fn standard(flash: Flash) -> Self {
        match flash {
            Flash::Small => Self::Torus,
            Flash::Large => Self::Bracket,
        }
    }

    /// Blobs whose bits are compared beside the standard ones.
    pub const VARIANTS: [Self; 3] = [Self::Grid16, Self::Grid24, Self::Cut];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Torus => "torus",
            Self::Bracket => "bracket",
            Self::Grid16 => "grid16",
            Self::Grid24 => "grid24",
            Self::Cut => "cut",
        }
    }

    /// Writes the blob; its path.
    pub fn file(self) -> Result<PathBuf, String> {
        let folder = workspace::target().join("blobs");
        fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
        let path = folder.join(self.name()).with_extension("msw");
        write_if_changed(&path, &self.bytes()?)?;
        Ok(path)
    }

    fn bytes(self) -> Result<Vec<u8>, String> {
        // 50 faces: the levels below the surface are few enough to be cut, and the splits are many.
        let small = |vertex_bits| whole(torus(2.0, 0.75, 20, 12), 50, vertex_bits);
        match self {
            Self::Torus => small(VertexBits::Auto),
            Self::Bracket => whole(bracket(), BuildOptions::default().base_faces, VertexBits::Auto),
            Self::Grid16 => small(VertexBits::Grid16),
            Self::Grid24 => small(VertexBits::Grid24),
            Self::Cut => {
                let bytes = small(VertexBits::Auto)?;
                let model = Model::open(&bytes).map_err(|error| error.to_string())?;
                Ok(cut(&model, 1).map_err(|error| error.to_string())?.to_bytes())
            }
        }
    }
}

fn whole(
    (positions, triangles): Triangles,
    base_faces: usize,
    vertex_bits: VertexBits,
) -> Result<Vec<u8>, String> {
    let mesh = Mesh::new(positions, triangles);
    let options = BuildOptions { base_faces, vertex_bits, ..BuildOptions::default() };
    let built =
        build(&mesh, 0.0, mesh.triangles.len(), &options, |_| {}).map_err(|error| error.to_string())?;
    Ok(built.bytes)
}

/// So that cargo does not build again what has not changed.
fn write_if_changed(path: &Path, content: &[u8]) -> Result<(), String> {
    if fs::read(path).is_ok_and(|there| there == content) {
        return Ok(());
    }
    fs::write(path, content).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::Blob;
    use meshsweep_core::Model;
    use meshsweep_core::blob::layout::VertexFormat;
    use meshsweep_suite::ask;

    const ALL: [Blob; 5] = [Blob::Torus, Blob::Bracket, Blob::Grid16, Blob::Grid24, Blob::Cut];

    #[test]
    fn every_blob_opens_and_the_suite_has_memory_for_it() {
        for blob in ALL {
            let bytes = blob.bytes().expect("a blob");
            let model = Model::open(&bytes).expect("opens");
            assert!(ask::Subject::Hull(model).memory_suffices(), "{blob:?}: {:?}", model.capacities());
        }
    }

    #[test]
    fn blobs_differ_in_format_and_in_what_they_hold() {
        let header = |blob: Blob| *Model::open(&blob.bytes().expect("a blob")).expect("opens").header();
        assert_eq!(header(Blob::Torus).vertex_format, VertexFormat::F32);
        assert_eq!(header(Blob::Grid16).vertex_format, VertexFormat::Grid16);
        assert_eq!(header(Blob::Grid24).vertex_format, VertexFormat::Grid24);
        assert_eq!(header(Blob::Torus).surface_triangles, 480);
        assert_eq!(header(Blob::Bracket).surface_triangles, 1948);
        let cut = header(Blob::Cut);
        assert!(cut.surface_triangles == 0 && cut.splits > 0);
    }
}
