//! A small window of the remaining soup, in bit masks: every run of triangles about every vertex
//! of it.
//!
//! Corner `3i + k` is corner `k` of the window's triangle `i`.

use super::adjacency::{Adjacency, NONE, following};
use super::remaining::Remaining;
use super::{Fan, MAX_LEAF_TRIANGLES};
use arrayvec::ArrayVec;

/// Most triangles in a window: as many as a mask has bits. 48 make no fewer leaves.
pub(super) const WINDOW: usize = 32;
const CORNERS: usize = 3 * WINDOW;
/// No corner, no triangle, no vertex.
const NO: u8 = u8::MAX;

/// A run of triangles about one vertex, given by one end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Run {
    /// The corner at the run's start, or at its end if `is_backward`.
    pub(super) corner: u8,
    /// Triangles.
    pub(super) len: u8,
    /// True if the run goes back from `corner`, against the winding.
    pub(super) is_backward: bool,
}

/// The triangles nearest to a seed, counted in edges crossed, with their adjacency.
pub(super) struct Window {
    /// The triangles' numbers; the first is the seed.
    triangles: ArrayVec<u32, WINDOW>,
    /// Most triangles.
    size: usize,
    /// For corner k, the triangles with a remaining neighbour across half-edge k, as a mask.
    shared: [u32; 3],
    /// For each triangle its neighbours in the window, as a mask.
    neighbours: [u32; WINDOW],
    /// The triangles with at least one, two, three remaining neighbours, in the window and beyond,
    /// as masks.
    degree_masks: [u32; 3],
    /// Triangles with a remaining neighbour beyond the window, as a mask.
    border: u32,
    /// The corner after and before each corner about its vertex, or [`NO`].
    next_about_vertex: [u8; CORNERS],
    previous_about_vertex: [u8; CORNERS],
    /// Vertex of each corner, numbered within the window.
    vertex: [u8; CORNERS],
    /// Linked lists of the corners of each vertex.
    corner_list_head: [u8; CORNERS],
    corner_list_next: [u8; CORNERS],
    /// For each corner the triangles about its vertex from the corner on, or back from it.
    forward: [Runs; CORNERS],
    backward: [Runs; CORNERS],
    /// Numbers within the window, for all triangles and vertices of the soup; [`NO`] between two
    /// calls.
    local_triangle: Vec<u8>,
    local_vertex: Vec<u8>,
}

impl Window {
    pub(super) fn new(vertex_count: usize, triangle_count: usize, size: usize) -> Self {
        Self {
            triangles: ArrayVec::new(),
            size: size.min(WINDOW),
            shared: [0; 3],
            neighbours: [0; WINDOW],
            degree_masks: [0; 3],
            border: 0,
            next_about_vertex: [NO; CORNERS],
            previous_about_vertex: [NO; CORNERS],
            vertex: [0; CORNERS],
            corner_list_head: [NO; CORNERS],
            corner_list_next: [NO; CORNERS],
            forward: [Runs::default(); CORNERS],
            backward: [Runs::default(); CORNERS],
            local_triangle: vec![NO; triangle_count],
            local_vertex: vec![NO; vertex_count],
        }
    }

    /// Moves the window to `seed`. Bounded work, for any valences.
    pub(super) fn fill(&mut self, adjacency: &Adjacency, remaining: &Remaining, seed: u32) {
        // 1. The triangles, breadth-first.
        self.triangles.clear();
        self.triangles.push(seed);
        self.local_triangle[seed as usize] = 0;
        let mut across_of = [[NONE; 3]; WINDOW];
        self.shared = [0; 3];
        let mut i = 0;
        while i < self.triangles.len() {
            let across_all = remaining_across(adjacency, remaining, self.triangles[i]);
            for (k, across) in
                across_all.into_iter().enumerate().filter(|&(_, across)| across != NONE)
            {
                self.shared[k] |= 1 << i;
                let slot = &mut self.local_triangle[across as usize / 3];
                if *slot == NO && self.triangles.len() < self.size {
                    *slot = self.triangles.len() as u8;
                    self.triangles.push(across / 3);
                }
            }
            across_of[i] = across_all;
            i += 1;
        }
        let [a, b, c] = self.shared;
        self.degree_masks = [a | b | c, a & b | b & c | c & a, a & b & c];

        // 2. Adjacency, and the list of each vertex's corners.
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
                    self.corner_list_head[vertex_count as usize] = NO;
                    vertex_count += 1;
                }
                self.vertex[corner] = *slot;
                self.corner_list_next[corner] =
                    std::mem::replace(&mut self.corner_list_head[*slot as usize], corner as u8);

                let after = self.next_in_triangle(corner as u8) as usize;
                (self.previous_about_vertex[corner], self.next_about_vertex[after]) = (NO, NO);
                if across == NONE {
                    continue;
                }
                let local = self.local_triangle[across as usize / 3];
                if local == NO {
                    self.border |= 1 << i;
                    continue;
                }
                self.neighbours[i] |= 1 << local;
                // Only a neighbour of the same winding continues a run.
                if adjacency.opposite(half_edge) != NONE {
                    self.previous_about_vertex[corner] = 3 * local + (following(across) % 3) as u8;
                    self.next_about_vertex[after] = 3 * local + (across % 3) as u8;
                }
            }
        }

        // 3. The runs. No number within the window is needed any more.
        for &t in &self.triangles {
            self.local_triangle[t as usize] = NO;
            adjacency.triangles()[t as usize]
                .iter()
                .for_each(|&v| self.local_vertex[v as usize] = NO);
        }
        for corner in 0..3 * self.triangles.len() {
            self.forward[corner] = Runs::new(corner as u8, &self.next_about_vertex);
            self.backward[corner] = Runs::new(corner as u8, &self.previous_about_vertex);
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

    /// Triangles with a remaining neighbour beyond the window, as a mask.
    pub(super) fn border(&self) -> u32 {
        self.border
    }

    /// The runs that start at `corner`, or end there if `is_backward`.
    pub(super) fn runs(&self, corner: u8, is_backward: bool) -> &Runs {
        if is_backward { &self.backward[corner as usize] } else { &self.forward[corner as usize] }
    }

    /// The corner before `corner` about its vertex, if its triangle is in the window.
    pub(super) fn previous_about_vertex(&self, corner: u8) -> Option<u8> {
        Some(self.previous_about_vertex[corner as usize]).filter(|&c| c != NO)
    }

    /// The corner after `corner` about its vertex, if its triangle is in the window.
    pub(super) fn next_about_vertex(&self, corner: u8) -> Option<u8> {
        Some(self.next_about_vertex[corner as usize]).filter(|&c| c != NO)
    }

    /// The corners of the vertex of `corner`.
    pub(super) fn corners_at(&self, corner: u8) -> impl Iterator<Item = u8> {
        let first = self.corner_list_head[self.vertex[corner as usize] as usize];
        std::iter::successors(Some(first), |&c| {
            Some(self.corner_list_next[c as usize]).filter(|&c| c != NO)
        })
    }

    /// The next corner of the same triangle.
    pub(super) const fn next_in_triangle(&self, corner: u8) -> u8 {
        if corner % 3 == 2 { corner - 2 } else { corner + 1 }
    }

    /// The previous corner of the same triangle.
    pub(super) const fn previous_in_triangle(&self, corner: u8) -> u8 {
        if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }
    }

    /// A run as a fan.
    pub(super) fn fan(&self, adjacency: &Adjacency, run: Run, reversed: bool) -> Fan {
        let steps =
            if run.is_backward { &self.previous_about_vertex } else { &self.next_about_vertex };
        let mut corners: ArrayVec<u8, MAX_LEAF_TRIANGLES> =
            std::iter::successors(Some(run.corner), |&c| Some(steps[c as usize]))
                .take(run.len as usize)
                .collect();
        if run.is_backward != reversed {
            corners.reverse();
        }
        let vertex = |corner: u8| {
            adjacency.triangles()[self.triangles[corner as usize / 3] as usize][corner as usize % 3]
        };
        let ends = |corner| {
            let [from, to] =
                [self.next_in_triangle(corner), self.previous_in_triangle(corner)].map(vertex);
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

/// The half-edges of remaining triangles across a triangle's edges, or [`NONE`].
fn remaining_across(adjacency: &Adjacency, remaining: &Remaining, triangle: u32) -> [u32; 3] {
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
