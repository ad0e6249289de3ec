//! `meshsweep signed`: on which side points are, and how far from the surface.

use crate::args::{PointArgs, SignedArgs, files};
use crate::ask::{Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::side::{has_sideless, name, reason};
use crate::{blob_file, served};
use meshsweep::distances::{has_sides, signed_distance};
use meshsweep_core::{BuildFor, Interval, SignedDistance};
use std::io::{self, Write};

pub fn run(args: &SignedArgs) -> Result<(), Failure> {
    let SignedArgs { input: PointArgs { blob: file, points }, search } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let tree = served::require_tree(file, &blob_file::open(file)?, BuildFor::Closest)?;
    let header = "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work";
    Question::new(header, Queries::read(points)?, search).ask_each(
        tree.scratch_entries(),
        |point, scratch| signed_distance(&tree, point, search.budget(), scratch),
        |out, _, point, &SignedDistance { distance, side, closest, .. }| {
            let Interval { lower, upper } = distance;
            let [px, py, pz] = closest.point;
            write_numbers(out, point)?;
            write!(out, "{},{},", name(side), reason(side))?;
            write_numbers(out, &[lower, upper, px, py, pz])?;
            write_end(out, closest.triangle, closest.work)
        },
    )?;
    if !has_sides(&tree) || (has_sideless(&tree) && !tree.serves_winding()) {
        // A closed standard error does not withhold the answers.
        let why = match (tree.is_closed(), tree.has_sides()) {
            (false, _) => "the mesh is not closed, so every side is undecided",
            (_, false) => "no triangle tells a side, so every side is undecided",
            _ => "some triangles tell no side: where the nearest is one of them, it is undecided",
        };
        let _ = writeln!(
            io::stderr(),
            "{}: {why}; distances hold; --for closest,winding decides sides",
            file.display()
        );
    }
    Ok(())
}
