//! `meshsweep cull`: the triangles that may face the eye.

use crate::args::CullArgs;
use crate::blob_file;
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use crate::served;
use meshsweep::counted::Counted;
use meshsweep_core::BuildFor;
use std::io::Write;

pub fn run(args: &CullArgs) -> Result<(), Failure> {
    let output = args.output.as_deref();
    refuse_same_file(output, &[&args.blob])?;
    let blob = blob_file::open(&args.blob)?;
    let tree = served::require_tree(&args.blob, &blob, BuildFor::Cull)?;
    let output = Output::file_or_stdout(output)?;
    let mut triangles = vec![0; tree.triangle_count() as usize];
    let found = tree
        .front_facing(args.eye(), &mut triangles)
        .map_err(|error| Failure::Search { file: args.blob.clone(), error })?;
    triangles.truncate(found.stored);
    triangles.sort_unstable();
    output.finish(|out| {
        writeln!(out, "triangle")?;
        triangles.iter().try_for_each(|triangle| writeln!(out, "{triangle}"))
    })?;
    // A closed standard error does not withhold the answers.
    let _ = writeln!(
        std::io::stderr(),
        "{} of {} certainly show their backs, {} of {} whole; the others are listed",
        found.culled,
        Counted(tree.triangle_count(), "triangle"),
        found.culled_leaves,
        Counted(found.leaves, "leaf")
    );
    Ok(())
}
