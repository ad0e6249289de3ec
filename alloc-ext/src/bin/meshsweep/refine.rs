//! `meshsweep refine`: the hull that a scene needs, out of a blob's hull hierarchy.

use crate::args::RefineArgs;
use crate::failure::Failure;
use crate::hull::enclosing;
use crate::output::{Output, refuse_other_extension, refuse_same_file};
use crate::{blob_file, served};
use meshsweep::counted::Counted;
use meshsweep::hull::{mesh_of, placed_mesh};
use meshsweep::mesh::{Mesh, write_ply};
use meshsweep::number::{AtLeast, AtMost};
use meshsweep_core::{
    Blob, Budget, Hull, Interval, QueryError, RefinedHull, Refinement, ScratchEntry,
};
use std::sync::{Mutex, PoisonError};

/// Splits that the hull may have: a mesh of two million triangles. Where they are not used they
/// take no memory.
const SPLITS: usize = 1 << 20;

/// Too large for a stack.
static REFINED: Mutex<RefinedHull<'static, SPLITS>> = Mutex::new(RefinedHull::new());

/// A refined hull, and what is said of it.
struct Written {
    mesh: Mesh,
    /// The largest error that the memory was too short for.
    error_left: f32,
    notes: Vec<String>,
}

pub fn run(args: &RefineArgs) -> Result<(), Failure> {
    refuse_other_extension(&args.output, "ply", "the hull is written as PLY")?;
    refuse_same_file(Some(&args.output), &[&args.blob])?;
    let blob = blob_file::open(&args.blob)?;
    let hull = served::require_hull(&args.blob, &blob)?;
    let mut refined = REFINED.lock().unwrap_or_else(PoisonError::into_inner);
    let Written { mesh, error_left, notes } = match args.sweep {
        Some(point) => swept(args, &blob, &hull, point, &mut refined)?,
        None => focused(args, &hull, &mut refined)?,
    };
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
        notes.iter().try_for_each(|note| writeln!(out, "  {note}"))
    })
}

fn search(args: &RefineArgs, error: QueryError) -> Failure {
    Failure::Search { file: args.blob.clone(), error }
}

/// Fine where a focus is.
fn focused(
    args: &RefineArgs,
    hull: &Hull<'static>,
    refined: &mut RefinedHull<'static, SPLITS>,
) -> Result<Written, Failure> {
    let Refinement { error_left, .. } = refined
        .update(hull, &args.focus(), args.error.unwrap_or(0.0), &mut [])
        .map_err(|error| search(args, error))?;
    let (mesh, note) = enclosing(hull, &mesh_of(hull, refined.faces(hull)));
    Ok(Written { mesh, error_left, notes: note.into_iter().collect() })
}

/// What a sweep about a point ends with.
fn swept(
    args: &RefineArgs,
    blob: &Blob<'static>,
    hull: &Hull<'static>,
    point: [f32; 3],
    refined: &mut RefinedHull<'static, SPLITS>,
) -> Result<Written, Failure> {
    let refuse = |error| search(args, error);
    let mut scratch = vec![ScratchEntry::EMPTY; hull.scratch_entries()];
    let (near, swept, mesh, note) = if let Some(frame) = args.frame {
        let (at, _) = served::require_frame(&args.blob, blob, frame)?;
        let near = at.closest_point(point, Budget::EXACT, &mut scratch).map_err(refuse)?;
        let swept = refined.sweep_to(&at, point, near.distance.upper).map_err(refuse)?;
        let mesh = placed_mesh(hull, refined.faces(hull), |vertex| at.vertex(vertex));
        (near, swept, mesh, None)
    } else {
        let near = hull.closest_point(point, Budget::EXACT, &mut scratch).map_err(refuse)?;
        let swept = refined.sweep_to(hull, point, near.distance.upper).map_err(refuse)?;
        let (mesh, note) = enclosing(hull, &mesh_of(hull, refined.faces(hull)));
        (near, swept, mesh, note)
    };
    let Interval { lower, upper } = near.distance;
    let distance = format!("distance {} to {}", AtLeast(f64::from(lower)), AtMost(upper));
    let notes = [distance].into_iter().chain(note).collect();
    Ok(Written { mesh, error_left: swept.error_left, notes })
}
