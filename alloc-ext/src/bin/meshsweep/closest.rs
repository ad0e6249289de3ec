//! `meshsweep closest`: query points in, intervals and closest points out.

use super::args::ClosestArgs;
use super::blob_file;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::stop::Tally;
use meshsweep_core::query::{ClosestPoint, closest_point};
use std::io::{self, Write};
use std::time::Instant;

const HEADER: &str = "x,y,z,lower,upper,px,py,pz,triangle,work";

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let output = args.search.output.as_deref();
    if let Some(output) = output {
        refuse_same_file(output, &[&args.blob, &args.points])?;
    }
    let bytes = blob_file::read(&args.blob)?;
    let model = blob_file::open(&args.blob, &bytes)?;
    let points = Queries::points(&args.points)?;
    let output = Output::file_or_stdout(output)?;
    let stop = args.search.stop(args.rel, args.abs);
    let mut queue = args.search.queue(&model);
    let mut answers = Vec::with_capacity(points.rows.len());
    let started = Instant::now();
    for (index, &point) in points.rows.iter().enumerate() {
        let answer = closest_point(&model, point, &stop, &mut queue);
        answers.push(answer.map_err(|error| points.refused(index, error))?);
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

fn write_row(out: &mut dyn Write, [x, y, z]: &[f32; 3], answer: &ClosestPoint) -> io::Result<()> {
    let ClosestPoint { lower, upper, point: [px, py, pz], triangle, work, .. } = answer;
    write!(out, "{x},{y},{z},{lower},{upper},{px},{py},{pz},")?;
    // A cut blob knows no triangles of the file.
    if let Some(triangle) = triangle {
        write!(out, "{triangle}")?;
    }
    writeln!(out, ",{}", work.total())
}
