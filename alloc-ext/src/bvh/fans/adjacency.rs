//! Which triangle lies across which edge, for any triangle soup.
//!
//! Half-edge `3t + k` runs from corner `k` of triangle `t` to the next corner; corner `3t + k` is
//! the one that it starts from.

/// No half-edge, no corner.
pub(super) const NONE: u32 = u32::MAX;

/// A soup with its edges paired.
pub(super) struct Adjacency<'a> {
    triangles: &'a [[u32; 3]],
    across: Vec<u32>,
}

impl<'a> Adjacency<'a> {
    /// Pairs the half-edges of each edge: first those that run in opposite directions, in ascending
    /// order, then what is left of one direction; an odd one stays open. So a soup is cut into
    /// pieces in which at most two triangles meet in an edge. An edge from a vertex to itself
    /// stays open, and no triangle is its own neighbour.
    ///
    /// A counting sort over the lower vertex and a short sort for each vertex.
    ///
    /// # Panics
    /// If a triangle names a vertex that is not below `vertex_count`, or if half-edges do not fit
    /// in 32 bits.
    pub(super) fn new(vertex_count: usize, triangles: &'a [[u32; 3]]) -> Self {
        assert!(triangles.len() < (u32::MAX / 3) as usize, "half-edges are numbered in 32 bits");
        let half_edges = || {
            triangles.iter().zip((0u32..).step_by(3)).flat_map(|(&[a, b, c], first)| {
                [(a, b, first), (b, c, first + 1), (c, a, first + 2)]
                    .into_iter()
                    .filter(|edge| edge.0 != edge.1)
            })
        };
        let mut starts = vec![0u32; vertex_count + 1];
        for (from, to, _) in half_edges() {
            starts[from.min(to) as usize + 1] += 1;
        }
        for v in 0..vertex_count {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut uses = vec![(0u32, false, 0u32); starts[vertex_count] as usize];
        for (from, to, half_edge) in half_edges() {
            let slot = &mut next[from.min(to) as usize];
            uses[*slot as usize] = (from.max(to), from > to, half_edge);
            *slot += 1;
        }
        let mut across = vec![NONE; 3 * triangles.len()];
        let mut pair = |(_, _, g): (u32, bool, u32), (_, _, h): (u32, bool, u32)| {
            if g / 3 != h / 3 {
                across[g as usize] = h;
                across[h as usize] = g;
            }
        };
        for range in starts.windows(2) {
            let at_vertex = &mut uses[range[0] as usize..range[1] as usize];
            at_vertex.sort_unstable();
            for edge in at_vertex.chunk_by(|a, b| a.0 == b.0) {
                let (up, down) = edge.split_at(edge.partition_point(|half_edge| !half_edge.1));
                let both = up.len().min(down.len());
                up.iter().zip(down).for_each(|(&g, &h)| pair(g, h));
                for rest in [&up[both..], &down[both..]] {
                    rest.chunks_exact(2).for_each(|two| pair(two[0], two[1]));
                }
            }
        }
        Self { triangles, across }
    }

    /// The corners' vertices of each triangle.
    pub(super) fn triangles(&self) -> &'a [[u32; 3]] {
        self.triangles
    }

    /// The vertex of a corner.
    pub(super) fn vertex(&self, corner: u32) -> u32 {
        self.triangles[corner as usize / 3][corner as usize % 3]
    }

    /// The half-edge paired with `half_edge`, whichever way it runs, or [`NONE`].
    pub(super) fn across(&self, half_edge: u32) -> u32 {
        self.across[half_edge as usize]
    }

    /// The half-edge paired with `half_edge` if it runs the other way, as in a consistently wound
    /// mesh, or [`NONE`].
    pub(super) fn opposite(&self, half_edge: u32) -> u32 {
        let across = self.across(half_edge);
        if across != NONE && self.vertex(across) == self.vertex(half_edge) { NONE } else { across }
    }

    /// The next corner at the same vertex, in the winding's sense, or [`NONE`].
    pub(super) fn next_around(&self, corner: u32) -> u32 {
        self.opposite(preceding(corner))
    }

    /// The previous corner at the same vertex, or [`NONE`].
    pub(super) fn previous_around(&self, corner: u32) -> u32 {
        match self.opposite(corner) {
            NONE => NONE,
            half_edge => following(half_edge),
        }
    }
}

/// The half-edge after `half_edge` in its triangle.
pub(super) const fn following(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 { half_edge - 2 } else { half_edge + 1 }
}

/// The half-edge before `half_edge` in its triangle.
pub(super) const fn preceding(half_edge: u32) -> u32 {
    if half_edge.is_multiple_of(3) { half_edge + 2 } else { half_edge - 1 }
}
