//! How large the cells are that leaves are packed in, and the report of the choice.

use super::fans::{Cost, Effort, LARGE, LeafBytes, Packed, Packing};
use crate::counted::Counted;
use std::fmt;

/// Triangles of a cell at most, where no cost chooses.
const CELL: usize = 128;

/// Triangles of the largest cells, and the weight of bytes.
const FAST: (usize, f64) = (256, 1.0);
/// The same for winding numbers: they count the triangles of all nodes that they open, so they gain
/// from full leaves and few nodes.
const FULL: (usize, f64) = (2048, 4.0);

/// The packing of a tree that is stored, with so many bytes a node. Cells are chosen by their cost,
/// which takes about five times as long as packing, unless the mesh is large.
pub(super) fn of_stored(node: usize, has_winding: bool, triangles: usize, is_f32: bool) -> Packing {
    if triangles > LARGE {
        return quick();
    }
    let (largest, weight_of_bytes) = if has_winding { FULL } else { FAST };
    let bytes = LeafBytes { node, coordinate: if is_f32 { 4 } else { 2 } };
    Packing::Cheapest { largest, weight_of_bytes, bytes }
}

/// How many candidates the packing of a tree that is stored looks at.
pub(super) const fn effort(triangles: usize) -> Effort {
    if triangles > LARGE { Effort::LARGE } else { Effort::FULL }
}

/// The packing of a tree that only a builder asks.
pub(super) const fn quick() -> Packing {
    Packing::Cells(CELL)
}

/// The cells that leaves were packed in, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PackingReport {
    /// Cells.
    pub cells: usize,
    /// Instructions of a query with the chosen cells, divided by those with the largest, by the
    /// model; `None` if the mesh was too large for a choice.
    pub instructions: Option<f64>,
    /// The same of the bytes of nodes and vertices.
    pub bytes: Option<f64>,
}

impl PackingReport {
    pub(super) fn of(packed: &Packed) -> Self {
        let ratio = |of: fn(&Cost) -> f64| {
            packed.choice.as_ref().map(|[largest, chosen]| of(chosen) / of(largest))
        };
        Self {
            cells: packed.cells,
            instructions: ratio(|cost| cost.instructions),
            bytes: ratio(|cost| cost.bytes),
        }
    }
}

impl fmt::Display for PackingReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "leaves packed in {}", Counted(self.cells, "cell"))?;
        match (self.instructions, self.bytes) {
            (Some(instructions), Some(bytes)) => write!(
                f,
                " of the least cost: {:+.1} % instructions, {:+.1} % bytes against the largest \
                 cells, by the model",
                100.0 * (instructions - 1.0),
                100.0 * (bytes - 1.0)
            ),
            _ => write!(f, " of at most {CELL} triangles: the mesh is too large for a choice"),
        }
    }
}
