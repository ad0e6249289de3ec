//! Hill climbing from random starts.

use crate::random::SplitMix;
use rayon::prelude::*;

/// A box of queries of `N` numbers.
#[derive(Clone, Copy, Debug)]
pub struct Domain<const N: usize> {
    /// Least value of each number.
    pub low: [f32; N],
    /// Greatest value of each number.
    pub high: [f32; N],
}

/// How long to climb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Climb {
    /// Random starts, beside those that the caller names.
    pub starts: usize,
    /// Moves tried from each start.
    pub moves: usize,
}

impl Climb {
    setters! {
        /// From so many random places.
        with_starts: usize => starts,
    }
}

impl Default for Climb {
    fn default() -> Self {
        Climb { starts: 48, moves: 400 }
    }
}

/// The summit of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Summit<const N: usize> {
    /// The query with the greatest value.
    pub query: [f32; N],
    /// Its value.
    pub value: f64,
    /// Mean value of the random starts; if none has a value, that of the summit.
    pub typical: f64,
    /// Queries asked.
    pub asked: usize,
}

/// Moves get smaller down to this part of the domain, then large again.
const SMALLEST_MOVE: f64 = 1.0 / (1u64 << 30) as f64;
const LARGEST_MOVE: f64 = 0.25;

impl<const N: usize> Domain<N> {
    fn random(&self, rng: &mut SplitMix) -> [f32; N] {
        std::array::from_fn(|k| {
            let (low, high) = (f64::from(self.low[k]), f64::from(self.high[k]));
            ((low + (high - low) * rng.roll()) as f32).clamp(self.low[k], self.high[k])
        })
    }

    /// `from`, about half of its numbers moved by at most `part` of the domain.
    fn beside(&self, from: &[f32; N], part: f64, rng: &mut SplitMix) -> [f32; N] {
        std::array::from_fn(|k| {
            let (low, high) = (f64::from(self.low[k]), f64::from(self.high[k]));
            let by = (2.0 * rng.roll() - 1.0) * part * (high - low);
            let is_moved = rng.roll() < 0.5;
            let to = if is_moved { f64::from(from[k]) + by } else { f64::from(from[k]) };
            (to as f32).clamp(self.low[k], self.high[k])
        })
    }
}

/// Climbs from random starts and from `seeds` to the query of the greatest value. A query without a
/// value (`None`) is not taken, and no start.
///
/// The result is the same in every run and on any number of threads, if `value` is. `None` if no
/// query has a value.
///
/// Cost: `(starts + seeds) · (moves + 1)` values.
pub fn climb<const N: usize>(
    domain: &Domain<N>,
    seeds: &[[f32; N]],
    options: &Climb,
    value: &(dyn Fn(&[f32; N]) -> Option<f64> + Sync),
) -> Option<Summit<N>> {
    let numbers = 0..options.starts + seeds.len();
    let climbed: Vec<_> = numbers
        .into_par_iter()
        .filter_map(|number| {
            let mut rng = SplitMix::new(number as u64);
            let random = number.checked_sub(seeds.len()).map(|_| domain.random(&mut rng));
            let start = random.unwrap_or_else(|| seeds[number]);
            let first = value(&start)?;
            let (query, best) = climb_from(domain, start, first, options.moves, &mut rng, value);
            Some((query, best, random.map(|_| first)))
        })
        .collect();
    let typical: Vec<f64> = climbed.iter().filter_map(|&(_, _, first)| first).collect();
    let mut summit: Option<([f32; N], f64)> = None;
    for &(query, value, _) in &climbed {
        if summit.is_none_or(|(_, best)| value > best) {
            summit = Some((query, value));
        }
    }
    summit.map(|(query, value)| Summit {
        query,
        value,
        typical: match typical.len() {
            0 => value,
            count => typical.iter().sum::<f64>() / count as f64,
        },
        asked: climbed.len() * options.moves + options.starts + seeds.len(),
    })
}

fn climb_from<const N: usize>(
    domain: &Domain<N>,
    start: [f32; N],
    first: f64,
    moves: usize,
    rng: &mut SplitMix,
    value: &(dyn Fn(&[f32; N]) -> Option<f64> + Sync),
) -> ([f32; N], f64) {
    let (mut query, mut best, mut part) = (start, first, LARGEST_MOVE);
    for _ in 0..moves {
        let next = domain.beside(&query, part, rng);
        match value(&next) {
            Some(reached) if reached >= best => {
                part = if reached > best { (2.0 * part).min(LARGEST_MOVE) } else { part };
                (query, best) = (next, reached);
            }
            _ => part *= 0.85,
        }
        if part < SMALLEST_MOVE {
            part = LARGEST_MOVE;
        }
    }
    (query, best)
}

#[cfg(test)]
mod tests {
    use super::{Climb, Domain, climb};

    const SQUARE: Domain<2> = Domain { low: [-3.0, 1.0], high: [5.0, 2.0] };

    #[test]
    fn the_top_of_a_hill_is_found_from_any_start() {
        let hill = |&[x, y]: &[f32; 2]| Some(-f64::from((x - 1.25).powi(2) + (y - 1.5).powi(2)));
        let top = climb(&SQUARE, &[], &Climb::default(), &hill).expect("a value everywhere");
        assert!(top.value > -1e-6 && top.typical < -0.5, "{top:?}");
        assert_eq!(climb(&SQUARE, &[], &Climb::default(), &hill), Some(top));
    }

    #[test]
    fn queries_stay_in_the_domain_and_those_without_a_value_are_not_taken() {
        let inside = |&[x, y]: &[f32; 2]| {
            assert!((-3.0..=5.0).contains(&x) && (1.0..=2.0).contains(&y));
            (x < 0.0).then_some(f64::from(x))
        };
        let top = climb(&SQUARE, &[], &Climb::default(), &inside).expect("half of it");
        assert!(top.value <= 0.0 && top.value > -0.01, "{top:?}");
        assert_eq!(climb(&SQUARE, &[], &Climb::default(), &|_| None), None);
    }

    #[test]
    fn a_named_start_on_a_spike_is_the_summit() {
        let spike = [2.0, 1.125];
        let value = |query: &[f32; 2]| Some(if *query == spike { 7.0 } else { 1.0 });
        let top = climb(&SQUARE, &[spike], &Climb::default(), &value).expect("values");
        assert_eq!((top.query, top.value, top.typical), (spike, 7.0, 1.0));
    }
}
