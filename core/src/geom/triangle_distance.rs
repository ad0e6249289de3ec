//! The distance of two triangles in f64, with both ends proved.
//!
//! Disjoint triangles are nearest at a vertex and a face, or at two edges. The upper end is the
//! length of the offset of two points that lie on the triangles, whichever were found. The lower
//! end is the gap along a direction: no direction makes it too great. So a case that rounding
//! misjudges costs width and no truth. Derivation: `core/docs/rounding.md` §18.
//!
//! That the search ends as soon as the gap along the offset is its length is of Larsen, Gottschalk,
//! Lin and Manocha, *Fast Proximity Queries with Swept Sphere Volumes* (1999).

use super::vector::{Point, cross, dot, minus};
use crate::num::tolerance::{GAP_DIRECTION_SQ, GAP_SETTLED, TRIANGLE_DISTANCE, U64};
use crate::num::{greater, lesser};

/// The distance of two triangles.
#[derive(Clone, Copy, Debug)]
pub struct TriangleDistance {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// A point of each triangle. They are at most `upper` apart.
    pub points: [[f64; 3]; 2],
}

/// Two points on the triangles, the offset from the first to the second, and its squared length.
#[derive(Clone, Copy)]
struct Candidate {
    points: [Point<f64>; 2],
    offset: Point<f64>,
    offset_sq: f64,
}

impl Candidate {
    #[inline(always)]
    fn new(from: Point<f64>, to: Point<f64>) -> Candidate {
        let offset = minus(to, from);
        Candidate { points: [from, to], offset, offset_sq: dot(offset, offset) }
    }

    #[inline(always)]
    fn turned(self) -> Candidate {
        let [from, to] = self.points;
        Candidate { points: [to, from], offset: self.offset.map(|x| -x), offset_sq: self.offset_sq }
    }

    #[inline(always)]
    fn or_nearer(self, other: Option<Candidate>) -> Candidate {
        other.filter(|other| other.offset_sq < self.offset_sq).unwrap_or(self)
    }
}

/// The distance of the triangles `a` and `b`. They may be segments or points. `guesses`: a bit for
/// each corner of either that may be among the nearest ones. These are tried first, then the next
/// guess; no proof rests on them.
///
/// Triangles that pass through each other have a lower end of 0. Their upper end is then only that
/// of a vertex and a face, or of two edges: ask [`triangles_meet`](super::triangles_meet) too.
/// Triangles that touch have an upper end of a few roundings.
/// Coordinates must be finite, 0 or from 1e-60 to 1e60 in size.
///
/// Cost: some fifteen inner products if the guess is right. Else up to nine pairs of edges with
/// some eight inner products each, and the feet of six vertices.
pub fn triangle_distance(
    a: [Point<f64>; 3],
    b: [Point<f64>; 3],
    guesses: [[u32; 2]; 2],
) -> TriangleDistance {
    let try_one = |guess: &[u32; 2]| {
        let found = guessed(&a, &b, *guess)?;
        Some((found, settled(&found, &a, &b)?))
    };
    let [first, second] = &guesses;
    let found = try_one(first).or_else(|| if first == second { None } else { try_one(second) });
    let (best, gap) = found.unwrap_or_else(|| among_all(&a, &b));
    let margin = TRIANGLE_DISTANCE * U64 * (farthest(&a) + farthest(&b));
    TriangleDistance {
        lower: greater(0.0, gap - margin),
        upper: libm::sqrt(best.offset_sq) + margin,
        points: best.points,
    }
}

/// The nearest points of the corners of a guess.
#[inline(always)]
fn guessed(
    a: &[Point<f64>; 3],
    b: &[Point<f64>; 3],
    [first, second]: [u32; 2],
) -> Option<Candidate> {
    if first == ALL {
        return foot_of_some(a, b, second);
    }
    if second == ALL {
        return foot_of_some(b, a, first).map(Candidate::turned);
    }
    let ([from, to], [start, end]) = (ends(a, first)?, ends(b, second)?);
    Some(between_edges(from, to, start, end))
}

/// The bits of all corners.
const ALL: u32 = 0b111;

/// The first foot of a corner with its bit that is in the face.
fn foot_of_some(
    face: &[Point<f64>; 3],
    other: &[Point<f64>; 3],
    corners: u32,
) -> Option<Candidate> {
    let normal = normal(face);
    let wanted = other.iter().enumerate().filter(|(k, _)| corners >> (k & 3) & 1 != 0);
    wanted.into_iter().find_map(|(_, corner)| over_face(face, normal, *corner))
}

/// The ends of an edge with these corners; twice the same if there is one. `None` if there is none.
fn ends(triangle: &[Point<f64>; 3], corners: u32) -> Option<[Point<f64>; 2]> {
    let at = |k: u32| triangle.get(k as usize).copied();
    Some([at(corners.trailing_zeros())?, at(31u32.wrapping_sub(corners.leading_zeros()))?])
}

/// The nearest points of all edges, vertices and faces, and the gap.
#[inline(never)]
fn among_all(a: &[Point<f64>; 3], b: &[Point<f64>; 3]) -> (Candidate, f64) {
    let [to_first, to_second] = [normal(a), normal(b)];
    let [from, ..] = *a;
    let [to, ..] = *b;
    let mut best = Candidate::new(from, to);
    // Of triangles that touch, a vertex may lie in the other one's plane or a little beyond it.
    for vertex in b {
        best = best.or_nearer(over_face(a, to_first, *vertex));
    }
    for vertex in a {
        best = best.or_nearer(over_face(b, to_second, *vertex).map(Candidate::turned));
    }
    if let Some(gap) = settled(&best, a, b) {
        return (best, gap);
    }
    let mut across = [0.0; 3];
    for (from, to) in edges(a) {
        for (start, end) in edges(b) {
            let found = between_edges(from, to, start, end);
            if found.offset_sq < best.offset_sq {
                best = found;
                across = cross(minus(to, from), minus(end, start));
                if let Some(gap) = settled(&best, a, b) {
                    return (best, gap);
                }
            }
        }
    }
    // A short offset is mostly rounding. Normals are not.
    let gap = [best.offset, to_first, to_second, across]
        .into_iter()
        .flat_map(|offset| [offset, offset.map(|x| -x)])
        .map(|offset| length_along(offset, a, b))
        .fold(0.0, greater);
    (best, gap)
}

/// Largest 1-norm.
#[inline(always)]
fn farthest(triangle: &[Point<f64>; 3]) -> f64 {
    triangle.iter().map(|[x, y, z]| x.abs() + y.abs() + z.abs()).fold(0.0, greater)
}

#[inline(always)]
fn normal(&[a, b, c]: &[Point<f64>; 3]) -> Point<f64> {
    cross(minus(b, a), minus(c, a))
}

#[inline(always)]
fn edges(&[a, b, c]: &[Point<f64>; 3]) -> [(Point<f64>, Point<f64>); 3] {
    [(a, b), (b, c), (c, a)]
}

/// How far `b` lies beyond `a` along a direction, times the direction's length.
#[inline(always)]
fn beyond(offset: Point<f64>, a: &[Point<f64>; 3], b: &[Point<f64>; 3]) -> f64 {
    let ([p, q, r], [s, t, u]) = (a.map(|x| dot(offset, x)), b.map(|x| dot(offset, x)));
    lesser(lesser(s, t), u) - greater(greater(p, q), r)
}

/// The same as a length; 0 of a direction that is too short to be trusted.
#[inline(always)]
fn length_along(offset: Point<f64>, a: &[Point<f64>; 3], b: &[Point<f64>; 3]) -> f64 {
    let offset_sq = dot(offset, offset);
    if offset_sq < GAP_DIRECTION_SQ { 0.0 } else { beyond(offset, a, b) / libm::sqrt(offset_sq) }
}

/// The gap along the offset of two points, if no others are nearer, but for rounding.
#[cfg_attr(meshsweep_wide, inline(always))]
#[cfg_attr(not(meshsweep_wide), inline(never))]
fn settled(best: &Candidate, a: &[Point<f64>; 3], b: &[Point<f64>; 3]) -> Option<f64> {
    if best.offset_sq < GAP_DIRECTION_SQ {
        return None;
    }
    let beyond = beyond(best.offset, a, b);
    let is_settled = beyond >= best.offset_sq * GAP_SETTLED;
    is_settled.then(|| beyond / libm::sqrt(best.offset_sq))
}

/// A vertex and the point of the face below or above it.
#[inline(always)]
fn over_face(
    &[origin, first, second]: &[Point<f64>; 3],
    normal: Point<f64>,
    vertex: Point<f64>,
) -> Option<Candidate> {
    let foot = foot_on(origin, first, second, normal, vertex)?;
    Some(Candidate::new(foot, vertex))
}

/// The foot of a perpendicular on a face, if it is in the face.
#[cfg_attr(meshsweep_wide, inline(always))]
#[cfg_attr(not(meshsweep_wide), inline(never))]
fn foot_on(
    origin: Point<f64>,
    first: Point<f64>,
    second: Point<f64>,
    normal: Point<f64>,
    point: Point<f64>,
) -> Option<Point<f64>> {
    let (e, g, s) = (minus(first, origin), minus(second, origin), minus(point, origin));
    let area_sq = dot(normal, normal);
    let (v, w) = (dot(normal, cross(s, g)) / area_sq, dot(normal, cross(e, s)) / area_sq);
    // A triangle without area gives NaN.
    let is_inside = v >= 0.0 && w >= 0.0 && v + w <= 1.0;
    is_inside.then(|| plus(origin, e, v, g, w))
}

#[inline(always)]
fn plus([x, y, z]: Point<f64>, e: Point<f64>, v: f64, g: Point<f64>, w: f64) -> Point<f64> {
    [x + (e[0] * v + g[0] * w), y + (e[1] * v + g[1] * w), z + (e[2] * v + g[2] * w)]
}

/// A quotient within 0 and 1; 0 if it is not defined.
#[inline(always)]
fn fraction(x: f64, of: f64) -> f64 {
    if of > 0.0 { (x / of).clamp(0.0, 1.0) } else { 0.0 }
}

/// Nearest points of two segments (Ericson, *Real-Time Collision Detection*, 5.1.9).
#[cfg_attr(meshsweep_wide, inline(always))]
#[cfg_attr(not(meshsweep_wide), inline(never))]
fn between_edges(
    from: Point<f64>,
    to: Point<f64>,
    start: Point<f64>,
    end: Point<f64>,
) -> Candidate {
    let (d, e, r) = (minus(to, from), minus(end, start), minus(from, start));
    let (dd, ee, de) = (dot(d, d), dot(e, e), dot(d, e));
    let (dr, er) = (dot(d, r), dot(e, r));
    let mut s = fraction(de * er - dr * ee, dd * ee - de * de);
    let along = de * s + er;
    let mut t = fraction(along, ee);
    if along < 0.0 || ee <= 0.0 {
        t = 0.0;
        s = fraction(-dr, dd);
    } else if along > ee {
        t = 1.0;
        s = fraction(de - dr, dd);
    }
    let at =
        |[x, y, z]: Point<f64>, [a, b, c]: Point<f64>, k: f64| [x + a * k, y + b * k, z + c * k];
    Candidate::new(at(from, d, s), at(start, e, t))
}

/// A common point of two triangles that pass through each other, up to rounding: where an edge of
/// one crosses the other. `None` if rounding leaves no edge that does.
pub fn crossing(a: [Point<f64>; 3], b: [Point<f64>; 3]) -> Option<[f64; 3]> {
    [(&a, &b), (&b, &a)].into_iter().find_map(|(face, other)| {
        let (&[origin, first, second], normal) = (face, normal(face));
        edges(other).into_iter().find_map(|(from, to)| {
            let (p, q) = (dot(normal, minus(from, origin)), dot(normal, minus(to, origin)));
            if (p > 0.0) == (q > 0.0) {
                return None;
            }
            let (offset, t) = (minus(to, from), (p / (p - q)).clamp(0.0, 1.0));
            let point = [from[0] + offset[0] * t, from[1] + offset[1] * t, from[2] + offset[2] * t];
            foot_on(origin, first, second, normal, point)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{Point, crossing, triangle_distance};

    const FLAT: [[f64; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn shifted(by: [f64; 3], t: [Point<f64>; 3]) -> [Point<f64>; 3] {
        t.map(|p| [p[0] + by[0], p[1] + by[1], p[2] + by[2]])
    }

    fn check(b: [Point<f64>; 3], expected: f64) {
        let turned = |[p, q, r]: [Point<f64>; 3]| [q, r, p];
        for (x, y) in [(FLAT, b), (b, FLAT), (turned(FLAT), turned(turned(b)))] {
            // No guess makes an answer wrong or wide.
            for guess in 0..64 {
                let y = if guess & 1 == 0 { y } else { [y[1], y[0], y[2]] };
                let guesses = [[guess & 7, guess >> 3], [guess >> 3, guess & 7]];
                let found = triangle_distance(x, y, guesses);
                assert!(
                    found.lower <= expected && expected <= found.upper,
                    "{x:?} {y:?} {found:?}"
                );
                assert!(found.upper - found.lower < 4e-13, "{x:?} {y:?} {found:?}");
            }
        }
    }

    #[test]
    fn faces_edges_and_vertices_have_tight_intervals() {
        let spike = [[1.0, 1.0, 1.0], [1.5, 1.0, 3.0], [1.0, 1.5, 3.0]];
        check(spike, 1.0);
        check(shifted([0.0, 0.0, -5.0], spike), 2.0);
        check(shifted([0.0, 0.0, 1e-9 - 1.0], spike), 1e-9);
        check(shifted([-5.0, 0.0, 0.0], spike), f64::sqrt(17.0));
        let across = [[-1.0, 2.0, 2.0], [5.0, 2.0, 2.0], [2.0, 2.0, 9.0]];
        check(across, 2.0);
        let beside = [[5.0, 5.0, 0.0], [9.0, 5.0, 0.0], [5.0, 9.0, 0.0]];
        check(beside, f64::sqrt(18.0));
        check(shifted([0.0, 0.0, 7.0], FLAT), 7.0);
        check([[1.0, 1.0, 2.0]; 3], 2.0);
        check([[1.0, 1.0, 2.0], [2.0, 1.0, 3.0], [3.0, 1.0, 4.0]], 2.0);
    }

    #[test]
    fn triangles_that_touch_have_tight_intervals() {
        // A tip, an edge and a face on the face, a point in it, and tips a little below it.
        check([[1.0, 1.0, 0.0], [1.5, 1.0, 3.0], [1.0, 1.5, 3.0]], 0.0);
        check([[1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 3.0]], 0.0);
        check([[1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 0.0]], 0.0);
        check([[1.0, 1.0, 0.0]; 3], 0.0);
        check([[1.0, 1.0, -1e-13], [1.5, 1.0, 3.0], [1.0, 1.5, 3.0]], 0.0);
        check([[1.0, 1.0, -1e-16], [1.5, 1.0, 3.0], [1.0, 1.5, 3.0]], 0.0);
    }

    #[test]
    fn triangles_that_pass_through_each_other_have_a_lower_end_of_zero_and_a_common_point() {
        let spike = [[0.5, 0.5, -1.0], [1.0, 0.5, -1.0], [1.0, 1.0, 1.0]];
        for (x, y) in [(FLAT, spike), (spike, FLAT)] {
            assert_eq!(triangle_distance(x, y, [[0; 2]; 2]).lower, 0.0);
            let [_, _, z] = crossing(x, y).expect("an edge crosses");
            assert!(z.abs() < 1e-15, "{z}");
        }
        assert!(crossing(FLAT, shifted([0.0, 0.0, 1.5], spike)).is_none());
    }
}
