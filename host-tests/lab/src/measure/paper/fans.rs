//! Triangle fans: those of the paper (Galin & Akkouche 2005, 5.2 and 5.3), and those that the
//! tree's leaves hold.

use crate::measure::tree::Built;
use meshsweep::bvh::TreeOptions;
use meshsweep_core::internal::geom::fan::WIDTH;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// Fans of the paper's decomposition, and those that leaves hold.
///
/// # Errors
/// A triangle is in no fan, or in several; or the tree does not open.
pub fn table(subject: &Subject) -> Result<Table, String> {
    let built = &Built::new(subject, &TreeOptions::default());
    let columns = [
        "decomposition",
        "triangles",
        "fans",
        "triangles a fan",
        "of one triangle",
        "patches",
        "triangles a patch",
        "stored vertices",
        "vertices a triangle",
    ];
    let mut table = Table::new("fans", "Triangle fans", &columns);
    let mesh = &subject.mesh;
    let papers = |rule, widest| -> Vec<usize> {
        let fans = by_rule(&mesh.triangles, mesh.positions.len(), rule, widest);
        fans.iter().map(|fan| fan.len() - 2).collect()
    };
    let leaves = of_leaves(built)?;
    let count = mesh.triangles.len();
    let kinds = [
        ("paper 003, 5.2", papers(Rule::LeastValence, usize::MAX), count, None),
        ("the same, fans of up to 8", papers(Rule::LeastValence, WIDTH), count, None),
        ("the largest f, fans of up to 8", papers(Rule::Largest, WIDTH), count, None),
        ("leaves: one or two fans", leaves, built.report.triangles, Some(&built.report.header)),
    ];
    for (name, fans, wanted, header) in kinds {
        let triangles: usize = fans.iter().sum();
        if triangles != wanted {
            return Err(format!("{name}: {triangles} of {wanted} triangles are in a fan"));
        }
        let mean = |count: usize, of: usize, digits| fixed(count as f64 / of.max(1) as f64, digits);
        let [patches, each, stored, share] = header.map_or([const { Cell::Empty }; 4], |header| {
            let (leaves, vertices) = (header.leaves as usize, header.vertices as usize);
            let [each, share] = [mean(triangles, leaves, 2), mean(vertices, triangles, 3)];
            [leaves.into(), each, vertices.into(), share]
        });
        table.push(row![
            name,
            triangles,
            fans.len(),
            mean(triangles, fans.len(), 2),
            fans.iter().filter(|&&size| size == 1).count(),
            patches,
            each,
            stored,
            share,
        ]);
    }
    table.note(
        "5.2: of the vertices on the front that of the fewest neighbours, then its neighbour of \
         the largest f; the largest f: of all vertices about the front",
    );
    table.note(
        "the paper's figures: Victory 49,078 triangles in 9,747 fans, 5.04 a fan; on all \
        models \"the average number is 5\"; it bounds no fan",
    );
    table.note(
        "and its gains over separate triangles: 25 to 40 % of the time of distances, \
        almost 40 % of segments'",
    );
    Ok(table)
}

/// Sizes of the fans of all leaves.
fn of_leaves(built: &Built) -> Result<Vec<usize>, String> {
    let tree = built.open()?;
    let mut fans = Vec::new();
    for node in 0..tree.header().nodes {
        let links = tree.links(node).ok_or("the tree ends early")?;
        for leaf in (links.inner..links.count).filter_map(|lane| tree.leaf(node, lane)) {
            let count = leaf.shape().triangles();
            let first = leaf.shape().turn().min(count);
            fans.extend([first, count - first].into_iter().filter(|&size| size > 0));
        }
    }
    Ok(fans)
}

/// The fans of 1 to [`WIDTH`] triangles into which a soup is split: the centre, then the rim in
/// order.
///
/// By the paper's priority, and not in its order (5.2): the front starts at the open edges, or at
/// the first triangle left if there are none. Of the vertices about the front, the one with the
/// largest `f(c) = α v + β r − γ t` becomes the next centre. Of the runs of triangles about a
/// centre only the longest are taken, cut to [`WIDTH`]. The rest stays for other centres, and this
/// centre is a candidate again. Ties go to the vertex with the larger number.
///
/// `O(n log n)`: the three counts are kept up to date as triangles go, and a centre's corners are
/// walked at most [`WIDTH`] times in a row.
pub fn decompose(triangles: &[[u32; 3]], vertex_count: usize) -> Vec<Vec<u32>> {
    by_rule(triangles, vertex_count, Rule::Largest, WIDTH)
}

/// Which vertex becomes the next centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// The one of the largest priority about the front.
    Largest,
    /// The paper's (5.2): of the vertices on the front that of the fewest neighbours is looked at
    /// first, so that no triangle is left alone there. Its neighbour of the largest priority is the
    /// centre. A closed mesh starts about a corner of its first triangle.
    LeastValence,
}

/// The fans of at most `widest` triangles by a rule.
fn by_rule(
    triangles: &[[u32; 3]],
    vertex_count: usize,
    rule: Rule,
    widest: usize,
) -> Vec<Vec<u32>> {
    let front = Front::new(vertex_count, Adjacency::new(triangles), widest);
    match rule {
        Rule::Largest => front.by_priority(),
        Rule::LeastValence => front.by_valence(),
    }
}

/// No half-edge, no corner.
const NONE: u32 = u32::MAX;

/// A soup with half-edges of opposite directions paired. Half-edge `3t + k` runs from corner `k` of
/// triangle `t` to the next corner.
struct Adjacency<'a> {
    triangles: &'a [[u32; 3]],
    opposite: Vec<u32>,
}

impl<'a> Adjacency<'a> {
    fn new(triangles: &'a [[u32; 3]]) -> Self {
        let mut opposite = vec![NONE; 3 * triangles.len()];
        let mut unpaired: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        for g in 0..opposite.len() as u32 {
            let at = |corner: u32| triangles[corner as usize / 3][corner as usize % 3];
            let [from, to] = [at(g), at(following(g))];
            let across = unpaired.get_mut(&[to, from]);
            match across.and_then(|across| across.pop_if(|h| *h / 3 != g / 3)) {
                Some(h) => (opposite[g as usize], opposite[h as usize]) = (h, g),
                None => unpaired.entry([from, to]).or_default().push(g),
            }
        }
        Self { triangles, opposite }
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.triangles[corner as usize / 3][corner as usize % 3]
    }

    fn opposite(&self, half_edge: u32) -> u32 {
        self.opposite[half_edge as usize]
    }

    /// The next corner at the same vertex, in the winding's sense, or [`NONE`].
    fn next_around(&self, corner: u32) -> u32 {
        self.opposite(preceding(corner))
    }

    /// The previous corner at the same vertex, or [`NONE`].
    fn previous_around(&self, corner: u32) -> u32 {
        match self.opposite(corner) {
            NONE => NONE,
            half_edge => following(half_edge),
        }
    }
}

/// The half-edge after `half_edge` in its triangle.
const fn following(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 { half_edge - 2 } else { half_edge + 1 }
}

/// The half-edge before `half_edge` in its triangle.
const fn preceding(half_edge: u32) -> u32 {
    if half_edge.is_multiple_of(3) { half_edge + 2 } else { half_edge - 1 }
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
    adjacency: Adjacency<'a>,
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
    /// Most triangles of a fan.
    widest: usize,
}

impl<'a> Front<'a> {
    fn new(vertex_count: usize, adjacency: Adjacency<'a>, widest: usize) -> Self {
        let (starts, corners) = corners_by_vertex(vertex_count, adjacency.triangles);
        let count = adjacency.triangles.len();
        let half_edges = 0..3 * count as u32;
        let open = half_edges.filter(|&g| adjacency.opposite(g) == NONE).collect::<Vec<u32>>();
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
            widest,
        };
        open.into_iter().for_each(|half_edge| front.open(half_edge));
        front
    }

    fn by_valence(mut self) -> Vec<Vec<u32>> {
        let (mut fans, mut queue) = (Vec::new(), BinaryHeap::new());
        let mut seeds = 0..self.taken.len();
        loop {
            while let Some(v) = self.touched.pop() {
                self.is_touched[v as usize] = false;
                queue.extend(self.valence(v).map(|valence| Reverse((valence, v))));
            }
            let centre = match queue.pop() {
                Some(Reverse((valence, v))) if self.valence(v) == Some(valence) => {
                    self.neighbours(v).into_iter().max_by_key(|&w| (self.priority(w), w))
                }
                Some(_) => None,
                None => match seeds.find(|&seed| !self.taken[seed]) {
                    Some(seed) => Some(self.adjacency.triangles[seed][0]),
                    None => return fans,
                },
            };
            centre.into_iter().for_each(|centre| self.take_fans(centre, &mut fans));
        }
    }

    /// Remaining corners at a vertex.
    fn corners_at(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let at = self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize;
        self.corners[at].iter().copied().filter(|&corner| self.remains(corner))
    }

    /// Neighbours of a vertex among the remaining triangles.
    fn neighbours(&self, v: u32) -> Vec<u32> {
        let ends = |corner| [following(corner), preceding(corner)];
        let others = self.corners_at(v).flat_map(ends).map(|other| self.adjacency.vertex(other));
        let mut others: Vec<u32> = others.collect();
        others.sort_unstable();
        others.dedup();
        others
    }

    /// Number of neighbours of a vertex on the front; `None` of any other.
    fn valence(&self, v: u32) -> Option<usize> {
        let is_open = |corner| {
            !self.remains(self.adjacency.next_around(corner))
                || !self.remains(self.adjacency.previous_around(corner))
        };
        self.corners_at(v).any(is_open).then(|| self.neighbours(v).len())
    }

    fn by_priority(mut self) -> Vec<Vec<u32>> {
        let mut fans = Vec::new();
        for (seed, triangle) in self.adjacency.triangles.iter().enumerate() {
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
    /// at most [`WIDTH`] times between changes by others however many runs it has. If fans may have
    /// any width, it takes all runs.
    fn take_fans(&mut self, centre: u32, fans: &mut Vec<Vec<u32>>) {
        let runs = self.runs(centre);
        let longest = runs.iter().map(Vec::len).max().unwrap_or(0).min(self.widest);
        let full = runs.iter().filter(|run| run.len() >= longest || self.widest == usize::MAX);
        let parts = |run: &Vec<u32>| {
            let size = longest.min(run.len());
            run.chunks_exact(size).map(<[u32]>::to_vec).collect::<Vec<_>>()
        };
        for fan in full.flat_map(parts).collect::<Vec<_>>() {
            fan.iter().for_each(|corner| self.take(corner / 3));
            let rim = fan.iter().map(|&corner| self.adjacency.vertex(preceding(corner)));
            let begin = fan.iter().take(1).map(|&corner| self.adjacency.vertex(following(corner)));
            fans.push(std::iter::once(centre).chain(begin).chain(rim).collect());
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
        self.adjacency.triangles[triangle as usize].iter().for_each(|&v| self.touch(v));
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
