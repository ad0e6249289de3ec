//! The record of all collapses: enough to undo each of them, in any order that dependencies allow.

use glam::DVec3;

/// One edge collapse. Labels number vertices for good: the mesh's own first, then one for each
/// collapse.
#[derive(Clone, Copy, Debug)]
pub struct Collapse {
    /// First end of the collapsed edge.
    pub origin: u32,
    /// Second end.
    pub destination: u32,
    /// The vertex that replaces both.
    pub vertex: u32,
    /// Position of the right wing in the ring; the left wing is at 0.
    pub right: u32,
    /// Where its ring begins in [`History::rings`].
    pub ring_start: u32,
    /// Ring vertices: triangles of the coarse fragment; the fine one has two more.
    pub ring_len: u32,
}

/// All collapses, fine to coarse, and the triangles that they make.
///
/// Triangle instances: the mesh's own triangles first, then for each collapse its `ring_len` coarse
/// triangles, triangle `i` being `(vertex, ring[i], ring[i + 1])`.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Positions by label, as stored.
    pub positions: Vec<DVec3>,
    /// Vertices of the original mesh.
    pub original_vertices: u32,
    /// Triangles of the original mesh: those of the surface, then those that close its holes.
    pub original_triangles: Vec<[u32; 3]>,
    /// Triangles of the surface.
    pub surface_triangles: usize,
    /// The collapses.
    pub collapses: Vec<Collapse>,
    /// Ring labels of all collapses, counter-clockwise, each starting at the left wing.
    pub rings: Vec<u32>,
    /// Instances of the fine fragment of each collapse, `ring_len + 2` each, in the slot order of
    /// [`Split`](meshsweep_core::internal::hull::format::Split).
    pub fine: Vec<u32>,
    /// Volume that each collapse adds, local frame. Empty if vertices are placed near the surface.
    pub added_volume: Vec<f64>,
    /// Corners (labels) of the base hull: first those of the surface, then those that close holes.
    pub base: Vec<[u32; 3]>,
    /// Instances of the base hull's triangles.
    pub base_instances: Vec<u32>,
    /// Triangles of the base hull that began as triangles of the surface.
    pub base_surface: usize,
}

impl History {
    /// Ring of a collapse.
    pub fn ring(&self, collapse: &Collapse) -> &[u32] {
        let start = collapse.ring_start as usize;
        &self.rings[start..start + collapse.ring_len as usize]
    }

    /// Fine instances of collapse number `index`: two more than its ring has vertices.
    pub fn fine(&self, index: usize) -> &[u32] {
        let collapse = &self.collapses[index];
        let start = collapse.ring_start as usize + 2 * index;
        &self.fine[start..start + collapse.ring_len as usize + 2]
    }

    /// First coarse instance of collapse number `index`.
    pub fn first_coarse(&self, index: usize) -> u32 {
        self.original_triangles.len() as u32 + self.collapses[index].ring_start
    }

    /// Instances in all.
    pub fn instances(&self) -> usize {
        self.original_triangles.len() + self.rings.len()
    }

    /// Corners (labels) of coarse triangle `i` of a collapse.
    pub fn coarse_corners(&self, collapse: &Collapse, i: usize) -> [u32; 3] {
        let ring = self.ring(collapse);
        [collapse.vertex, ring[i], ring[(i + 1) % ring.len()]]
    }
}

/// Blob order of the vertices: base hull first, then the two that each split brings, coarse to
/// fine.
#[derive(Clone, Debug)]
pub struct VertexOrder {
    /// Blob index of each label.
    pub index: Vec<u32>,
    /// Label of each blob index.
    pub label: Vec<u32>,
    /// Vertices of the base hull.
    pub base: u32,
}

impl VertexOrder {
    /// Split `i` undoes collapse `n − 1 − i`. Base vertices stand in the order in which the base
    /// triangles name them.
    pub fn new(history: &History) -> Self {
        let mut index = vec![u32::MAX; history.positions.len()];
        let mut label = Vec::with_capacity(history.positions.len());
        let mut place = |l: u32| {
            if index[l as usize] == u32::MAX {
                index[l as usize] = label.len() as u32;
                label.push(l);
            }
        };
        history.base.iter().flatten().for_each(|&l| place(l));
        let base = label.len() as u32;
        for collapse in history.collapses.iter().rev() {
            for l in [collapse.origin, collapse.destination] {
                index[l as usize] = label.len() as u32;
                label.push(l);
            }
        }
        VertexOrder { index, label, base }
    }
}
