//! The order in which constraints are inserted, and the work that it takes.

use super::half_space::HalfSpace;
use crate::random::SplitMix;
use std::fmt;
use std::str::FromStr;

/// The order in which the constraints of a program are inserted.
///
/// The order decides the time, not the answer: optima agree to within rounding, and so do verdicts
/// unless the program hangs on rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// The next constraint is the one that the optimum so far violates most.
    ///
    /// The fastest order for stars. No bound on its expected work is known. The worst case is cubic
    /// in the number of constraints.
    #[default]
    MostViolated,
    /// Seidel's order: constraints are shuffled, and then inserted as they come. The number seeds
    /// the shuffle.
    ///
    /// Whatever the program, the expected work over all seeds is linear in the number of
    /// constraints: see [`Work::tests`].
    ///
    /// Degenerate case: bundles of nearly coplanar planes that leave a single point. This order may
    /// start within one bundle, where lines of intersection keep few digits, and so miss the
    /// point. Of 100,000 programs made of such bundles it calls about 50 infeasible, and
    /// [`Order::MostViolated`] none.
    Shuffled(u64),
}

/// The name of an order, with the seed of a shuffle: `violated`, `shuffled:7`.
impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MostViolated => f.write_str("violated"),
            Self::Shuffled(seed) => write!(f, "shuffled:{seed}"),
        }
    }
}

/// By its name. Without a seed a shuffle has the seed 0.
impl FromStr for Order {
    type Err = UnknownOrder;

    fn from_str(text: &str) -> Result<Self, UnknownOrder> {
        match text.split_once(':') {
            None if text == "violated" => Ok(Self::MostViolated),
            None if text == "shuffled" => Ok(Self::Shuffled(0)),
            Some(("shuffled", seed)) => seed.parse().map(Self::Shuffled).map_err(|_| UnknownOrder),
            _ => Err(UnknownOrder),
        }
    }
}

/// A text that names no [`Order`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownOrder;

impl fmt::Display for UnknownOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("violated or shuffled is wanted, or shuffled with a seed, as shuffled:7")
    }
}

impl std::error::Error for UnknownOrder {}

/// What a program cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Work {
    /// Times that a constraint was compared with a point or a line.
    ///
    /// With `m` constraints that have a point in common, [`Order::Shuffled`] takes `d!·m` of the
    /// order, in expectation over seeds: at most `m` on a line, `3m` on a plane, `10m` in space. An
    /// optimum in `d` variables depends on `d` constraints at most, so the `i`-th one changes it
    /// with a probability of at most `d/i`. Only then a program with one variable less is solved:
    /// `T(d, m) ≤ Σ 1 + d/i · T(d − 1, i − 1) ≤ m + d · T(d − 1, m)`. This takes shuffles for
    /// random permutations, and leaves out the second look at a line whose ends rounding cannot
    /// tell apart.
    pub tests: u64,
}

/// One run of the solver.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) order: Order,
    /// [`Work::tests`] so far.
    pub(super) tests: u64,
}

impl Run {
    /// Starts a run, and puts `constraints` in the order that a shuffle gives them.
    ///
    /// One shuffle serves all programs of the run. In a random order the constraints before the
    /// `i`-th are in random order, too, whatever the `i`-th is.
    #[inline(always)]
    pub(super) fn start(order: Order, constraints: &mut [HalfSpace]) -> Self {
        if let Order::Shuffled(seed) = order {
            SplitMix::new(seed).shuffle(constraints);
        }
        Self { order, tests: 0 }
    }
}
