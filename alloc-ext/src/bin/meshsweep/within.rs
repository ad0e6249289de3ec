//! `meshsweep within`: whether points are within a distance of the surface, or of which triangles.

use crate::args::{SearchArgs, WithinArgs, files};
use crate::ask::{self, Question, verdict_name, write_end, write_neighbor, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, curve, served};
use meshsweep_core::{
    AllWithin, BuildFor, Bvh, Ended, Neighbor, QueryError, ScratchEntry, TightHull, Within, Work,
};
use std::io::{self, Write};

/// Room for triangles at first.
const TRIANGLES: usize = 64;

pub fn run(args: &WithinArgs) -> Result<(), Failure> {
    let file = &args.input.blob;
    refuse_same_file(args.search.output.as_deref(), &files(&[file], &args.input.points))?;
    let bytes = blob_file::read(file)?;
    let blob = blob_file::open(file, &bytes)?;
    if let Ok(curve) = blob.curve()
        && !args.all
        && args.tight.is_none()
    {
        return curve::within(curve, args, Queries::read(&args.input.points)?);
    }
    let hull = if args.all { None } else { served::tight_hull(file, &blob, args.tight)? };
    let tree = match &hull {
        Some(hull) => *hull.bvh(),
        None => served::require_tree(file, &blob, BuildFor::Closest)?,
    };
    let points = Queries::read(&args.input.points)?;
    let (search, distance) = (&args.search, args.distance);
    if args.all {
        ask::run(&All { tree, distance, search }, points, search)
    } else {
        ask::run(&Any { tree, hull, distance, search }, points, search)
    }
}

/// Whether the surface is within the distance.
struct Any<'a> {
    tree: Bvh<'a>,
    /// The hull that the tree is of, if the mesh's own tree is not asked.
    hull: Option<TightHull<'a>>,
    distance: f32,
    search: &'a SearchArgs,
}

impl Question<3> for Any<'_> {
    type Answer = Within;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        "x,y,z,within,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        self.search.scratch(self.tree.scratch_entries())
    }

    fn ask(&self, point: [f32; 3], scratch: &mut Self::Memory) -> Result<Within, QueryError> {
        let (distance, budget) = (self.distance, self.search.budget());
        match &self.hull {
            Some(hull) => hull.within(point, distance, budget, scratch),
            None => self.tree.within(point, distance, budget, scratch),
        }
    }

    fn outcome(answer: &Within) -> (Ended, Work) {
        (ask::ended(answer.verdict), answer.work)
    }

    fn is_by_hull(&self) -> bool {
        self.hull.is_some()
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        point: &[f32; 3],
        answer: &Within,
    ) -> io::Result<()> {
        write_numbers(out, point)?;
        write!(out, "{},", verdict_name(answer.verdict))?;
        write_end(out, answer.triangle, answer.work)
    }
}

/// Which triangles are within the distance.
struct All<'a> {
    tree: Bvh<'a>,
    distance: f32,
    search: &'a SearchArgs,
}

impl Question<3> for All<'_> {
    type Answer = (AllWithin, Vec<Neighbor>);
    type Memory = (Vec<Neighbor>, Vec<ScratchEntry>);

    fn header(&self) -> &'static str {
        "query,within,lower,upper,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        (vec![Neighbor::EMPTY; TRIANGLES], self.search.scratch(self.tree.scratch_entries()))
    }

    fn ask(
        &self,
        point: [f32; 3],
        (room, scratch): &mut Self::Memory,
    ) -> Result<Self::Answer, QueryError> {
        let budget = self.search.budget();
        ask::all(
            room,
            Neighbor::EMPTY,
            |room| self.tree.all_within(point, self.distance, room, budget, scratch),
            |found| (found.stored, found.dropped),
        )
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
        for (index, near) in triangles.iter().enumerate() {
            let verdict = if index < found.certain { "yes" } else { "unknown" };
            write!(out, "{query},{verdict},")?;
            write_neighbor(out, near, found.work)?;
        }
        let verdict = match found.ended {
            Ended::Exact if triangles.is_empty() => "no",
            Ended::Exact => return Ok(()),
            // Triangles may be missing.
            _ => "unknown",
        };
        write!(out, "{query},{verdict},,,,,,")?;
        write_end(out, None, found.work)
    }
}
