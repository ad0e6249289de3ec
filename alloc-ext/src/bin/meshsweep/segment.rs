//! `meshsweep segment`: query segments in, first hits or all hits out.
//!
//! `unknown` means one thing whatever the reason: the segment is proved clear before `t`, and no more is known for certain.

use super::args::{Engine, SegmentArgs};
use super::blob_file;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::stop::Tally;
use meshsweep_core::query::{Ended, Hit, Search, SegmentHit, Stop, Work, all_hits, first_hit, outer_hits};
use meshsweep_core::refine::{Face, Front};
use meshsweep_core::{Model, QueryError, QueueEntry};
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

const HEADER: &str = "hit,t,px,py,pz,triangle,work";

/// Hits that fit at first; a segment with more is asked again with as much room as it needs.
const HITS: usize = 64;

/// Faces that wait on the hull; more cost a search to find again, not an answer.
const CANDIDATES: usize = 1024;

/// What is known of a segment, or of one of its hits.
#[derive(Clone, Copy)]
enum Verdict {
    Hit(Hit),
    Clear,
    /// Clear before this parameter.
    Unknown(f32),
}

/// One line of output.
struct Row {
    query: usize,
    verdict: Verdict,
    work: Work,
}

pub fn run(args: &SegmentArgs) -> Result<(), Failure> {
    let output = args.search.output.as_deref();
    if let Some(output) = output {
        refuse_same_file(output, &[&args.blob, &args.segments])?;
    }
    let is_limited = args.all || args.search.steps.is_some() || args.search.queue.is_some();
    if args.engine == Engine::Hull && is_limited {
        let what =
            "--engine hull finds first hits to their end; leave out --all, --steps and --queue".to_owned();
        return Err(Failure::Usage { what });
    }
    let bytes = blob_file::read(&args.blob)?;
    let model = blob_file::open(&args.blob, &bytes)?;
    if args.engine == Engine::Hull {
        require_exact_surface(&args.blob, &model)?;
    }
    let segments = Queries::segments(&args.segments)?;
    let output = Output::file_or_stdout(output)?;
    let mut caster = Caster::new(&model, args);
    let mut rows = Vec::with_capacity(segments.rows.len());
    let mut tally = Tally::default();
    let started = Instant::now();
    for (index, &segment) in segments.rows.iter().enumerate() {
        let cast = if args.all {
            caster.all(index, segment, &mut rows)
        } else {
            caster.first(index, segment, &mut rows)
        };
        let (ended, work) = cast.map_err(|error| segments.refused(index, error))?;
        tally.count(ended, work);
    }
    let time = started.elapsed();
    output.finish(|out| {
        writeln!(out, "{}{HEADER}", if args.all { "query," } else { "" })?;
        rows.iter().try_for_each(|row| {
            if args.all {
                write!(out, "{},", row.query)?;
            }
            write_row(out, row, &segments.rows[row.query])
        })
    })?;
    args.search.note(&tally, time);
    Ok(())
}

fn require_exact_surface(file: &Path, model: &Model<'_>) -> Result<(), Failure> {
    let reason = if model.is_cut() {
        "a blob that is not cut"
    } else if model.header().surface_error > 0.0 {
        "a surface error of zero (coordinates stored as the file has them)"
    } else {
        return Ok(());
    };
    Err(Failure::HullEngine { file: file.to_owned(), reason })
}

/// Working memory of the searches.
struct Caster<'a> {
    model: &'a Model<'a>,
    engine: Engine,
    stop: Stop,
    queue: Vec<QueueEntry>,
    hits: Vec<Hit>,
    performed: Vec<u32>,
    swept: Vec<u32>,
    candidates: Vec<Face>,
}

impl<'a> Caster<'a> {
    fn new(model: &'a Model<'a>, args: &SegmentArgs) -> Self {
        let words = if args.engine == Engine::Hull { model.capacities().front_words } else { 0 };
        Caster {
            model,
            engine: args.engine,
            stop: args.search.stop(0.0, 0.0),
            queue: args.search.queue(model),
            hits: vec![Hit::EMPTY; HITS],
            performed: vec![0; words],
            swept: vec![0; words],
            candidates: vec![Face::EMPTY; CANDIDATES],
        }
    }

    /// The first hit: one row.
    fn first(
        &mut self,
        query: usize,
        segment: [f32; 6],
        rows: &mut Vec<Row>,
    ) -> Result<(Ended, Work), QueryError> {
        let [a, b] = ends(segment);
        let on_hull = match self.engine {
            Engine::Hull => self.on_hull(a, b)?,
            Engine::Cover => None,
        };
        let answer = match on_hull {
            Some(answer) => answer,
            None => first_hit(self.model, a, b, &self.stop, &mut self.queue)?,
        };
        let verdict = match answer.hit {
            _ if answer.is_clear() => Verdict::Clear,
            Some(hit) if answer.ended == Ended::Exact => Verdict::Hit(hit),
            _ => Verdict::Unknown(answer.lower),
        };
        rows.push(Row { query, verdict, work: answer.work });
        Ok((answer.ended, answer.work))
    }

    /// The first hit by the refined hull; `None` if the segment does not start outside.
    fn on_hull(&mut self, a: [f32; 3], b: [f32; 3]) -> Result<Option<SegmentHit>, QueryError> {
        let mut front = Front::new(&mut self.performed, &mut self.swept, &mut self.candidates);
        let outer = outer_hits(self.model, a, b, Search::First, &mut front, &mut self.hits)?;
        if outer.starts_inside {
            return Ok(None);
        }
        let hit = self.hits.first().copied().filter(|_| outer.stored > 0);
        let (lower, upper) = (outer.lower, outer.upper);
        Ok(Some(SegmentHit { lower, upper, hit, work: outer.work, ended: outer.ended }))
    }

    /// All hits: a row for each, or one that says that there is none.
    fn all(
        &mut self,
        query: usize,
        segment: [f32; 6],
        rows: &mut Vec<Row>,
    ) -> Result<(Ended, Work), QueryError> {
        let [a, b] = ends(segment);
        let mut found = all_hits(self.model, a, b, &mut self.queue, &mut self.hits)?;
        if found.dropped > 0 {
            self.hits.resize(found.stored + found.dropped as usize, Hit::EMPTY);
            found = all_hits(self.model, a, b, &mut self.queue, &mut self.hits)?;
        }
        let work = found.work;
        let is_exact = found.ended == Ended::Exact;
        for &hit in self.hits.iter().take(found.stored) {
            // Beyond a cut, a hit is a place from which on the surface may be; its t was rounded to nearest.
            let from = hit.t.next_down().max(0.0);
            let verdict =
                if found.ended == Ended::Level { Verdict::Unknown(from) } else { Verdict::Hit(hit) };
            rows.push(Row { query, verdict, work });
        }
        if found.ended == Ended::Capacity {
            // Hits may be missing anywhere.
            rows.push(Row { query, verdict: Verdict::Unknown(0.0), work });
        } else if found.stored == 0 {
            let verdict = if is_exact { Verdict::Clear } else { Verdict::Unknown(0.0) };
            rows.push(Row { query, verdict, work });
        }
        Ok((found.ended, work))
    }
}

fn ends([ax, ay, az, bx, by, bz]: [f32; 6]) -> [[f32; 3]; 2] {
    [[ax, ay, az], [bx, by, bz]]
}

fn write_row(out: &mut dyn Write, row: &Row, segment: &[f32; 6]) -> io::Result<()> {
    match row.verdict {
        Verdict::Hit(Hit { t, point: [x, y, z], triangle }) => {
            write!(out, "yes,{t},{x},{y},{z},")?;
            if let Some(triangle) = triangle {
                write!(out, "{triangle}")?;
            }
        }
        Verdict::Clear => write!(out, "no,,,,,")?,
        Verdict::Unknown(t) => {
            let [a, b] = ends(*segment);
            let [x, y, z] = point_at(a, b, t);
            write!(out, "unknown,{t},{x},{y},{z},")?;
        }
    }
    writeln!(out, ",{}", row.work.total())
}

fn point_at(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    let along = |from: f32, to: f32| f64::from(from) + (f64::from(to) - f64::from(from)) * f64::from(t);
    core::array::from_fn(|k| along(a[k], b[k]) as f32)
}
