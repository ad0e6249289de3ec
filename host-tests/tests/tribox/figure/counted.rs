//! A number that counts what is done with it.

use meshsweep_core::internal::tribox::Scalar;
use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Neg, Sub};

thread_local! {
    pub static COUNTS: Cell<[u32; 3]> = const { Cell::new([0; 3]) };
}

/// A number that counts additions, halvings and comparisons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted(pub f64);

fn count(what: usize) {
    COUNTS.with(|counts| {
        let mut now = counts.get();
        now[what] += 1;
        counts.set(now);
    });
}

impl Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        count(0);
        Counted(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        count(0);
        Counted(self.0 - other.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Counted(-self.0)
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        count(2);
        self.0.partial_cmp(&other.0)
    }
}

impl Scalar for Counted {
    const ZERO: Self = Counted(0.0);
    fn half(self) -> Self {
        count(1);
        Counted(0.5 * self.0)
    }
}
