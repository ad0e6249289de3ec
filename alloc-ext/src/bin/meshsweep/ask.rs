//! Asks a question about many rows of numbers, and writes the answers as CSV. All commands with
//! queries run through here.

mod tally;
pub mod threads;

use crate::args::SearchArgs;
use crate::failure::{Failure, Place};
use crate::number::Short;
use crate::output::Output;
use crate::queries::Queries;
use meshsweep::counted::Counted;
use meshsweep_core::{
    Budget, Ended, Interval, Neighbor, QueryError, ScratchEntry, Undecided, Verdict, Work,
};
use std::io::{self, Write};
use std::time::{Duration, Instant};
use tally::Tally;
use threads::Refused;

/// Rows that a thread takes at once: enough to make the cost of taking them vanish.
pub const AT_ONCE: usize = 512;

/// A question about rows of `N` numbers.
pub trait Question<const N: usize>: Sync {
    type Answer: Send;
    /// A thread's working memory.
    type Memory;

    /// Names of the columns.
    fn header(&self) -> &'static str;

    fn memory(&self) -> Self::Memory;

    fn ask(&self, row: [f32; N], memory: &mut Self::Memory) -> Result<Self::Answer, QueryError>;

    /// How the search ended, and its work.
    fn outcome(answer: &Self::Answer) -> (Ended, Work);

    /// Writes the rows of query `query`, counted from 0.
    fn write(
        &self,
        out: &mut dyn Write,
        query: usize,
        row: &[f32; N],
        answer: &Self::Answer,
    ) -> io::Result<()>;

    /// Rows that a thread takes at once.
    fn at_once(&self) -> usize {
        AT_ONCE
    }

    /// Appends the answers to `rows`, the first of which is query `first`. On an error it appends
    /// at most the answers before the refused query.
    fn ask_many(
        &self,
        first: usize,
        rows: &[[f32; N]],
        memory: &mut Self::Memory,
        answers: &mut Vec<Self::Answer>,
    ) -> Result<(), Refused> {
        each(self, first, rows, memory, answers)
    }

    /// Whether the blob knows the mesh by a tight hull alone.
    fn is_by_hull(&self) -> bool {
        false
    }

    /// The failure of a refused query.
    fn refuse(&self, place: Place, error: QueryError) -> Failure {
        Failure::Query { place, error }
    }
}

/// Asks one row after the other.
pub fn each<const N: usize, Q: Question<N> + ?Sized>(
    question: &Q,
    first: usize,
    rows: &[[f32; N]],
    memory: &mut Q::Memory,
    answers: &mut Vec<Q::Answer>,
) -> Result<(), Refused> {
    for (index, &row) in (first..).zip(rows) {
        answers.push(question.ask(row, memory).map_err(|error| (index, error))?);
    }
    Ok(())
}

/// Asks all queries, writes the answers, and says on the standard error how the queries ended.
///
/// # Errors
/// A query is refused or broken, after the answers before it have been printed; or the answers
/// cannot be written.
pub fn run<const N: usize, Q: Question<N>>(
    question: &Q,
    mut queries: Queries<N>,
    search: &SearchArgs,
) -> Result<(), Failure> {
    let output = Output::file_or_stdout(search.output.as_deref())?;
    let at_once = question.at_once();
    let threads = threads::count(search.threads, queries.rows.len().div_ceil(at_once));
    let started = Instant::now();
    let asked = threads::ask(&queries.rows, threads, at_once, || {
        let mut memory = question.memory();
        move |first, rows: &[[f32; N]], answers: &mut Vec<Q::Answer>, tally: &mut Tally| {
            let done = question.ask_many(first, rows, &mut memory, answers);
            answers.iter().for_each(|answer| tally.count(Q::outcome(answer)));
            done
        }
    });
    let time = started.elapsed();
    let broken = queries.broken.take();
    let refused = asked.refused.map(|(index, error)| question.refuse(queries.place(index), error));
    output.finish_until(refused.or(broken), |out| {
        writeln!(out, "{}", question.header())?;
        let mut rows = queries.rows.iter().zip(&asked.answers).enumerate();
        rows.try_for_each(|(query, (row, answer))| question.write(out, query, row, answer))
    })?;
    note(&asked.tally, time, threads, search.time, question.is_by_hull());
    Ok(())
}

/// Says on the standard error how queries ended if any ended early, and how long they took if
/// `is_timed`. A closed standard error does not withhold the answers.
fn note(tally: &Tally, time: Duration, threads: usize, is_timed: bool, is_by_hull: bool) {
    let mut stderr = io::stderr();
    if is_timed {
        let queries = tally.queries().max(1) as f64;
        let _ = writeln!(
            stderr,
            "{:.1} ns and {:.1} steps of work per query; {} in {:.3} s on {}",
            time.as_nanos() as f64 / queries,
            tally.work as f64 / queries,
            Counted(tally.queries(), "query"),
            time.as_secs_f64(),
            Counted(threads, "thread")
        );
    }
    if is_timed || tally.ended_early() {
        let _ = writeln!(stderr, "ended: {}", tally.describe(is_by_hull));
    }
}

impl SearchArgs {
    pub fn budget(&self) -> Budget {
        Budget::EXACT.with_steps(self.steps.unwrap_or(u32::MAX))
    }

    /// So many entries, unless `--queue` says otherwise.
    pub fn scratch(&self, entries: usize) -> Vec<ScratchEntry> {
        vec![ScratchEntry::EMPTY; self.queue.map_or(entries, |entries| entries as usize)]
    }
}

/// How a search ended that gave a verdict.
pub fn ended(verdict: Verdict) -> Ended {
    match verdict {
        Verdict::Yes | Verdict::No => Ended::Exact,
        Verdict::Undecided(Undecided::Steps) => Ended::Steps,
        Verdict::Undecided(Undecided::Scratch) => Ended::Scratch,
        Verdict::Undecided(_) => Ended::Resolution,
    }
}

/// A verdict as a column says it.
pub fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Yes => "yes",
        Verdict::No => "no",
        Verdict::Undecided(_) => "unknown",
    }
}

/// Asks for all of something in the room that there is, and once more if something is dropped.
/// `counts` are the numbers of stored and dropped ones.
pub fn all<T: Copy, F>(
    room: &mut Vec<T>,
    empty: T,
    mut ask: impl FnMut(&mut [T]) -> Result<F, QueryError>,
    counts: fn(&F) -> (usize, u32),
) -> Result<(F, Vec<T>), QueryError> {
    let mut found = ask(room)?;
    let (stored, dropped) = counts(&found);
    if dropped > 0 {
        room.resize(stored + dropped as usize, empty);
        found = ask(room)?;
    }
    let stored = counts(&found).0;
    Ok((found, room.iter().take(stored).copied().collect()))
}

/// Numbers, each with a comma after it.
pub fn write_numbers(out: &mut dyn Write, numbers: &[f32]) -> io::Result<()> {
    numbers.iter().try_for_each(|&x| write!(out, "{},", Short(x)))
}

/// The last two columns: the triangle, which cut blobs and tight hulls do not know, and the work.
pub fn write_end(out: &mut dyn Write, triangle: Option<u32>, work: Work) -> io::Result<()> {
    triangle.map_or(Ok(()), |triangle| write!(out, "{triangle}"))?;
    writeln!(out, ",{}", work.total())
}

/// The last columns of a near triangle: interval, closest point, triangle, and the query's work.
pub fn write_neighbor(out: &mut dyn Write, near: &Neighbor, work: Work) -> io::Result<()> {
    let (Interval { lower, upper }, [x, y, z]) = (near.distance(), near.point());
    write_numbers(out, &[lower, upper, x, y, z])?;
    write_end(out, Some(near.triangle()), work)
}
