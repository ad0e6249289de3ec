//! `meshsweep nearest`: the closest triangles of each point.

use super::args::NearestArgs;
use super::failure::Failure;
use super::points::{self, Question};
use meshsweep_core::Tree;
use meshsweep_core::query::tree::{Near, Nearest, TreeEntry, nearest};
use meshsweep_core::query::{Ended, QueryError, Stop, Work};
use std::io::{self, Write};

pub fn run(args: &NearestArgs) -> Result<(), Failure> {
    let found = vec![Near::EMPTY; args.count as usize];
    points::run(&args.input, &args.search, &Ranking { found })
}

#[derive(Clone)]
struct Ranking {
    found: Vec<Near>,
}

impl Question for Ranking {
    type Answer = (Nearest, Vec<Near>);

    fn header(&self) -> &'static str {
        "query,rank,lower,upper,px,py,pz,triangle,work"
    }

    fn ask(
        &mut self,
        tree: &Tree<'_>,
        point: [f32; 3],
        stop: &Stop,
        stack: &mut [TreeEntry],
    ) -> Result<Self::Answer, QueryError> {
        // A mesh has no more triangles than that.
        self.found.truncate(tree.header().triangles as usize);
        let went = nearest(tree, point, stop, &mut self.found, stack)?;
        Ok((went, self.found.iter().take(went.stored).copied().collect()))
    }

    fn outcome((went, _): &Self::Answer) -> (Ended, Work) {
        (went.ended, went.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        _: &[f32; 3],
        (went, found): &Self::Answer,
    ) -> io::Result<()> {
        for (rank, near) in found.iter().enumerate() {
            write!(out, "{query},{},", rank + 1)?;
            points::write_near(out, near, went.work.total())?;
        }
        Ok(())
    }
}
