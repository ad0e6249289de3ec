//! Queries on several threads: the same answers in the same order as on one thread.

use meshsweep_core::QueryError;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A row that is refused, by its index, and why.
pub type Refused = (usize, QueryError);

/// The number of threads: `wanted`, or else one for each processor; at most one for each of the
/// `parts` of the work.
pub fn count(wanted: Option<NonZeroUsize>, parts: usize) -> usize {
    let all = || std::thread::available_parallelism().ok();
    wanted.or_else(all).map_or(1, NonZeroUsize::get).min(parts).max(1)
}

/// Runs `work` on so many threads, the caller's among them. Returns the results in the order in
/// which they were ready. Panics continue in the caller.
pub fn each<T: Send>(threads: usize, work: impl Fn() -> T + Sync) -> Vec<T> {
    let all = Mutex::new(Vec::new());
    run(threads, &|| {
        let one = work();
        // No thread can panic while it holds the lock.
        all.lock().unwrap_or_else(PoisonError::into_inner).push(one);
    });
    all.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Not generic, here and below: the compiler would make a copy for each question.
fn run(threads: usize, work: &(dyn Fn() + Sync)) {
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        work();
        for other in others {
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
}

/// Answers one row after the other.
pub type Worker<'a, R, A> = Box<dyn FnMut(&R) -> Result<A, QueryError> + 'a>;

/// Asks all `rows`, of which a thread takes `at_once` at once. `worker` makes a thread's worker.
/// Returns the answers in the order of the rows, up to the first refused row, and that row.
pub fn ask<'a, R: Sync, A: Send>(
    rows: &[R],
    threads: usize,
    at_once: usize,
    worker: &(dyn Fn() -> Worker<'a, R, A> + Sync),
) -> (Vec<A>, Option<Refused>) {
    let chunks: Vec<_> = rows.chunks(at_once).map(|rows| (rows, Mutex::default())).collect();
    let (next, refused) = (AtomicUsize::new(0), Mutex::new(None));
    run(threads, &|| {
        let mut worker = worker();
        loop {
            let chunk = next.fetch_add(1, Ordering::Relaxed);
            let Some((rows, place)) = chunks.get(chunk) else { return };
            let mut answers = Vec::with_capacity(rows.len());
            for row in *rows {
                match worker(row) {
                    Ok(answer) => answers.push(answer),
                    Err(error) => {
                        // The other threads take no chunk more.
                        next.store(chunks.len(), Ordering::Relaxed);
                        take_first(&refused, (chunk * at_once + answers.len(), error));
                        break;
                    }
                }
            }
            *place.lock().unwrap_or_else(PoisonError::into_inner) = answers;
        }
    });
    // Threads take chunks in order. So all chunks before the first refused row were asked.
    let refused = refused.into_inner().unwrap_or_else(PoisonError::into_inner);
    let asked = refused.map_or(chunks.len(), |(index, _)| index / at_once + 1);
    let mut answers = Vec::with_capacity(rows.len());
    for (_, place) in chunks.into_iter().take(asked) {
        answers.append(&mut place.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    (answers, refused)
}

/// Keeps the refused row that comes first.
fn take_first(refused: &Mutex<Option<Refused>>, row: Refused) {
    let mut first = refused.lock().unwrap_or_else(PoisonError::into_inner);
    if first.is_none_or(|(index, _)| row.0 < index) {
        *first = Some(row);
    }
}
