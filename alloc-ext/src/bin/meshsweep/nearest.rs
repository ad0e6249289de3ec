//! `meshsweep nearest`: the closest triangles of each point.

use super::args::NearestArgs;
use super::failure::Failure;
use super::points::{self, Question};
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{Nearest, Neighbor, ScratchEntry, nearest};
use meshsweep_core::query::{Budget, Ended, QueryError, Work};
use std::io::{self, Write};

pub fn run(args: &NearestArgs) -> Result<(), Failure> {
    let found = vec![Neighbor::EMPTY; args.count as usize];
    points::run(&args.input, &args.search, &Ranking { found })
}

#[derive(Clone)]
struct Ranking {
    found: Vec<Neighbor>,
}

impl Question for Ranking {
    type Answer = (Nearest, Vec<Neighbor>);

    fn header(&self) -> &'static str {
        "query,rank,lower,upper,px,py,pz,triangle,work"
    }

    fn ask(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        stop: &Budget,
        stack: &mut [ScratchEntry],
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
