//! Mesh files in, a clean triangle mesh out; and [`write_ply`], the way back.
//!
//! ```text
//! file ─ read ─ RawMesh ─ repair ─ Mesh + RepairReport ─ require_closed_manifold ─ ready for hulls
//! ```
//!
//! [`read`] takes PLY, OBJ, STL, OFF, glTF, 3MF and COLLADA. [`repair`] mends what can be mended
//! without moving the surface and reports each mend with its place; it accepts any triangle soup.
//! [`require_closed_manifold`] is the further demand of an outer hull. It is kept apart, because a
//! distance index is content with a soup.
//!
//! Numbers of vertices, faces and triangles count from 0 in file order; errors of reading OBJ count
//! from 1, as such a file does. A *face* is what the file lists, perhaps a polygon; a *triangle* is
//! one after polygons are split, numbered through in file order. Copies that nodes and items of a
//! scene make are numbered through in the order of the scene.

mod boundary;
mod caps;
mod collada;
mod collinear;
mod copies;
mod document;
mod duplicate;
mod ears;
mod edges;
mod error;
mod filed;
mod gltf;
mod hash;
mod input;
mod joined;
mod key_frame;
mod layout;
mod left_out;
mod manifold;
mod no_volume;
mod obj;
mod off;
mod outward;
mod placement;
mod ply;
mod polygons;
mod read;
mod repair;
mod report;
mod round;
mod stl;
mod strip;
mod text;
mod threemf;
mod unit;
mod vertex_fans;
mod volume;
mod weld;
mod winding;
mod wire;
mod write_ply;
mod xml;

use glam::{DVec3, Vec3};
use std::path::{Path, PathBuf};

pub(crate) use collinear::collinear;
pub(crate) use document::{Document, text_of};
pub(crate) use edges::{EdgeTable, UnionFind, ends};
pub use error::{EdgePlace, MeshError};
pub use filed::Filed;
pub use input::Input;
pub(crate) use joined::joined;
pub use key_frame::{KeyFrame, key_frame, require_deformable};
pub use left_out::{LeftOut, Remark};
pub use manifold::require_closed_manifold;
pub use no_volume::NoVolume;
pub(crate) use placement::Placement;
pub use polygons::{FacePlace, NamedFaces, Polygons};
pub use read::{read, read_bytes};
pub use repair::repair;
pub(crate) use repair::repair_moved;
pub use report::{Finding, Found, Place, RepairReport};
pub use unit::Unit;
pub(crate) use volume::SignedVolume;
pub use wire::Wire;
pub use write_ply::{write_coloured_ply, write_ply};

/// Extensions of the files that [`read`] reads.
pub const FORMATS: [&str; 8] = ["stl", "ply", "obj", "off", "glb", "gltf", "3mf", "dae"];

/// A triangle mesh as the rest of the builder takes it.
///
/// [`repair`] guarantees: coordinates finite and without −0.0, indices in range, every vertex used,
/// no triangle with a repeated vertex or zero area, no two triangles on the same three vertices.
/// Every point of the input lies on one of `triangles` or on one of `wires`. Vertices that only
/// wires use come last.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions in the file's unit and frame.
    pub positions: Vec<[f32; 3]>,
    /// Three vertex indices per triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle its number in the input file: polygons are split in file order, then
    /// numbered from 0. Two triangles share a number where an edge flip removed a flat
    /// cap (see [`RepairReport::flipped_caps`]).
    pub source: Vec<u32>,
    /// Per vertex its number in the input file: of welded vertices the first, and that of the
    /// original for a copy.
    pub vertex_source: Vec<u32>,
    /// The points of triangles without area that no triangle above covers.
    pub wires: Vec<Wire>,
    /// Upper bound, rounded up, of the Euclidean distance that any vertex moved when it was
    /// rounded to `f32`, in the file's unit; 0 if every coordinate was an `f32` already. For
    /// text, the input is the decimal number as written, except that a decimal whose nearest
    /// `f64` is an `f32` counts as that `f32`. If the file or the caller scales or moves the
    /// coordinates, the input is their exact places after that.
    pub rounding: f64,
    /// Repair dropped a triangle whose corners are those of another one in opposite order. The two
    /// may be the walls of a shell that rounding has closed. Then the input's winding numbers are
    /// lost, so no structure decides a side of this mesh.
    pub has_merged_walls: bool,
    /// Per triangle whether repair wound it against the file. Empty if it wound none so.
    pub turned: Vec<bool>,
    /// The file's triangles, if they are not those of `triangles` in the same winding, or if
    /// vertices were welded that the file has at different places. `None` for a mesh in memory.
    pub filed: Option<Box<Filed>>,
}

impl Mesh {
    /// A mesh taken as it is: `source` counts from 0, `rounding` is 0. Nothing is checked; pass the
    /// arrays through [`RawMesh::from_f32`] and [`repair`] if they are not known to be clean.
    #[must_use]
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        let source = (0..triangles.len() as u32).collect();
        let vertex_source = (0..positions.len() as u32).collect();
        Self { positions, triangles, source, vertex_source, ..Self::default() }
    }

    /// Triangles that have all points of the mesh: those with an area, then one for each
    /// [`Wire`].
    pub fn all_triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.triangles.iter().copied().chain(self.wires.iter().map(Wire::triangle))
    }

    /// Numbers in the input file of [`all_triangles`](Self::all_triangles).
    pub fn all_sources(&self) -> impl Iterator<Item = u32> + '_ {
        self.source.iter().copied().chain(self.wires.iter().map(|wire| wire.source))
    }

    /// Corners of the wires' triangles.
    pub fn wire_corners(&self) -> impl Iterator<Item = [[f32; 3]; 3]> + '_ {
        self.wires.iter().map(|wire| wire.triangle().map(|v| self.positions[v as usize]))
    }

    /// The mesh without its wires and their vertices.
    #[must_use]
    pub fn without_wires(&self) -> Self {
        let used = self.triangles.iter().flatten().fold(0, |most, &v| most.max(v as usize + 1));
        let positions = self.positions[..used].to_vec();
        let vertex_source = self.vertex_source.iter().copied().take(used).collect();
        Self { positions, vertex_source, wires: Vec::new(), filed: None, ..self.clone() }
    }

    /// Corners of triangle `triangle`, or `None` if it or one of its vertices does not exist.
    #[must_use]
    pub fn corners(&self, triangle: usize) -> Option<[[f32; 3]; 3]> {
        let [a, b, c] = *self.triangles.get(triangle)?;
        let at = |v: u32| self.positions.get(v as usize).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }

    /// Corners of all triangles, in the file's unit and frame. Indices must be in range.
    pub(crate) fn corners_f64(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles.iter().map(|&triangle| self.wide(triangle))
    }

    /// Corners of [`all_triangles`](Self::all_triangles), in f64.
    pub(crate) fn all_corners_f64(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.all_triangles().map(|triangle| self.wide(triangle))
    }

    fn wide(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|v| Vec3::from(self.positions[v as usize]).as_dvec3())
    }
}

/// A mesh as read: finite coordinates, indices in range, at least one triangle; nothing else is
/// promised.
#[derive(Clone, Debug, PartialEq)]
pub struct RawMesh {
    /// Vertex positions in the file's unit and frame. STL shares no vertices, so it gives three
    /// per triangle.
    pub positions: Vec<[f64; 3]>,
    /// Three vertex indices per triangle, in the file's winding; polygons are split, into
    /// the fan about their first corner where that is the polygon.
    pub triangles: Vec<[u32; 3]>,
    /// Where it came from; only for messages.
    pub file: PathBuf,
    /// Faces of the file with more than three corners, which [`triangles`](Self::triangles) has in
    /// parts.
    pub polygons: Polygons,
    /// For each triangle that is an ear of a concave polygon, its number and the polygon's corners
    /// in its place: those of the fan, or in STL the ear's, counted from 0. With them two files of
    /// one topology are equal, also if a polygon is concave in one of them only.
    pub fans: Vec<(usize, [u32; 3])>,
    /// True if the coordinates were decimal text, so that `positions` holds the nearest `f64` of
    /// each.
    pub decimal: bool,
    /// Upper bound of the distance of a position from the exact one, where the file's transforms
    /// or another unit moved it; 0 if nothing did. [`Mesh::rounding`] includes it.
    pub error: f64,
    /// The unit of the coordinates, if the format tells it.
    pub unit: Option<Unit>,
    /// True if the file names no unit, and `unit` is its format's default.
    pub unit_by_default: bool,
    /// Parts of the file that are no triangles, or doubtful.
    pub left_out: LeftOut,
}

impl RawMesh {
    /// The triangles as they would be if no polygon were concave.
    pub(crate) fn fan_triangles(&self) -> Vec<[u32; 3]> {
        let mut triangles = self.triangles.clone();
        for &(number, fan) in &self.fans {
            if let Some(triangle) = triangles.get_mut(number) {
                *triangle = fan;
            }
        }
        triangles
    }

    /// A raw mesh from arrays in memory. [`repair`] checks coordinates and indices.
    #[must_use]
    pub fn from_f32(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let positions = positions.iter().map(|p| p.map(f64::from)).collect();
        Self::from_f64(positions, triangles.to_vec())
    }

    /// As [`RawMesh::from_f32`], for coordinates that [`repair`] has yet to round.
    #[must_use]
    pub fn from_f64(positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            positions,
            triangles,
            file: PathBuf::from("(memory)"),
            polygons: Polygons::default(),
            fans: Vec::new(),
            decimal: false,
            error: 0.0,
            unit: None,
            unit_by_default: false,
            left_out: LeftOut::default(),
        }
    }
}

/// Reads, repairs and checks a mesh for a hull in one step.
///
/// # Errors
/// Those of [`read`], [`repair`] and [`require_closed_manifold`]; for an open mesh the error names
/// the dropped zero-area triangle that is the likely cause, if there is one.
pub fn load_closed(path: &Path) -> Result<(Mesh, RepairReport), MeshError> {
    let (mesh, report) = repair(read(path)?)?;
    match require_closed_manifold(&mesh) {
        Ok(()) => Ok((mesh, report)),
        Err(error) => Err(report.explain(error)),
    }
}
