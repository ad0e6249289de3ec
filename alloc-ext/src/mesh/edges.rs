//! Undirected edges and the half-edges on them.
//!
//! Half-edge `3t + k` runs from corner `k` of triangle `t` to the next corner.

/// No other triangle on the edge.
pub(super) const BOUNDARY: u32 = u32::MAX;
/// More than two triangles on the edge, or one triangle twice.
pub(super) const NON_MANIFOLD: u32 = u32::MAX - 1;

/// All half-edges, grouped by undirected edge. Built by a counting sort over the lower vertex and a
/// short sort for each vertex, which is several times faster than sorting all of them.
#[derive(Clone)]
pub(crate) struct EdgeTable {
    starts: Vec<u32>,
    uses: Vec<(u32, u32)>,
}

impl EdgeTable {
    pub(crate) fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0u32; vertex_count + 1];
        for_each_half_edge(triangles, |_, low, _| starts[low as usize + 1] += 1);
        for v in 0..vertex_count {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut uses = vec![(0, 0); 3 * triangles.len()];
        for_each_half_edge(triangles, |half_edge, low, high| {
            let slot = &mut next[low as usize];
            uses[*slot as usize] = (high, half_edge);
            *slot += 1;
        });
        for pair in starts.windows(2) {
            uses[pair[0] as usize..pair[1] as usize].sort_unstable();
        }
        Self { starts, uses }
    }

    /// For each edge its half-edges in ascending order, as `(higher vertex, half-edge)`.
    pub(crate) fn edges(&self) -> impl Iterator<Item = &[(u32, u32)]> {
        self.starts.windows(2).flat_map(|pair| {
            self.uses[pair[0] as usize..pair[1] as usize].chunk_by(|a, b| a.0 == b.0)
        })
    }

    /// For each half-edge the other one on its edge, or [`BOUNDARY`], or [`NON_MANIFOLD`].
    pub(super) fn twins(&self) -> Vec<u32> {
        let mut twins = vec![BOUNDARY; self.uses.len()];
        for edge in self.edges() {
            match *edge {
                [_] => {}
                [(_, g), (_, h)] if g / 3 != h / 3 => {
                    twins[g as usize] = h;
                    twins[h as usize] = g;
                }
                _ => edge.iter().for_each(|&(_, h)| twins[h as usize] = NON_MANIFOLD),
            }
        }
        twins
    }
}

fn for_each_half_edge(triangles: &[[u32; 3]], mut visit: impl FnMut(u32, u32, u32)) {
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        let first = 3 * t as u32;
        for (k, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            visit(first + k as u32, from.min(to), from.max(to));
        }
    }
}

/// The vertices that half-edge `half_edge` runs from and to.
pub(crate) fn ends(triangles: &[[u32; 3]], half_edge: u32) -> [u32; 2] {
    let triangle = triangles[half_edge as usize / 3];
    let k = half_edge as usize % 3;
    [triangle[k], triangle[(k + 1) % 3]]
}

/// A forest of sets of numbers, for grouping.
pub(crate) struct UnionFind(Vec<u32>);

impl UnionFind {
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The set's least member. Halves the path on its way.
    pub(crate) fn find(&mut self, mut item: u32) -> u32 {
        while self.0[item as usize] != item {
            let above = self.0[self.0[item as usize] as usize];
            self.0[item as usize] = above;
            item = above;
        }
        item
    }

    /// Joins two sets; the lower root stays, so that results follow file order.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
