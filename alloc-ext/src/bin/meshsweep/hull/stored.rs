//! Hulls that a blob holds: levels of its hull hierarchy, and its tight hulls.

use crate::args::HullArgs;
use crate::failure::Failure;
use crate::output::Output;
use crate::{blob_file, describe, served};
use meshsweep::BuildError;
use meshsweep::counted::Counted;
use meshsweep::mesh::{Mesh, write_ply};
use meshsweep::number::{AtMost, Percent};
use meshsweep::tight::hull_mesh;
use meshsweep_core::{Hull, HullFace, VertIdx};

/// Writes the finest tight hull of at most so many faces.
pub fn write_tight(args: &HullArgs, faces: u32) -> Result<(), Failure> {
    let blob = blob_file::open(&args.input)?;
    let hull = served::require_tight(&args.input, &blob, faces)?;
    Output::file(&args.output)?.finish(|out| write_ply(&hull_mesh(&hull), out))?;
    Output::stdout().finish(|out| {
        let record = hull.record();
        write!(out, "{}: {}, ", args.output.display(), Counted(record.faces, "face"))?;
        if let Some(void) = describe::tight::void(record) {
            write!(out, "{} % void space, ", Percent(f64::from(void) * 100.0))?;
        }
        writeln!(out, "at most {} from the mesh", AtMost(record.slack))
    })
}

/// Writes level `index` of the hull hierarchy.
pub fn write_level(args: &HullArgs, index: u32) -> Result<(), Failure> {
    let blob = blob_file::open(&args.input)?;
    let hierarchy = served::require_hulls(&args.input, &blob)?;
    let levels = hierarchy.header().levels;
    let no_level = || Failure::Build {
        file: args.input.clone(),
        error: BuildError::NoLevel { wanted: index, levels },
    };
    let level = hierarchy.level(index).ok_or_else(no_level)?;
    let hull = mesh_of(&hierarchy, hierarchy.faces(&level));
    Output::file(&args.output)?.finish(|out| write_ply(&hull, out))?;
    Output::stdout().finish(|out| {
        writeln!(
            out,
            "{}: {}, {} % void space, level {index} of 0 to {}",
            args.output.display(),
            Counted(hull.triangles.len(), "face"),
            Percent(f64::from(level.void_ratio) * 100.0),
            levels - 1
        )
    })
}

/// Faces of a hull as a mesh in the mesh's unit. The scale is a power of two, so its vertices are
/// exactly the stored ones.
pub fn mesh_of(hull: &Hull<'_>, faces: impl Iterator<Item = HullFace>) -> Mesh {
    let mut number = vec![None; hull.header().vertices as usize];
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for face in faces {
        triangles.push(face.corners.map(|vertex: VertIdx| {
            *number[vertex.usize()].get_or_insert_with(|| {
                positions.push(hull.vertex(vertex).unwrap_or_default());
                positions.len() as u32 - 1
            })
        }));
    }
    Mesh::new(positions, triangles)
}
