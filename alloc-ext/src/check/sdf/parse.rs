//! The numbers of the section, and its cells.

use super::function::{Bent, CELL, Function, PART, Trilinear};
use crate::check::bytes::{Cursor, section};
use glam::DVec3;

const SDF: u32 = 28;

/// Units along each axis of a tree's root cell.
const ROOT: f64 = 65_536.0;

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
    /// Of a tree: entries, and those that are leaves with their boxes.
    tree: Option<(Vec<[u8; 5]>, Vec<Leaf>)>,
}

/// A leaf's entry and box: least corner, sides.
struct Leaf {
    entry: usize,
    corner: DVec3,
    sides: DVec3,
}

/// What a field says of a cell or leaf.
pub(super) struct Claim {
    /// The least corner of the box.
    pub(super) corner: DVec3,
    pub(super) sides: DVec3,
    pub(super) function: Function,
    /// How far the distance may be below and above the function: without what a query may lose.
    pub(super) errors: [f64; 2],
}

/// The leaves of a tree, by a walk through all entries.
fn leaves(entries: &[[u8; 5]], roots: [usize; 3]) -> Result<Vec<Leaf>, String> {
    let mut open = Vec::new();
    for entry in 0..roots.iter().product() {
        let [x, y, _] = roots;
        let at = [entry % x, entry / x % y, entry / (x * y)];
        let corner = DVec3::from(at.map(|n| n as f64)) * ROOT;
        open.push(Leaf { entry, corner, sides: DVec3::splat(ROOT) });
    }
    let (mut seen, mut leaves) = (0, Vec::new());
    while let Some(leaf) = open.pop() {
        seen += 1;
        let &[a, b, _, kind, _] =
            entries.get(leaf.entry).ok_or("a child that is no entry of the tree")?;
        if kind >= 128 {
            leaves.push(leaf);
            continue;
        }
        let halved = [0, 1, 2].map(|axis| kind >> axis & 1 != 0);
        let mut sides = leaf.sides;
        for axis in (0..3).filter(|&axis| halved[axis]) {
            sides[axis] *= 0.5;
        }
        if sides == leaf.sides || sides.min_element() < 512.0 || seen > entries.len() {
            return Err("a node that halves no axis, or one too often".to_owned());
        }
        let mut child = leaf.entry + 1 + usize::from(a) + 256 * usize::from(b);
        let ups = |axis: usize| if halved[axis] { vec![0.0, 1.0] } else { vec![0.0] };
        for up_z in ups(2) {
            for up_y in ups(1) {
                for up_x in ups(0) {
                    let corner = leaf.corner + sides * DVec3::new(up_x, up_y, up_z);
                    open.push(Leaf { entry: child, corner, sides });
                    child += 1;
                }
            }
        }
    }
    if seen == entries.len() { Ok(leaves) } else { Err("entries of no node".to_owned()) }
}

impl Field {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, String> {
        let mut cursor = Cursor(section(bytes, SDF, "distance field")?, "distance field");
        let mut float = || cursor.float().map(f64::from);
        let origin = DVec3::new(float()?, float()?, float()?);
        let (per_unit, unit) = (float()?, float()?);
        let base = f64::from(cursor.uint(4)?.cast_signed());
        let step = f64::from(cursor.uint(2)?);
        let (kind, layout) = (cursor.uint(1)?, cursor.uint(1)?);
        let [x, y, z] = [cursor.uint(1)?, cursor.uint(1)?, cursor.uint(1)?].map(|n| n as usize);
        let is_tree = layout == 1;
        if (cursor.uint(1)? == 0) == is_tree || kind > 2 || layout > 1 {
            return Err("the kind or the layout is unknown, or the steps are wrong".to_owned());
        }
        // The inverse of the real number `per_unit`, to nearest.
        if unit as f32 != (1.0 / per_unit) as f32 {
            return Err(format!("the unit {unit:e} is not 1 / {per_unit:e}, rounded to f32"));
        }
        let mut book = || (0..16).map(|_| cursor.uint(2).map(f64::from)).collect();
        let (low, high): (Result<Vec<f64>, String>, Result<Vec<f64>, String>) = (book(), book());
        let cells = [x, y, z];
        let (mut codes, mut errors, mut tree) = (Vec::new(), Vec::new(), None);
        if is_tree {
            let entries = cursor.0.chunks(5).map(|entry| {
                <[u8; 5]>::try_from(entry).map_err(|_| "a part of an entry".to_owned())
            });
            let entries = entries.collect::<Result<Vec<_>, _>>()?;
            // Beyond these the core's integers would overflow.
            if step > 16_384.0 || base.abs() > 2f64.powi(28) {
                return Err("the step or the base of the tree is too large".to_owned());
            }
            if cells.iter().any(|&roots| roots > 7) || entries.len() > 1 << 16 {
                return Err("the tree has too many root cells or entries".to_owned());
            }
            let leaves = leaves(&entries, cells)?;
            tree = Some((entries, leaves));
        } else {
            let mut bytes =
                |count: usize| (0..count).map(|_| cursor.uint(1).map(|b| b as u8)).collect();
            let of_corners: Result<Vec<u8>, String> = bytes((x + 1) * (y + 1) * (z + 1));
            let of_cells: Result<Vec<u8>, String> = bytes(x * y * z);
            (codes, errors) = (of_corners?, of_cells?);
            cursor.end()?;
        }
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
            tree,
        })
    }

    pub(super) fn is_unsigned(&self) -> bool {
        self.kind == 0
    }

    pub(super) fn is_solid(&self) -> bool {
        self.kind == 2
    }

    /// A point of the mesh, in units from the field's corner 0.
    pub(super) fn place(&self, p: [f32; 3]) -> DVec3 {
        (DVec3::from(p.map(f64::from)) - self.origin) * self.per_unit - 0.5
    }

    /// The greatest corner of the field.
    pub(super) fn end(&self) -> DVec3 {
        let side = if self.tree.is_some() { ROOT } else { CELL };
        DVec3::from(self.cells.map(|n| n as f64)) * side
    }

    /// Cells, or leaves.
    pub(super) fn count(&self) -> usize {
        let of_lattice = self.cells.into_iter().product();
        self.tree.as_ref().map_or(of_lattice, |(_, leaves)| leaves.len())
    }

    /// What is said of a cell or leaf.
    pub(super) fn claim(&self, number: usize) -> Claim {
        match &self.tree {
            None => self.cell(number),
            Some((entries, leaves)) => {
                let leaf = &leaves[number];
                self.leaf(leaf, entries[leaf.entry])
            }
        }
    }

    fn leaf(&self, leaf: &Leaf, entry: [u8; 5]) -> Claim {
        let [a, b, c, d, e] = entry.map(u64::from);
        let bits = a | b << 8 | c << 16 | d << 24 | e << 32;
        let six = |at: u32| {
            let bits = (bits >> at & 63) as f64;
            if bits < 32.0 { bits } else { bits - 64.0 }
        };
        let code = (bits >> 29 & 3 | e << 2) as f64;
        let width = (d & 31) as usize;
        let width = if width < 16 { self.low[width] } else { self.high[width - 16] };
        let function = Bent {
            middle: 0.5 * leaf.sides,
            constant: self.base + PART * code * self.step,
            gradient: DVec3::new(six(0), six(6), six(12)),
            curvature: six(18),
        };
        let [below, above] = function.losses();
        Claim {
            corner: leaf.corner,
            sides: leaf.sides,
            function: Function::OfTree(function),
            errors: [-above, width - below],
        }
    }

    fn cell(&self, number: usize) -> Claim {
        let [x, y, _] = self.cells;
        let at = [number % x, number / x % y, number / (x * y)];
        let values = std::array::from_fn(|k| {
            let [i, j, l] = [at[0] + (k & 1), at[1] + (k >> 1 & 1), at[2] + (k >> 2)];
            self.base + self.step * f64::from(self.codes[(l * (y + 1) + j) * (x + 1) + i])
        });
        let errors = self.errors[number] as usize;
        let lost = 1.0 + 3.0 * self.step / 2048.0;
        let corner = DVec3::from(at.map(|n| n as f64)) * CELL;
        Claim {
            corner,
            sides: DVec3::splat(CELL),
            function: Function::OfLattice(Trilinear::of(values)),
            errors: [self.low[errors % 16], self.high[errors / 16] - lost],
        }
    }
}
