//! Queries on several threads: the same answers in the same order as on one thread.

use super::tally::Tally;
use meshsweep_core::QueryError;
use std::num::NonZeroUsize;
use std::sync::Mutex;

/// A query that is refused, by its index, and why.
pub type Refused = (usize, QueryError);

/// Answers of all threads.
pub struct Answers<A> {
    /// In the order of the queries, up to the first one that is refused.
    pub answers: Vec<A>,
    /// The first query that is refused.
    pub refused: Option<Refused>,
    pub tally: Tally,
}

/// The number of threads: `wanted`, or else one for each processor; at most one for each of the
/// `parts` of the work.
pub fn count(wanted: Option<NonZeroUsize>, parts: usize) -> usize {
    let all = || std::thread::available_parallelism().ok();
    wanted.or_else(all).map_or(1, NonZeroUsize::get).min(parts).max(1)
}

/// Runs `work` on so many threads, the caller's among them. Panics continue in the caller.
pub fn each<T: Send>(threads: usize, work: impl Fn() -> T + Sync) -> Vec<T> {
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(&work)).collect();
        let mine = work();
        let join = |other: std::thread::ScopedJoinHandle<'_, T>| {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        std::iter::once(mine).chain(others.into_iter().map(join)).collect()
    })
}

/// Asks all `rows` in chunks of `at_once`. `worker` makes a thread's worker. A worker gets the
/// index of a chunk's first row and the chunk; it appends the answers and counts them. If it
/// refuses rows, it names the one of the least index, and appends at most the answers before it.
pub fn ask<R: Sync, A: Send, W>(
    rows: &[R],
    threads: usize,
    at_once: usize,
    worker: impl Fn() -> W + Sync,
) -> Answers<A>
where
    W: FnMut(usize, &[R], &mut Vec<A>, &mut Tally) -> Result<(), Refused>,
{
    let chunks = Mutex::new(rows.chunks(at_once).enumerate());
    let all = each(threads, || {
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
    });
    // Threads take chunks in order. So all chunks before the first refused query were asked.
    let refused = all.iter().filter_map(|(_, refused)| *refused).min_by_key(|(index, _)| *index);
    let mut done: Vec<_> = all.into_iter().flat_map(|(done, _)| done).collect();
    done.retain(|(chunk, ..)| refused.is_none_or(|(index, _)| *chunk <= index / at_once));
    done.sort_unstable_by_key(|(chunk, ..)| *chunk);
    let mut asked = Answers { answers: Vec::new(), refused, tally: Tally::default() };
    for (_, answers, tally) in done {
        asked.answers.extend(answers);
        asked.tally.add(&tally);
    }
    asked
}
