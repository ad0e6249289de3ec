//! Codes of the functions' values at the leaves' centres, and how they are read.

use super::leaf::GRADIENT_STEP;
use crate::sdf::region::MARGIN;
use meshsweep_core::internal::sdf::format::layout::MOST_BASE;
use meshsweep_core::internal::sdf::format::layout::tree::{MOST_CODE, MOST_STEP};

/// Codes that are kept below the least one and above the greatest: a proof may need lower ones.
const SPARE_CODES: f64 = 12.0;

/// What stands in a leaf: code, and width in whole units.
#[derive(Clone, Copy)]
pub(super) struct Coded {
    pub code: i64,
    pub width: u32,
}

/// How codes are read, units.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub base: i32,
    pub step: u16,
}

impl Scale {
    /// That holds these values; `None` if they are too far apart.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let least = values.clone().fold(f64::INFINITY, f64::min);
        let most = values.fold(f64::NEG_INFINITY, f64::max);
        let step = (most - least) / GRADIENT_STEP / (f64::from(MOST_CODE) - 2.0 * SPARE_CODES);
        let step = step.ceil().max(1.0);
        let base = (least - SPARE_CODES * step * GRADIENT_STEP).floor();
        let fits = step <= f64::from(MOST_STEP) && base.abs() <= f64::from(MOST_BASE);
        fits.then_some(Self { base: base as i32, step: step as u16 })
    }

    /// Units of a code.
    pub fn step(self) -> f64 {
        f64::from(self.step) * GRADIENT_STEP
    }

    pub fn value(self, code: i64) -> f64 {
        f64::from(self.base) + code as f64 * self.step()
    }

    /// The greatest code whose value is not above this.
    pub fn code(self, value: f64) -> i64 {
        ((value - f64::from(self.base)) / self.step()).floor() as i64
    }

    /// A scale that holds the leaves: this one, or a wider one, on which leaves go down and become
    /// as much wider. A proof may have lowered a leaf by many codes.
    pub fn holding(self, leaves: &mut [Coded]) -> Option<Self> {
        let in_range = |coded: &Coded| (0..=i64::from(MOST_CODE)).contains(&coded.code);
        if leaves.iter().all(in_range) {
            return Some(self);
        }
        let wider = Self::of(leaves.iter().map(|coded| self.value(coded.code)))?;
        for coded in leaves {
            let value = self.value(coded.code);
            let code = wider.code(value);
            let width = f64::from(coded.width) + value - wider.value(code) + MARGIN;
            *coded = Coded { code, width: width.ceil() as u32 };
        }
        Some(wider)
    }
}
