//! `meshsweep clear`: straight moves of a convex tool in, whether the whole move is clear out.

use crate::args::{ClearArgs, files};
use crate::ask::{Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::internal::num::{exp2, tolerance, up_to_f32};
use meshsweep_core::{BuildFor, Ended, Solid};

pub fn run(args: &ClearArgs) -> Result<(), Failure> {
    let ClearArgs { blob: file, moves, path, tool, radius, search } = args;
    let read = [files(&[file], moves), files(&[], path)].concat();
    refuse_same_file(search.output.as_deref(), &read)?;
    let blob = blob_file::open(file)?;
    let tree = served::require_tree(file, &blob, BuildFor::Segment)?;
    let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
    let farthest = tolerance::OVERLAP_FARTHEST * unit;
    if f64::from(*radius) > farthest {
        let what = format!("--radius {radius:e}: for this blob it is {farthest:.1e} at most");
        return Err(Failure::Usage { what });
    }
    let limit = format!("a corner of the tool may be about {farthest:.1e} from the mesh at most");
    let moves = if path.is_empty() {
        Queries::read(moves)?
    } else {
        Queries::read(path)?.moves(|[ax, ay, az], [bx, by, bz]| [ax, ay, az, bx, by, bz])?
    };
    let header = "clear,t,px,py,pz,triangle,work";
    let question = Question { limit: Some(limit), ..Question::new(header, moves, search) };
    question.ask_each(
        tree.scratch_entries(),
        |[ax, ay, az, bx, by, bz], scratch| {
            let ends = [[ax, ay, az], [bx, by, bz]].map(|place| tool.at(place));
            let [(from, off), (to, off_there)] = ends;
            // Corners that were rounded: the tool is within this of them.
            let radius = up_to_f32(f64::from(*radius) + off.max(off_there));
            let (from, to) = (Solid::new(&from, radius)?, Solid::new(&to, radius)?);
            tree.solid_first_contact(&from, &to, search.budget(), scratch)
        },
        |out, _, _, found| {
            let work = found.work;
            if found.is_clear() {
                write!(out, "yes,,,,,")?;
                return write_end(out, None, work);
            }
            let word = if found.ended == Ended::Exact { "no" } else { "undecided" };
            write!(out, "{word},")?;
            match found.hit {
                Some(hit) => {
                    let [x, y, z] = hit.point;
                    write_numbers(out, &[found.t.lower, x, y, z])?;
                }
                None => {
                    write_numbers(out, &[found.t.lower])?;
                    write!(out, ",,,")?;
                }
            }
            write_end(out, found.hit.and_then(|hit| hit.triangle), work)
        },
    )
}
