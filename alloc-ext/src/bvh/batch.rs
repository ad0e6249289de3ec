//! Batches of queries on several threads.

use meshsweep_core::{Budget, Bvh, ClosestPoint, Hint, QueryError, ScratchEntry};
use std::num::NonZeroUsize;

/// Queries that are sorted at once. Their order takes 4 MiB, and neighbours in it are near.
const PIECE: usize = 1 << 18;

/// Closest points of all `points`, in their order, with the bits of [`Bvh::closest_point`]. Only
/// `work` depends on the number of threads: a query starts from the answer of the one before.
///
/// Each thread takes a run of successive queries. It asks a path, or a grid row by row, as given,
/// and other points in Morton order (see [`Bvh::closest_points`]).
///
/// Memory: 16 bytes a query besides the answers, at most 4 MiB a thread.
///
/// # Errors
/// [`QueryError::PointNotFinite`] with the least index that is refused, and those of
/// [`Bvh::closest_point`].
pub fn closest_points(
    tree: &Bvh<'_>,
    points: &[[f32; 3]],
    budget: &Budget,
    threads: NonZeroUsize,
) -> Result<Vec<ClosestPoint>, QueryError> {
    let mut answers = vec![ClosestPoint::EMPTY; points.len()];
    let run = points.len().div_ceil(threads.get()).max(1);
    let ask = |number: usize, points: &[[f32; 3]], answers: &mut [ClosestPoint]| {
        let sorted = if is_coherent(points) { 0 } else { points.len().min(PIECE) };
        let mut scratch = vec![ScratchEntry::EMPTY; tree.scratch_entries() + 2 * sorted];
        let asked =
            tree.closest_points(points, &mut Hint::NONE.clone(), answers, *budget, &mut scratch);
        asked.map_err(|error| match error {
            QueryError::PointNotFinite { index } => {
                QueryError::PointNotFinite { index: (number * run) as u32 + index }
            }
            other => other,
        })
    };
    let ask = &ask;
    let runs = points.chunks(run).zip(answers.chunks_mut(run)).enumerate();
    let first_error = std::thread::scope(|scope| {
        if threads.get() == 1 {
            return runs
                .map(|(number, (points, answers))| ask(number, points, answers))
                .find_map(Result::err);
        }
        let running: Vec<_> = runs
            .map(|(number, (points, answers))| scope.spawn(move || ask(number, points, answers)))
            .collect();
        running.into_iter().map(join).find_map(Result::err)
    });
    first_error.map_or(Ok(answers), Err)
}

/// Whether queries are near the ones before: on average within a sixteenth of the box of all, in
/// the 1-norm.
fn is_coherent(points: &[[f32; 3]]) -> bool {
    let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f64>();
    let wide = |p: &[f32; 3]| p.map(f64::from);
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in points {
        for (k, x) in wide(point).into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(x), high[k].max(x));
        }
    }
    let path: f64 = points.windows(2).map(|pair| apart(wide(&pair[0]), wide(&pair[1]))).sum();
    path * 16.0 <= apart(low, high) * points.len() as f64
}

/// Passes on a thread's panic to the caller.
fn join<T>(thread: std::thread::ScopedJoinHandle<'_, T>) -> T {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
