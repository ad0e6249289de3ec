//! Books of errors or widths: each cell takes the least entry that is not below its own.

/// Most different errors that are looked at. The others are rounded up to them.
const MOST_GROUPS: usize = 1024;

/// The book of least weighted sum, for errors and weights. By dynamic programming over the sorted
/// errors: with one more entry, the cells above a place take the greatest of theirs.
///
/// Errors are whole units. Cost: the sort, and the square of the groups for each entry.
pub(super) fn book<const N: usize>(errors: &[u32], weights: &[f64]) -> [u32; N] {
    let mut sorted: Vec<(u32, f64)> = errors.iter().copied().zip(weights.iter().copied()).collect();
    sorted.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let of_group = sorted.len().div_ceil(MOST_GROUPS).max(1);
    let mut groups: Vec<(u32, f64)> = Vec::new();
    for chunk in sorted.chunks(of_group) {
        let top = chunk.last().map_or(0, |&(error, _)| error);
        let weight: f64 = chunk.iter().map(|(_, weight)| weight).sum();
        match groups.last_mut() {
            Some(last) if last.0 == top => last.1 += weight,
            _ => groups.push((top, weight)),
        }
    }
    let count = groups.len();
    let mut below = vec![0.0; count + 1];
    for (group, (_, weight)) in groups.iter().enumerate() {
        below[group + 1] = below[group] + weight;
    }
    // Least sum of the groups below `to`, and where the last entry's groups begin.
    let mut least = vec![f64::INFINITY; count + 1];
    least[0] = 0.0;
    let mut from = vec![vec![0; count + 1]; N];
    for entry in &mut from {
        let mut next = least.clone();
        for to in 1..=count {
            let top = f64::from(groups[to - 1].0);
            for start in 0..to {
                let sum = least[start] + (below[to] - below[start]) * top;
                if sum < next[to] {
                    next[to] = sum;
                    entry[to] = start;
                }
            }
            if next[to] == least[to] {
                // No entry more is better.
                entry[to] = to;
            }
        }
        least = next;
    }
    let mut book = [0; N];
    let mut to = count;
    for (place, entry) in book.iter_mut().zip(&from).rev() {
        *place = if to > 0 { groups[to - 1].0 } else { 0 };
        to = entry[to];
    }
    book
}

/// The index of the least entry of an ascending book that is not below an error. The last entry
/// must not be below it: neither [`book`] nor `Books::hold` leaves an error above.
pub(super) fn entry<const N: usize>(book: &[u32; N], error: u32) -> usize {
    debug_assert!(error <= book[N - 1], "{error} is above all of {book:?}");
    book.partition_point(|&of| of < error).min(N - 1)
}

#[cfg(test)]
mod tests {
    use super::{book, entry};

    #[test]
    fn every_error_has_an_entry_and_few_errors_keep_theirs() {
        let errors = [7, 3, 900, 3, 12, 7, 5];
        let found: [u32; 16] = book(&errors, &[1.0; 7]);
        assert!(found.is_sorted());
        for error in errors {
            assert_eq!(found[entry(&found, error)], error);
        }
    }

    #[test]
    fn the_book_of_many_errors_is_the_best_of_even_and_of_doubling_steps() {
        let errors: Vec<u32> = (1..=640).collect();
        let weights: Vec<f64> = errors.iter().map(|&e| 1.0 / f64::from(e)).collect();
        let sum = |book: &[u32; 16]| -> f64 {
            let of = |(&e, w): (&u32, &f64)| w * f64::from(book[entry(book, e)]);
            errors.iter().zip(&weights).map(of).sum()
        };
        let best = sum(&book(&errors, &weights));
        assert!(best <= sum(&std::array::from_fn(|k| 40 * (k as u32 + 1))));
        assert!(best <= sum(&std::array::from_fn(|k| 640u32.div_ceil(1 << (15 - k)))));
    }
}
