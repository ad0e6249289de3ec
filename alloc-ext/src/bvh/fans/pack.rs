//! Greedy packing of a soup into leaves.

use super::adjacency::Adjacency;
use super::best_leaf::LeafSearch;
use super::cells::Cells;
use super::front::Front;
use super::remaining::Remaining;
use super::{Effort, FanLeaf, MAX_LEAF_TRIANGLES};
use crate::error::BuildError;
use crate::progress::Watch;
use crate::surface::EdgeTable;
use glam::DVec3;

/// Packs a soup into leaves of the box tree. Every triangle is in exactly one leaf, and all of a
/// leaf are in one cell.
///
/// The paper's rule, with the leaf in place of the fan, in each cell by itself: the front starts at
/// the cell's edges and moves inwards. The next seed is the remaining triangle with the fewest
/// remaining neighbours; of equals, the oldest entry of the queue. In a window of 32 triangles about
/// the seed, every run that contains the seed is scored, alone and with each longest second run
/// that joins it. A low effort looks at fewer. The score counts the leaf's triangles, its edges to
/// remaining triangles, the triangles that it cuts off, and its box. The best candidate becomes the
/// next leaf.
///
/// Triangles from different edge-connected components never share a leaf. Of three triangles on an
/// edge, two are neighbours.
///
/// The same input gives the same leaves, on any number of threads: each packs cells of its own.
///
/// Cost: O(n log n) for the cells, then about 10 µs a leaf, for any valences.
///
/// # Errors
/// [`BuildError::Cancelled`].
///
/// # Panics
/// If a triangle names a vertex that has no position, or if there are 2³²/3 triangles or more.
pub(in crate::bvh) fn pack(
    triangles: &[[u32; 3]],
    positions: &[DVec3],
    cells: Cells,
    effort: Effort,
    watch: Watch<'_>,
) -> Result<Vec<FanLeaf>, BuildError> {
    let cells = cells.of(triangles, positions);
    let packed = watch.map(cells.len(), |cell| {
        let soup = Soup::of(&cells[cell], triangles, positions);
        let leaves = pack_soup(&soup.triangles, &soup.positions, effort);
        leaves.into_iter().map(|leaf| soup.numbered(leaf)).collect::<Vec<_>>()
    })?;
    Ok(packed.into_iter().flatten().collect())
}

/// Some triangles of a mesh with numbers of their own.
struct Soup<'a> {
    /// Their numbers in the mesh.
    numbers: &'a [u32],
    /// The numbers of their vertices in the mesh, in ascending order.
    vertices: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    positions: Vec<DVec3>,
}

impl<'a> Soup<'a> {
    fn of(numbers: &'a [u32], triangles: &[[u32; 3]], positions: &[DVec3]) -> Self {
        let in_mesh: Vec<[u32; 3]> = numbers.iter().map(|&t| triangles[t as usize]).collect();
        let mut vertices = in_mesh.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: u32| vertices.partition_point(|&other| other < v) as u32;
        let triangles = in_mesh.iter().map(|triangle| triangle.map(number)).collect();
        let positions = vertices.iter().map(|&v| positions[v as usize]).collect();
        Self { numbers, vertices, triangles, positions }
    }

    /// A leaf with the numbers of the mesh.
    fn numbered(&self, mut leaf: FanLeaf) -> FanLeaf {
        for fan in std::iter::once(&mut leaf.first).chain(&mut leaf.second) {
            fan.centre = self.vertices[fan.centre as usize];
            fan.ring.iter_mut().for_each(|v| *v = self.vertices[*v as usize]);
            fan.triangles.iter_mut().for_each(|t| *t = self.numbers[*t as usize]);
        }
        leaf
    }
}

/// The leaves of one cell.
fn pack_soup(triangles: &[[u32; 3]], positions: &[DVec3], effort: Effort) -> Vec<FanLeaf> {
    let adjacency = Adjacency::new(triangles, &EdgeTable::new(positions.len(), triangles));
    let mut remaining = Remaining::new(&adjacency);
    let mut search = LeafSearch::new(&adjacency, positions, effort);
    let mut front = Front::default();
    for triangle in 0..triangles.len() as u32 {
        front.push(triangle, remaining.degree(triangle));
    }
    let mut leaves = Vec::with_capacity(triangles.len() / MAX_LEAF_TRIANGLES + 1);
    while let Some(seed) = front.pop(&remaining) {
        let leaf = search.best_leaf(&remaining, seed);
        front.take(&leaf, &adjacency, &mut remaining);
        leaves.push(leaf);
    }
    leaves
}
