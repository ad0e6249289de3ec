//! `meshsweep signed`: on which side points are, and how far from the surface.

use super::args::SignedArgs;
use super::failure::Failure;
use super::points::{self, Question};
use meshsweep_core::Tree;
use meshsweep_core::query::tree::{Side, SignedDistance, TreeEntry, signed_distance};
use meshsweep_core::query::{Ended, QueryError, Stop, Work};
use std::io::{self, Write};

pub fn run(args: &SignedArgs) -> Result<(), Failure> {
    points::run(&args.input, &args.search, Signed)
}

struct Signed;

impl Question for Signed {
    type Answer = SignedDistance;

    fn header(&self) -> &'static str {
        "x,y,z,side,lower,upper,px,py,pz,triangle,work"
    }

    fn ask(
        &mut self,
        tree: &Tree<'_>,
        point: [f32; 3],
        stop: &Stop,
        stack: &mut [TreeEntry],
    ) -> Result<SignedDistance, QueryError> {
        signed_distance(tree, point, stop, stack)
    }

    fn outcome(answer: &SignedDistance) -> (Ended, Work) {
        (answer.closest.ended, answer.closest.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        [x, y, z]: &[f32; 3],
        answer: &SignedDistance,
    ) -> io::Result<()> {
        let SignedDistance { lower, upper, side, closest } = answer;
        let side = match side {
            Side::Outside => "outside",
            Side::Inside => "inside",
            Side::Undefined => "undefined",
        };
        let [px, py, pz] = closest.point;
        write!(out, "{x},{y},{z},{side},{lower},{upper},{px},{py},{pz},")?;
        if let Some(triangle) = closest.triangle {
            write!(out, "{triangle}")?;
        }
        writeln!(out, ",{}", closest.work.total())
    }
}
