//! Whether two triangles meet, with proof, by signs of determinants after Devillers & Guigue,
//! *Faster Triangle-Triangle Intersection Tests* (2002).
//!
//! Two triangles have a common point exactly if an edge of one has a point in common with the
//! other. An edge misses a triangle if its ends lie on one side of the plane, or if its line passes
//! two of the triangle's edges on different sides; it crosses if its ends lie on different sides
//! and its line passes all three on one side. If both triangles pass through the other's plane, it
//! is enough to compare where they do. All of these are signs of determinants of three differences,
//! and a sign counts only where it would be the same for all vertices within `doubt`:
//! `core/docs/rounding.md` §11.

use super::vector::{Point, Precision, cross, dot, minus, norm_1};
use crate::num::each;

/// The proved relation of two surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// Proved: they have no common point.
    Apart,
    /// Proved: they have a common point.
    Meets,
    /// The distance is within the error of the vertices, or within rounding.
    Undecided,
}

/// Error of a determinant of vectors of these 1-norms, each of which may be off by `shift`.
#[inline(always)]
pub fn determinant_margin<T: Precision>(x: T, y: T, z: T, shift: T) -> T {
    let (xy, sum) = (x * y, x + y);
    T::DETERMINANT * (xy * z)
        + shift * ((xy + sum * z) + shift * ((sum + z) + shift))
        + T::UNDERFLOW_LOSS
}

/// The proved sign, 1 or −1; 0 if no sign is proved.
#[inline(always)]
fn sign<T: Precision>(value: T, margin: T) -> i8 {
    i8::from(value > margin) - i8::from(value < T::ZERO - margin)
}

/// An edge of a triangle: its start, its direction, and the direction's 1-norm.
#[derive(Clone, Copy)]
struct Edge<T> {
    from: Point<T>,
    offset: Point<T>,
    length: T,
}

#[inline(always)]
fn edges<T: Precision>([a, b, c]: [Point<T>; 3]) -> [Edge<T>; 3] {
    each([(a, b), (b, c), (c, a)], |(from, to)| {
        let offset = minus(to, from);
        Edge { from, offset, length: norm_1(offset) }
    })
}

/// On which sides of a triangle's plane points lie.
#[inline(always)]
fn sides<T: Precision>(
    [first, second, _]: &[Edge<T>; 3],
    points: [Point<T>; 3],
    shift: T,
) -> [i8; 3] {
    let normal = cross(first.offset, second.offset);
    each(points, |p| {
        // From the vertex that both edges share.
        let offset = minus(p, second.from);
        sign(
            dot(normal, offset),
            determinant_margin(first.length, second.length, norm_1(offset), shift),
        )
    })
}

/// Whether the triangles `a` and `b` have a common point. No true vertex is farther than `doubt`
/// from its given place.
///
/// Triangles that touch are [`Contact::Undecided`] in any precision. So is every pair in which one
/// triangle has no area and the other comes within rounding of it. With a `doubt` of 0 the given
/// coordinates are the truth. Products of three lengths must stay within the type's range.
///
/// Cost: 3 or 6 determinants if the plane of one triangle separates them, mostly 8; 15 and 36 inner
/// products where a vertex comes near the other's plane.
#[inline(always)]
pub fn triangles_meet<T: Precision>(a: [Point<T>; 3], b: [Point<T>; 3], doubt: T) -> Contact {
    // Each end of a difference may be off.
    let shift = doubt + doubt;
    let (edges_a, edges_b) = (edges(a), edges(b));
    let parted = |[p, q, r]: [i8; 3]| p != 0 && p == q && q == r;
    let b_sides = sides(&edges_a, b, shift);
    if parted(b_sides) {
        return Contact::Apart;
    }
    let a_sides = sides(&edges_b, a, shift);
    if parted(a_sides) {
        return Contact::Apart;
    }
    if is_certain(a_sides) && is_certain(b_sides) {
        return straddling_triangles_meet(a, b, [a_sides, b_sides], shift);
    }
    undecided(&edges_a, &edges_b, [a, b], [a_sides, b_sides], shift)
}

#[inline(always)]
fn is_certain([p, q, r]: [i8; 3]) -> bool {
    p != 0 && q != 0 && r != 0
}

/// How one edge turns past another: 1 or −1; 0 if it is not certain.
#[inline(always)]
fn turn<T: Precision>(first: &Edge<T>, second: &Edge<T>, shift: T) -> i8 {
    let offset = minus(second.from, first.from);
    let margin = determinant_margin(first.length, second.length, norm_1(offset), shift);
    sign(dot(cross(first.offset, second.offset), offset), margin)
}

/// The edges by which a triangle passes up and down through a plane, if some of its vertices are
/// above (1) and the others below it (−1).
#[inline(always)]
fn passing<T: Precision>([a, b, c]: [Point<T>; 3], [p, q, r]: [i8; 3]) -> [Edge<T>; 2] {
    let edge = |from: Point<T>, to: Point<T>| {
        let offset = minus(to, from);
        Edge { from, offset, length: norm_1(offset) }
    };
    let (up, down) = if p > q {
        // The edge from `a` goes down. The edge that goes up begins at `b` if `c` is above.
        (if r > q { (b, c) } else { (c, a) }, (a, b))
    } else if p < q {
        ((a, b), if r < q { (b, c) } else { (c, a) })
    } else if p > r {
        ((c, a), (b, c))
    } else {
        ((b, c), (c, a))
    };
    [edge(up.0, up.1), edge(down.0, down.1)]
}

/// Whether two triangles meet that certainly pass through each other's planes. `sides`: on which
/// side of the other's plane the vertices of the first, and of the second, lie, 1 where corners run
/// counter-clockwise. `shift`: the error of a difference of two vertices.
///
/// Both meet the planes' common line in an interval. Along the product of their normals the first
/// interval begins where an edge passes up, and the second where an edge passes down. So two
/// determinants tell whether either interval ends before the other begins.
#[inline(always)]
pub fn straddling_triangles_meet<T: Precision>(
    a: [Point<T>; 3],
    b: [Point<T>; 3],
    [a_sides, b_sides]: [[i8; 3]; 2],
    shift: T,
) -> Contact {
    let ([a_up, a_down], [b_up, b_down]) = (passing(a, a_sides), passing(b, b_sides));
    // Negative if the second begins behind the first one's end, positive if it ends before its
    // beginning.
    let (behind, before) = (turn(&a_down, &b_down, shift), turn(&a_up, &b_up, shift));
    if behind < 0 || before > 0 {
        Contact::Apart
    } else if behind > 0 && before < 0 {
        Contact::Meets
    } else {
        Contact::Undecided
    }
}

/// Whether they meet if some vertex has no certain side of the other plane.
#[inline(never)]
fn undecided<T: Precision>(
    edges_a: &[Edge<T>; 3],
    edges_b: &[Edge<T>; 3],
    points: [[Point<T>; 3]; 2],
    [a_sides, b_sides]: [[i8; 3]; 2],
    shift: T,
) -> Contact {
    // How each edge of `a` runs past each edge of `b`.
    let turns = edges_a.map(|first| edges_b.map(|second| turn(&first, &second, shift)));
    let [[s, t, u], [v, w, x], [y, z, o]] = turns;
    let across = [[s, v, y], [t, w, z], [u, x, o]];
    let mut all_miss = true;
    for (turns, sides) in [(turns, a_sides), (across, b_sides)] {
        let [p, q, r] = sides;
        for ([i, j, k], (from, to)) in turns.into_iter().zip([(p, q), (q, r), (r, p)]) {
            let is_through = i != 0 && i == j && j == k;
            if is_through && from * to < 0 {
                return Contact::Meets;
            }
            let is_past = (i > 0 || j > 0 || k > 0) && (i < 0 || j < 0 || k < 0);
            all_miss &= is_past || from * to > 0;
        }
    }
    if all_miss || parted_in_a_plane(edges_a, edges_b, points, shift) {
        Contact::Apart
    } else {
        Contact::Undecided
    }
}

/// Whether some plane upright on a triangle, along one of its edges, separates it from the other.
/// Of triangles in one plane no determinant says more.
fn parted_in_a_plane<T: Precision>(
    edges_a: &[Edge<T>; 3],
    edges_b: &[Edge<T>; 3],
    [a, b]: [[Point<T>; 3]; 2],
    shift: T,
) -> bool {
    [(edges_a, a, b), (edges_b, b, a)].into_iter().any(|(edges, own, other)| {
        let [first, second, _] = edges;
        let normal = cross(first.offset, second.offset);
        edges
            .iter()
            .any(|edge| parted_along(cross(edge.offset, normal), edge.from, own, other, shift))
    })
}

/// Whether the direction, taken as it is, points from all of `own` to all of `other`. Distances are
/// measured from a vertex of `own`.
#[inline(always)]
fn parted_along<T: Precision>(
    direction: Point<T>,
    from: Point<T>,
    own: [Point<T>; 3],
    other: [Point<T>; 3],
    shift: T,
) -> bool {
    let length = norm_1(direction);
    let height = |p: Point<T>| {
        let offset = minus(p, from);
        (
            dot(direction, offset),
            length * (T::DETERMINANT * norm_1(offset) + shift) + T::UNDERFLOW_LOSS,
        )
    };
    // The vertices that are farthest out and nearest.
    let [own, other] = [own, other].map(|points| points.map(height));
    own.iter().all(|&(height, margin)| {
        other.iter().all(|&(beyond, doubt)| beyond - doubt > height + margin)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [[f32; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn shifted(by: [f32; 3], t: [[f32; 3]; 3]) -> [[f32; 3]; 3] {
        t.map(|p| [p[0] + by[0], p[1] + by[1], p[2] + by[2]])
    }

    fn turned(t: [[f32; 3]; 3]) -> [[f32; 3]; 3] {
        [t[1], t[2], t[0]]
    }

    #[test]
    fn triangles_are_told_apart_from_those_that_meet_in_either_order_and_winding() {
        let spike = [[0.5, 0.5, -1.0], [1.0, 0.5, -1.0], [1.0, 1.0, 1.0]];
        let cases = [
            (spike, 0.0, Contact::Meets),
            (spike, 0.4, Contact::Undecided),
            (shifted([0.0, 0.0, 1.5], spike), 0.0, Contact::Apart),
            (shifted([0.0, 0.0, 1.5], spike), 0.3, Contact::Undecided),
            // Beyond the slanted edge: planes do not separate them, edges do.
            (shifted([2.0, 2.0, 0.0], spike), 0.0, Contact::Apart),
            (shifted([0.0, 0.0, 1e-30], FLAT), 0.0, Contact::Undecided),
            (FLAT, 0.0, Contact::Undecided),
            ([[1.0, 1.0, 0.0]; 3], 0.0, Contact::Undecided),
            ([[1.0, 1.0, 1.0]; 3], 0.0, Contact::Apart),
        ];
        for (other, doubt, wanted) in cases {
            for (a, b) in [(FLAT, other), (other, FLAT), (turned(FLAT), turned(turned(other)))] {
                let mirrored = [b[1], b[0], b[2]];
                assert_eq!(triangles_meet(a, b, doubt), wanted, "{a:?} {b:?} {doubt}");
                assert_eq!(
                    triangles_meet(a, mirrored, doubt),
                    wanted,
                    "{a:?} {mirrored:?} {doubt}"
                );
                let wide = |t: [[f32; 3]; 3]| t.map(|p| p.map(f64::from));
                assert_eq!(triangles_meet(wide(a), wide(b), f64::from(doubt)), wanted);
            }
        }
    }
}
