//! `meshsweep segment`: segments or rays in, first hits or all hits out.
//!
//! `undecided` means of a first hit: the segment is proved clear before `t`, and no more is
//! certain. Of one of all hits it means: the stored triangle is hit there, and the mesh's may be.
//! Without a triangle, after all hits, it means: other triangles may be hit.

use crate::args::{self, SegmentArgs, files};
use crate::ask::{self, Answer, Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::served::Engine;
use crate::{blob_file, served, triboxes};
use meshsweep::bvh::FastBvh;
use meshsweep_core::internal::num::{exp2, tolerance};
use meshsweep_core::{BuildFor, Ended, FrameHull, Hit, Hull, TriangleHit, Work};
use std::io::{self, Write};

/// Hits that fit the buffer at first.
const HITS: usize = 64;

pub fn run(args: &SegmentArgs) -> Result<(), Failure> {
    let SegmentArgs { blob: file, search, .. } = args;
    refuse_same_file(search.output.as_deref(), &files(&[file], &args.segments))?;
    if args.engine == Some(args::Engine::Hull) && args.facing.is_some() {
        let what = "--facing is for the box tree; leave it out, or use --engine tree".to_owned();
        return Err(Failure::Usage { what });
    }
    let blob = blob_file::open(file)?;
    if args.triboxes {
        return triboxes::segment(args, &blob);
    }
    let engine = if let Some(frame) = args.frame {
        let (hull, entries) = served::require_frame(file, &blob, frame)?;
        Asked::Frame(hull, served::require_hull(file, &blob)?, entries)
    } else if args.facing.is_some() {
        Asked::Rest(Engine::Tree(served::require_tree(file, &blob, BuildFor::Segment)?))
    } else {
        let tree_chosen = args.engine.map(|engine| engine == args::Engine::Tree);
        Asked::Rest(served::choose(file, &blob, BuildFor::Segment, tree_chosen)?)
    };
    let question = |header| {
        let segments = Queries::read(&args.segments)?;
        let limit = Some(farthest(&engine.rest(), args.rays));
        Ok(Question { limit, ..Question::new(header, segments, search) })
    };
    if args.all {
        ask_all(args, engine, question("query,hit,t,px,py,pz,triangle,work")?)
    } else {
        ask_first(args, engine, question("hit,t,px,py,pz,triangle,work")?)
    }
}

/// What segments are asked of.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "the program makes one")]
enum Asked<'a> {
    Rest(Engine<'a>),
    /// A mesh at a key frame, the same at rest, and the scratch entries to ask it with.
    Frame(FrameHull<'a>, Hull<'a>, usize),
}

impl<'a> Asked<'a> {
    fn rest(&self) -> Engine<'a> {
        match self {
            Asked::Rest(engine) => *engine,
            Asked::Frame(_, hull, _) => Engine::Hull(*hull),
        }
    }

    fn scratch_entries(&self) -> usize {
        match self {
            Asked::Rest(engine) => engine.scratch_entries(),
            Asked::Frame(_, _, entries) => *entries,
        }
    }
}

/// How far away the ends of segments, or the origins of rays, may be, in the mesh's unit.
fn farthest(engine: &Engine<'_>, is_ray: bool) -> String {
    let part = if is_ray { 0.25 } else { 1.0 };
    match engine {
        Engine::Tree(tree) => {
            let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
            let farthest = part * f64::from(tolerance::BVH_FAR) * unit;
            format!(
                "the ways along x, y and z to the farthest corner of its box may add up to about \
                 {farthest:.1e}"
            )
        }
        Engine::Hull(hull) => {
            let farthest = part * tolerance::HULL_FAR * hull.scale();
            format!("a coordinate may be about {farthest:.1e} at most")
        }
    }
}

/// Asks for the first hit of each segment.
fn ask_first(
    args: &SegmentArgs,
    engine: Asked<'_>,
    question: Question<'_, 6>,
) -> Result<(), Failure> {
    let (facing, budget) = (args.facing(), args.search.budget());
    question.ask_each(
        engine.scratch_entries(),
        |segment, scratch| {
            let [a, b] = ends(segment);
            match &engine {
                Asked::Rest(Engine::Tree(tree)) if args.rays => {
                    tree.first_hit_of_ray(a, b, facing, budget, scratch)
                }
                Asked::Rest(Engine::Tree(tree)) => {
                    FastBvh::new(*tree).first_hit(a, b, facing, budget, scratch)
                }
                Asked::Rest(Engine::Hull(hull)) if args.rays => {
                    hull.first_hit_of_ray(a, b, budget, scratch)
                }
                Asked::Rest(Engine::Hull(hull)) => hull.first_hit(a, b, budget, scratch),
                Asked::Frame(hull, ..) => hull.first_hit(a, b, budget, scratch),
            }
        },
        |out, _, segment, found| match found.hit {
            _ if found.is_clear() => write_clear(out, found.work),
            Some(hit) if found.ended == Ended::Exact => write_hit(out, "yes", hit, found.work),
            _ => write_undecided(out, line(segment, args.rays), found.t.lower, None, found.work),
        },
    )
}

/// Asks for all hits of each segment. Writes a row for each hit; one row if there is none; one more
/// if triangles may be missing.
fn ask_all(
    args: &SegmentArgs,
    engine: Asked<'_>,
    question: Question<'_, 6>,
) -> Result<(), Failure> {
    let (facing, budget) = (args.facing(), args.search.budget());
    question.ask(
        || {
            let mut scratch = args.search.scratch(engine.scratch_entries());
            let mut buffer = vec![TriangleHit::EMPTY; HITS];
            move |segment| {
                let [a, b] = ends(segment);
                let (all, found) = ask::all(
                    &mut buffer,
                    TriangleHit::EMPTY,
                    |hits| match &engine {
                        Asked::Rest(Engine::Tree(tree)) if args.rays => {
                            tree.all_hits_of_ray(a, b, facing, hits, budget, &mut scratch)
                        }
                        Asked::Rest(Engine::Hull(hull)) if args.rays => {
                            hull.all_hits_of_ray(a, b, hits, budget, &mut scratch)
                        }
                        Asked::Rest(Engine::Tree(tree)) => {
                            tree.all_hits(a, b, facing, hits, budget, &mut scratch)
                        }
                        Asked::Rest(Engine::Hull(hull)) => {
                            hull.all_hits(a, b, hits, budget, &mut scratch)
                        }
                        Asked::Frame(hull, ..) => hull.all_hits(a, b, hits, budget, &mut scratch),
                    },
                    |all| (all.stored, all.dropped),
                )?;
                Ok(Answer { found: (all.is_complete, found), ended: all.ended, work: all.work })
            }
        },
        |out, query, segment, &Answer { found: (is_complete, ref hits), work, .. }| {
            let line = line(segment, args.rays);
            for &TriangleHit { hit, is_certain } in hits {
                write!(out, "{query},")?;
                if is_certain {
                    write_hit(out, "yes", hit, work)?;
                } else {
                    // The surface may be from here on: `t` was rounded to nearest.
                    let from = hit.t.next_down().max(0.0);
                    write_undecided(out, line, from, hit.triangle, work)?;
                }
            }
            if !is_complete {
                write!(out, "{query},")?;
                write_undecided(out, line, 0.0, None, work)
            } else if hits.is_empty() {
                write!(out, "{query},")?;
                write_clear(out, work)
            } else {
                Ok(())
            }
        },
    )
}

fn ends([ax, ay, az, bx, by, bz]: [f32; 6]) -> [[f32; 3]; 2] {
    [[ax, ay, az], [bx, by, bz]]
}

/// A start and the way for each unit of the parameter.
fn line(query: &[f32; 6], is_ray: bool) -> [[f64; 3]; 2] {
    let [a, b] = ends(*query).map(|end| end.map(f64::from));
    [a, if is_ray { b } else { core::array::from_fn(|k| b[k] - a[k]) }]
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
fn write_undecided(
    out: &mut dyn Write,
    [start, way]: [[f64; 3]; 2],
    t: f32,
    triangle: Option<u32>,
    work: Work,
) -> io::Result<()> {
    let point = core::array::from_fn(|k| (start[k] + way[k] * f64::from(t)) as f32);
    write_hit(out, "undecided", Hit { t, point, triangle }, work)
}
