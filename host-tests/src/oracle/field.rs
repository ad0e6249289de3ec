//! A field's bytes, decoded in f64 by the format's text alone.

use meshsweep_core::{Blob, SectionKind};

/// A field.
#[derive(Clone, Debug)]
pub struct Field {
    /// The least corner, input units.
    pub origin: [f64; 3],
    /// Units in one of the input.
    pub per_unit: f64,
    /// What distances mean: 0 signed, 1 solid, 2 surface.
    pub kind: u8,
    /// Cells along each axis: of a tree its root cells.
    pub cells: [usize; 3],
    base: f64,
    step: f64,
    low: [f64; 16],
    high: [f64; 16],
    codes: Vec<u8>,
    errors: Vec<u8>,
    /// Of a tree; else empty.
    entries: Vec<[u8; 5]>,
}

fn f32_at(bytes: &[u8], at: usize) -> f64 {
    f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")))
}

fn u16_at(bytes: &[u8], at: usize) -> f64 {
    f64::from(u16::from_le_bytes(bytes[at..at + 2].try_into().expect("two bytes")))
}

impl Field {
    /// The field of a blob.
    ///
    /// # Panics
    /// The blob has no field.
    #[must_use]
    pub fn of(blob: &[u8]) -> Self {
        let opened = Blob::open(blob).expect("opens");
        let section = opened.sections().find(|of| of.kind == SectionKind::Sdf).expect("a field");
        let bytes = &blob[section.offset as usize..][..section.bytes as usize];
        let cells = [28, 29, 30].map(|at| usize::from(bytes[at]));
        let is_tree = bytes[27] == 1;
        let corners: usize = cells.iter().map(|n| n + 1).product();
        let count: usize = cells.iter().product();
        let [corners, count] = if is_tree { [0, 0] } else { [corners, count] };
        let rest = &bytes[96 + corners + count..];
        let (entries, over) = if is_tree { rest.as_chunks::<5>() } else { (&[][..], rest) };
        assert!(over.is_empty());
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
            errors: bytes[96 + corners..][..count].to_vec(),
            entries: entries.to_vec(),
        }
    }

    /// Whether it is a tree.
    #[must_use]
    pub const fn is_tree(&self) -> bool {
        !self.entries.is_empty()
    }

    /// Units along a side of a cell, or of a root cell.
    fn side(&self) -> f64 {
        if self.is_tree() { 65_536.0 } else { 2048.0 }
    }

    /// The interval of a place of a tree, units.
    fn of_tree(&self, place: [f64; 3]) -> Option<[f64; 2]> {
        let root = place.map(|x| (x / 65_536.0).floor());
        if (0..3).any(|k| root[k] < 0.0 || root[k] >= self.cells[k] as f64) {
            return None;
        }
        let [x, y, _] = self.cells;
        let [i, j, k] = root.map(|x| x as usize);
        let mut at = i + x * (j + y * k);
        let mut entry = self.entries[at];
        let (mut middle, mut half) = (root.map(|x| (x + 0.5) * 65_536.0), [32_768.0; 3]);
        while entry[3] < 128 {
            let between = usize::from(entry[0]) + 256 * usize::from(entry[1]);
            let (mut child, mut weight) = (at + 1 + between, 1);
            for k in (0..3).filter(|k| entry[3] >> k & 1 == 1) {
                half[k] /= 2.0;
                let is_upper = place[k] >= middle[k];
                middle[k] += if is_upper { half[k] } else { -half[k] };
                child += usize::from(is_upper) * weight;
                weight *= 2;
            }
            at = child;
            entry = self.entries[at];
        }
        let bits = (0..5).map(|k| u64::from(entry[k]) << (8 * k)).sum::<u64>();
        let number = |at: u32| ((bits >> at & 63) as f64 + 32.0).rem_euclid(64.0) - 32.0;
        let gradient = [number(0), number(6), number(12)];
        let code = (bits >> 32 << 2 | bits >> 29 & 3) as f64;
        let way = [0, 1, 2].map(|k| place[k] - middle[k]);
        let along: f64 = (0..3).map(|k| gradient[k] * way[k]).sum();
        let square: f64 = way.iter().map(|x| x * x).sum();
        let largest = half[0].max(half[1]).max(half[2]);
        let bend = number(18) * (square - (along / 32.0).powi(2)) / (2.0 * largest);
        let value = self.base + 1057.0 / 32_768.0 * (code * self.step + along + bend);
        let width = (bits >> 24 & 31) as usize;
        let width = if width < 16 { self.low[width] } else { self.high[width - 16] };
        // The function is claimed to be below the distance, and the last shift's unit is lost
        // above.
        Some([value, value + width - 1.0])
    }

    /// The field's box in input units.
    #[must_use]
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        let end = |part: f64| {
            [0, 1, 2].map(|k| {
                self.origin[k] + (0.5 + part * self.side() * self.cells[k] as f64) / self.per_unit
            })
        };
        [end(0.0), end(1.0)]
    }

    /// The proved interval of a point in the field, units, before it is cut at 0: without what the
    /// errors above hold for the value that a query computes.
    #[must_use]
    pub fn interval(&self, p: [f32; 3]) -> Option<[f64; 2]> {
        if self.is_tree() {
            let place = |k: usize| (f64::from(p[k]) - self.origin[k]) * self.per_unit - 0.5;
            return self.of_tree([place(0), place(1), place(2)]);
        }
        let (value, errors) = self.of_lattice(p)?;
        let loss = 1.0 + 3.0 * self.step / 2048.0;
        Some([value - self.low[errors & 15], value + self.high[errors >> 4] - loss])
    }

    /// The function of a lattice at a point in it, and its cell's errors below and above, input
    /// units.
    #[must_use]
    pub fn function(&self, p: [f32; 3]) -> Option<(f64, [f64; 2])> {
        let (value, errors) = self.of_lattice(p)?;
        let errors = [self.low[errors & 15], self.high[errors >> 4]];
        Some((value / self.per_unit, errors.map(|error| error / self.per_unit)))
    }

    /// The function of a lattice, units, and the cell's byte of errors.
    fn of_lattice(&self, p: [f32; 3]) -> Option<(f64, usize)> {
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
        Some((value, errors))
    }
}
