//! `meshsweep nearest`: the closest triangles of each point.

use crate::args::{NearestArgs, SearchArgs, files};
use crate::ask::{self, Question, write_neighbor};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::{BuildFor, Bvh, Ended, KNearest, Neighbor, QueryError, ScratchEntry, Work};
use std::io::{self, Write};

pub fn run(args: &NearestArgs) -> Result<(), Failure> {
    let file = &args.input.blob;
    refuse_same_file(args.search.output.as_deref(), &files(&[file], &args.input.points))?;
    let bytes = blob_file::read(file)?;
    let blob = blob_file::open(file, &bytes)?;
    let tree = served::require_tree(file, &blob, BuildFor::Closest)?;
    let points = Queries::read(&args.input.points)?;
    let question = Ranking { tree, count: args.count, search: &args.search };
    ask::run(&question, points, &args.search)
}

struct Ranking<'a> {
    tree: Bvh<'a>,
    count: u32,
    search: &'a SearchArgs,
}

impl Question<3> for Ranking<'_> {
    type Answer = (KNearest, Vec<Neighbor>);
    type Memory = (Vec<Neighbor>, Vec<ScratchEntry>);

    fn header(&self) -> &'static str {
        "query,rank,lower,upper,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        // There are no more triangles than the mesh has.
        let count = self.count.min(self.tree.triangle_count());
        (vec![Neighbor::EMPTY; count as usize], self.search.scratch(self.tree.scratch_entries()))
    }

    fn ask(
        &self,
        point: [f32; 3],
        (room, scratch): &mut Self::Memory,
    ) -> Result<Self::Answer, QueryError> {
        let found = self.tree.nearest(point, room, self.search.budget(), scratch)?;
        Ok((found, room.iter().take(found.stored).copied().collect()))
    }

    fn outcome((found, _): &Self::Answer) -> (Ended, Work) {
        (found.ended, found.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        _: &[f32; 3],
        (found, triangles): &Self::Answer,
    ) -> io::Result<()> {
        (1..).zip(triangles).try_for_each(|(rank, near): (usize, _)| {
            write!(out, "{query},{rank},")?;
            write_neighbor(out, near, found.work)
        })
    }
}
