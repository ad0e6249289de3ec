//! Many queries on several threads: the same answers in the same order as on one.

use super::queries::Queries;
use super::stop::Tally;
use meshsweep_core::QueryError;
use meshsweep_core::query::{Ended, Work};
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Queries that a thread takes at once: enough to forget what taking them costs.
const AT_ONCE: usize = 512;

/// Answers, and what they took.
pub struct Asked<A> {
    /// In the order of the queries, up to the first that is refused.
    pub answers: Vec<A>,
    /// The first query that is refused, and why.
    pub refused: Option<(usize, QueryError)>,
    pub tally: Tally,
    pub time: Duration,
    pub threads: usize,
}

/// As many as wanted; unless told otherwise as many as the machine has processors for. No more than
/// there are `parts` of work.
pub fn count(wanted: Option<NonZeroUsize>, parts: usize) -> usize {
    let all = || std::thread::available_parallelism().ok();
    wanted.or_else(all).map_or(1, NonZeroUsize::get).min(parts).max(1)
}

/// Asks every query. `worker` makes what a thread works with: it appends the answers to one query,
/// and says how the search went.
pub fn ask<const N: usize, A: Send, W>(
    queries: &Queries<N>,
    threads: Option<NonZeroUsize>,
    worker: impl Fn() -> W + Sync,
) -> Asked<A>
where
    W: FnMut(usize, [f32; N], &mut Vec<A>) -> Result<(Ended, Work), QueryError>,
{
    ask_batches(queries, threads, AT_ONCE, || {
        let mut worker = worker();
        move |first: usize, rows: &[[f32; N]], answers: &mut Vec<A>, tally: &mut Tally| {
            for (index, &row) in (first..).zip(rows) {
                let (ended, work) = worker(index, row, answers).map_err(|error| (index, error))?;
                tally.count(ended, work);
            }
            Ok(())
        }
    })
}

/// Asks every query, so many `at_once`. `worker` makes what a thread works with: of queries that
/// stand together, the first of them with the given number, it appends the answers and counts how
/// they ended; or it says which one is refused, the least number, and appends the answers before it
/// at most.
pub fn ask_batches<const N: usize, A: Send, W>(
    queries: &Queries<N>,
    threads: Option<NonZeroUsize>,
    at_once: usize,
    worker: impl Fn() -> W + Sync,
) -> Asked<A>
where
    W: FnMut(usize, &[[f32; N]], &mut Vec<A>, &mut Tally) -> Result<(), (usize, QueryError)>,
{
    let threads = count(threads, queries.rows.len().div_ceil(at_once));
    let started = Instant::now();
    let chunks = Mutex::new(queries.rows.chunks(at_once).enumerate());
    let work = || {
        let mut worker = worker();
        let mut done = Vec::new();
        // No thread can panic while it holds the lock.
        while let Some((chunk, rows)) = chunks.lock().ok().and_then(|mut chunks| chunks.next()) {
            let mut answers = Vec::with_capacity(rows.len());
            let mut tally = Tally::default();
            let refused = worker(chunk * at_once, rows, &mut answers, &mut tally).err();
            done.push((chunk, answers, tally));
            if refused.is_some() {
                return (done, refused);
            }
        }
        (done, None)
    };
    let all: Vec<(Vec<_>, Option<(usize, QueryError)>)> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mine = work();
        let join = |other: std::thread::ScopedJoinHandle<'_, _>| {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        std::iter::once(mine).chain(others.into_iter().map(join)).collect()
    });
    // Chunks are taken in order, so the first query that is refused is among those that were asked,
    // and all before it are.
    let refused = all.iter().filter_map(|(_, refused)| *refused).min_by_key(|(index, _)| *index);
    let time = started.elapsed();
    let mut done: Vec<_> = all.into_iter().flat_map(|(done, _)| done).collect();
    done.retain(|(chunk, ..)| refused.is_none_or(|(index, _)| *chunk <= index / at_once));
    done.sort_unstable_by_key(|(chunk, ..)| *chunk);
    let mut asked = Asked { answers: Vec::new(), refused, tally: Tally::default(), time, threads };
    for (_, answers, tally) in done {
        asked.answers.extend(answers);
        asked.tally.add(&tally);
    }
    asked
}
