//! `meshsweep signed`: on which side points are, and how far from the surface.

use crate::args::{SearchArgs, SignedArgs, files};
use crate::ask::{self, Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::need::Need;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{ScratchEntry, Side, SignedDistance, signed_distance};
use meshsweep_core::query::{ClosestPoint, Ended, QueryError, Work};
use std::io::{self, Write};

pub fn run(args: &SignedArgs) -> Result<(), Failure> {
    let blob = &args.input.blob;
    refuse_same_file(args.search.output.as_deref(), &files(&[blob], &args.input.points))?;
    let bytes = blob_file::read(blob)?;
    let model = blob_file::open(blob, &bytes)?;
    let tree = served::require_tree(blob, &model, Need::Distances)?;
    let points = Queries::read(&args.input.points)?;
    ask::run(&Signed { tree, search: &args.search }, points, &args.search)?;
    if !tree.header().is_closed() {
        // A closed standard error does not withhold the answers.
        let _ = writeln!(
            io::stderr(),
            "{}: was built from a mesh that is not closed, so every side is undefined; distances \
             are not",
            blob.display()
        );
    }
    Ok(())
}

/// The side in a word.
pub fn name(side: Side) -> &'static str {
    match side {
        Side::Outside => "outside",
        Side::Inside => "inside",
        Side::Undefined => "undefined",
    }
}

/// Why a side is undefined.
pub fn reason(tree: &Bvh<'_>, answer: &SignedDistance) -> &'static str {
    let ClosestPoint { lower, ended, .. } = answer.closest;
    match (answer.side, ended) {
        (Side::Outside | Side::Inside, _) => "",
        _ if !tree.header().is_closed() => "open mesh",
        (_, Ended::Steps) => "out of steps",
        (_, Ended::Capacity) => "out of stack",
        _ if lower <= 0.0 => "at the surface",
        _ => "rounding",
    }
}

struct Signed<'a> {
    tree: Bvh<'a>,
    search: &'a SearchArgs,
}

impl Question<3> for Signed<'_> {
    type Answer = SignedDistance;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        self.search.stack(&self.tree)
    }

    fn ask(&self, point: [f32; 3], stack: &mut Self::Memory) -> Result<SignedDistance, QueryError> {
        signed_distance(&self.tree, point, &self.search.budget(0.0, 0.0), stack)
    }

    fn outcome(answer: &SignedDistance) -> (Ended, Work) {
        (answer.closest.ended, answer.closest.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        point: &[f32; 3],
        answer: &SignedDistance,
    ) -> io::Result<()> {
        let SignedDistance { lower, upper, side, closest } = answer;
        let [px, py, pz] = closest.point;
        write_numbers(out, point)?;
        write!(out, "{},{},", name(*side), reason(&self.tree, answer))?;
        write_numbers(out, &[*lower, *upper, px, py, pz])?;
        write_end(out, closest.triangle, closest.work)
    }
}
