//! `meshsweep closest`: query points in, intervals and closest points out.

use super::args::{ClosestArgs, ClosestEngine};
use super::blob_file;
use super::csv::Short;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::served::{self, Need};
use super::stop::Tally;
use super::threads;
use meshsweep_core::query::tight;
use meshsweep_core::query::tree::{BatchError, Hint, closest_points};
use meshsweep_core::query::{ClosestPoint, Ended, QueryError, Work, closest_point};
use std::io::{self, Write};

/// Queries that are sorted at once: enough for neighbours to be near, and for all threads to have
/// some.
const BATCH: usize = 1 << 14;

const UNANSWERED: ClosestPoint = ClosestPoint {
    lower: 0.0,
    upper: f32::INFINITY,
    point: [0.0; 3],
    triangle: None,
    work: Work { nodes: 0, triangles: 0, exact: 0, splits: 0 },
    ended: Ended::Steps,
};

const HEADER: &str = "x,y,z,lower,upper,px,py,pz,triangle,work";

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let blob = &args.input.blob;
    let output = args.search.output.as_deref();
    if let Some(output) = output {
        refuse_same_file(output, &args.input.files())?;
    }
    let bytes = blob_file::read(blob)?;
    let model = blob_file::open(blob, &bytes)?;
    let tree_chosen = args.engine.map(|engine| engine == ClosestEngine::Tree);
    let hull = match tree_chosen {
        Some(_) => None,
        None => served::tight_hull(blob, &model, args.tight)?,
    };
    let tree = match hull {
        Some(_) => None,
        None => served::choose(blob, &model, Need::Distances, tree_chosen)?,
    };
    let mut points = Queries::points(&args.input.points)?;
    let output = Output::file_or_stdout(output)?;
    let stop = args.search.stop(args.rel, args.abs);
    let asked = match (hull, tree) {
        (Some(hull), _) => threads::ask(&points, args.search.threads, || {
            let mut stack = args.search.stack(hull.tree());
            move |_, point, answers: &mut Vec<ClosestPoint>| {
                let answer = tight::closest_point(&hull, point, &stop, &mut stack)?;
                answers.push(answer);
                Ok((answer.ended, answer.work))
            }
        }),
        (None, Some(tree)) => threads::ask_batches(&points, args.search.threads, BATCH, || {
            let mut stack = args.search.stack(&tree);
            let mut order = vec![0; 2 * BATCH.min(points.rows.len())];
            move |first, rows: &[[f32; 3]], answers: &mut Vec<ClosestPoint>, tally: &mut Tally| {
                answers.resize(rows.len(), UNANSWERED);
                // From nowhere, so that the work does not depend on which thread took the batch
                // before.
                let mut hint = Hint::NONE;
                let done =
                    closest_points(&tree, rows, answers, &stop, &mut stack, &mut order, &mut hint);
                if done.is_err() {
                    // A batch is not answered in its order.
                    answers.clear();
                }
                answers.iter().for_each(|answer| tally.count(answer.ended, answer.work));
                done.map_err(|error| refused(first, error))
            }
        }),
        (None, None) => threads::ask(&points, args.search.threads, || {
            let mut queue = args.search.queue(&model);
            let model = &model;
            move |_, point, answers: &mut Vec<ClosestPoint>| {
                let answer = closest_point(model, point, &stop, &mut queue)?;
                answers.push(answer);
                Ok((answer.ended, answer.work))
            }
        }),
    };
    let stopped = points.stopped(asked.refused);
    output.finish_until(stopped, |out| {
        writeln!(out, "{HEADER}")?;
        points
            .rows
            .iter()
            .zip(&asked.answers)
            .try_for_each(|(point, answer)| write_row(out, point, answer))
    })?;
    args.search.note(&asked, hull.is_some());
    Ok(())
}

fn refused(first: usize, error: BatchError) -> (usize, QueryError) {
    match error {
        BatchError::Query { index, error } => (first + index, error),
        // There is a place for each.
        BatchError::Length { .. } => (first, QueryError::Model),
    }
}

fn write_row(out: &mut dyn Write, [x, y, z]: &[f32; 3], answer: &ClosestPoint) -> io::Result<()> {
    let ClosestPoint { lower, upper, point: [px, py, pz], triangle, work, .. } = answer;
    for number in [x, y, z, lower, upper, px, py, pz] {
        write!(out, "{},", Short(*number))?;
    }
    // A cut blob and a tight hull know no triangles of the file.
    if let Some(triangle) = triangle {
        write!(out, "{triangle}")?;
    }
    writeln!(out, ",{}", work.total())
}
