//! A closed manifold around any triangles: vertices are copied until every edge has two triangles
//! at most, and every hole is closed by a fan about a vertex of its own.
//!
//! 1. At each edge triangles that run against each other are glued in pairs. The others end there.
//! 2. Corners at a vertex that no chain of glued edges joins get copies of the vertex.
//! 3. Where two edges have the same ends even so, the triangles at one end are unglued, and step 2
//!    follows again. A hole of two edges is glued instead.
//! 4. The edges where one triangle ends form closed loops of three edges or more, through different
//!    vertices. Each gets a fan.

use crate::mesh::{EdgeTable, UnionFind};
use rustc_hash::FxHashSet;

/// No triangle on the other side.
const NONE: u32 = u32::MAX;

/// A closed manifold, its winding consistent.
#[derive(Clone, Debug)]
pub struct Closed {
    /// The mesh's triangles in their order, then those that close holes.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles that close holes, each `[to, from, centre]` of the hole's edge `from` → `to`.
    pub fillers: usize,
    /// Holes.
    pub holes: usize,
    /// Vertices that were copied from another.
    pub copies: usize,
    /// The vertex of the mesh that has the place of each vertex. The centre of a hole's fan has the
    /// place of one of the hole's vertices.
    pub places: Vec<u32>,
}

/// Closes any triangles. No triangle may name a vertex twice, and every vertex must be less than
/// `vertex_count`. Cost: a sort of the edges, and another for each round of step 3.
#[must_use]
pub fn close(vertex_count: usize, triangles: &[[u32; 3]]) -> Closed {
    let mut gluing = Gluing::new(vertex_count, triangles);
    while gluing.resolve() {}
    gluing.filled()
}

/// Triangles, and which half-edges of theirs are glued.
struct Gluing<'a> {
    triangles: &'a [[u32; 3]],
    twins: Vec<u32>,
}

fn next(half_edge: u32) -> u32 {
    half_edge - half_edge % 3 + (half_edge + 1) % 3
}

impl<'a> Gluing<'a> {
    fn new(vertex_count: usize, triangles: &'a [[u32; 3]]) -> Self {
        let mut gluing = Gluing { triangles, twins: vec![NONE; 3 * triangles.len()] };
        let (mut up, mut down) = (Vec::new(), Vec::new());
        for edge in EdgeTable::new(vertex_count, triangles).edges() {
            up.clear();
            down.clear();
            for &(high, half_edge) in edge {
                let runs_up = gluing.vertex(next(half_edge)) == high;
                if runs_up { &mut up } else { &mut down }.push(half_edge);
            }
            for (&g, &h) in up.iter().zip(&down) {
                gluing.glue(g, h);
            }
        }
        gluing
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.triangles[corner as usize / 3][corner as usize % 3]
    }

    fn glue(&mut self, g: u32, h: u32) {
        self.twins[g as usize] = h;
        self.twins[h as usize] = g;
    }

    fn unglue(&mut self, half_edge: u32) {
        let twin = std::mem::replace(&mut self.twins[half_edge as usize], NONE);
        if twin != NONE {
            self.twins[twin as usize] = NONE;
        }
    }

    /// For each corner the first corner that glued edges join it with.
    fn fans(&self) -> Vec<u32> {
        let mut sets = UnionFind::new(self.twins.len());
        for (half_edge, &twin) in (0u32..).zip(&self.twins) {
            if twin != NONE {
                sets.join(half_edge, next(twin));
            }
        }
        (0..self.twins.len() as u32).map(|corner| sets.find(corner)).collect()
    }

    /// Glues holes of two edges, and unglues where two edges have the same ends. False if there is
    /// nothing to do.
    fn resolve(&mut self) -> bool {
        let fans = self.fans();
        let mut edges: Vec<([u32; 2], u32)> = Vec::with_capacity(self.twins.len());
        for (half_edge, &twin) in (0u32..).zip(&self.twins) {
            if twin == NONE || half_edge < twin {
                let [from, to] = [half_edge, next(half_edge)].map(|c| fans[c as usize]);
                edges.push(([from.min(to), from.max(to)], half_edge));
            }
        }
        edges.sort_unstable();
        let mut crowded = vec![false; self.twins.len()];
        let mut is_changed = false;
        for same in edges.chunk_by(|a, b| a.0 == b.0) {
            let [(ends, g), others @ ..] = same else { continue };
            if let [(_, h)] = others
                && [*g, *h].iter().all(|&h| self.twins[h as usize] == NONE)
                && fans[*g as usize] == fans[next(*h) as usize]
            {
                self.glue(*g, *h);
                is_changed = true;
            } else if !others.is_empty() {
                crowded[ends[0] as usize] = true;
                is_changed = true;
            }
        }
        for (corner, &fan) in (0u32..).zip(&fans) {
            if crowded[fan as usize] {
                self.unglue(corner);
                self.unglue(next(next(corner)));
            }
        }
        is_changed
    }

    /// Vertices by fans, in the order of their first corners, and a fan of triangles in each hole.
    fn filled(&self) -> Closed {
        let fans = self.fans();
        let mut number = vec![NONE; fans.len()];
        let mut places = Vec::new();
        let mut taken = FxHashSet::default();
        let mut copies = 0;
        for (corner, &fan) in (0u32..).zip(&fans) {
            if number[fan as usize] == NONE {
                number[fan as usize] = places.len() as u32;
                places.push(self.vertex(corner));
                copies += usize::from(!taken.insert(self.vertex(corner)));
            }
        }
        let label = |corner: u32| number[fans[corner as usize] as usize];
        let corners = (0..self.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
        let mut triangles: Vec<[u32; 3]> = corners.map(|corners| corners.map(label)).collect();
        // The edge of a hole that leaves each vertex.
        let mut leaving = vec![NONE; places.len()];
        for (half_edge, &twin) in (0u32..).zip(&self.twins) {
            if twin == NONE {
                leaving[label(half_edge) as usize] = half_edge;
            }
        }
        let mut holes = 0;
        for first in 0..leaving.len() {
            let mut half_edge = std::mem::replace(&mut leaving[first], NONE);
            if half_edge == NONE {
                continue;
            }
            holes += 1;
            let centre = places.len() as u32;
            places.push(places[first]);
            while half_edge != NONE {
                let [from, to] = [label(half_edge), label(next(half_edge))];
                triangles.push([to, from, centre]);
                half_edge =
                    leaving.get_mut(to as usize).map_or(NONE, |e| std::mem::replace(e, NONE));
                if to as usize == first {
                    break;
                }
            }
        }
        let fillers = triangles.len() - self.triangles.len();
        Closed { triangles, fillers, holes, copies, places }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::{HashMap, HashSet};

    /// Every directed edge stands once and has its opposite; the triangles at a vertex are one
    /// fan.
    fn assert_manifold(closed: &Closed) {
        let mut edges = HashMap::new();
        for &[a, b, c] in &closed.triangles {
            for (from, to, apex) in [(a, b, c), (b, c, a), (c, a, b)] {
                assert!(edges.insert((from, to), apex).is_none(), "{from} to {to} twice");
            }
        }
        assert!(edges.keys().all(|&(from, to)| edges.contains_key(&(to, from))));
        let mut valence = HashMap::<u32, usize>::new();
        closed.triangles.iter().flatten().for_each(|&v| *valence.entry(v).or_default() += 1);
        assert_eq!(valence.len(), closed.places.len());
        for &(from, to) in edges.keys() {
            let (mut at, mut seen) = (to, HashSet::new());
            while seen.insert(at) {
                at = edges[&(from, at)];
            }
            assert_eq!(seen.len(), valence[&from], "several fans at {from}");
        }
    }

    fn closed(triangles: &[[u32; 3]]) -> Closed {
        let count = triangles.iter().flatten().max().map_or(0, |&v| v as usize + 1);
        let closed = close(count, triangles);
        assert_manifold(&closed);
        let surface = &closed.triangles[..triangles.len()];
        for (&t, &of) in surface.iter().zip(triangles) {
            assert_eq!(t.map(|v| closed.places[v as usize]), of);
        }
        closed
    }

    #[test]
    fn a_closed_mesh_stays_as_it_is() {
        let tetrahedron = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
        let Closed { triangles, fillers, holes, copies, places } = closed(&tetrahedron);
        assert_eq!((triangles.as_slice(), fillers), (tetrahedron.as_slice(), 0));
        assert_eq!((holes, copies), (0, 0));
        assert_eq!(places, [0, 1, 2, 3]);
    }

    #[test]
    fn every_loop_of_edges_gets_a_fan() {
        assert_eq!(closed(&[[0, 1, 2]]).fillers, 3);
        let two_apart = closed(&[[0, 1, 2], [3, 4, 5]]);
        assert_eq!((two_apart.fillers, two_apart.holes), (6, 2));
        // A prism's walls without its ends.
        let walls = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
        let tube = closed(&walls);
        assert_eq!((tube.fillers, tube.holes), (6, 2));
    }

    #[test]
    fn loops_that_touch_at_a_vertex_get_a_copy_each() {
        let bow_tie = closed(&[[0, 1, 2], [0, 3, 4]]);
        assert_eq!((bow_tie.holes, bow_tie.copies, bow_tie.fillers), (2, 1, 6));
    }

    #[test]
    fn fins_crowded_edges_and_one_sided_strips_are_cut() {
        // Two triangles and a fin; then four on an edge; then a Möbius strip of five.
        closed(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        closed(&[[0, 1, 2], [1, 0, 3], [0, 1, 4], [1, 0, 5]]);
        closed(&[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
        closed(&[[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 0], [4, 0, 1]]);
        // A fin inside of a disc, whose two sides are joined around both ends of the edge.
        let ring = [2, 3, 4, 5, 6, 7];
        let mut disc = vec![[0, 1, 2], [1, 0, 5], [0, 1, 8]];
        disc.extend([[1, 3, 2], [1, 4, 3], [1, 5, 4], [0, 6, 5], [0, 7, 6], [0, 2, 7]]);
        assert!(ring.iter().all(|v| disc.iter().flatten().any(|u| u == v)));
        closed(&disc);
        // The same with two fins on the other side.
        disc.extend([[1, 0, 9], [0, 1, 10], [1, 0, 11]]);
        closed(&disc);
    }

    #[test]
    fn any_triangles_on_few_vertices_are_closed() {
        let mut state = 1u32;
        let mut below = |n: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) % n
        };
        for round in 0..400 {
            let (vertices, count) = (4 + round % 9, 1 + below(30));
            let mut triangles = Vec::new();
            let mut taken = HashSet::new();
            for _ in 0..count {
                let t = [below(vertices), below(vertices), below(vertices)];
                let mut sorted = t;
                sorted.sort_unstable();
                if sorted[0] < sorted[1] && sorted[1] < sorted[2] && taken.insert(sorted) {
                    triangles.push(t);
                }
            }
            closed(&triangles);
        }
    }
}
