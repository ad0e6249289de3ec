//! A field's bytes, decoded in f64 by the format's text alone.

use meshsweep_core::{Blob, SectionKind};

/// A field.
pub struct Field {
    pub origin: [f64; 3],
    pub per_unit: f64,
    pub kind: u8,
    pub cells: [usize; 3],
    base: f64,
    step: f64,
    low: [f64; 16],
    high: [f64; 16],
    codes: Vec<u8>,
    errors: Vec<u8>,
}

fn f32_at(bytes: &[u8], at: usize) -> f64 {
    f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")))
}

fn u16_at(bytes: &[u8], at: usize) -> f64 {
    f64::from(u16::from_le_bytes(bytes[at..at + 2].try_into().expect("two bytes")))
}

impl Field {
    pub fn of(blob: &[u8]) -> Self {
        let opened = Blob::open(blob).expect("opens");
        let section = opened.sections().find(|of| of.kind == SectionKind::Sdf).expect("a field");
        let bytes = &blob[section.offset as usize..][..section.bytes as usize];
        let cells = [28, 29, 30].map(|at| usize::from(bytes[at]));
        let corners: usize = cells.iter().map(|n| n + 1).product();
        let count: usize = cells.iter().product();
        assert_eq!(bytes.len(), 96 + corners + count);
        Self {
            origin: [0, 4, 8].map(|at| f32_at(bytes, at)),
            per_unit: f32_at(bytes, 12),
            kind: bytes[26],
            cells,
            base: f64::from(i32::from_le_bytes(bytes[20..24].try_into().expect("four bytes"))),
            step: u16_at(bytes, 24),
            low: std::array::from_fn(|k| u16_at(bytes, 32 + 2 * k)),
            high: std::array::from_fn(|k| u16_at(bytes, 64 + 2 * k)),
            codes: bytes[96..96 + corners].to_vec(),
            errors: bytes[96 + corners..].to_vec(),
        }
    }

    /// The field's box in input units.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        let end = |part: f64| {
            [0, 1, 2].map(|k| {
                self.origin[k] + (0.5 + part * 2048.0 * self.cells[k] as f64) / self.per_unit
            })
        };
        [end(0.0), end(1.0)]
    }

    /// The proved interval of a point in the field, units, before it is cut at 0: without what the
    /// errors above hold for the value that a query computes.
    pub fn interval(&self, p: [f32; 3]) -> Option<[f64; 2]> {
        let [nx, ny, nz] = self.cells;
        let mut cell = [0; 3];
        let mut at = [0.0; 3];
        for k in 0..3 {
            let units = (f64::from(p[k]) - self.origin[k]) * self.per_unit - 0.5;
            let in_cells = units / 2048.0;
            if !(in_cells >= 0.0 && in_cells <= self.cells[k] as f64) {
                return None;
            }
            cell[k] = (in_cells as usize).min(self.cells[k] - 1);
            at[k] = in_cells - cell[k] as f64;
        }
        let [x, y, z] = cell;
        let mut sum = 0.0;
        for corner in 0..8 {
            let [i, j, k] = [corner & 1, corner >> 1 & 1, corner >> 2];
            let part = |bit: usize, at: f64| if bit == 1 { at } else { 1.0 - at };
            let number = x + i + (nx + 1) * (y + j + (ny + 1) * (z + k));
            sum += part(i, at[0]) * part(j, at[1]) * part(k, at[2]) * f64::from(self.codes[number]);
        }
        assert!(z < nz);
        let value = self.base + self.step * sum;
        let errors = usize::from(self.errors[x + nx * (y + ny * z)]);
        let loss = 1.0 + 3.0 * self.step / 2048.0;
        Some([value - self.low[errors & 15], value + self.high[errors >> 4] - loss])
    }
}
