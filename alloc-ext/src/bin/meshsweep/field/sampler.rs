//! Asks for the values of rows of samples, on several threads.

use super::lattice::Lattice;
use crate::ask::threads;
use crate::progress::Bar;
use crate::side;
use meshsweep::distances::signed_distance;
use meshsweep_core::{Budget, Bvh, Hint, Interval, QueryError, ScratchEntry, Side};
use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Write};
use std::sync::Mutex;

/// Samples that are computed before they are written: this bounds the memory, and suffices for all
/// threads.
const AT_ONCE: usize = 1 << 22;

/// The value of a sample without a sign: these bits on every machine.
const QUIET_NAN: f32 = f32::from_bits(0x7FC0_0000);

/// How many samples have no sign, by the reason.
#[derive(Debug, Default)]
pub struct NoSign(BTreeMap<&'static str, usize>);

impl NoSign {
    pub fn count(&self) -> usize {
        self.0.values().sum()
    }

    fn add(mut self, other: &NoSign) -> NoSign {
        other.0.iter().for_each(|(reason, count)| *self.0.entry(reason).or_default() += count);
        self
    }
}

impl fmt::Display for NoSign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts: Vec<String> =
            self.0.iter().map(|(reason, count)| format!("{count} {reason}")).collect();
        f.write_str(&counts.join(", "))
    }
}

/// A lattice of samples, and the tree that answers for them.
pub struct Sampler<'a> {
    pub tree: &'a Bvh<'a>,
    pub lattice: Lattice,
    pub signed: bool,
    pub interval: bool,
}

impl Sampler<'_> {
    /// Numbers of a sample.
    pub fn values(&self) -> usize {
        1 + usize::from(self.interval)
    }

    /// Computes and writes all samples, many rows at once.
    pub fn write(&self, out: &mut dyn Write, threads: usize, bar: &Bar) -> io::Result<NoSign> {
        let [nx, ny, nz] = self.lattice.size;
        let row_values = nx * self.values();
        let rows_at_once = (AT_ONCE / nx).clamp(1, ny * nz);
        let mut values = vec![0f32; rows_at_once * row_values];
        let mut no_sign = NoSign::default();
        for first in (0..ny * nz).step_by(rows_at_once) {
            let rows = rows_at_once.min(ny * nz - first);
            let part = &mut values[..rows * row_values];
            no_sign =
                no_sign.add(&self.sample(first, part, threads, bar).map_err(io::Error::other)?);
            for value in part.iter() {
                out.write_all(&value.to_le_bytes())?;
            }
        }
        Ok(no_sign)
    }

    /// Computes the rows from `first` on. A thread that is done takes the next row. The values of a
    /// row do not depend on the thread.
    fn sample(
        &self,
        first: usize,
        values: &mut [f32],
        threads: usize,
        bar: &Bar,
    ) -> Result<NoSign, QueryError> {
        let row_values = self.lattice.size[0] * self.values();
        let rows = Mutex::new(values.chunks_mut(row_values).enumerate());
        let work = || -> Result<NoSign, QueryError> {
            let mut scratch = vec![ScratchEntry::EMPTY; self.tree.scratch_entries()];
            let mut no_sign = NoSign::default();
            loop {
                // No thread can panic while it holds the lock.
                let Some((row, values)) = rows.lock().ok().and_then(|mut rows| rows.next()) else {
                    return Ok(no_sign);
                };
                self.row(first + row, values, &mut scratch, &mut no_sign)?;
                bar.advance(1);
            }
        };
        let all = threads::each(threads, work);
        all.into_iter().try_fold(NoSign::default(), |sum, one| Ok(sum.add(&one?)))
    }

    /// Row `row`. Neighbouring samples follow each other, so an answer is a good hint for the next
    /// sample.
    fn row(
        &self,
        row: usize,
        values: &mut [f32],
        scratch: &mut [ScratchEntry],
        no_sign: &mut NoSign,
    ) -> Result<(), QueryError> {
        let ny = self.lattice.size[1];
        let mut hint = Hint::NONE;
        for (i, slot) in values.chunks_mut(self.values()).enumerate() {
            let point = self.lattice.point([i, row % ny, row / ny]);
            let (Interval { lower, upper }, reason) = self.interval(point, scratch, &mut hint)?;
            match slot {
                [low, high] => (*low, *high) = (lower, upper),
                [middle] if reason.is_some() => *middle = QUIET_NAN,
                [middle] => *middle = ((f64::from(lower) + f64::from(upper)) / 2.0) as f32,
                _ => {}
            }
            if let Some(reason) = reason {
                *no_sign.0.entry(reason).or_default() += 1;
            }
        }
        Ok(())
    }

    /// The bounds of a sample, and why they have no sign if one is wanted.
    fn interval(
        &self,
        point: [f32; 3],
        scratch: &mut [ScratchEntry],
        hint: &mut Hint,
    ) -> Result<(Interval, Option<&'static str>), QueryError> {
        if self.signed {
            let answer = signed_distance(self.tree, point, Budget::EXACT, scratch)?;
            let is_undecided = matches!(answer.side, Side::Undecided(_));
            return Ok((answer.distance, is_undecided.then(|| side::reason(answer.side))));
        }
        let answer = self.tree.closest_point_from(point, hint, Budget::EXACT, scratch)?;
        Ok((answer.distance, None))
    }
}
