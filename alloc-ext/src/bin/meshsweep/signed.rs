//! `meshsweep signed`: on which side points are, and how far from the surface.

use super::args::SignedArgs;
use super::csv::Short;
use super::failure::Failure;
use super::points::{self, Question};
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{ScratchEntry, Side, SignedDistance, signed_distance};
use meshsweep_core::query::{Budget, ClosestPoint, Ended, QueryError, Work};
use std::io::{self, Write};
use std::path::Path;

pub fn run(args: &SignedArgs) -> Result<(), Failure> {
    points::run(&args.input, &args.search, &Signed)
}

/// The side in a word.
pub fn name(side: Side) -> &'static str {
    match side {
        Side::Outside => "outside",
        Side::Inside => "inside",
        Side::Undefined => "undefined",
    }
}

#[derive(Clone)]
struct Signed;

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

impl Question for Signed {
    type Answer = (SignedDistance, &'static str);

    fn header(&self) -> &'static str {
        "x,y,z,side,reason,lower,upper,px,py,pz,triangle,work"
    }

    fn ask(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        stop: &Budget,
        stack: &mut [ScratchEntry],
    ) -> Result<Self::Answer, QueryError> {
        let answer = signed_distance(tree, point, stop, stack)?;
        Ok((answer, reason(tree, &answer)))
    }

    fn outcome((answer, _): &Self::Answer) -> (Ended, Work) {
        (answer.closest.ended, answer.closest.work)
    }

    fn remark(&self, blob: &Path, tree: &Bvh<'_>) {
        if !tree.header().is_closed() {
            // A standard error that is closed is no reason to withhold the answers.
            let _ = writeln!(
                io::stderr(),
                "{}: was built from a mesh that is not closed, so every side is undefined; distances are not",
                blob.display()
            );
        }
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        [x, y, z]: &[f32; 3],
        (answer, reason): &Self::Answer,
    ) -> io::Result<()> {
        let SignedDistance { lower, upper, side, closest } = answer;
        let [px, py, pz] = closest.point;
        write!(out, "{},{},{},{},{reason},", Short(*x), Short(*y), Short(*z), name(*side))?;
        for number in [lower, upper, &px, &py, &pz] {
            write!(out, "{},", Short(*number))?;
        }
        if let Some(triangle) = closest.triangle {
            write!(out, "{triangle}")?;
        }
        writeln!(out, ",{}", closest.work.total())
    }
}
