//! Whether triangles meet, decided exactly for any finite `f32` coordinates.
//!
//! Every answer is a sign of `robust`'s adaptive determinants, so that no answer depends on a
//! tolerance. Triangles are closed: touching counts as meeting. Coordinates are `f32` numbers held
//! in `f64`. Products of three have no bit below 2^-447, so that nothing underflows.

use super::bounds::Bounds;
use glam::DVec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Three corners, counter-clockwise seen from outside.
pub(crate) type Triangle = [DVec3; 3];

fn coord(p: DVec3) -> Coord3D<f64> {
    Coord3D { x: p.x, y: p.y, z: p.z }
}

/// Bound of a determinant's rounding, as a fraction of the product of its rows' sums of magnitudes.
///
/// Each entry is a difference of coordinates, rounded once. The determinant is three sums of three
/// products. Each is off by less than eight roundings of its size, and nothing underflows.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Positive where `p` is in front of the triangle's plane, 0 on it. Only the sign means anything.
#[inline]
pub(crate) fn side(t: &Triangle, p: DVec3) -> f64 {
    let [a, b, c] = t;
    rounded_side(t, p).unwrap_or_else(|| exact_side(a, b, c, p))
}

/// [`side`], if rounding leaves no doubt.
#[inline]
fn rounded_side([a, b, c]: &Triangle, p: DVec3) -> Option<f64> {
    let sum = |v: DVec3| v.x.abs() + v.y.abs() + v.z.abs();
    let (ab, ac, ap) = (*b - *a, *c - *a, p - *a);
    let height = ab.cross(ac).dot(ap);
    (height.abs() > ROUNDING * sum(ab) * sum(ac) * sum(ap)).then_some(height)
}

#[cold]
#[inline(never)]
fn exact_side(a: &DVec3, b: &DVec3, c: &DVec3, p: DVec3) -> f64 {
    -orient3d(coord(*a), coord(*b), coord(*c), coord(p))
}

/// A coordinate plane in which the triangle keeps some area, as the pair of coordinates that is
/// kept; `None` if the triangle has no area.
pub(super) fn projection(t: &Triangle) -> Option<[usize; 2]> {
    [[0, 1], [1, 2], [2, 0]].into_iter().find(|&axes| turn(axes, t[0], t[1], t[2]) != 0.0)
}

/// Sign of the turn a → b → c after projection.
pub(super) fn turn([i, j]: [usize; 2], a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let flat = |p: DVec3| Coord { x: p[i], y: p[j] };
    orient2d(flat(a), flat(b), flat(c))
}

/// Whether the triangle has no area.
pub(crate) fn is_degenerate(t: &Triangle) -> bool {
    projection(t).is_none()
}

/// Whether a point lies on the closed triangle, which may have no area.
pub(crate) fn lies_on(p: DVec3, t: &Triangle) -> bool {
    if side(t, p) != 0.0 {
        return false;
    }
    let bounds = Bounds::of(t);
    if !bounds.meets(&Bounds { low: p, high: p }) {
        return false;
    }
    let turns = |axes| [0, 1, 2].map(|i| turn(axes, t[i], t[(i + 1) % 3], p));
    match projection(t) {
        Some(axes) => {
            let turns = turns(axes);
            !(turns.iter().any(|&s| s > 0.0) && turns.iter().any(|&s| s < 0.0))
        }
        // A segment fills its box along its line.
        None => [[0, 1], [1, 2], [2, 0]].into_iter().all(|axes| turns(axes) == [0.0; 3]),
    }
}

fn same_strict_side([a, b, c]: [f64; 3]) -> bool {
    (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0)
}

/// Whether two closed triangles have a point in common. One of them may have no area.
pub(crate) fn meet(s: &Triangle, t: &Triangle) -> bool {
    let of_t = t.map(|p| side(s, p));
    if same_strict_side(of_t) {
        return false;
    }
    let of_s = s.map(|p| side(t, p));
    if same_strict_side(of_s) {
        return false;
    }
    edges_meet(t, of_t, s) || edges_meet(s, of_s, t)
}

/// Whether an edge of `s`, whose corners lie on the given sides of `t`'s plane, meets `t`. If `t`
/// has no area: false.
fn edges_meet(s: &Triangle, sides: [f64; 3], t: &Triangle) -> bool {
    (0..3).any(|i| {
        let j = (i + 1) % 3;
        segment_meets([s[i], s[j]], [sides[i], sides[j]], t)
    })
}

/// Whether a closed segment, whose ends lie on the given sides of `t`'s plane, meets `t`. If `t`
/// has no area: false.
pub(crate) fn segment_meets([p, q]: [DVec3; 2], [of_p, of_q]: [f64; 2], t: &Triangle) -> bool {
    if (of_p > 0.0 && of_q > 0.0) || (of_p < 0.0 && of_q < 0.0) {
        return false;
    }
    if of_p == 0.0 && of_q == 0.0 {
        return coplanar_segment_meets([p, q], t);
    }
    let turns = [0, 1, 2].map(|i| side(&[p, q, t[i]], t[(i + 1) % 3]));
    !(turns.iter().any(|&s| s > 0.0) && turns.iter().any(|&s| s < 0.0))
}

/// Two convex sets of a plane are disjoint if and only if a line along an edge of one of them has
/// them strictly on its two sides.
fn coplanar_segment_meets([p, q]: [DVec3; 2], t: &Triangle) -> bool {
    let Some(axes) = projection(t) else { return false };
    let winding = turn(axes, t[0], t[1], t[2]);
    for i in 0..3 {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        if turn(axes, a, b, p) * winding.signum() < 0.0
            && turn(axes, a, b, q) * winding.signum() < 0.0
        {
            return false;
        }
    }
    !same_strict_side([0, 1, 2].map(|i| turn(axes, p, q, t[i])))
}

/// A face with the numbers of its corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    pub ids: [u32; 3],
    pub at: Triangle,
}

/// Whether two faces with area share no points but common corners and edges.
pub(crate) fn are_apart(s: &Face, t: &Face) -> bool {
    let shared = |ids: &[u32; 3], other: &[u32; 3]| ids.map(|id| other.contains(&id));
    let shared = [shared(&s.ids, &t.ids), shared(&t.ids, &s.ids)];
    shared[0] != [true; 3] && (is_simply_apart(s, t, shared) || is_apart(s, t, shared))
}

/// Whether two faces are apart for a reason that takes no exact sides: neighbours on a fine surface
/// nearly lie in a plane, where these take long. `shared` tells which corners the other face has.
fn is_simply_apart(s: &Face, t: &Face, [in_t, in_s]: [[bool; 3]; 2]) -> bool {
    // One reaches the plane of the other in common corners alone.
    let is_off_plane = |of: &Face, shared: [bool; 3], t: &Triangle| {
        let own = || (0..3).filter(|&i| !shared[i]).map(|i| rounded_side(t, of.at[i]));
        own().all(|s| s.is_some_and(|s| s > 0.0)) || own().all(|s| s.is_some_and(|s| s < 0.0))
    };
    is_off_plane(s, in_t, &t.at) || is_off_plane(t, in_s, &s.at) || are_beside(s, t)
}

/// [`are_apart`] of faces that share two corners at most, by sides.
fn is_apart(s: &Face, t: &Face, [in_t, in_s]: [[bool; 3]; 2]) -> bool {
    match in_t.iter().filter(|&&is| is).count() {
        0 => !meet(&s.at, &t.at),
        1 => {
            // The intersection is convex and holds the shared corner. If it holds more, it reaches
            // an edge opposite to that corner.
            let opposite = |face: &Face, shared: [bool; 3]| {
                let at = shared.iter().position(|&is| is).unwrap_or_default();
                [face.at[(at + 1) % 3], face.at[(at + 2) % 3]]
            };
            let (edge_s, edge_t) = (opposite(s, in_t), opposite(t, in_s));
            !segment_meets(edge_s, edge_s.map(|p| side(&t.at, p)), &t.at)
                && !segment_meets(edge_t, edge_t.map(|p| side(&s.at, p)), &s.at)
        }
        _ => {
            let odd = |shared: [bool; 3]| shared.iter().position(|&is| !is).unwrap_or_default();
            let (of_s, of_t) = (odd(in_t), odd(in_s));
            let apex = t.at[of_t];
            if side(&s.at, apex) != 0.0 {
                return true;
            }
            let Some(axes) = projection(&s.at) else { return false };
            let (u, v) = (s.at[(of_s + 1) % 3], s.at[(of_s + 2) % 3]);
            let (here, there) = (turn(axes, u, v, s.at[of_s]), turn(axes, u, v, apex));
            (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)
        }
    }
}

/// Whether a line along an edge of one of two faces, seen along the axis that is nearest to the
/// first one's normal, tells them apart. Then they share nothing but the common corners on that
/// edge. Exact if true.
fn are_beside(s: &Face, t: &Face) -> bool {
    let [a, b, c] = s.at;
    let normal = (b - a).cross(c - a).abs();
    let axes = if normal.z >= normal.x.max(normal.y) {
        [0, 1]
    } else if normal.x >= normal.y {
        [1, 2]
    } else {
        [2, 0]
    };
    lies_off_an_edge(axes, t, s) || lies_off_an_edge(axes, s, t)
}

/// Whether `t`, seen along an axis, lies beyond an edge of `s`, but for corners that are ends of
/// that edge. With its third corner on the other side, `s` reaches the line in the edge alone.
fn lies_off_an_edge(axes: [usize; 2], t: &Face, s: &Face) -> bool {
    let winding = turn(axes, s.at[0], s.at[1], s.at[2]);
    let is_off = |i: usize| {
        let j = (i + 1) % 3;
        t.ids.iter().zip(t.at).all(|(id, p)| {
            if *id == s.ids[i] || *id == s.ids[j] {
                return true;
            }
            let turned = turn(axes, s.at[i], s.at[j], p);
            (winding > 0.0 && turned < 0.0) || (winding < 0.0 && turned > 0.0)
        })
    };
    (0..3).any(is_off)
}

/// Whether an edit that replaces the face `base` by faces at `apex` cuts `p` off the hull: `apex`
/// is not in front of the base, and `p` lies in their closed tetrahedron. A flat tetrahedron counts
/// as well.
pub(crate) fn is_cut_off(base: &Triangle, apex: DVec3, p: DVec3) -> bool {
    if side(base, apex) > 0.0 || side(base, p) > 0.0 {
        return false;
    }
    let [a, b, c] = *base;
    // Below the base, the tetrahedron's faces at the apex wind the other way round.
    [[a, b], [b, c], [c, a]].into_iter().all(|[u, v]| side(&[u, v, apex], p) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;

    fn triangle(points: [[f64; 3]; 3]) -> Triangle {
        points.map(DVec3::from)
    }

    const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn triangles_that_touch_meet_and_those_a_bit_apart_do_not() {
        let flat = triangle(FLAT);
        let tip = |z: f64| triangle([[1.0, 1.0, z], [1.0, 1.0, 3.0], [2.0, 1.0, 3.0]]);
        assert!(meet(&flat, &tip(0.0)) && meet(&tip(0.0), &flat) && meet(&flat, &tip(-1.0)));
        let least = f64::from(f32::from_bits(1));
        assert!(!meet(&flat, &tip(least)) && !meet(&tip(least), &flat));
        let inside = triangle([[1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 0.0]]);
        assert!(meet(&flat, &inside) && meet(&inside, &flat));
        let beside = triangle([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]]);
        assert!(!meet(&flat, &beside) && !meet(&beside, &flat));
        let corner = triangle([[4.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, -1.0, 0.0]]);
        assert!(meet(&flat, &corner) && meet(&corner, &flat));
    }

    #[test]
    fn a_triangle_without_area_meets_as_the_segment_or_point_that_it_is() {
        let flat = triangle(FLAT);
        let needle = |z: f64| triangle([[1.0, 1.0, z], [1.0, 1.0, 2.0], [1.0, 1.0, 3.0]]);
        assert!(meet(&flat, &needle(-1.0)) && meet(&needle(-1.0), &flat));
        assert!(!meet(&flat, &needle(1.0)) && !meet(&needle(1.0), &flat));
        let point = triangle([[1.0, 1.0, 0.0]; 3]);
        assert!(meet(&flat, &point) && !meet(&flat, &triangle([[3.0, 3.0, 0.0]; 3])));
    }

    #[test]
    fn faces_that_share_corners_may_share_no_more() {
        let face = |ids, at| Face { ids, at: triangle(at) };
        let flat = face([0, 1, 2], FLAT);
        let [a, b, c] = FLAT;
        assert!(are_apart(&flat, &face([1, 0, 3], [b, a, [1.0, 1.0, 1.0]])));
        assert!(are_apart(&flat, &face([1, 0, 3], [b, a, [1.0, -1.0, 0.0]])));
        assert!(!are_apart(&flat, &face([1, 0, 3], [b, a, [1.0, 1.0, 0.0]])), "folded over");
        assert!(are_apart(&flat, &face([0, 3, 4], [a, [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]])));
        assert!(!are_apart(&flat, &face([0, 3, 4], [a, [1.0, 1.0, 1.0], [2.0, 1.0, -1.0]])));
        assert!(!are_apart(&flat, &face([2, 1, 0], [c, b, a])));
        assert!(
            !are_apart(&flat, &face([3, 4, 5], [a, [0.0, 0.0, 1.0], [0.0, -1.0, 1.0]])),
            "same place, other number"
        );
    }

    #[test]
    fn faces_that_are_simply_apart_are_apart_by_sides() {
        let mut random = SplitMix::new(11);
        let mut counts = [[0; 2]; 3];
        while counts.as_flattened().iter().any(|&n| n < 500) {
            // Corners of a lattice, so that many faces touch and lie in a plane.
            let places = [0; 6].map(|_| [0; 3].map(|_| (random.roll() * 4.0).floor()));
            let mut face = |of: usize| {
                let ids = [0; 3].map(|_| (random.roll() * of as f64) as u32);
                Face { ids, at: triangle(ids.map(|id| places[id as usize])) }
            };
            let (s, t) = (face(6), face(5));
            if is_degenerate(&s.at) || is_degenerate(&t.at) {
                continue;
            }
            let shared = [s.ids.map(|id| t.ids.contains(&id)), t.ids.map(|id| s.ids.contains(&id))];
            let count = shared[0].iter().filter(|&&is| is).count();
            if count < 3 {
                let (simply, apart) = (is_simply_apart(&s, &t, shared), is_apart(&s, &t, shared));
                assert!(apart || !simply, "{s:?} {t:?}");
                counts[count][usize::from(simply)] += 1;
            }
        }
    }

    #[test]
    fn points_of_a_sunken_tetrahedron_are_found_up_to_its_sides() {
        let flat = triangle(FLAT);
        let apex = DVec3::new(1.0, 1.0, -2.0);
        assert!(is_cut_off(&flat, apex, DVec3::new(1.0, 1.0, -1.0)));
        assert!(
            is_cut_off(&flat, apex, apex) && is_cut_off(&flat, apex, DVec3::new(0.0, 0.0, 0.0))
        );
        assert!(!is_cut_off(&flat, apex, DVec3::new(1.0, 1.0, 0.5)));
        assert!(!is_cut_off(&flat, apex, DVec3::new(1.0, 1.0, -2.5)));
        assert!(!is_cut_off(&flat, -apex, DVec3::new(1.0, 1.0, 1.0)), "a raised one");
    }
}
