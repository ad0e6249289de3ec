//! `meshsweep closest`: query points in, intervals and closest points out.

use super::args::{ClosestArgs, ClosestEngine};
use super::blob_file;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::served::{self, Need};
use super::stop::Tally;
use meshsweep_core::query::{ClosestPoint, QueryError, closest_point, tree};
use std::io::{self, Write};
use std::time::Instant;

const HEADER: &str = "x,y,z,lower,upper,px,py,pz,triangle,work";

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let (blob, points) = (&args.input.blob, &args.input.points);
    let output = args.search.output.as_deref();
    if let Some(output) = output {
        refuse_same_file(output, &[blob, points])?;
    }
    let bytes = blob_file::read(blob)?;
    let model = blob_file::open(blob, &bytes)?;
    let tree_chosen = args.engine.map(|engine| engine == ClosestEngine::Tree);
    let tree = served::choose(blob, &model, Need::Distances, tree_chosen)?;
    let points = Queries::points(points)?;
    let output = Output::file_or_stdout(output)?;
    let stop = args.search.stop(args.rel, args.abs);
    let mut answers = Vec::with_capacity(points.rows.len());
    let started = Instant::now();
    match tree {
        Some(tree) => {
            let mut stack = args.search.stack(&tree);
            ask(&points, &mut answers, |point| tree::closest_point(&tree, point, &stop, &mut stack))?;
        }
        None => {
            let mut queue = args.search.queue(&model);
            ask(&points, &mut answers, |point| closest_point(&model, point, &stop, &mut queue))?;
        }
    }
    let time = started.elapsed();
    let mut tally = Tally::default();
    answers.iter().for_each(|answer| tally.count(answer.ended, answer.work));
    output.finish(|out| {
        writeln!(out, "{HEADER}")?;
        points.rows.iter().zip(&answers).try_for_each(|(point, answer)| write_row(out, point, answer))
    })?;
    args.search.note(&tally, time);
    Ok(())
}

fn ask(
    points: &Queries<3>,
    answers: &mut Vec<ClosestPoint>,
    mut question: impl FnMut([f32; 3]) -> Result<ClosestPoint, QueryError>,
) -> Result<(), Failure> {
    for (index, &point) in points.rows.iter().enumerate() {
        answers.push(question(point).map_err(|error| points.refused(index, error))?);
    }
    Ok(())
}

fn write_row(out: &mut dyn Write, [x, y, z]: &[f32; 3], answer: &ClosestPoint) -> io::Result<()> {
    let ClosestPoint { lower, upper, point: [px, py, pz], triangle, work, .. } = answer;
    write!(out, "{x},{y},{z},{lower},{upper},{px},{py},{pz},")?;
    // A cut blob knows no triangles of the file.
    if let Some(triangle) = triangle {
        write!(out, "{triangle}")?;
    }
    writeln!(out, ",{}", work.total())
}
