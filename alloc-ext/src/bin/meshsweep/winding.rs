//! `meshsweep winding`: how often the mesh encloses each point.

use crate::args::{PointArgs, WindingArgs, files};
use crate::ask::{Question, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::side::{name, reason};
use crate::{blob_file, served};
use meshsweep_core::{BuildFor, WindingNumber};

pub fn run(args: &WindingArgs) -> Result<(), Failure> {
    let WindingArgs { input: PointArgs { blob: file, points }, abs, search } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], points))?;
    let tree = served::require_tree(file, &blob_file::open(file)?, BuildFor::Winding)?;
    let budget = search.budget().with_absolute(*abs);
    Question::new("x,y,z,side,reason,lower,upper,work", Queries::read(points)?, search).ask_each(
        tree.scratch_entries(),
        |point, scratch| tree.winding_number(point, budget, scratch),
        |out, _, point, &WindingNumber { number, side, work, .. }| {
            write_numbers(out, point)?;
            write!(out, "{},{},", name(side), reason(side))?;
            write_numbers(out, &[number.lower, number.upper])?;
            writeln!(out, "{}", work.total())
        },
    )
}
