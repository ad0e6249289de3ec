//! Whether the points of a triangle without area are points of a mesh, in exact arithmetic.

use super::place::{Place, place};
use crate::check::dyadic::Dyadic;
use crate::check::vector::{cross, minus};
use crate::mesh::Mesh;
use std::collections::{HashMap, HashSet};

type Point = [f32; 3];

/// Whether three points lie on a line.
pub(super) fn is_flat([a, b, c]: [Point; 3]) -> bool {
    let exact = |p: Point| p.map(|x| Dyadic::from(f64::from(x)));
    let [a, b, c] = [a, b, c].map(exact);
    cross(&minus(&b, &a), &minus(&c, &a)).iter().all(|x| x.sign() == 0)
}

/// Whether a point lies on a segment. Along a line all coordinates are monotone.
pub(super) fn is_between(p: Point, a: Point, b: Point) -> bool {
    let in_box = (0..3).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]));
    in_box && is_flat([a, b, p])
}

/// The longest segment of a triangle without area.
fn span([a, b, c]: [Point; 3]) -> [Point; 2] {
    if is_between(b, a, c) {
        [a, c]
    } else if is_between(c, a, b) {
        [a, b]
    } else {
        [b, c]
    }
}

/// Whether a segment has the points of a triangle without area, and no others.
pub(super) fn is_wire_of(ends: [Point; 2], corners: [Point; 3]) -> bool {
    let [a, b] = span(corners).map(place);
    ends.map(place) == [a, b] || ends.map(place) == [b, a]
}

/// The edges of a mesh and its wires, from both ends.
pub(super) struct Edges(HashMap<Place, Vec<Point>>);

impl Edges {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let mut edges: HashMap<Place, Vec<Point>> = HashMap::new();
        for triangle in mesh.all_triangles() {
            let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
            for (from, to) in [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)] {
                edges.entry(place(from)).or_default().push(to);
            }
        }
        Self(edges)
    }

    /// Whether every point of a triangle without area is one of an edge: edges lead from end to
    /// end of its segment without leaving it.
    pub(super) fn cover(&self, corners: [Point; 3]) -> bool {
        let [start, end] = span(corners);
        let (mut waiting, mut seen) = (vec![start], HashSet::from([place(start)]));
        while let Some(from) = waiting.pop() {
            let Some(ways) = self.0.get(&place(from)) else { continue };
            if place(from) == place(end) {
                return true;
            }
            for &to in ways {
                if is_between(to, from, end) && seen.insert(place(to)) {
                    waiting.push(to);
                }
            }
        }
        false
    }
}
