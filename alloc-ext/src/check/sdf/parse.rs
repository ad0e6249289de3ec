//! The numbers of the section, and the trilinear function of a cell.

use crate::check::bytes::{Cursor, section};
use glam::DVec3;

const SDF: u32 = 28;

/// Units along each axis of a cell.
pub(super) const CELL: f64 = 2048.0;

/// A field as the bytes say it.
pub(super) struct Field {
    origin: DVec3,
    pub(super) per_unit: f64,
    base: f64,
    step: f64,
    kind: u32,
    pub(super) cells: [usize; 3],
    low: Vec<f64>,
    high: Vec<f64>,
    codes: Vec<u8>,
    errors: Vec<u8>,
}

impl Field {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, String> {
        let mut cursor = Cursor(section(bytes, SDF, "distance field")?, "distance field");
        let mut float = || cursor.float().map(f64::from);
        let origin = DVec3::new(float()?, float()?, float()?);
        let (per_unit, unit) = (float()?, float()?);
        let base = f64::from(cursor.uint(4)?.cast_signed());
        let step = f64::from(cursor.uint(2)?);
        let kind = cursor.uint(2)?;
        let [x, y, z] = [cursor.uint(1)?, cursor.uint(1)?, cursor.uint(1)?].map(|n| n as usize);
        if cursor.uint(1)? != 0 || kind > 2 {
            return Err("a byte that should be 0 is not, or the kind is unknown".to_owned());
        }
        // The inverse of the real number `per_unit`, to nearest.
        if unit as f32 != (1.0 / per_unit) as f32 {
            return Err(format!("the unit {unit:e} is not 1 / {per_unit:e}, rounded to f32"));
        }
        let mut book = || (0..16).map(|_| cursor.uint(2).map(f64::from)).collect();
        let (low, high): (Result<Vec<f64>, String>, Result<Vec<f64>, String>) = (book(), book());
        let mut bytes =
            |count: usize| (0..count).map(|_| cursor.uint(1).map(|b| b as u8)).collect();
        let codes: Result<Vec<u8>, String> = bytes((x + 1) * (y + 1) * (z + 1));
        let errors: Result<Vec<u8>, String> = bytes(x * y * z);
        let (codes, errors) = (codes?, errors?);
        cursor.end()?;
        let cells = [x, y, z];
        Ok(Self {
            origin,
            per_unit,
            base,
            step,
            kind,
            cells,
            low: low?,
            high: high?,
            codes,
            errors,
        })
    }

    pub(super) fn is_unsigned(&self) -> bool {
        self.kind == 0
    }

    pub(super) fn is_solid(&self) -> bool {
        self.kind == 2
    }

    /// A point of the mesh, in units from corner 0 of the lattice.
    pub(super) fn place(&self, p: [f32; 3]) -> DVec3 {
        (DVec3::from(p.map(f64::from)) - self.origin) * self.per_unit - 0.5
    }

    /// The greatest corner of the lattice.
    pub(super) fn end(&self) -> DVec3 {
        DVec3::from(self.cells.map(|n| n as f64)) * CELL
    }

    /// The least corner of a cell, its function, and its errors below and above: of the one above,
    /// the part that a query's shifts may lose is taken off.
    pub(super) fn cell(&self, number: usize) -> (DVec3, Trilinear, [f64; 2]) {
        let [x, y, _] = self.cells;
        let at = [number % x, number / x % y, number / (x * y)];
        let values = std::array::from_fn(|k| {
            let [i, j, l] = [at[0] + (k & 1), at[1] + (k >> 1 & 1), at[2] + (k >> 2)];
            self.base + self.step * f64::from(self.codes[(l * (y + 1) + j) * (x + 1) + i])
        });
        let errors = self.errors[number] as usize;
        let lost = 1.0 + 3.0 * self.step / 2048.0;
        let corner = DVec3::from(at.map(|n| n as f64)) * CELL;
        (corner, Trilinear::of(values), [self.low[errors % 16], self.high[errors / 16] - lost])
    }
}

/// A polynomial of degree 1 in each coordinate, which count from a cell's least corner in units.
pub(super) struct Trilinear {
    constant: f64,
    of: DVec3,
    /// Of yz, xz, xy.
    of_two: DVec3,
    of_three: f64,
}

impl Trilinear {
    /// From the values at the corners, x fastest.
    fn of([a, b, c, d, e, f, g, h]: [f64; 8]) -> Self {
        let square = CELL * CELL;
        Self {
            constant: a,
            of: DVec3::new(b - a, c - a, e - a) / CELL,
            of_two: DVec3::new(g - e - c + a, f - e - b + a, d - c - b + a) / square,
            of_three: (h - g - f + e - d + c + b - a) / (square * CELL),
        }
    }

    /// Value and gradient at a place, and how far the function is from these within half sides of a
    /// box, at most.
    pub(super) fn about(&self, p: DVec3, half: DVec3) -> (f64, DVec3, f64) {
        let DVec3 { x, y, z } = p;
        let two = self.of_two;
        let products = DVec3::new(y * z, x * z, x * y);
        let value =
            self.constant + self.of.dot(p) + two.dot(products) + self.of_three * (x * y * z);
        let gradient = self.of
            + DVec3::new(two.z * y + two.y * z, two.z * x + two.x * z, two.y * x + two.x * y)
            + self.of_three * products;
        // Second derivatives at the place, and the third.
        let bent = (two + self.of_three * p).abs();
        let halves = DVec3::new(half.y * half.z, half.x * half.z, half.x * half.y);
        let rest = bent.dot(halves) + self.of_three.abs() * (half.x * half.y * half.z);
        (value, gradient, rest)
    }
}
