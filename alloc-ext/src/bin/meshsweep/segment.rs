//! `meshsweep segment`: segments in, first hits or all hits out.
//!
//! `unknown` means of a first hit: the segment is proved clear before `t`, and no more is certain.
//! Of all hits it means: the stored surface is hit there, and the mesh's may be.

use crate::args::{self, SearchArgs, SegmentArgs, files};
use crate::ask::{self, Question, write_end, write_numbers};
use crate::failure::{Failure, Place};
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::served::Engine;
use crate::{blob_file, served};
use meshsweep_core::internal::num::{exp2, tolerance};
use meshsweep_core::{
    AllHits, BuildFor, Ended, Facing, FirstHit, Hit, QueryError, ScratchEntry, Work,
};
use std::io::{self, Write};

/// Room for hits at first.
const HITS: usize = 64;

pub fn run(args: &SegmentArgs) -> Result<(), Failure> {
    let SegmentArgs { blob: file, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], &args.segments))?;
    if args.engine == Some(args::Engine::Hull) && args.facing.is_some() {
        let what = "--facing is for the box tree; leave it out, or use --engine tree".to_owned();
        return Err(Failure::Usage { what });
    }
    let bytes = blob_file::read(file)?;
    let blob = blob_file::open(file, &bytes)?;
    let engine = if args.facing.is_some() {
        Engine::Tree(served::require_tree(file, &blob, BuildFor::Segment)?)
    } else {
        let tree_chosen = args.engine.map(|engine| engine == args::Engine::Tree);
        served::choose(file, &blob, BuildFor::Segment, tree_chosen)?
    };
    let segments = Queries::read(&args.segments)?;
    let caster = Caster { engine, facing: args.facing(), search };
    if args.all {
        ask::run(&All(caster), segments, search)
    } else {
        ask::run(&First(caster), segments, search)
    }
}

/// The engine, and the limits of the search.
struct Caster<'a> {
    engine: Engine<'a>,
    facing: Facing,
    search: &'a SearchArgs,
}

impl Caster<'_> {
    fn scratch(&self) -> Vec<ScratchEntry> {
        self.search.scratch(self.engine.scratch_entries())
    }

    /// How far away the ends of segments may be, in the mesh's unit.
    fn limit(&self) -> String {
        match &self.engine {
            Engine::Tree(tree) => {
                let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
                let farthest = f64::from(tolerance::BVH_FAR) * unit;
                format!(
                    "the ways along x, y and z to the farthest corner of its box may add up to \
                     about {farthest:.1e}"
                )
            }
            Engine::Hull(hull) => {
                let farthest = tolerance::HULL_FAR * hull.scale();
                format!("a coordinate may be about {farthest:.1e} at most")
            }
        }
    }

    fn refuse(&self, place: Place, error: QueryError) -> Failure {
        match error {
            QueryError::OutOfDomain => Failure::TooFar { place, limit: self.limit() },
            error => Failure::Query { place, error },
        }
    }
}

/// The first hit of each segment.
struct First<'a>(Caster<'a>);

impl Question<6> for First<'_> {
    type Answer = FirstHit;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        "hit,t,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        self.0.scratch()
    }

    fn ask(&self, segment: [f32; 6], scratch: &mut Self::Memory) -> Result<FirstHit, QueryError> {
        let ([a, b], budget) = (ends(segment), self.0.search.budget());
        match &self.0.engine {
            Engine::Tree(tree) => tree.first_hit(a, b, self.0.facing, budget, scratch),
            Engine::Hull(hull) => hull.first_hit(a, b, budget, scratch),
        }
    }

    fn outcome(answer: &FirstHit) -> (Ended, Work) {
        (answer.ended, answer.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        segment: &[f32; 6],
        answer: &FirstHit,
    ) -> io::Result<()> {
        match answer.hit {
            _ if answer.is_clear() => write_clear(out, answer.work),
            Some(hit) if answer.ended == Ended::Exact => write_hit(out, "yes", hit, answer.work),
            _ => write_unknown(out, segment, answer.t.lower, None, answer.work),
        }
    }

    fn refuse(&self, place: Place, error: QueryError) -> Failure {
        self.0.refuse(place, error)
    }
}

/// All hits of each segment.
struct All<'a>(Caster<'a>);

impl Question<6> for All<'_> {
    type Answer = (AllHits, Vec<Hit>);
    type Memory = (Vec<Hit>, Vec<ScratchEntry>);

    fn header(&self) -> &'static str {
        "query,hit,t,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        (vec![Hit::EMPTY; HITS], self.0.scratch())
    }

    fn ask(
        &self,
        segment: [f32; 6],
        (room, scratch): &mut Self::Memory,
    ) -> Result<Self::Answer, QueryError> {
        let ([a, b], budget) = (ends(segment), self.0.search.budget());
        ask::all(
            room,
            Hit::EMPTY,
            |hits| match &self.0.engine {
                Engine::Tree(tree) => tree.all_hits(a, b, self.0.facing, hits, budget, scratch),
                Engine::Hull(hull) => hull.all_hits(a, b, hits, budget, scratch),
            },
            |found| (found.stored, found.dropped),
        )
    }

    fn outcome((found, _): &Self::Answer) -> (Ended, Work) {
        (found.ended, found.work)
    }

    /// A row for each hit; one row if there is none; one more if hits may be missing.
    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        segment: &[f32; 6],
        (found, hits): &Self::Answer,
    ) -> io::Result<()> {
        for &hit in hits {
            write!(out, "{query},")?;
            if found.ended == Ended::Resolution {
                // The surface may be from here on: `t` was rounded to nearest.
                let from = hit.t.next_down().max(0.0);
                write_unknown(out, segment, from, hit.triangle, found.work)?;
            } else {
                write_hit(out, "yes", hit, found.work)?;
            }
        }
        let may_miss = matches!(found.ended, Ended::Steps | Ended::Scratch);
        if hits.is_empty() && found.ended == Ended::Exact {
            write!(out, "{query},")?;
            write_clear(out, found.work)?;
        } else if hits.is_empty() || may_miss {
            write!(out, "{query},")?;
            write_unknown(out, segment, 0.0, None, found.work)?;
        }
        Ok(())
    }

    fn refuse(&self, place: Place, error: QueryError) -> Failure {
        self.0.refuse(place, error)
    }
}

fn ends([ax, ay, az, bx, by, bz]: [f32; 6]) -> [[f32; 3]; 2] {
    [[ax, ay, az], [bx, by, bz]]
}

fn write_clear(out: &mut dyn Write, work: Work) -> io::Result<()> {
    write!(out, "no,,,,,")?;
    write_end(out, None, work)
}

fn write_hit(out: &mut dyn Write, word: &str, hit: Hit, work: Work) -> io::Result<()> {
    let Hit { t, point: [x, y, z], triangle } = hit;
    write!(out, "{word},")?;
    write_numbers(out, &[t, x, y, z])?;
    write_end(out, triangle, work)
}

/// The surface may be met from the parameter `t` on.
fn write_unknown(
    out: &mut dyn Write,
    segment: &[f32; 6],
    t: f32,
    triangle: Option<u32>,
    work: Work,
) -> io::Result<()> {
    let [a, b] = ends(*segment).map(|end| end.map(f64::from));
    let point = core::array::from_fn(|k| (a[k] + (b[k] - a[k]) * f64::from(t)) as f32);
    write_hit(out, "unknown", Hit { t, point, triangle }, work)
}
