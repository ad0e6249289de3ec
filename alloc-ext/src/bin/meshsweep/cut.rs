//! `meshsweep cut`: a coarser blob from a finer one. A box tree holds all of the surface or
//! nothing, so it is left out beside a cut hull hierarchy.

use crate::args::CutArgs;
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use crate::{blob_file, served};
use meshsweep::counted::Counted;
use meshsweep::cut::{Keep, cut_blob};
use meshsweep_core::Blob;

pub fn run(args: &CutArgs) -> Result<(), Failure> {
    refuse_same_file(Some(&args.output), &[&args.blob])?;
    let blob = blob_file::open(&args.blob)?;
    if args.level.is_some() {
        served::require_hull(&args.blob, &blob)?;
    }
    if let Some(faces) = args.tight {
        served::require_tight(&args.blob, &blob, faces)?;
    }
    let mut keep = Keep::default();
    (keep.level, keep.triboxes, keep.tight) = (args.level, args.triboxes, args.tight);
    let cut = cut_blob(&blob, &keep).map_err(|error| Failure::build(&args.blob, error))?;
    // A blob that does not open must not be written.
    let left = Blob::open(&cut).map_err(|error| Failure::open(&args.output, error))?;
    Output::file(&args.output)?.finish(|out| out.write_all(&cut))?;
    Output::stdout().finish(|out| {
        let (kept, all) = (cut.len(), blob.bytes().len());
        let share = kept as f64 / all as f64 * 100.0;
        write!(
            out,
            "{}: {kept} of {} ({share:.1} %)",
            args.output.display(),
            Counted(all, "byte")
        )?;
        if let Some(level) = args.level {
            write!(out, ", levels 0 to {level}")?;
        }
        if let Some(triboxes) = left.triboxes().ok().filter(|_| args.triboxes.is_some()) {
            write!(out, ", {}", Counted(triboxes.leaf_count(), "tribox"))?;
        }
        if let Some(hulls) = left.tight_hulls().ok().filter(|_| args.tight.is_some()) {
            write!(out, ", {}", Counted(hulls.count(), "tight hull"))?;
        }
        writeln!(out)?;
        if blob.deformable_hull().is_ok() && left.deformable_hull().is_err() {
            writeln!(out, "key frames and moving vertices cannot be cut and are left out")?;
        }
        match blob.bvh().ok().filter(|_| args.level.is_some()) {
            Some(_) => writeln!(
                out,
                "the box tree cannot be cut and is left out: closest and segment sweep the hull"
            ),
            None => Ok(()),
        }
    })
}
