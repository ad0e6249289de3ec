//! Asks a question about many rows of numbers, and writes the answers as CSV. All commands with
//! queries run through here.

mod tally;
pub mod threads;

use crate::args::SearchArgs;
use crate::failure::Failure;
use crate::output::Output;
use crate::queries::Queries;
use meshsweep::counted::Counted;
use meshsweep::distances::{AnyWithin, Closest, Element};
use meshsweep::number::Short;
use meshsweep_core::{
    Budget, CurveNeighbor, CurveSignedDistance, Decided, Ended, FirstHit, Interval, Neighbor,
    PairContact, PairDistance, Penetration, QueryError, ScratchEntry, Separation, SignedDistance,
    TriboxBound, Undecided, Verdict, WindingNumber, Work,
};
use std::io::{self, Write};
use std::time::{Duration, Instant};
use tally::Tally;
use threads::{Refused, Worker};

/// Rows that a thread takes at once: enough to make the cost of taking them vanish.
const AT_ONCE: usize = 512;

/// A question about rows of `N` numbers.
pub struct Question<'a, const N: usize> {
    /// Names of the columns.
    pub header: &'static str,
    pub queries: Queries<N>,
    pub search: &'a SearchArgs,
    /// Whether the blob knows the mesh by a tight hull alone.
    pub is_by_hull: bool,
    /// How far away a query may be, in words, for the refusal of one that is farther.
    pub limit: Option<String>,
}

/// An answer to one row.
pub trait Answered: Send {
    /// How its search ended.
    fn ended(&self) -> Ended;
    /// The work of its search.
    fn work(&self) -> Work;
}

/// Says of answers of these types how their search ended.
macro_rules! answered {
    ($($answer:ty: |$found:ident| $ended:expr, $work:expr;)*) => {
        $(
            impl Answered for $answer {
                fn ended(&self) -> Ended {
                    let $found = self;
                    $ended
                }

                fn work(&self) -> Work {
                    let $found = self;
                    $work
                }
            }
        )*
    };
}

answered! {
    Closest: |found| found.ended, found.work;
    FirstHit: |found| found.ended, found.work;
    PairContact: |found| found.ended, found.work;
    PairDistance: |found| found.ended, found.work;
    Penetration: |found| found.ended, found.work;
    Separation: |found| found.ended, found.work;
    CurveSignedDistance: |found| found.closest.ended, found.closest.work;
    SignedDistance: |found| found.closest.ended, found.closest.work;
    TriboxBound: |found| found.ended, found.work;
    WindingNumber: |found| found.ended, found.work;
    AnyWithin: |found| ended(found.verdict), found.work;
    Decided<[u32; 2]>: |found| ended(found.verdict), found.work;
}

/// An answer that is put together of several, how its search ended, and the work of the search.
pub struct Answer<A> {
    pub found: A,
    pub ended: Ended,
    pub work: Work,
}

impl<A: Send> Answered for Answer<A> {
    fn ended(&self) -> Ended {
        self.ended
    }

    fn work(&self) -> Work {
        self.work
    }
}

/// Asks about rows on so many threads. Gives the answers before the first refused row, and that
/// row.
type AskRows<'a, const N: usize, A> = dyn Fn(&[[f32; N]], usize) -> (Vec<A>, Option<Refused>) + 'a;

/// Writes the number of a row, from 0, the row and its answer.
type WriteAnswer<'a, const N: usize, A> =
    dyn Fn(&mut dyn Write, usize, &[f32; N], &A) -> io::Result<()> + 'a;

impl<'a, const N: usize> Question<'a, N> {
    pub fn new(header: &'static str, queries: Queries<N>, search: &'a SearchArgs) -> Self {
        Question { header, queries, search, is_by_hull: false, limit: None }
    }

    /// Asks about one row after the other, each thread with scratch of its own: so many entries,
    /// unless `--scratch` says otherwise. `write` gets the number of a row, from 0, the row and its
    /// answer.
    ///
    /// # Errors
    /// As [`ask_all`](Self::ask_all).
    pub fn ask_each<A: Answered>(
        self,
        entries: usize,
        ask: impl Fn([f32; N], &mut [ScratchEntry]) -> Result<A, QueryError> + Sync,
        write: impl Fn(&mut dyn Write, usize, &[f32; N], &A) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let search = self.search;
        let asker = || {
            let (ask, mut scratch) = (&ask, search.scratch(entries));
            move |row| ask(row, &mut scratch)
        };
        self.ask(asker, write)
    }

    /// As [`ask_each`](Self::ask_each), where `asker` makes a thread's asker with its memory.
    ///
    /// # Errors
    /// As [`ask_all`](Self::ask_all).
    pub fn ask<A: Answered, F>(
        self,
        asker: impl Fn() -> F + Sync,
        write: impl Fn(&mut dyn Write, usize, &[f32; N], &A) -> io::Result<()>,
    ) -> Result<(), Failure>
    where
        F: FnMut([f32; N]) -> Result<A, QueryError>,
    {
        let worker = || -> Worker<'_, [f32; N], A> {
            let mut ask = asker();
            Box::new(move |row| ask(*row))
        };
        let ask = |rows: &[[f32; N]], threads| threads::ask(rows, threads, AT_ONCE, &worker);
        self.ask_all(AT_ONCE, &ask, &write)
    }

    /// Asks about all rows, writes the answers, and says on the standard error how the queries
    /// ended. `ask` gets the rows and the number of threads, each of which takes `at_once` rows at
    /// once. It returns the answers before the first refused row, and that row.
    ///
    /// # Errors
    /// A query is refused or broken, after the answers before it have been printed; or the answers
    /// cannot be written.
    pub fn ask_all<A: Answered>(
        mut self,
        at_once: usize,
        ask: &AskRows<'_, N, A>,
        write: &WriteAnswer<'_, N, A>,
    ) -> Result<(), Failure> {
        let (queries, search) = (&mut self.queries, self.search);
        let output = Output::file_or_stdout(search.output.as_deref())?;
        let threads = threads::count(search.threads.wanted, queries.rows.len().div_ceil(at_once));
        let started = Instant::now();
        let (answers, refused) = ask(&queries.rows, threads);
        let time = started.elapsed();
        let broken = queries.broken.take();
        let refused = refused.map(|(index, error)| match (error, self.limit) {
            (QueryError::OutOfDomain, Some(limit)) => {
                Failure::TooFar { place: queries.place(index), limit }
            }
            (error, _) => Failure::Query { place: queries.place(index), error },
        });
        output.finish_until(refused.or(broken), |out| {
            writeln!(out, "{}", self.header)?;
            let mut rows = queries.rows.iter().zip(&answers).enumerate();
            rows.try_for_each(|(query, (row, answer))| write(out, query, row, answer))
        })?;
        let mut tally = Tally::default();
        answers.iter().for_each(|answer| tally.count(answer.ended(), answer.work()));
        note(&tally, time, threads, search.time, self.is_by_hull);
        Ok(())
    }
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

    /// So many entries, unless `--scratch` says otherwise.
    pub fn scratch(&self, entries: usize) -> Vec<ScratchEntry> {
        vec![ScratchEntry::EMPTY; self.scratch.map_or(entries, |entries| entries as usize)]
    }
}

/// How a search ended that gave a verdict.
pub fn ended(verdict: Verdict) -> Ended {
    match verdict {
        Verdict::Yes | Verdict::No => Ended::Exact,
        Verdict::Undecided(Undecided::Steps) => Ended::Steps,
        Verdict::Undecided(Undecided::Scratch) => Ended::Scratch,
        _ => Ended::Resolution,
    }
}

/// A verdict as a column says it.
pub fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Yes => "yes",
        Verdict::No => "no",
        _ => "undecided",
    }
}

/// Asks a question whose answers go into `buffer`: hits, pairs, triangles. If some did not fit, it
/// makes the buffer longer and asks once more. `counts` gives the numbers of stored and of dropped
/// answers. Returns the result of the question and the stored answers.
pub fn all<T: Copy, F>(
    buffer: &mut Vec<T>,
    empty: T,
    mut ask: impl FnMut(&mut [T]) -> Result<F, QueryError>,
    counts: fn(&F) -> (usize, u32),
) -> Result<(F, Vec<T>), QueryError> {
    let mut found = ask(buffer)?;
    let (stored, dropped) = counts(&found);
    if dropped > 0 {
        buffer.resize(stored + dropped as usize, empty);
        found = ask(buffer)?;
    }
    let stored = counts(&found).0;
    Ok((found, buffer.iter().take(stored).copied().collect()))
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

/// The columns of what an answer is on: triangle; or polyline and segment of a curve.
pub fn write_element(
    out: &mut dyn Write,
    is_curve: bool,
    element: Option<Element>,
) -> io::Result<()> {
    match element {
        Some(Element::Triangle(triangle)) => write!(out, "{triangle},"),
        Some(Element::Segment(at)) => write!(out, "{},{},", at.polyline, at.segment),
        None => write!(out, "{}", if is_curve { ",," } else { "," }),
    }
}

/// The last three columns of a pair: a triangle of each mesh, and the work.
pub fn write_pair(out: &mut dyn Write, triangles: Option<[u32; 2]>, work: Work) -> io::Result<()> {
    let [first, second] = triangles.map_or([None; 2], |pair| pair.map(Some));
    first.map_or(Ok(()), |first| write!(out, "{first}"))?;
    write!(out, ",")?;
    write_end(out, second, work)
}

/// The last columns of a near triangle: interval, closest point, triangle, and the query's work.
pub fn write_neighbor(out: &mut dyn Write, near: &Neighbor, work: Work) -> io::Result<()> {
    let (Interval { lower, upper }, [x, y, z]) = (near.distance(), near.point());
    write_numbers(out, &[lower, upper, x, y, z])?;
    write_end(out, Some(near.triangle()), work)
}

/// The last columns of a near segment of a curve: interval, closest point, polyline, segment, and
/// the query's work.
pub fn write_curve_neighbor(
    out: &mut dyn Write,
    near: &CurveNeighbor,
    work: Work,
) -> io::Result<()> {
    let (Interval { lower, upper }, [x, y, z]) = (near.distance(), near.point());
    write_numbers(out, &[lower, upper, x, y, z])?;
    write_element(out, true, Some(Element::Segment(near.segment())))?;
    writeln!(out, "{}", work.total())
}
