//! Queries on several threads: the same answers in the same order as on one thread.

use meshsweep_core::QueryError;
use std::num::NonZeroUsize;
use std::sync::Mutex;

/// A row that is refused, by its index, and why.
pub type Refused = (usize, QueryError);

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

/// Asks all `rows` in chunks of `at_once`. `worker` makes a thread's worker. A worker gets a chunk
/// and appends its answers. If it refuses rows, it names the first of them by its index in the
/// chunk, and appends at most the answers before it. Returns the answers in the order of the rows,
/// up to the first refused row, and that row.
pub fn ask<R: Sync, A: Send, W>(
    rows: &[R],
    threads: usize,
    at_once: usize,
    worker: impl Fn() -> W + Sync,
) -> (Vec<A>, Option<Refused>)
where
    W: FnMut(&[R], &mut Vec<A>) -> Result<(), Refused>,
{
    let chunks = Mutex::new(rows.chunks(at_once).enumerate());
    let all = each(threads, || {
        let mut worker = worker();
        let mut done = Vec::new();
        // No thread can panic while it holds the lock.
        while let Some((chunk, rows)) = chunks.lock().ok().and_then(|mut chunks| chunks.next()) {
            let mut answers = Vec::with_capacity(rows.len());
            let asked = worker(rows, &mut answers);
            done.push((chunk, answers));
            if let Err((index, error)) = asked {
                return (done, Some((chunk * at_once + index, error)));
            }
        }
        (done, None)
    });
    // Threads take chunks in order. So all chunks before the first refused row were asked.
    let refused = all.iter().filter_map(|(_, refused)| *refused).min_by_key(|(index, _)| *index);
    let mut done: Vec<_> = all.into_iter().flat_map(|(done, _)| done).collect();
    done.retain(|(chunk, _)| refused.is_none_or(|(index, _)| *chunk <= index / at_once));
    done.sort_unstable_by_key(|(chunk, _)| *chunk);
    (done.into_iter().flat_map(|(_, answers)| answers).collect(), refused)
}
