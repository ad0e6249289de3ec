//! `meshsweep segment`: query segments in, first hits or all hits out.

mod caster;

use super::args::{SegmentArgs, SegmentEngine};
use super::blob_file;
use super::csv::Short;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::served::{self, Need};
use super::threads;
use caster::{Caster, Row, Verdict, ends};
use meshsweep_core::num::{exp2, tolerance};
use meshsweep_core::query::Hit;
use meshsweep_core::{Bvh, Model, QueryError};
use std::io::{self, Write};
use std::path::Path;

const HEADER: &str = "hit,t,px,py,pz,triangle,work";

pub fn run(args: &SegmentArgs) -> Result<(), Failure> {
    let output = args.search.output.as_deref();
    if let Some(output) = output {
        refuse_same_file(output, &args.files())?;
    }
    let usage = |what: &str| Err(Failure::Usage { what: what.to_owned() });
    let limits_tree =
        || usage("--steps is for the cover tree; leave it out, or add --engine cover");
    let by_hull = args.engine == Some(SegmentEngine::Hull);
    let is_limited = args.all || args.search.steps.is_some() || args.search.queue.is_some();
    if by_hull && is_limited {
        return usage(
            "--engine hull finds first hits to their end; leave out --all, --steps and --queue",
        );
    }
    if args.engine == Some(SegmentEngine::Tree) && args.search.steps.is_some() {
        return limits_tree();
    }
    if args.engine.is_some_and(|engine| engine != SegmentEngine::Tree) && args.facing.is_some() {
        return usage("--facing is for the box tree; leave it out, or use --engine tree");
    }
    let bytes = blob_file::read(&args.blob)?;
    let model = blob_file::open(&args.blob, &bytes)?;
    let tree_chosen = args.engine.map(|engine| engine == SegmentEngine::Tree);
    let tree = served::choose(&args.blob, &model, Need::Segments, tree_chosen)?;
    if tree.is_some() && args.search.steps.is_some() {
        return limits_tree();
    }
    if tree.is_none() && args.facing.is_some() {
        // Only the tree will do.
        served::require_tree(&args.blob, &model, Need::Segments)?;
    }
    if by_hull {
        require_exact_surface(&args.blob, &model)?;
    }
    let mut segments = Queries::segments(&args.segments)?;
    let output = Output::file_or_stdout(output)?;
    let asked = threads::ask(&segments, args.search.threads, || {
        let mut caster = match tree {
            Some(tree) => Caster::tree(tree, args.facing(), &args.search),
            None if by_hull => Caster::hull(&model, &args.search),
            None => Caster::cover(&model, &args.search),
        };
        move |index, segment, rows: &mut Vec<Row>| {
            if args.all {
                caster.all(index, segment, rows)
            } else {
                caster.first(index, segment, rows)
            }
        }
    });
    let stopped = match asked.refused {
        Some((index, QueryError::OutOfDomain)) => Some(Failure::TooFar {
            place: segments.place(index),
            limit: limit(&model, tree.as_ref()),
        }),
        refused => segments.stopped(refused),
    };
    output.finish_until(stopped, |out| {
        writeln!(out, "{}{HEADER}", if args.all { "query," } else { "" })?;
        asked.answers.iter().try_for_each(|row| {
            if args.all {
                write!(out, "{},", row.query)?;
            }
            write_row(out, row, &segments.rows[row.query])
        })
    })?;
    args.search.note(&asked, false);
    Ok(())
}

/// How far away the ends of segments may be, in the mesh's unit.
fn limit(model: &Model<'_>, tree: Option<&Bvh<'_>>) -> String {
    match tree {
        Some(tree) => {
            let unit = exp2(tree.header().grid_exponent + tree.scale_exponent());
            let farthest = f64::from(tolerance::TREE_FAR) * unit;
            format!(
                "the ways along x, y and z to the farthest corner of its box may add up to about {farthest:.1e}"
            )
        }
        None => format!("a coordinate may be about {:.1e} at most", tolerance::FAR * model.scale()),
    }
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

fn write_row(out: &mut dyn Write, row: &Row, segment: &[f32; 6]) -> io::Result<()> {
    match row.verdict {
        Verdict::Hit(Hit { t, point, triangle }) => {
            write_place(out, "yes", t, point, triangle)?;
        }
        Verdict::Clear => write!(out, "no,,,,,")?,
        Verdict::Unknown { t, triangle } => {
            let [a, b] = ends(*segment);
            write_place(out, "unknown", t, point_at(a, b, t), triangle)?;
        }
    }
    writeln!(out, ",{}", row.work.total())
}

fn write_place(
    out: &mut dyn Write,
    verdict: &str,
    t: f32,
    [x, y, z]: [f32; 3],
    triangle: Option<u32>,
) -> io::Result<()> {
    write!(out, "{verdict},{},{},{},{},", Short(t), Short(x), Short(y), Short(z))?;
    triangle.map_or(Ok(()), |triangle| write!(out, "{triangle}"))
}

fn point_at(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    let along =
        |from: f32, to: f32| f64::from(from) + (f64::from(to) - f64::from(from)) * f64::from(t);
    core::array::from_fn(|k| along(a[k], b[k]) as f32)
}
