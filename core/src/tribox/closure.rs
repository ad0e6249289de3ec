//! Closure: planes moved inward as far as the other parameters imply.
//!
//! Slabs along the axes and the diagonals of the coordinate planes are the *octagons* of Miné (*The
//! octagon abstract domain*, 2006). Every parameter bounds a difference between two of the six
//! numbers x, −x, y, −y, z, −z. Shortest paths give the bounds that sums of differences imply, and
//! one more step those that two bounds of single coordinates imply. Over the reals no bound is
//! tighter.

use super::bounds::Tribox;
use super::directions::SLABS;
use crate::num::{greater, lesser, sum_up};

/// Numbers between which parameters bound differences.
const NUMBERS: usize = 6;

/// Entry `[i][j]` bounds number `j` less number `i`.
type Differences = [[f32; NUMBERS]; NUMBERS];

/// For each slab two coordinates, and whether the second one is negative; the same twice for the
/// axes.
const PAIRS: [(usize, usize, bool); SLABS] = [
    (0, 0, false),
    (1, 1, false),
    (2, 2, false),
    (0, 1, false),
    (0, 1, true),
    (1, 2, false),
    (1, 2, true),
    (2, 0, false),
    (2, 0, true),
];

/// The entries of a slab's greatest value: two, or one for an axis, whose value counts double.
#[inline(always)]
fn places((first, second, negative): (usize, usize, bool)) -> [(usize, usize); 2] {
    let (a, minus_a) = (2 * first, 2 * first + 1);
    let (b, minus_b) =
        if negative { (2 * second + 1, 2 * second) } else { (2 * second, 2 * second + 1) };
    // a + b ≤ high is a − (−b) ≤ high, and b − (−a) ≤ high.
    [(minus_b, a), (minus_a, b)]
}

/// Half of it, rounded up.
#[inline(always)]
fn half_up(x: f32) -> f32 {
    let half = 0.5 * x;
    if half + half < x { half.next_up() } else { half }
}

#[inline(always)]
fn lower(differences: &mut Differences, i: usize, j: usize, value: f32) {
    if let Some(entry) = differences.get_mut(i).and_then(|row| row.get_mut(j))
        && value < *entry
    {
        *entry = value;
    }
}

#[inline(always)]
fn entry(differences: &Differences, i: usize, j: usize) -> f32 {
    differences.get(i).and_then(|row| row.get(j)).copied().unwrap_or(f32::INFINITY)
}

impl Tribox {
    /// The same set with every plane moved inward until it touches, rounded outward.
    /// [`Tribox::EMPTY`] proves that the slabs have no common point. Off a [grid](Self::on_grid)
    /// rounding may hide this.
    ///
    /// Parameters never grow. Exact if they are on a [grid](Self::on_grid). Cost: somewhat more
    /// than 216 sums and comparisons.
    #[must_use]
    pub fn tightened(&self) -> Tribox {
        if self.is_empty() {
            return Tribox::EMPTY;
        }
        let mut differences = [[f32::INFINITY; NUMBERS]; NUMBERS];
        for ((pair, low), high) in PAIRS.into_iter().zip(self.low).zip(self.high) {
            let scale = if pair.0 == pair.1 { 2.0 } else { 1.0 };
            for (i, j) in places(pair) {
                lower(&mut differences, i, j, scale * high);
                // The least value of a + b is the greatest of −a − b, the same differences the
                // other way.
                lower(&mut differences, j, i, -(scale * low));
            }
        }
        for via in 0..NUMBERS {
            for i in 0..NUMBERS {
                let first = entry(&differences, i, via);
                for j in 0..NUMBERS {
                    let path = sum_up(first, entry(&differences, via, j));
                    lower(&mut differences, i, j, path);
                }
            }
        }
        if (0..NUMBERS).any(|i| entry(&differences, i, i) < 0.0) {
            return Tribox::EMPTY;
        }
        let both = differences;
        for i in 0..NUMBERS {
            for j in 0..NUMBERS {
                let doubled = sum_up(entry(&both, i, i ^ 1), entry(&both, j ^ 1, j));
                lower(&mut differences, i, j, half_up(doubled));
            }
        }
        let mut tight = *self;
        let slabs = tight.low.iter_mut().zip(tight.high.iter_mut());
        for ((low, high), pair) in slabs.zip(PAIRS) {
            let [(i, j), _] = places(pair);
            let (up, down) = (entry(&differences, i, j), entry(&differences, j, i));
            let (up, down) =
                if pair.0 == pair.1 { (half_up(up), half_up(down)) } else { (up, down) };
            *high = lesser(*high, up);
            *low = if -down > *low { -down } else { *low };
        }
        if tight.is_empty() { Tribox::EMPTY } else { tight }
    }

    /// A tribox that holds this one and whose [`boundary`](Self::boundary) f32 computes exactly.
    /// Parameters are rounded outward to multiples of 2^-20 of the power of two above all of them,
    /// then [tightened](Self::tightened). That may leave multiples of half of it, so a second call
    /// may round again. Coarse far from the origin, for the unit depends on coordinates, not on
    /// size.
    #[must_use]
    pub fn on_grid(&self) -> Tribox {
        if self.is_empty() {
            return Tribox::EMPTY;
        }
        let most = self
            .slabs()
            .fold(0f32, |most, (low, high)| greater(most, greater(high.abs(), low.abs())));
        // The exponent of the power of two above it, less 20, but f32 still has to hold a quarter
        // of it.
        let exponent = (most.to_bits() >> 23).cast_signed() - 126 - 20;
        let unit = crate::num::exp2(if exponent > -147 { exponent } else { -147 }) as f32;
        let mut out = *self;
        out.low.iter_mut().for_each(|low| *low = -multiple_above(-*low, unit));
        out.high.iter_mut().for_each(|high| *high = multiple_above(*high, unit));
        out.tightened()
    }
}

/// The least multiple of `unit`, a power of two, that is not below `x`. Its factor fits in an i32.
#[inline(always)]
fn multiple_above(x: f32, unit: f32) -> f32 {
    let whole = (x / unit) as i32 as f32 * unit;
    if whole < x { whole + unit } else { whole }
}
