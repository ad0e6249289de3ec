//! Triangles without area: their segments and points, kept where no other triangle covers them.
//!
//! The points of a triangle without area are points of the mesh. Most often an edge of a neighbour,
//! or a chain of edges, covers them. Those that nothing covers become a [`Wire`].

use super::collinear::{collinear, middle};
use super::report::RepairReport;
use rustc_hash::FxHashSet;

/// A segment of the mesh that belongs to no triangle with an area, or, if both ends are one vertex,
/// a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wire {
    /// Vertices of both ends.
    pub ends: [u32; 2],
    /// Number of its triangle in the input file.
    pub source: u32,
}

impl Wire {
    /// The triangle that has the wire's points and no others: its corners are the first end, and
    /// twice the second.
    #[must_use]
    pub fn triangle(&self) -> [u32; 3] {
        [self.ends[0], self.ends[1], self.ends[1]]
    }

    /// The points of a triangle without area.
    pub(crate) fn of(positions: &[[f32; 3]], triangle: [u32; 3], source: u32) -> Self {
        let [a, b, c] = triangle;
        let ends = if a == b || b == c {
            [a, c]
        } else if c == a {
            [a, b]
        } else {
            let middle = middle(triangle.map(|v| positions[v as usize]));
            [triangle[(middle + 1) % 3], triangle[(middle + 2) % 3]]
        };
        Self { ends, source }
    }

    fn is_point(&self) -> bool {
        self.ends[0] == self.ends[1]
    }
}

/// A triangle without area that repair took out, and its kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct TakenOut {
    pub wire: Wire,
    /// Its first corner.
    pub first: u32,
    /// Else its three corners are distinct.
    pub repeats_corner: bool,
}

/// Edges that a search for a chain of them looks at: beyond that a wire is kept, covered or not.
const LONGEST_SEARCH: usize = 4096;

/// Of the triangles without area those that are not covered by an edge of `triangles`, or by a
/// chain of edges, or by a wire before them.
///
/// Cost: O(n log n) if there are any; nothing else.
pub(super) fn uncovered(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    taken_out: &[TakenOut],
    report: &mut RepairReport,
) -> Vec<Wire> {
    if taken_out.is_empty() {
        return Vec::new();
    }
    let edges = Edges::of(triangles);
    let mut kept: Vec<Wire> = Vec::new();
    let mut seen: FxHashSet<[u32; 2]> = FxHashSet::default();
    let mut ends: FxHashSet<u32> = FxHashSet::default();
    // Points last: the end of a wire covers a point.
    let (points, segments): (Vec<&TakenOut>, Vec<&TakenOut>) =
        taken_out.iter().partition(|taken| taken.wire.is_point());
    for TakenOut { wire, first, repeats_corner } in segments.into_iter().chain(points) {
        let [a, b] = wire.ends;
        let is_covered = edges.cover(positions, wire.ends)
            || (a == b && ends.contains(&a))
            || !seen.insert([a.min(b), a.max(b)]);
        let finding = match (is_covered, repeats_corner) {
            (false, _) => &mut report.wires,
            (true, true) => &mut report.repeated_corner,
            (true, false) => &mut report.zero_area,
        };
        finding.triangle(wire.source, positions[*first as usize]);
        if !is_covered {
            ends.extend(wire.ends);
            kept.push(*wire);
        }
    }
    kept.sort_by_key(|wire| wire.source);
    kept
}

/// The edges of triangles, from both ends, sorted.
struct Edges(Vec<[u32; 2]>);

impl Edges {
    fn of(triangles: &[[u32; 3]]) -> Self {
        let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]];
        let mut edges: Vec<[u32; 2]> = triangles.iter().flat_map(sides).collect();
        edges.sort_unstable();
        edges.dedup();
        Self(edges)
    }

    /// The edges from a vertex.
    fn from(&self, vertex: u32) -> &[[u32; 2]] {
        let first = self.0.partition_point(|edge| edge[0] < vertex);
        let count = self.0[first..].partition_point(|edge| edge[0] == vertex);
        &self.0[first..first + count]
    }

    /// Whether every point of a segment is one of an edge, for certain: an edge or a chain of edges
    /// leads from end to end, all on the segment's line by an exact test. Of a point, whether it is
    /// a corner.
    fn cover(&self, positions: &[[f32; 3]], [start, end]: [u32; 2]) -> bool {
        if start == end {
            return !self.from(start).is_empty();
        }
        if self.0.binary_search(&[start, end]).is_ok() {
            return true;
        }
        let at = |v: u32| positions[v as usize];
        let mut reached = vec![start];
        let (mut next, mut looked_at) = (0, 0);
        while let Some(&from) = reached.get(next) {
            next += 1;
            for &[_, to] in self.from(from) {
                looked_at += 1;
                if looked_at > LONGEST_SEARCH {
                    return false;
                }
                let goes_on = collinear(at(start), at(end), at(to))
                    && is_between(at(to), at(from), at(end))
                    && !reached.contains(&to);
                if goes_on && to == end {
                    return true;
                }
                if goes_on {
                    reached.push(to);
                }
            }
        }
        false
    }
}

/// Whether `p`, a point of the line through `a` and `b`, lies between them. Along a line all
/// coordinates are monotone.
fn is_between(p: [f32; 3], a: [f32; 3], b: [f32; 3]) -> bool {
    (0..3).all(|axis| {
        let (a, b) = (a[axis], b[axis]);
        (a.min(b)..=a.max(b)).contains(&p[axis])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32) -> [f32; 3] {
        [x, 2.0 * x, -x]
    }

    #[test]
    fn a_chain_of_edges_covers_a_segment_and_a_gap_does_not() {
        let mut positions: Vec<[f32; 3]> = (0..5).map(|i| at(i as f32)).collect();
        positions.push([9.0; 3]);
        let triangles = [[0, 1, 5], [1, 3, 5], [4, 3, 5]];
        let covers = |triangles: &[[u32; 3]], ends| Edges::of(triangles).cover(&positions, ends);
        assert!(covers(&triangles, [0, 4]) && covers(&triangles, [4, 0]));
        assert!(covers(&triangles, [1, 3]) && covers(&triangles, [3, 3]));
        assert!(!covers(&triangles, [0, 2]) && !covers(&triangles, [2, 2]));
        assert!(!covers(&triangles[..2], [0, 4]));
    }
}
