//! The greedy decomposition into fans (Galin & Akkouche 2005, 5.2 and 5.3).

use std::collections::BinaryHeap;

use super::adjacency::{Adjacency, NONE, following, preceding};
use super::{Fan, MAX_LEAF_TRIANGLES};

/// Splits a soup into fans of 1 to [`MAX_LEAF_TRIANGLES`] triangles, none of them reversed.
///
/// The paper's rule: the front starts at the open edges, or at the first triangle left if there are
/// none. Of the vertices about the front, the one with the largest `f(c) = α v + β r − γ t` becomes
/// the next centre. One rule is added: of the runs of triangles about a centre only the
/// longest are taken, cut to [`MAX_LEAF_TRIANGLES`]. The rest stays for other centres, and this
/// centre is a candidate again. Ties go to the vertex with the larger number.
///
/// `O(n log n)`: the three counts are kept up to date as triangles go, and a centre's corners are
/// walked at most [`MAX_LEAF_TRIANGLES`] times in a row.
///
/// # Panics
/// If a triangle names a vertex that is not below `vertex_count`, or if there are 2³²/3 triangles
/// or more.
#[must_use]
pub fn decompose(triangles: &[[u32; 3]], vertex_count: usize) -> Vec<Fan> {
    let adjacency = Adjacency::new(vertex_count, triangles);
    Front::new(vertex_count, &adjacency).run()
}

// Weights of the paper's priority `f(c) = α v(c) + β r(c) − γ t(c)` (5.3).

/// For each triangle that is left about the candidate.
const ALPHA: i64 = 2;

/// For each open edge opposite the candidate.
const BETA: i64 = 7;

/// Against each triangle that the fan would leave alone.
const GAMMA: i64 = 11;

/// A vertex's counts among the remaining triangles.
#[derive(Clone, Copy, Default)]
struct Counts {
    /// Corners at the vertex: the paper's `v`.
    triangles: i32,
    /// Open edges opposite the vertex: `r`.
    open_edges: i32,
    /// Triangles with two open edges that meet the vertex's triangles in their third: `t`.
    degenerate: i32,
}

/// What remains of the soup.
struct Front<'a> {
    adjacency: &'a Adjacency<'a>,
    /// The corners at vertex `v` are `corners[starts[v]..starts[v + 1]]`.
    starts: Vec<u32>,
    corners: Vec<u32>,
    taken: Vec<bool>,
    open_edges: Vec<u8>,
    counts: Vec<Counts>,
    /// Priority and vertex; an entry is stale if the vertex has another priority by now.
    queue: BinaryHeap<(i64, u32)>,
    /// Vertices whose priority may have changed since they were last queued.
    touched: Vec<u32>,
    is_touched: Vec<bool>,
    /// For each triangle the last visit of a centre that put it in a run.
    visited: Vec<u32>,
    visit: u32,
}

impl<'a> Front<'a> {
    fn new(vertex_count: usize, adjacency: &'a Adjacency<'a>) -> Self {
        let (starts, corners) = corners_by_vertex(vertex_count, adjacency.triangles());
        let count = adjacency.triangles().len();
        let mut front = Self {
            adjacency,
            counts: starts
                .windows(2)
                .map(|range| Counts {
                    triangles: (range[1] - range[0]).cast_signed(),
                    ..Counts::default()
                })
                .collect(),
            starts,
            corners,
            taken: vec![false; count],
            open_edges: vec![0; count],
            queue: BinaryHeap::new(),
            touched: Vec::new(),
            is_touched: vec![false; vertex_count],
            visited: vec![0; count],
            visit: 0,
        };
        for half_edge in 0..3 * count as u32 {
            if adjacency.opposite(half_edge) == NONE {
                front.open(half_edge);
            }
        }
        front
    }

    fn run(mut self) -> Vec<Fan> {
        let mut fans = Vec::new();
        for (seed, triangle) in self.adjacency.triangles().iter().enumerate() {
            if self.taken[seed] {
                continue;
            }
            triangle.iter().for_each(|&v| self.touch(v));
            self.queue_touched();
            while let Some((priority, centre)) = self.queue.pop() {
                if self.counts[centre as usize].triangles > 0 && priority == self.priority(centre) {
                    self.take_fans(centre, &mut fans);
                    self.queue_touched();
                }
            }
        }
        fans
    }

    fn priority(&self, v: u32) -> i64 {
        let Counts { triangles, open_edges, degenerate } = self.counts[v as usize];
        let product = |a, b| a * i64::from(b);
        product(ALPHA, triangles) + product(BETA, open_edges) - product(GAMMA, degenerate)
    }

    fn touch(&mut self, v: u32) {
        if !std::mem::replace(&mut self.is_touched[v as usize], true) {
            self.touched.push(v);
        }
    }

    fn queue_touched(&mut self) {
        while let Some(v) = self.touched.pop() {
            self.is_touched[v as usize] = false;
            if self.counts[v as usize].triangles > 0 {
                self.queue.push((self.priority(v), v));
            }
        }
    }

    fn remains(&self, corner: u32) -> bool {
        corner != NONE && !self.taken[corner as usize / 3]
    }

    /// Takes the longest runs about `centre`, all those of one length, so that a vertex is visited
    /// at most [`MAX_LEAF_TRIANGLES`] times between changes by others however many runs it has.
    fn take_fans(&mut self, centre: u32, fans: &mut Vec<Fan>) {
        let runs = self.runs(centre);
        let longest = runs.iter().map(Vec::len).max().unwrap_or(0).min(MAX_LEAF_TRIANGLES);
        for piece in
            runs.iter().filter(|run| run.len() >= longest).flat_map(|run| run.chunks_exact(longest))
        {
            piece.iter().for_each(|corner| self.take(corner / 3));
            let end = |&corner: &u32| self.adjacency.vertex(preceding(corner));
            fans.push(Fan {
                centre,
                ring: std::iter::once(self.adjacency.vertex(following(piece[0])))
                    .chain(piece.iter().map(end))
                    .collect(),
                triangles: piece.iter().map(|corner| corner / 3).collect(),
                reversed: false,
            });
        }
    }

    /// The remaining triangles about a vertex, as runs of corners; a closed run starts anywhere.
    fn runs(&mut self, centre: u32) -> Vec<Vec<u32>> {
        self.visit += 1;
        let at = self.starts[centre as usize] as usize..self.starts[centre as usize + 1] as usize;
        let mut runs = Vec::new();
        for closed in [false, true] {
            for i in at.clone() {
                let mut corner = self.corners[i];
                if !closed && self.remains(self.adjacency.previous_around(corner)) {
                    continue;
                }
                let mut run = Vec::new();
                while self.remains(corner) && self.visited[corner as usize / 3] != self.visit {
                    self.visited[corner as usize / 3] = self.visit;
                    run.push(corner);
                    corner = self.adjacency.next_around(corner);
                }
                if !run.is_empty() {
                    runs.push(run);
                }
            }
        }
        runs
    }

    fn take(&mut self, triangle: u32) {
        if self.open_edges[triangle as usize] == 2 {
            self.count_degenerate(triangle, -1);
        }
        self.taken[triangle as usize] = true;
        for half_edge in 3 * triangle..3 * triangle + 3 {
            let opposite = self.adjacency.opposite(half_edge);
            let apex = self.adjacency.vertex(preceding(half_edge));
            self.counts[apex as usize].triangles -= 1;
            self.touch(apex);
            if self.remains(opposite) {
                self.open(opposite);
            } else {
                self.counts[apex as usize].open_edges -= 1;
            }
        }
    }

    /// An edge of a remaining triangle has become open.
    fn open(&mut self, half_edge: u32) {
        let triangle = half_edge / 3;
        self.counts[self.adjacency.vertex(preceding(half_edge)) as usize].open_edges += 1;
        self.adjacency.triangles()[triangle as usize].iter().for_each(|&v| self.touch(v));
        if self.open_edges[triangle as usize] == 2 {
            self.count_degenerate(triangle, -1);
        }
        self.open_edges[triangle as usize] += 1;
        if self.open_edges[triangle as usize] == 2 {
            self.count_degenerate(triangle, 1);
        }
    }

    /// A fan about the apex across the last closed edge of `triangle` would leave it alone.
    fn count_degenerate(&mut self, triangle: u32, change: i32) {
        for half_edge in 3 * triangle..3 * triangle + 3 {
            let opposite = self.adjacency.opposite(half_edge);
            if self.remains(opposite) {
                let apex = self.adjacency.vertex(preceding(opposite));
                self.counts[apex as usize].degenerate += change;
                self.touch(apex);
            }
        }
    }
}

fn corners_by_vertex(vertex_count: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; vertex_count + 1];
    for &v in triangles.as_flattened() {
        starts[v as usize + 1] += 1;
    }
    for v in 0..vertex_count {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut corners = vec![0; 3 * triangles.len()];
    for (corner, &v) in (0u32..).zip(triangles.as_flattened()) {
        corners[next[v as usize] as usize] = corner;
        next[v as usize] += 1;
    }
    (starts, corners)
}
