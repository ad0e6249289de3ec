//! `meshsweep signed`: on which side points are, and how far from the surface.

use crate::args::{SearchArgs, SignedArgs, files};
use crate::ask::{self, Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::{
    BuildFor, Bvh, Ended, Interval, QueryError, ScratchEntry, Side, SignedDistance, Undecided, Work,
};
use std::io::{self, Write};

pub fn run(args: &SignedArgs) -> Result<(), Failure> {
    let file = &args.input.blob;
    refuse_same_file(args.search.output.as_deref(), &files(&[file], &args.input.points))?;
    let bytes = blob_file::read(file)?;
    let blob = blob_file::open(file, &bytes)?;
    let tree = served::require_tree(file, &blob, BuildFor::Closest)?;
    let points = Queries::read(&args.input.points)?;
    ask::run(&Signed { tree, search: &args.search }, points, &args.search)?;
    if !tree.is_closed() {
        // A closed standard error does not withhold the answers.
        let _ = writeln!(
            io::stderr(),
            "{}: was built from a mesh that is not closed, so every side is undefined; distances \
             are not",
            file.display()
        );
    }
    Ok(())
}

/// The side in a word.
pub fn name(side: Side) -> &'static str {
    match side {
        Side::Outside => "outside",
        Side::Inside => "inside",
        _ => "undefined",
    }
}

/// Why a side is undefined, in a word or two; nothing if it is not.
pub fn reason(side: Side) -> &'static str {
    match side {
        Side::Outside | Side::Inside => "",
        Side::Undecided(Undecided::OpenMesh) => "open mesh",
        Side::Undecided(Undecided::Steps) => "out of steps",
        Side::Undecided(Undecided::Scratch) => "out of stack",
        Side::Undecided(Undecided::OnSurface) => "at the surface",
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
        self.search.scratch(self.tree.scratch_entries())
    }

    fn ask(
        &self,
        point: [f32; 3],
        scratch: &mut Self::Memory,
    ) -> Result<SignedDistance, QueryError> {
        self.tree.signed_distance(point, self.search.budget(), scratch)
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
        let SignedDistance { distance: Interval { lower, upper }, side, closest, .. } = *answer;
        let [px, py, pz] = closest.point;
        write_numbers(out, point)?;
        write!(out, "{},{},", name(side), reason(side))?;
        write_numbers(out, &[lower, upper, px, py, pz])?;
        write_end(out, closest.triangle, closest.work)
    }
}
