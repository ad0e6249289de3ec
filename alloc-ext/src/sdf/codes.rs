//! Codes of the lattice's corners.
//!
//! They begin at the rounded distances. In each round every code moves, one step at a time, while
//! the weighted width of the eight cells about its corner falls. Corners whose x, y and z have the
//! same three parities share no cell, so they move at once, and the codes do not depend on the
//! number of threads.

use super::allowed::Allowed;
use super::domain::{CELL, Domain};
use super::function::Trilinear;
use super::prove::Errors;
use super::samples::{Sample, Samples};
use super::truth::{Side, Truth};
use super::widths::{LEAST_WEIGHT, NEAR, Widths, weight};
use glam::DVec3;
use meshsweep_core::SdfKind;
use meshsweep_core::internal::sdf::format::layout::{MOST_BASE, MOST_STEP, value_loss};
use rayon::prelude::*;

/// The cost of a cell is its part of the allowed width to this power, so that the widest cells
/// count most.
const SHARPNESS: i32 = 8;

/// Most rounds of moves.
const ROUNDS: usize = 8;

/// Codes, and what they mean.
#[derive(Clone, Debug)]
pub(super) struct Codes {
    /// Distance of code 0, units.
    pub base: i32,
    /// Distance of two codes, units.
    pub step: u16,
    /// Per corner, x fastest.
    pub codes: Vec<u8>,
    /// Weights of the cells.
    pub weights: Vec<f64>,
}

/// What samples of a cell allow: least and most.
struct Limits {
    least: Vec<f32>,
    most: Vec<f32>,
}

impl Limits {
    fn of(samples: impl Iterator<Item = Sample>, kind: SdfKind) -> Self {
        let limits = samples.map(|sample| sample.limits(kind));
        let (least, most) = limits.map(|[least, most]| (least, most)).unzip();
        Self { least, most }
    }
}

/// Distance at a corner.
fn value(sample: Sample, kind: SdfKind, deepest: f64) -> f64 {
    let [low, high] = sample.limits(kind).map(f64::from);
    match (sample.side, kind) {
        (Side::Inside, SdfKind::Solid) => f64::max(-f64::from(sample.distance), -deepest),
        _ => 0.5 * (low + high),
    }
}

impl Codes {
    /// With a width that is allowed, the cells that take the most of it count the most.
    pub fn of(
        truth: &Truth<'_>,
        domain: &Domain,
        samples: &Samples,
        allowed: Option<Allowed>,
    ) -> Self {
        let kind = truth.kind;
        // Deeper inside, a solid field only has to stay below 0.
        let deepest = 0.5 * CELL * 3f64.sqrt();
        let values: Vec<f64> = (0..domain.corner_count())
            .map(|number| {
                let at = domain.corner(number);
                let bit = |axis: usize| usize::from(at[axis] == domain.cells[axis]);
                let [x, y, z] = at;
                let cell = [x - bit(0), y - bit(1), z - bit(2)];
                value(samples.corner(cell, bit(0) | bit(1) << 1 | bit(2) << 2), kind, deepest)
            })
            .collect();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let base = least.floor().clamp(-f64::from(MOST_BASE), f64::from(MOST_BASE));
        let step = ((most - base) / 255.0).ceil().clamp(1.0, f64::from(MOST_STEP));
        let codes = values.iter().map(|value| ((value - base) / step).round() as u8).collect();
        let near = NEAR * domain.diagonal;
        let in_cell = (samples.steps + 1).pow(3) as f64;
        let weight_of = |cell: usize| {
            let of_cell = samples.cell(domain.cell(cell));
            let sum: f64 = of_cell.map(|sample| weight(sample, kind, near)).sum();
            sum / in_cell + LEAST_WEIGHT
        };
        let weights = (0..domain.cell_count()).map(weight_of).collect();
        let mut codes = Self { base: base as i32, step: step as u16, codes, weights };
        codes.narrow(domain, samples, kind, allowed);
        if let Some(allowed) = allowed {
            let taken = |cell: usize| {
                let errors = codes.errors(domain, samples, cell, kind);
                taken(allowed, &codes.corners(domain, cell), errors)
            };
            codes.weights = (0..domain.cell_count()).map(taken).collect();
        }
        codes
    }

    /// The least and the greatest lower end in a cell with these errors, units.
    pub fn lowest(&self, domain: &Domain, cell: usize, errors: Errors) -> [f64; 2] {
        let [least, most] = lowest(&self.corners(domain, cell), errors);
        [least - f64::from(value_loss(self.step)), most]
    }

    /// The function of a cell, units.
    pub fn function(&self, domain: &Domain, cell: usize) -> Trilinear {
        Trilinear::new(self.corners(domain, cell))
    }

    fn corners(&self, domain: &Domain, cell: usize) -> [f64; 8] {
        let [x, y, z] = domain.cell(cell);
        std::array::from_fn(|corner| {
            let at = [x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)];
            let code = self.codes[domain.corner_number(at)];
            f64::from(self.base) + f64::from(self.step) * f64::from(code)
        })
    }

    fn narrow(
        &mut self,
        domain: &Domain,
        samples: &Samples,
        kind: SdfKind,
        allowed: Option<Allowed>,
    ) {
        let of = |cell: usize| Limits::of(samples.cell(domain.cell(cell)), kind);
        let limits: Vec<Limits> = (0..domain.cell_count()).into_par_iter().map(of).collect();
        for _ in 0..ROUNDS {
            let mut moved = 0;
            for parity in 0..8 {
                let corners: Vec<usize> = (0..domain.corner_count())
                    .filter(|&number| {
                        let [x, y, z] = domain.corner(number);
                        x & 1 | (y & 1) << 1 | (z & 1) << 2 == parity
                    })
                    .collect();
                let found: Vec<(usize, u8)> = corners
                    .par_iter()
                    .filter_map(|&number| {
                        let code = self.best(domain, samples.steps, &limits, number, allowed);
                        (code != self.codes[number]).then_some((number, code))
                    })
                    .collect();
                moved += found.len();
                found.into_iter().for_each(|(number, code)| self.codes[number] = code);
            }
            if moved < 1 + domain.corner_count() / 500 {
                break;
            }
        }
    }

    /// The code of a corner with which the cells about it are narrowest, found by single steps from
    /// the present one.
    fn best(
        &self,
        domain: &Domain,
        steps: usize,
        limits: &[Limits],
        number: usize,
        allowed: Option<Allowed>,
    ) -> u8 {
        let at = domain.corner(number);
        let mut cells = Vec::with_capacity(8);
        for corner in 0..8 {
            let bits = [corner & 1, corner >> 1 & 1, corner >> 2];
            let place = [0, 1, 2].map(|axis| at[axis].checked_sub(bits[axis]));
            if let [Some(x), Some(y), Some(z)] = place
                && [x, y, z].iter().zip(domain.cells).all(|(&at, cells)| at < cells)
            {
                let cell = domain.cell_number([x, y, z]);
                cells.push((cell, corner, self.corners(domain, cell)));
            }
        }
        let width = |code: u8| -> f64 {
            let value = f64::from(self.base) + f64::from(self.step) * f64::from(code);
            cells
                .iter()
                .map(|&(cell, corner, mut corners)| {
                    corners[corner] = value;
                    let found = errors(&corners, &limits[cell], steps);
                    match allowed {
                        Some(allowed) => taken(allowed, &corners, found),
                        None => self.weights[cell] * (found.low + found.high),
                    }
                })
                .sum()
        };
        let code = self.codes[number];
        let mut best = (code, width(code));
        for up in [false, true] {
            loop {
                let next = if up { best.0.checked_add(1) } else { best.0.checked_sub(1) };
                let Some(next) = next else { break };
                let found = width(next);
                if found >= best.1 * 0.9999 {
                    break;
                }
                best = (next, found);
            }
        }
        best.0
    }

    /// The errors that a cell's samples need.
    pub fn errors(&self, domain: &Domain, samples: &Samples, cell: usize, kind: SdfKind) -> Errors {
        let limits = Limits::of(samples.cell(domain.cell(cell)), kind);
        errors(&self.corners(domain, cell), &limits, samples.steps)
    }
}

fn lowest(corners: &[f64; 8], errors: Errors) -> [f64; 2] {
    let first = [f64::INFINITY, f64::NEG_INFINITY];
    let of_corners = |[least, most]: [f64; 2], &at: &f64| [least.min(at), most.max(at)];
    corners.iter().fold(first, of_corners).map(|value| value - errors.low)
}

/// The cost of a cell where widths are limited: see [`SHARPNESS`].
fn taken(allowed: Allowed, corners: &[f64; 8], errors: Errors) -> f64 {
    let width = errors.low + errors.high;
    allowed.taken(lowest(corners, errors), width).powi(SHARPNESS)
}

/// The values of a trilinear function at a cell's samples.
fn values(corners: &[f64; 8], steps: usize, mut row: impl FnMut(usize, f32, f32)) {
    let part = 1.0 / steps as f64;
    let between = |a: f64, b: f64, at: usize| a + (b - a) * (at as f64 * part);
    let mut start = 0;
    for k in 0..=steps {
        let face: [f64; 4] = std::array::from_fn(|i| between(corners[i], corners[i + 4], k));
        for j in 0..=steps {
            let [from, to] = [between(face[0], face[2], j), between(face[1], face[3], j)];
            row(start, from as f32, ((to - from) * part) as f32);
            start += steps + 1;
        }
    }
}

fn errors(corners: &[f64; 8], limits: &Limits, steps: usize) -> Errors {
    let (mut low, mut high) = (0f32, 0f32);
    values(corners, steps, |start, from, rise| {
        let least = &limits.least[start..=start + steps];
        let most = &limits.most[start..=start + steps];
        for (at, (least, most)) in least.iter().zip(most).enumerate() {
            let value = from + rise * at as f32;
            low = low.max(value - least);
            high = high.max(most - value);
        }
    });
    Errors { low: f64::from(low), high: f64::from(high) }
}

/// The widths of a cell's intervals with these errors, in the box that was asked for.
pub(super) fn widths(
    codes: &Codes,
    domain: &Domain,
    samples: &Samples,
    cell: usize,
    kind: SdfKind,
    of: Errors,
) -> Widths {
    let mut found = Widths::default();
    let corners = codes.corners(domain, cell);
    let (side, step) = (samples.steps + 1, CELL / samples.steps as f64);
    let first = DVec3::from(domain.cell(cell).map(|at| at as f64)) * CELL;
    let of_cell: Vec<Sample> = samples.cell(domain.cell(cell)).collect();
    values(&corners, samples.steps, |start, from, rise| {
        for (at, &sample) in of_cell[start..=start + samples.steps].iter().enumerate() {
            let (row, value) = (start / side, f64::from(from + rise * at as f32));
            let place = [at, row % side, row / side].map(|at| at as f64 * step);
            if !domain.is_asked(first + DVec3::from(place)) {
                continue;
            }
            let interval = [value - of.low, value + of.high];
            found.add(sample, kind, NEAR * domain.diagonal, interval, 1.0);
        }
    });
    found
}
