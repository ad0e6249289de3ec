//! Questions about points that only the box tree answers: all points asked, then all rows written.

use super::args::{PointArgs, SearchArgs};
use super::blob_file;
use super::csv::Short;
use super::failure::Failure;
use super::output::{Output, refuse_same_file};
use super::queries::Queries;
use super::served::{self, Need};
use super::threads;
use meshsweep_core::Bvh;
use meshsweep_core::query::tree::{Neighbor, ScratchEntry};
use meshsweep_core::query::{Budget, Ended, QueryError, Work};
use std::io::{self, Write};
use std::path::Path;

/// A question about a point.
pub trait Question: Clone + Sync {
    type Answer: Send;

    /// Names of the columns.
    fn header(&self) -> &'static str;

    fn ask(
        &mut self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        stop: &Budget,
        stack: &mut [ScratchEntry],
    ) -> Result<Self::Answer, QueryError>;

    /// How a search ended, and what it took.
    fn outcome(answer: &Self::Answer) -> (Ended, Work);

    /// Whether the mesh is known by a tight hull alone.
    fn is_by_hull(&self) -> bool {
        false
    }

    /// Says on the standard error what holds for all answers.
    fn remark(&self, _blob: &Path, _tree: &Bvh<'_>) {}

    /// Writes the rows of query number `query`, from 0.
    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        point: &[f32; 3],
        answer: &Self::Answer,
    ) -> io::Result<()>;
}

/// Asks `question` about every point of the file.
pub fn run<Q: Question>(
    input: &PointArgs,
    search: &SearchArgs,
    question: &Q,
) -> Result<(), Failure> {
    refuse_blob_as_output(input, search)?;
    let bytes = blob_file::read(&input.blob)?;
    let model = blob_file::open(&input.blob, &bytes)?;
    let tree = served::require_tree(&input.blob, &model, Need::Distances)?;
    ask(input, search, &tree, question)
}

pub fn refuse_blob_as_output(input: &PointArgs, search: &SearchArgs) -> Result<(), Failure> {
    search.output.as_deref().map_or(Ok(()), |output| refuse_same_file(output, &input.files()))
}

/// The same of a tree that was chosen before.
pub fn ask<Q: Question>(
    input: &PointArgs,
    search: &SearchArgs,
    tree: &Bvh<'_>,
    question: &Q,
) -> Result<(), Failure> {
    let output = search.output.as_deref();
    let mut points = Queries::points(&input.points)?;
    let output = Output::file_or_stdout(output)?;
    let stop = search.stop(0.0, 0.0);
    let asked = threads::ask(&points, search.threads, || {
        let mut question = question.clone();
        let mut stack = search.stack(tree);
        move |_, point, answers: &mut Vec<Q::Answer>| {
            let answer = question.ask(tree, point, &stop, &mut stack)?;
            let outcome = Q::outcome(&answer);
            answers.push(answer);
            Ok(outcome)
        }
    });
    let stopped = points.stopped(asked.refused);
    output.finish_until(stopped, |out| {
        writeln!(out, "{}", question.header())?;
        let mut rows = points.rows.iter().zip(&asked.answers).enumerate();
        rows.try_for_each(|(query, (point, answer))| question.write(out, query, point, answer))
    })?;
    question.remark(&input.blob, tree);
    search.note(&asked, question.is_by_hull());
    Ok(())
}

/// The last columns of a triangle's row: its interval, its closest point, its number, and the work
/// of the query.
pub fn write_near(out: &mut dyn Write, near: &Neighbor, work: u32) -> io::Result<()> {
    let Neighbor { lower, upper, point: [x, y, z], triangle } = near;
    for number in [lower, upper, x, y, z] {
        write!(out, "{},", Short(*number))?;
    }
    writeln!(out, "{triangle},{work}")
}
