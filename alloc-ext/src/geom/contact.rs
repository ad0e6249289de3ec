//! How two faces of a surface meet, by exact predicates.
//!
//! The intersection of two triangles is convex. If two faces share no corner, it is nothing, a
//! point, a segment or an area. If they share one, it is that corner alone or more than a point.

use super::bounds::Bounds;
use super::predicates::{Face, Triangle, are_apart, is_degenerate, projection, side, turn};

/// How two faces with area meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contact {
    /// They share no points but common corners and a common edge.
    Apart,
    /// They share no corner, and at most one point.
    Point,
    /// What they share lies on edges of both: one bit for each edge, which leads from the corner of
    /// that number to the next.
    Edges([u8; 2]),
    /// They cross, or overlap in a plane, or an edge of one runs within the other.
    Crossing,
}

impl Contact {
    /// How two faces with area meet. Exact.
    pub fn of(s: &Face, t: &Face) -> Self {
        if are_apart(s, t) {
            return Self::Apart;
        }
        match s.ids.iter().filter(|&id| t.ids.contains(id)).count() {
            0 => of_strangers(&s.at, &t.at),
            1 => along_edges(&s.at, &t.at),
            _ => Self::Crossing,
        }
    }
}

/// Whether two faces, with area or not, [cross](Contact::Crossing). Faces without area cross none.
pub(crate) fn crosses(s: &Face, t: &Face) -> bool {
    Bounds::of(&s.at).meets(&Bounds::of(&t.at))
        && !is_degenerate(&s.at)
        && !is_degenerate(&t.at)
        && Contact::of(s, t) == Contact::Crossing
}

/// Sides of a triangle's corners about another's plane.
fn sides(of: &Triangle, about: &Triangle) -> [f64; 3] {
    of.map(|p| side(about, p))
}

/// Whether one corner lies on the plane, and both others on one side of it.
fn touches_by_corner(sides: [f64; 3]) -> bool {
    let count = |is: fn(&f64) -> bool| sides.iter().filter(|s| is(s)).count();
    count(|&s| s == 0.0) == 1 && count(|&s| s > 0.0) != 1
}

/// Faces without a common corner that meet.
fn of_strangers(s: &Triangle, t: &Triangle) -> Contact {
    let (of_s, of_t) = (sides(s, t), sides(t, s));
    if touches_by_corner(of_s) || touches_by_corner(of_t) {
        return Contact::Point;
    }
    match along_edges(s, t) {
        Contact::Crossing if of_s != [0.0; 3] && share_no_segment(s, of_s, t, of_t) => {
            Contact::Point
        }
        contact => contact,
    }
}

/// Faces that meet: whether what they share lies on edges of both.
fn along_edges(s: &Triangle, t: &Triangle) -> Contact {
    let (of_s, of_t) = (sides(s, t), sides(t, s));
    if of_s == [0.0; 3] {
        return beside(s, t)
            .or_else(|| beside(t, s).map(|[t, s]| [s, t]))
            .map_or(Contact::Crossing, Contact::Edges);
    }
    match (edges_on(of_s), edges_on(of_t)) {
        (0, _) | (_, 0) => Contact::Crossing,
        (of_s, of_t) => Contact::Edges([of_s, of_t]),
    }
}

/// The edges whose two ends have a height of 0, one bit each.
fn edges_on(heights: [f64; 3]) -> u8 {
    (0..3)
        .filter(|&i| heights[i] == 0.0 && heights[(i + 1) % 3] == 0.0)
        .fold(0, |edges, i| edges | 1 << i)
}

/// Two triangles of one plane, where a line along an edge of `s` has their interiors on its two
/// sides: the edges on that line.
fn beside(s: &Triangle, t: &Triangle) -> Option<[u8; 2]> {
    let axes = projection(s)?;
    let winding = turn(axes, s[0], s[1], s[2]);
    (0..3).find_map(|i| {
        let (a, b) = (s[i], s[(i + 1) % 3]);
        let heights = t.map(|p| turn(axes, a, b, p) * winding.signum());
        heights.iter().all(|&height| height <= 0.0).then(|| [1 << i, edges_on(heights)])
    })
}

/// Whether two triangles of different planes share at most a point. Each cuts the line of the two
/// planes in an interval that is longer than a point (Guigue & Devillers, *Fast and Robust
/// Triangle-Triangle Overlap Test Using Orientation Predicates*, 2003).
fn share_no_segment(s: &Triangle, of_s: [f64; 3], t: &Triangle, of_t: [f64; 3]) -> bool {
    let ([p, q, r], flips_t) = from_lone_corner(s, of_s);
    let ([u, v, w], flips_s) = from_lone_corner(t, of_t);
    // With its lone corner in front of the other's plane, each interval runs from one of its edges
    // to the other.
    let ([q, r], [v, w]) =
        (if flips_s { [r, q] } else { [q, r] }, if flips_t { [w, v] } else { [v, w] });
    !(side(&[p, q, u], v) < 0.0 && side(&[p, r, u], w) > 0.0)
}

/// The triangle's corners from the one that lies alone on its side of a plane, and whether that is
/// the back.
fn from_lone_corner(corners: &Triangle, sides: [f64; 3]) -> (Triangle, bool) {
    let count = |is: fn(&f64) -> bool| sides.iter().filter(|s| is(s)).count();
    let in_front = count(|&s| s > 0.0) == 1;
    let is_lone = |s: &f64| if in_front { *s > 0.0 } else { *s < 0.0 };
    let first = sides.iter().position(is_lone).unwrap_or_default();
    ([0, 1, 2].map(|k| corners[(first + k) % 3]), !in_front)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;
    use glam::DVec3;

    fn contact(s: [[f64; 3]; 3], t: [[f64; 3]; 3]) -> Contact {
        let face = |ids, at: [[f64; 3]; 3]| Face { ids, at: at.map(DVec3::from) };
        Contact::of(&face([0, 1, 2], s), &face([3, 4, 5], t))
    }

    const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn a_corner_on_a_face_an_edge_or_a_corner_is_a_point() {
        for [x, y] in [[1.0, 1.0], [2.0, 2.0], [0.0, 0.0], [2.0, 0.0]] {
            let tip = [[x, y, 0.0], [1.0, 1.0, 3.0], [2.0, 1.0, 3.0]];
            assert_eq!(contact(FLAT, tip), Contact::Point);
            assert_eq!(contact(tip, FLAT), Contact::Point);
        }
    }

    #[test]
    fn edges_that_cross_are_a_point_and_edges_on_a_line_are_edges() {
        let across = [[2.0, -1.0, -1.0], [2.0, 1.0, 1.0], [2.0, -1.0, 1.0]];
        assert_eq!(contact(FLAT, across), Contact::Point);
        assert_eq!(contact(across, FLAT), Contact::Point);
        let along = [[1.0, 0.0, 0.0], [9.0, 0.0, 0.0], [3.0, 0.0, 2.0]];
        assert_eq!(contact(FLAT, along), Contact::Edges([1, 1]));
        let beside = [[9.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, -2.0, 0.0]];
        assert_eq!(contact(FLAT, beside), Contact::Edges([1, 1]));
        let over = [[1.0, 1.0, 0.0], [9.0, 1.0, 0.0], [3.0, 2.0, 2.0]];
        assert_eq!(contact(FLAT, over), Contact::Crossing);
        assert_eq!(contact(over, FLAT), Contact::Crossing);
    }

    /// Corners of a triangle on a small lattice, where contacts of all kinds are common.
    fn lattice(random: &mut SplitMix) -> [[f64; 3]; 3] {
        [0; 3].map(|_| [0; 3].map(|_| (random.roll() * 5.0).floor()))
    }

    /// The ends of the intersection of two triangles of different planes, as exact fractions
    /// would give them: places along the planes' line where their edges cross it.
    fn interval(
        t: [[f64; 3]; 3],
        normal: [f64; 3],
        offset: f64,
        line: [f64; 3],
    ) -> Option<[f64; 2]> {
        let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
        let heights = t.map(|p| dot(normal, p) - offset);
        let mut ends: Vec<f64> = Vec::new();
        for i in 0..3 {
            let j = (i + 1) % 3;
            if heights[i] == 0.0 {
                ends.push(dot(line, t[i]));
            }
            if heights[i] * heights[j] < 0.0 {
                let (a, b) = (dot(line, t[i]), dot(line, t[j]));
                ends.push(a + (b - a) * heights[i] / (heights[i] - heights[j]));
            }
        }
        let low = ends.iter().copied().reduce(f64::min)?;
        Some([low, ends.iter().copied().fold(low, f64::max)])
    }

    #[test]
    fn pairs_on_a_lattice_meet_as_their_intervals_do() {
        let mut random = SplitMix::new(7);
        let cross = |t: [[f64; 3]; 3]| {
            let [a, b, c] = t.map(DVec3::from);
            (b - a).cross(c - a)
        };
        let (mut points, mut segments) = (0, 0);
        for _ in 0..40_000 {
            let (s, t) = (lattice(&mut random), lattice(&mut random));
            let (n, m) = (cross(s), cross(t));
            let line = n.cross(m);
            if line == DVec3::ZERO {
                continue;
            }
            let of = |t, n: DVec3, p: [f64; 3]| {
                interval(t, n.to_array(), n.dot(DVec3::from(p)), line.to_array())
            };
            let (of_s, of_t) = (of(s, m, t[0]), of(t, n, s[0]));
            let shared = match (of_s, of_t) {
                (Some([a, b]), Some([c, d])) => b.min(d) - a.max(c),
                _ => -1.0,
            };
            let found = contact(s, t);
            let is = match shared {
                x if x < -1e-6 => found == Contact::Apart,
                x if x < 1e-6 => found == Contact::Point || matches!(found, Contact::Edges(_)),
                _ => matches!(found, Contact::Crossing | Contact::Edges(_)),
            };
            assert!(is, "{s:?} {t:?}: {found:?}, {shared}");
            points += u32::from(found == Contact::Point);
            segments += u32::from(found == Contact::Crossing);
        }
        assert!(points > 1000 && segments > 1000, "{points} {segments}");
    }
}
