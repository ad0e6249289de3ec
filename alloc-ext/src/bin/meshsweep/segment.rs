//! `meshsweep segment`: segments in, first hits or all hits out.
//!
//! `unknown` means of a first hit: the segment is proved clear before `t`, and no more is certain.
//! Of all hits it means: the stored surface is hit there, and the mesh's may be.

use crate::args::{Engine, SearchArgs, SegmentArgs, files};
use crate::ask::{self, Question, write_end, write_numbers};
use crate::failure::{Failure, Place};
use crate::need::Need;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::num::{exp2, tolerance};
use meshsweep_core::query::tree::{self, Facing, ScratchEntry};
use meshsweep_core::query::{AllHits, Ended, Hit, SegmentHit, Work, all_hits, first_hit};
use meshsweep_core::{Bvh, Model, QueryError, QueueEntry};
use std::io::{self, Write};

/// Room for hits at first.
const HITS: usize = 64;

pub fn run(args: &SegmentArgs) -> Result<(), Failure> {
    let SegmentArgs { blob, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[blob], &args.segments))?;
    let usage = |what: &str| Err(Failure::Usage { what: what.to_owned() });
    let limits_tree =
        || usage("--steps is for the cover tree; leave it out, or add --engine cover");
    if args.engine == Some(Engine::Tree) && search.steps.is_some() {
        return limits_tree();
    }
    if args.engine == Some(Engine::Cover) && args.facing.is_some() {
        return usage("--facing is for the box tree; leave it out, or use --engine tree");
    }
    let bytes = blob_file::read(blob)?;
    let model = blob_file::open(blob, &bytes)?;
    let tree_chosen = args.engine.map(|engine| engine == Engine::Tree);
    let tree = served::choose(blob, &model, Need::Segments, tree_chosen)?;
    if tree.is_some() && search.steps.is_some() {
        return limits_tree();
    }
    if tree.is_none() && args.facing.is_some() {
        // Only the box tree tells sides.
        served::require_tree(blob, &model, Need::Segments)?;
    }
    let segments = Queries::read(&args.segments)?;
    let caster = Caster { model: &model, tree, facing: args.facing(), search };
    if args.all {
        ask::run(&All(caster), segments, search)
    } else {
        ask::run(&First(caster), segments, search)
    }
}

/// What is asked, and what limits the search.
struct Caster<'a> {
    model: &'a Model<'a>,
    /// `None` for the cover tree.
    tree: Option<Bvh<'a>>,
    facing: Facing,
    search: &'a SearchArgs,
}

struct Memory {
    stack: Vec<ScratchEntry>,
    queue: Vec<QueueEntry>,
    hits: Vec<Hit>,
}

impl Caster<'_> {
    fn memory(&self) -> Memory {
        let hits = vec![Hit::EMPTY; HITS];
        match &self.tree {
            Some(tree) => Memory { stack: self.search.stack(tree), queue: Vec::new(), hits },
            None => Memory { stack: Vec::new(), queue: self.search.queue(self.model), hits },
        }
    }

    /// How far away the ends of segments may be, in the mesh's unit.
    fn limit(&self) -> String {
        match &self.tree {
            Some(tree) => {
                let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
                let farthest = f64::from(tolerance::TREE_FAR) * unit;
                format!(
                    "the ways along x, y and z to the farthest corner of its box may add up to \
                     about {farthest:.1e}"
                )
            }
            None => {
                let farthest = tolerance::FAR * self.model.scale();
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
    type Answer = SegmentHit;
    type Memory = Memory;

    fn header(&self) -> &'static str {
        "hit,t,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Memory {
        self.0.memory()
    }

    fn ask(&self, segment: [f32; 6], memory: &mut Memory) -> Result<SegmentHit, QueryError> {
        let Caster { model, tree, facing, search } = &self.0;
        let [a, b] = ends(segment);
        match tree {
            Some(tree) => tree::first_hit(tree, a, b, facing, &mut memory.stack),
            None => first_hit(model, a, b, &search.budget(0.0, 0.0), &mut memory.queue),
        }
    }

    fn outcome(answer: &SegmentHit) -> (Ended, Work) {
        (answer.ended, answer.work)
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        segment: &[f32; 6],
        answer: &SegmentHit,
    ) -> io::Result<()> {
        match answer.hit {
            _ if answer.is_clear() => write_clear(out, answer.work),
            Some(hit) if answer.ended == Ended::Exact => write_hit(out, "yes", hit, answer.work),
            _ => write_unknown(out, segment, answer.lower, None, answer.work),
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
    type Memory = Memory;

    fn header(&self) -> &'static str {
        "query,hit,t,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Memory {
        self.0.memory()
    }

    fn ask(&self, segment: [f32; 6], memory: &mut Memory) -> Result<Self::Answer, QueryError> {
        let Caster { model, tree, facing, .. } = &self.0;
        let Memory { stack, queue, hits } = memory;
        let [a, b] = ends(segment);
        ask::all(
            hits,
            Hit::EMPTY,
            |hits| match tree {
                Some(tree) => tree::all_hits(tree, a, b, facing, hits, stack),
                None => all_hits(model, a, b, queue, hits),
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
            if found.ended == Ended::Level {
                // The surface may be from here on: `t` was rounded to nearest.
                let from = hit.t.next_down().max(0.0);
                write_unknown(out, segment, from, hit.triangle, found.work)?;
            } else {
                write_hit(out, "yes", hit, found.work)?;
            }
        }
        match found.ended {
            Ended::Exact if hits.is_empty() => {
                write!(out, "{query},")?;
                write_clear(out, found.work)
            }
            // Hits may be missing anywhere.
            ended if ended == Ended::Capacity || hits.is_empty() => {
                write!(out, "{query},")?;
                write_unknown(out, segment, 0.0, None, found.work)
            }
            _ => Ok(()),
        }
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
