//! `meshsweep within`: whether points are within a distance of the surface, or which triangles are.

use super::args::WithinArgs;
use super::blob_file;
use super::csv::Short;
use super::failure::Failure;
use super::points::{self, Question};
use super::served::{self, Need};
use meshsweep_core::query::tight;
use meshsweep_core::query::tree::{
    AllWithin, Neighbor, ScratchEntry, Verdict, Within, all_within, is_within,
};
use meshsweep_core::query::{Budget, Ended, QueryError, Work};
use meshsweep_core::{Bvh, TightHull};
use std::io::{self, Write};

const HEADER: &str = "x,y,z,within,triangle,work";

/// Triangles that fit at first; a point with more is asked again with as much room as it needs.
const TRIANGLES: usize = 64;

pub fn run(args: &WithinArgs) -> Result<(), Failure> {
    let distance = args.distance;
    if args.all {
        let found = vec![Neighbor::EMPTY; TRIANGLES];
        points::run(&args.input, &args.search, &All { distance, found })
    } else {
        let blob = &args.input.blob;
        points::refuse_blob_as_output(&args.input, &args.search)?;
        let bytes = blob_file::read(blob)?;
        let model = blob_file::open(blob, &bytes)?;
        let hull = served::tight_hull(blob, &model, args.tight)?;
        let tree = match &hull {
            Some(hull) => *hull.tree(),
            None => served::require_tree(blob, &model, Need::Distances)?,
        };
        points::ask(&args.input, &args.search, &tree, &Any { hull, distance })
    }
}

/// Whether the surface is within the distance.
#[derive(Clone)]
struct Any<'a> {
    /// By which the surface is known, if the tree asked is not its own but a hull's.
    hull: Option<TightHull<'a>>,
    distance: f32,
}

impl Question for Any<'_> {
    type Answer = Within;

    fn header(&self) -> &'static str {
        HEADER
    }

    fn is_by_hull(&self) -> bool {
        self.hull.is_some()
    }

    fn ask(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        stop: &Budget,
        stack: &mut [ScratchEntry],
    ) -> Result<Within, QueryError> {
        match &self.hull {
            Some(hull) => tight::is_within(hull, point, self.distance, stop, stack),
            None => is_within(tree, point, self.distance, stop, stack),
        }
    }

    fn outcome(answer: &Within) -> (Ended, Work) {
        (answer.ended, answer.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        [x, y, z]: &[f32; 3],
        answer: &Within,
    ) -> io::Result<()> {
        write!(out, "{},{},{},", Short(*x), Short(*y), Short(*z))?;
        match answer.verdict {
            Verdict::Yes { triangle: Some(triangle) } => write!(out, "yes,{triangle}")?,
            Verdict::Yes { triangle: None } => write!(out, "yes,")?,
            Verdict::No => write!(out, "no,")?,
            Verdict::Unknown => write!(out, "unknown,")?,
        }
        writeln!(out, ",{}", answer.work.total())
    }
}

/// Which triangles are within the distance.
#[derive(Clone)]
struct All {
    distance: f32,
    found: Vec<Neighbor>,
}

impl Question for All {
    type Answer = (AllWithin, Vec<Neighbor>);

    fn header(&self) -> &'static str {
        "query,within,lower,upper,px,py,pz,triangle,work"
    }

    fn ask(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        stop: &Budget,
        stack: &mut [ScratchEntry],
    ) -> Result<Self::Answer, QueryError> {
        let mut went = all_within(tree, point, self.distance, stop, &mut self.found, stack)?;
        if went.dropped > 0 {
            self.found.resize(went.stored + went.dropped as usize, Neighbor::EMPTY);
            went = all_within(tree, point, self.distance, stop, &mut self.found, stack)?;
        }
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
        let work = went.work.total();
        for (index, near) in found.iter().enumerate() {
            let verdict = if index < went.certain { "yes" } else { "unknown" };
            write!(out, "{query},{verdict},")?;
            points::write_near(out, near, work)?;
        }
        if went.ended != Ended::Exact {
            // Triangles may be missing.
            writeln!(out, "{query},unknown,,,,,,,{work}")?;
        } else if found.is_empty() {
            writeln!(out, "{query},no,,,,,,,{work}")?;
        }
        Ok(())
    }
}
