//! A small window of the remaining soup, in bit masks: every run of triangles about every vertex
//! of it.
//!
//! Corner `3i + k` is corner `k` of the window's triangle `i`.

use super::adjacency::{Adjacency, NONE, following};
use super::remaining::Remaining;
use super::{Fan, MAX_LEAF_TRIANGLES};
use arrayvec::ArrayVec;

/// Triangles in a window: as many as a mask has bits. 20 make half a percent more leaves, 48 no
/// fewer.
pub(super) const WINDOW: usize = 32;
const CORNERS: usize = 3 * WINDOW;
/// No corner, no triangle, no vertex.
const NO: u8 = u8::MAX;

/// A run of triangles about one vertex, given by one end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Run {
    /// The corner at the run's start, or at its end if `behind`.
    pub(super) corner: u8,
    /// Triangles.
    pub(super) len: u8,
    /// True if the run goes back from `corner`, against the winding.
    pub(super) behind: bool,
}

/// The triangles nearest to a seed, counted in edges crossed, with their adjacency.
pub(super) struct Window {
    /// The triangles' numbers; the first is the seed.
    triangles: ArrayVec<u32, WINDOW>,
    /// The half-edges beyond which a triangle remains, in the window or not, by corners.
    open: [u32; 3],
    /// For each triangle its neighbours in the window, as a mask.
    neighbours: [u32; WINDOW],
    /// The triangles with at least one, two, three remaining neighbours, in the window and beyond,
    /// as masks.
    degree_masks: [u32; 3],
    /// Triangles with a remaining neighbour beyond the window, as a mask.
    border: u32,
    next: [u8; CORNERS],
    previous: [u8; CORNERS],
    /// Vertex of each corner, numbered within the window.
    vertex: [u8; CORNERS],
    /// A corner of each vertex, and for each corner another one of its vertex.
    first_at: [u8; CORNERS],
    other_at: [u8; CORNERS],
    /// For each corner the triangles about its vertex from the corner on, or back from it.
    ahead: [Runs; CORNERS],
    behind: [Runs; CORNERS],
    /// Numbers within the window, for all triangles and vertices of the soup; [`NO`] between two
    /// calls.
    local_triangle: Vec<u8>,
    local_vertex: Vec<u8>,
}

impl Window {
    pub(super) fn new(vertex_count: usize, triangle_count: usize) -> Self {
        Self {
            triangles: ArrayVec::new(),
            open: [0; 3],
            neighbours: [0; WINDOW],
            degree_masks: [0; 3],
            border: 0,
            next: [NO; CORNERS],
            previous: [NO; CORNERS],
            vertex: [0; CORNERS],
            first_at: [NO; CORNERS],
            other_at: [NO; CORNERS],
            ahead: [Runs::default(); CORNERS],
            behind: [Runs::default(); CORNERS],
            local_triangle: vec![NO; triangle_count],
            local_vertex: vec![NO; vertex_count],
        }
    }

    /// Moves the window to `seed`. Bounded work, for any valences.
    pub(super) fn fill(&mut self, adjacency: &Adjacency, remaining: &Remaining, seed: u32) {
        self.triangles.clear();
        self.triangles.push(seed);
        self.local_triangle[seed as usize] = 0;
        let mut across_of = [[NONE; 3]; WINDOW];
        self.open = [0; 3];
        let mut i = 0;
        while i < self.triangles.len() {
            let open = open_edges(adjacency, remaining, self.triangles[i]);
            for (k, across) in open.into_iter().enumerate().filter(|&(_, across)| across != NONE) {
                self.open[k] |= 1 << i;
                let slot = &mut self.local_triangle[across as usize / 3];
                if *slot == NO && self.triangles.len() < WINDOW {
                    *slot = self.triangles.len() as u8;
                    self.triangles.push(across / 3);
                }
            }
            across_of[i] = open;
            i += 1;
        }
        let [a, b, c] = self.open;
        self.degree_masks = [a | b | c, a & b | b & c | c & a, a & b & c];

        let mut vertex_count = 0u8;
        self.border = 0;
        for (i, across_of) in across_of.iter().take(self.triangles.len()).enumerate() {
            self.neighbours[i] = 0;
            for (k, &across) in across_of.iter().enumerate() {
                let half_edge = 3 * self.triangles[i] + k as u32;
                let corner = 3 * i + k;
                let slot = &mut self.local_vertex[adjacency.vertex(half_edge) as usize];
                if *slot == NO {
                    *slot = vertex_count;
                    self.first_at[vertex_count as usize] = NO;
                    vertex_count += 1;
                }
                self.vertex[corner] = *slot;
                self.other_at[corner] =
                    std::mem::replace(&mut self.first_at[*slot as usize], corner as u8);

                let after = self.after(corner as u8) as usize;
                (self.previous[corner], self.next[after]) = (NO, NO);
                if across == NONE {
                    continue;
                }
                let local = self.local_triangle[across as usize / 3];
                if local == NO {
                    self.border |= 1 << i;
                    continue;
                }
                self.neighbours[i] |= 1 << local;
                if adjacency.opposite(half_edge) != NONE {
                    self.previous[corner] = 3 * local + (following(across) % 3) as u8;
                    self.next[after] = 3 * local + (across % 3) as u8;
                }
            }
        }
        for &t in &self.triangles {
            self.local_triangle[t as usize] = NO;
            adjacency.triangles()[t as usize]
                .iter()
                .for_each(|&v| self.local_vertex[v as usize] = NO);
        }
        for corner in 0..3 * self.triangles.len() {
            self.ahead[corner] = Runs::new(corner as u8, &self.next);
            self.behind[corner] = Runs::new(corner as u8, &self.previous);
        }
    }

    /// All triangles, as a mask.
    pub(super) fn all(&self) -> u32 {
        u32::MAX >> (WINDOW - self.triangles.len())
    }

    /// The triangles' numbers.
    pub(super) fn triangles(&self) -> &[u32] {
        &self.triangles
    }

    /// The neighbours of triangle `i` in the window, as a mask.
    pub(super) fn neighbours(&self, i: usize) -> u32 {
        self.neighbours[i]
    }

    /// The triangles with at least one, two, three remaining neighbours, in the window and beyond,
    /// as masks.
    pub(super) fn degree_masks(&self) -> [u32; 3] {
        self.degree_masks
    }

    /// What the window holds, for a later look.
    pub(super) fn footprint(&self) -> Footprint {
        Footprint { triangles: self.triangles.clone(), open: self.open }
    }

    /// Triangles with a remaining neighbour beyond the window, as a mask.
    pub(super) fn border(&self) -> u32 {
        self.border
    }

    /// The runs that start at `corner`, or end there if `behind`.
    pub(super) fn runs(&self, corner: u8, behind: bool) -> &Runs {
        if behind { &self.behind[corner as usize] } else { &self.ahead[corner as usize] }
    }

    /// The corner before `corner` about its vertex, if its triangle is in the window.
    pub(super) fn previous(&self, corner: u8) -> Option<u8> {
        Some(self.previous[corner as usize]).filter(|&c| c != NO)
    }

    /// The corner after `corner` about its vertex, if its triangle is in the window.
    pub(super) fn next(&self, corner: u8) -> Option<u8> {
        Some(self.next[corner as usize]).filter(|&c| c != NO)
    }

    /// The corners of the vertex of `corner`.
    pub(super) fn corners_at(&self, corner: u8) -> impl Iterator<Item = u8> {
        let first = self.first_at[self.vertex[corner as usize] as usize];
        std::iter::successors(Some(first), |&c| {
            Some(self.other_at[c as usize]).filter(|&c| c != NO)
        })
    }

    /// The next corner of the same triangle.
    pub(super) const fn after(&self, corner: u8) -> u8 {
        if corner % 3 == 2 { corner - 2 } else { corner + 1 }
    }

    /// The previous corner of the same triangle.
    pub(super) const fn before(&self, corner: u8) -> u8 {
        if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }
    }

    /// A run as a fan.
    pub(super) fn fan(&self, adjacency: &Adjacency, run: Run, reversed: bool) -> Fan {
        let steps = if run.behind { &self.previous } else { &self.next };
        let mut corners: ArrayVec<u8, MAX_LEAF_TRIANGLES> =
            std::iter::successors(Some(run.corner), |&c| Some(steps[c as usize]))
                .take(run.len as usize)
                .collect();
        if run.behind != reversed {
            corners.reverse();
        }
        let vertex = |corner: u8| {
            adjacency.triangles()[self.triangles[corner as usize / 3] as usize][corner as usize % 3]
        };
        let ends = |corner| {
            let [from, to] = [self.after(corner), self.before(corner)].map(vertex);
            if reversed { [to, from] } else { [from, to] }
        };
        Fan {
            centre: vertex(corners[0]),
            ring: std::iter::once(ends(corners[0])[0])
                .chain(corners.iter().map(|&c| ends(c)[1]))
                .collect(),
            triangles: corners.iter().map(|&c| self.triangles[c as usize / 3]).collect(),
            reversed,
        }
    }
}

/// Triangles and open edges of a window.
pub(super) struct Footprint {
    triangles: ArrayVec<u32, WINDOW>,
    open: [u32; 3],
}

impl Footprint {
    /// Whether the window about its seed still is the same. Its triangles follow from the seed and
    /// the open edges.
    pub(super) fn is_of(&self, adjacency: &Adjacency, remaining: &Remaining) -> bool {
        self.triangles.iter().enumerate().all(|(i, &triangle)| {
            let open = open_edges(adjacency, remaining, triangle);
            (0..3).all(|k| (open[k] != NONE) == (self.open[k] & 1 << i != 0))
        })
    }
}

/// The half-edges of remaining triangles across a triangle's edges, or [`NONE`].
fn open_edges(adjacency: &Adjacency, remaining: &Remaining, triangle: u32) -> [u32; 3] {
    [0, 1, 2].map(|k| {
        let across = adjacency.across(3 * triangle + k);
        if across == NONE || !remaining.has(across / 3) { NONE } else { across }
    })
}

/// The runs from one corner in one direction, as masks by their length, up to the longest.
#[derive(Clone, Copy, Default)]
pub(super) struct Runs {
    masks: [u32; MAX_LEAF_TRIANGLES + 1],
    longest: u8,
}

impl Runs {
    /// The runs from `corner` along `steps`, until a triangle comes back.
    fn new(corner: u8, steps: &[u8; CORNERS]) -> Self {
        let mut runs = Self::default();
        let (mut mask, mut corner) = (0, corner);
        while usize::from(runs.longest) < MAX_LEAF_TRIANGLES
            && corner != NO
            && mask & 1 << (corner / 3) == 0
        {
            mask |= 1 << (corner / 3);
            runs.longest += 1;
            runs.masks[usize::from(runs.longest)] = mask;
            corner = steps[corner as usize];
        }
        runs
    }

    /// The length of the longest run: 1 at least.
    pub(super) fn longest(&self) -> usize {
        usize::from(self.longest)
    }

    /// The run of a length, as a mask.
    pub(super) fn mask(&self, len: usize) -> u32 {
        self.masks[len]
    }
}
