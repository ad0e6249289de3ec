//! `meshsweep refine`: the hull that a scene needs, out of a blob's hull hierarchy.

use crate::args::RefineArgs;
use crate::failure::Failure;
use crate::hull::enclosing;
use crate::output::{Output, refuse_other_extension, refuse_same_file};
use crate::{blob_file, served};
use meshsweep::counted::Counted;
use meshsweep::hull::mesh_of;
use meshsweep::mesh::write_ply;
use meshsweep::number::AtMost;
use meshsweep_core::{RefinedHull, Refinement};
use std::sync::{Mutex, PoisonError};

/// Splits that the hull may have: a mesh of two million triangles. Where they are not used they
/// take no memory.
const SPLITS: usize = 1 << 20;

/// Too large for a stack.
static REFINED: Mutex<RefinedHull<'static, SPLITS>> = Mutex::new(RefinedHull::new());

pub fn run(args: &RefineArgs) -> Result<(), Failure> {
    refuse_other_extension(&args.output, "ply", "the hull is written as PLY")?;
    refuse_same_file(Some(&args.output), &[&args.blob])?;
    let blob = blob_file::open(&args.blob)?;
    let hull = served::require_hull(&args.blob, &blob)?;
    let mut refined = REFINED.lock().unwrap_or_else(PoisonError::into_inner);
    let Refinement { error_left, .. } = refined
        .update(&hull, &args.focus(), args.error.unwrap_or(0.0), &mut [])
        .map_err(|error| Failure::Search { file: args.blob.clone(), error })?;
    let (mesh, note) = enclosing(&hull, &mesh_of(&hull, refined.faces(&hull)));
    Output::file(&args.output)?.finish(|out| write_ply(&mesh, out))?;
    Output::stdout().finish(|out| {
        writeln!(
            out,
            "{}: {} of {}, error left {}",
            args.output.display(),
            Counted(mesh.triangles.len(), "face"),
            hull.levels().last().map_or(0, |level| level.faces),
            AtMost(error_left)
        )?;
        note.map_or(Ok(()), |note| writeln!(out, "  {note}"))
    })
}
