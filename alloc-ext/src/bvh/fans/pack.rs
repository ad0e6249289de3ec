//! The leaves of a mesh, cell by cell, on all threads.

use super::cells::cells;
use super::greedy::greedy;
use super::price::{Cost, Costs, LeafBytes};
use super::soup::Soup;
use super::{Effort, FanLeaf};
use crate::error::BuildError;
use crate::progress::Watch;
use glam::DVec3;

/// How large cells are.
#[derive(Clone, Copy, Debug)]
pub(in crate::bvh) enum Packing {
    /// At most so many triangles.
    Cells(usize),
    /// As large as costs least, where bytes count this much: with 1 the product of a query's
    /// instructions and the bytes is least.
    Cheapest { largest: usize, weight_of_bytes: f64, bytes: LeafBytes },
}

/// Packed leaves, and what they cost.
pub(in crate::bvh) struct Packed {
    pub leaves: Vec<FanLeaf>,
    /// Cells that leaves were packed in.
    pub cells: usize,
    /// The largest cells and those that were chosen, if there was a choice.
    pub choice: Option<[Cost; 2]>,
}

/// Halvings of a cell at most, so that the time has a bound.
const MOST_HALVINGS: u32 = 12;

/// Halves whose price is so many times that of their cell are not halved again. Up to 1.1, a fifth
/// more time, nothing changes; with 1.02 small meshes are a tenth costlier.
const HOPELESS: f64 = 1.05;

/// Packs a soup into leaves of the box tree. Every triangle is in exactly one leaf, and all of a
/// leaf are in one cell.
///
/// Triangles from different edge-connected components never share a leaf. Of three triangles on an
/// edge, two are neighbours.
///
/// The same input gives the same leaves, on any number of threads: each packs cells of its own.
///
/// Cost: O(n log n) for the cells, then about 10 µs a leaf, for any valences; the cheapest cells
/// take up to twelve times as much, five times as a rule.
///
/// # Errors
/// [`BuildError::Cancelled`].
///
/// # Panics
/// If a triangle names a vertex that has no position, or if there are 2³²/3 triangles or more.
pub(in crate::bvh) fn pack(
    triangles: &[[u32; 3]],
    positions: &[DVec3],
    packing: Packing,
    effort: Effort,
    watch: Watch<'_>,
) -> Result<Packed, BuildError> {
    let (most, choice) = match packing {
        Packing::Cells(most) => (most, None),
        Packing::Cheapest { largest, weight_of_bytes, bytes } => {
            (largest, Some((weight_of_bytes, Costs::new(positions, bytes))))
        }
    };
    let cells = cells(triangles, positions, most);
    let soup = |cell: &Vec<u32>| Soup::of(cell.clone(), triangles, positions);
    let Some((weight_of_bytes, costs)) = choice else {
        let leaves = watch.map(cells.len(), |at| {
            let soup = soup(&cells[at]);
            greedy(&soup, effort).into_iter().map(|leaf| soup.in_mesh(leaf)).collect::<Vec<_>>()
        })?;
        let leaves = leaves.into_iter().flatten().collect();
        return Ok(Packed { leaves, cells: cells.len(), choice: None });
    };
    let whole = watch.part(0.0, 0.2).map(cells.len(), |at| {
        let soup = soup(&cells[at]);
        Division::whole(soup, &costs, effort)
    })?;
    let cost = whole.iter().map(|division| division.cost).sum::<Cost>().of_query();
    // Near this cost a part of the instructions is worth the same part of the bytes.
    let per_byte = weight_of_bytes * cost.instructions / cost.bytes;
    let divided = watch
        .part(0.2, 1.0)
        .map(whole.len(), |at| whole[at].divided(&costs, effort, per_byte, MOST_HALVINGS))?;
    let chosen = divided.iter().map(|found| found.cost).sum::<Cost>().of_query();
    Ok(Packed {
        cells: divided.iter().map(|found| found.cells).sum(),
        leaves: divided.into_iter().flat_map(|found| found.leaves).collect(),
        choice: Some([cost, chosen]),
    })
}

/// A cell with its leaves.
struct Division {
    soup: Soup,
    leaves: Vec<FanLeaf>,
    cost: Cost,
}

/// The leaves of a cell, with the numbers of the mesh.
struct Found {
    leaves: Vec<FanLeaf>,
    cells: usize,
    cost: Cost,
}

impl Division {
    fn whole(soup: Soup, costs: &Costs, effort: Effort) -> Self {
        let leaves = greedy(&soup, effort);
        let cost = leaves.iter().map(|leaf| costs.of(&soup, leaf)).sum();
        Self { soup, leaves, cost }
    }

    /// The cell as it is, or its halves divided in the same way: whichever costs less.
    fn divided(&self, costs: &Costs, effort: Effort, per_byte: f64, halvings: u32) -> Found {
        let whole = || {
            let leaves = self.leaves.iter().map(|leaf| self.soup.in_mesh(leaf.clone())).collect();
            Found { leaves, cells: 1, cost: self.cost }
        };
        if halvings == 0 || self.soup.triangles.len() < 2 {
            return whole();
        }
        let halves: Vec<Self> =
            self.soup.halves().into_iter().map(|half| Self::whole(half, costs, effort)).collect();
        let price = self.cost.price(per_byte);
        let of_halves: f64 = halves.iter().map(|half| half.cost.price(per_byte)).sum();
        if of_halves > HOPELESS * price {
            return whole();
        }
        let halves = halves.iter().map(|half| half.divided(costs, effort, per_byte, halvings - 1));
        let joined = halves.reduce(|mut all, half| {
            all.leaves.extend(half.leaves);
            Found { cells: all.cells + half.cells, cost: all.cost + half.cost, ..all }
        });
        match joined {
            Some(found) if found.cost.price(per_byte) < price => found,
            _ => whole(),
        }
    }
}
