//! Batches of queries on all cores.

use super::FastBvh;
use meshsweep_core::{Budget, Bvh, ClosestPoint, Hint, QueryError, ScratchEntry};
use rayon::prelude::*;

/// Queries that one thread takes at once. Their order takes 256 KiB, and neighbours in it are near.
pub const BATCH: usize = 1 << 14;

/// Closest points of all `points`, in their order, with the bits of [`Bvh::closest_point`], on the
/// threads of rayon's current pool. `work` depends on the order of the points, because a query
/// starts from the answer of the one before. Nothing depends on the number of threads.
///
/// A thread takes pieces of 2^14 successive queries. It asks a path, or a grid row by row, as
/// given, and other points in Morton order (see [`Bvh::closest_points`]).
///
/// Memory: at most 256 KiB a thread besides the answers.
///
/// # Errors
/// [`QueryError::PointNotFinite`] with the least index that is refused, and those of
/// [`Bvh::closest_point`].
pub fn closest_points(
    tree: &Bvh<'_>,
    points: &[[f32; 3]],
    budget: &Budget,
) -> Result<Vec<ClosestPoint>, QueryError> {
    let mut answers = vec![ClosestPoint::EMPTY; points.len()];
    fill(&FastBvh::new(*tree), points, &mut answers, budget)
        .map_or(Ok(answers), |(_, error)| Err(error))
}

/// As [`closest_points`], up to the first point that is refused: the answers before it, its index,
/// and why.
#[must_use]
pub fn closest_points_until_refused(
    tree: &Bvh<'_>,
    points: &[[f32; 3]],
    budget: &Budget,
) -> (Vec<ClosestPoint>, Option<(usize, QueryError)>) {
    let tree = FastBvh::new(*tree);
    let mut answers = vec![ClosestPoint::EMPTY; points.len()];
    let refused = fill(&tree, points, &mut answers, budget);
    if let Some((index, _)) = refused {
        // A piece with a refused point has no answers.
        answers.truncate(index);
        let begin = index - index % BATCH;
        let (points, answers) = (points.get(begin..index), answers.get_mut(begin..));
        fill(&tree, points.unwrap_or_default(), answers.unwrap_or_default(), budget);
    }
    (answers, refused)
}

/// Answers all pieces. The first refused point, if one is.
fn fill(
    tree: &FastBvh<'_>,
    points: &[[f32; 3]],
    answers: &mut [ClosestPoint],
    budget: &Budget,
) -> Option<(usize, QueryError)> {
    let pieces = points.par_chunks(BATCH).zip(answers.par_chunks_mut(BATCH)).enumerate();
    pieces.find_map_first(|(number, (points, answers))| {
        let sorted = if is_coherent(points) { 0 } else { points.len() };
        let mut scratch = vec![ScratchEntry::EMPTY; tree.scratch_entries() + 2 * sorted];
        let asked =
            tree.closest_points(points, &mut Hint::NONE.clone(), answers, *budget, &mut scratch);
        asked.err().map(|error| match error {
            QueryError::PointNotFinite { index } => {
                let index = number * BATCH + index as usize;
                (index, QueryError::PointNotFinite { index: index as u32 })
            }
            other => (number * BATCH, other),
        })
    })
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
