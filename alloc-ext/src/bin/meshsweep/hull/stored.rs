//! Hulls that a blob holds: levels of its hull hierarchy, and its tight hulls.

use super::written::{self, Of, Written};
use crate::args::HullArgs;
use crate::failure::Failure;
use crate::output::Output;
use crate::{blob_file, describe, served};
use meshsweep::BuildError;
use meshsweep::hull::{enclosing_input, mesh_of, sticks_out_note};
use meshsweep::mesh::{Mesh, write_ply};
use meshsweep::tight::hull_mesh;
use meshsweep::tribox::volume;
use meshsweep_core::Hull;

/// Writes the finest tight hull of at most so many faces.
pub fn write_tight(args: &HullArgs, faces: u32) -> Result<(), Failure> {
    let blob = blob_file::open(&args.input)?;
    let hull = served::require_tight(&args.input, &blob, faces)?;
    Output::file(&args.output)?.finish(|out| write_ply(&hull_mesh(&hull), out))?;
    let record = hull.record();
    let off = f64::from(hull.bvh().surface_error());
    let written = Written {
        faces: record.faces as usize,
        void: describe::tight::void(record).map(f64::from),
        at_most: Some(f64::from(record.slack) + off),
        ..Written::default()
    };
    written::report(args, &Of::Blob, &[written], &[])
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
    let stored = mesh_of(&hierarchy, hierarchy.faces(&level));
    let (hull, note) = enclosing(&hierarchy, &stored);
    let void = f64::from(level.void_ratio);
    let void = match hull == stored {
        true => void,
        false => (1.0 + void) * volume(&hull) / volume(&stored) - 1.0,
    };
    Output::file(&args.output)?.finish(|out| write_ply(&hull, out))?;
    let written = Written {
        faces: hull.triangles.len(),
        void: Some(void),
        level: Some([index, levels - 1]),
        notes: note.into_iter().collect(),
        ..Written::default()
    };
    written::report(args, &Of::Blob, &[written], &[])
}

/// A hull that encloses the input; or the stored one, and how far the input sticks out.
pub fn enclosing(hierarchy: &Hull<'_>, stored: &Mesh) -> (Mesh, Option<String>) {
    match enclosing_input(hierarchy, stored) {
        Some(hull) => (hull, None),
        None => (stored.clone(), sticks_out_note(f64::from(hierarchy.surface_error()))),
    }
}
