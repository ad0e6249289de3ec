//! Segment–triangle intersection in f64 that never misses: a case that rounding leaves undecided
//! counts as a hit.
//!
//! Signs of the three triple products `d · (B × C)`, `d · (C × A)`, `d · (A × B)` with the corners
//! taken from the segment's start (Segura & Feito 1998). `x × y = −(y × x)` holds bit for bit. So
//! two triangles with a common edge agree on its side. The closed test with a proved margin leaves
//! no gap along edges and at vertices. Derivation: `core/docs/rounding.md` §5.

use super::point_triangle::point_triangle;
use super::real_vector::RealVector;
use super::vector::norm_1;
use crate::num::tolerance::{COPLANAR_TOUCH, SIGN_TRIPLE_PRODUCT, TRIPLE_PRODUCT, U32, U64};
use crate::num::{Real, SOFT_DOUBLE, each, greater, lesser};
use glam::DVec3;

/// A common point of a segment and a triangle. Parameters run from 0 at the segment's start to 1 at
/// its end.
#[derive(Clone, Copy, Debug)]
pub struct SegmentTriangle {
    /// Best estimate of the first parameter at which they meet.
    pub t: f64,
    /// The real first parameter is not below this.
    pub t_lower: f64,
    /// The real first parameter is not above this (both hold if they meet at all).
    pub t_upper: f64,
    /// It is proved that they meet.
    pub is_certain: bool,
}

/// First common point of the closed segment `a b` and the closed triangle `v0 v1 v2`.
///
/// `None` proves that they do not meet. `Some` may be a miss by less than some 1e-15 of the lengths
/// involved (on a needle, times its aspect ratio): a caller must never hear "clear" by mistake.
/// Both facings hit. A segment in the triangle's plane hits at their first common point. A segment
/// of no length hits if its point lies on the triangle. Only a segment that goes through the inside
/// of the triangle is [certain](SegmentTriangle::is_certain) to hit.
pub fn segment_triangle(a: DVec3, b: DVec3, corners: [DVec3; 3]) -> Option<SegmentTriangle> {
    way_triangle([a, b], b - a, corners)
}

/// The same with the way `d` from end to end. Of a ray `d` is exact, and `b` is rounded.
pub fn way_triangle(
    [a, b]: [DVec3; 2],
    d: DVec3,
    [v0, v1, v2]: [DVec3; 3],
) -> Option<SegmentTriangle> {
    let p = v0 - a;
    let (np, nd) = (norm_1(p), norm_1(d));
    let is_through = match if SOFT_DOUBLE { passage_in_f32(a, d, [v0, v1, v2]) } else { None } {
        Some(passage) => passage,
        None => passage(a, d, [v0, v1, v2]),
    };
    let is_through = match is_through {
        Passage::Beside => return None,
        passage => passage == Passage::Through,
    };
    let unit = TRIPLE_PRODUCT * U64;
    // The difference of the corners: `q − p` would carry the rounding of a far start.
    let (e1, e2) = (v1 - v0, v2 - v0);
    let normal = e1.cross(e2);
    let across = d.dot(normal);
    let across_error = unit * nd * norm_1(e1) * norm_1(e2);
    if across.abs() <= across_error {
        return in_plane([a, b], d, [v0, v1, v2]);
    }
    let height = p.dot(normal);
    let height_error = unit * np * norm_1(e1) * norm_1(e2);
    let t = height / across;
    // |δt| ≤ (δheight + |t| δacross) / (|across| − δacross), and the rounding of the corners.
    let error = (height_error + t.abs() * across_error) / (across.abs() - across_error)
        + 8.0 * U64 * t.abs();
    if t + error < 0.0 || t - error > 1.0 {
        return None;
    }
    Some(SegmentTriangle {
        t: t.clamp(0.0, 1.0),
        t_lower: (t - error).max(0.0),
        t_upper: (t + error).min(1.0),
        is_certain: is_through && t - error >= 0.0 && t + error <= 1.0,
    })
}

/// Lengths for [`passage_in_f32`] are up to this, and not below its inverse.
const PASSAGE_RANGE: f32 = (1 << 30) as f32;

/// How the line of a segment passes a triangle.
#[derive(Clone, Copy, PartialEq)]
enum Passage {
    /// Certainly through the inside, unless both lie in one plane.
    Through,
    /// Perhaps through an edge or a corner.
    Edge,
    /// Certainly beside it.
    Beside,
}

/// By three triple products and their errors.
fn passage(a: DVec3, d: DVec3, [v0, v1, v2]: [DVec3; 3]) -> Passage {
    let (p, q, r) = (v0 - a, v1 - a, v2 - a);
    let (np, nq, nr, nd) = (norm_1(p), norm_1(q), norm_1(r), norm_1(d));
    let unit = TRIPLE_PRODUCT * U64;
    let u = d.dot(q.cross(r));
    let v = d.dot(r.cross(p));
    let w = d.dot(p.cross(q));
    let (eu, ev, ew) = (unit * nd * nq * nr, unit * nd * nr * np, unit * nd * np * nq);
    let positive = u >= -eu && v >= -ev && w >= -ew;
    let negative = u <= eu && v <= ev && w <= ew;
    if !positive && !negative {
        Passage::Beside
    } else if (u > eu && v > ev && w > ew) || (u < -eu && v < -ev && w < -ew) {
        Passage::Through
    } else {
        Passage::Edge
    }
}

/// The same where f32 suffices, which boards compute in a tenth of the time.
#[inline(never)]
fn passage_in_f32(a: DVec3, d: DVec3, corners: [DVec3; 3]) -> Option<Passage> {
    let (a, d) = (RealVector::from(a.as_vec3()), RealVector::from(d.as_vec3()));
    let (na, nd) = (a.norm_1(), d.norm_1());
    let [(p, np), (q, nq), (r, nr)] = each(corners, |corner| seen_in_f32(a, na, corner));
    let (least, most) =
        (lesser(lesser(nd, np), lesser(nq, nr)), greater(greater(nd, np), greater(nq, nr)));
    // No triple product leaves the range of normal numbers by as much as its margin.
    if least < Real(1.0 / PASSAGE_RANGE) || most > Real(PASSAGE_RANGE) {
        return None;
    }
    let unit = nd * Real(SIGN_TRIPLE_PRODUCT * U32);
    let u = side(d, q, r, unit * (nq * nr));
    let v = side(d, r, p, unit * (nr * np));
    let w = side(d, p, q, unit * (np * nq));
    match (lesser(lesser(u, v), w), greater(greater(u, v), w)) {
        (1, _) | (_, -1) => Some(Passage::Through),
        (-1, 1) => Some(Passage::Beside),
        _ => None,
    }
}

/// The way from a start to a corner, and its 1-norm and the start's.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn seen_in_f32(a: RealVector, na: Real, corner: DVec3) -> (RealVector, Real) {
    let seen = RealVector::from(corner.as_vec3()) - a;
    (seen, seen.norm_1() + na)
}

/// The sign of a triple product; 0 if it does not exceed the error.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn side(d: RealVector, x: RealVector, y: RealVector, error: Real) -> i32 {
    let product = d.dot(x.cross(y));
    i32::from(product > error) - i32::from(product < -error)
}

/// The segment lies in the plane of the triangle up to rounding, or one of them is degenerate.
fn in_plane([a, b]: [DVec3; 2], d: DVec3, corners: [DVec3; 3]) -> Option<SegmentTriangle> {
    let [p, q, r] = corners.map(|v| v - a);
    let lengths = norm_1(p) + norm_1(q) + norm_1(r) + norm_1(d);
    let touch = COPLANAR_TOUCH * U64 * lengths;
    if gap(a, b, corners) > touch {
        return None;
    }
    let [v0, v1, v2] = corners;
    if point_triangle(a, v0, v1, v2).lower <= touch {
        return Some(SegmentTriangle { t: 0.0, t_lower: 0.0, t_upper: 0.0, is_certain: false });
    }
    // The start is outside, so the first common point lies on an edge. The crossing of nearly
    // parallel lines is ill-conditioned. The shadow of the triangle on the segment is not.
    let dd = d.dot(d);
    let nearest = d.dot(p).min(d.dot(q)).min(d.dot(r));
    let shadow = if dd > 0.0 { (nearest - touch * libm::sqrt(dd)) / dd - 16.0 * U64 } else { 0.0 };
    let t_lower = shadow.clamp(0.0, 1.0);
    let crossings = [(v0, v1), (v1, v2), (v2, v0)];
    let first = crossings
        .into_iter()
        .filter_map(|(from, to)| edge_crossing(a, d, from, to, touch))
        .fold(f64::INFINITY, f64::min);
    let t = if first <= 1.0 { first } else { t_lower };
    Some(SegmentTriangle { t, t_lower: t_lower.min(t), t_upper: 1.0, is_certain: false })
}

/// A lower bound of the distance between a segment and a triangle, by separating axes. It is tight
/// up to rounding.
///
/// The closest points of the two are an end and the triangle, two points inside the segment and an
/// edge, or a point inside the segment and a corner. So one of the axes below points from one to
/// the other. Any axis gives a true bound.
fn gap(a: DVec3, b: DVec3, corners: [DVec3; 3]) -> f64 {
    let d = b - a;
    let [v0, v1, v2] = corners;
    let [p, q, r] = corners.map(|v| v - a);
    let margin = TRIPLE_PRODUCT * U64 * (norm_1(p) + norm_1(q) + norm_1(r) + norm_1(d));
    let along = |g: DVec3| {
        let gg = g.dot(g);
        if gg <= 0.0 {
            return 0.0;
        }
        let (low, high) =
            (g.dot(p).min(g.dot(q)).min(g.dot(r)), g.dot(p).max(g.dot(q)).max(g.dot(r)));
        let (near, far) = (g.dot(d).min(0.0), g.dot(d).max(0.0));
        (low - far).max(near - high) / libm::sqrt(gg) - margin
    };
    let towards = |end: DVec3| {
        let hit = point_triangle(end, v0, v1, v2);
        end - v0 - (v1 - v0) * hit.u - (v2 - v0) * hit.v
    };
    let dd = d.dot(d);
    let across = |e: DVec3| if dd > 0.0 { e - d * (e.dot(d) / dd) } else { e };
    let (e0, e1, e2) = (v1 - v0, v2 - v1, v0 - v2);
    let normal = e0.cross(v2 - v0);
    [
        towards(a),
        towards(b),
        d.cross(e0),
        d.cross(e1),
        d.cross(e2),
        across(p),
        across(q),
        across(r),
        normal,
        normal.cross(d),
        normal.cross(e0),
        normal.cross(e1),
        normal.cross(e2),
    ]
    .into_iter()
    .map(along)
    .fold(0.0, f64::max)
}

/// Whether the segment may come within `distance` of the triangle. `false` proves that it does not.
pub fn comes_within(a: DVec3, b: DVec3, corners: [DVec3; 3], distance: f64) -> bool {
    gap(a, b, corners) <= distance
}

/// Parameter on `a + t·d` at which the segment comes within `touch` of the edge, if it does.
fn edge_crossing(a: DVec3, d: DVec3, from: DVec3, to: DVec3, touch: f64) -> Option<f64> {
    // Closest points of two segments (Ericson 5.1.9), both ends clamped, the better of two orders.
    let e = to - from;
    let s = a - from;
    let (dd, ee, de) = (d.dot(d), e.dot(e), d.dot(e));
    let (ds, es) = (d.dot(s), e.dot(s));
    let clamp = |x: f64| x.clamp(0.0, 1.0);
    let divide = |x: f64, by: f64| if by > 0.0 { clamp(x / by) } else { 0.0 };
    let distance = |t: f64, k: f64| {
        let gap = s + d * t - e * k;
        libm::sqrt(gap.dot(gap))
    };
    let mut first: Option<f64> = None;
    let mut consider = |t: f64, k: f64| {
        if distance(t, k) <= touch {
            first = Some(first.map_or(t, |best| best.min(t)));
        }
    };
    let denominator = dd * ee - de * de;
    let t = divide(de * es - ds * ee, denominator);
    let k = divide(de * t + es, ee);
    consider(divide(de * k - ds, dd), k);
    // Parallel overlaps and touching ends.
    consider(divide(-ds, dd), 0.0);
    consider(divide(de - ds, dd), 1.0);
    consider(0.0, divide(es, ee));
    consider(1.0, divide(de + es, ee));
    first
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::noise::Noise;
    use glam::Vec3;

    const T: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn hit(a: [f64; 3], b: [f64; 3]) -> Option<f64> {
        segment_triangle(DVec3::from(a), DVec3::from(b), T).map(|h| {
            assert!(h.t_lower <= h.t && h.t <= h.t_upper, "{h:?}");
            h.t
        })
    }

    #[test]
    fn what_f32_tells_of_a_passage_f64_tells_too() {
        let mut noise = Noise(3);
        let mut random = || noise.unit();
        let (mut told, mut counts) = (0, [0; 2]);
        for round in 0..300_000 {
            let size = [1.0, 30.0, 1e-3, 1e6][round % 4];
            let mut vector = |size: f32| Vec3::new(random(), random(), random()) * size;
            let near = vector(size);
            let corners = [near + vector(1.0), near + vector(1.0), near + vector(1e-3)];
            let a = vector(size);
            // Through the inside, an edge, a corner, or next to them.
            let (share, off) = ([0.3, 0.0, 1.0][round / 4 % 3], [0.0, 1e-6, 1.0][round / 12 % 3]);
            let aim = corners[0] * share + corners[1] * (1.0 - share) + vector(off);
            let (a, aim) = (a.as_dvec3(), aim.as_dvec3());
            let (d, corners) = ((aim - a) * 1.5, corners.map(|v| v.as_dvec3()));
            let exact = passage(a, d, corners);
            if let Some(passage) = passage_in_f32(a, d, corners) {
                assert!(passage == exact, "{a} {d} {corners:?}");
                told += 1;
                counts[usize::from(passage == Passage::Through)] += 1;
            }
        }
        assert!(told > 60_000 && counts.iter().all(|&count| count > 1000), "{told} {counts:?}");
    }

    #[test]
    fn interior_edge_and_vertex_hit_from_both_sides() {
        for z in [1.0, -1.0] {
            for (x, y) in [(0.25, 0.25), (0.5, 0.0), (0.5, 0.5), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]
            {
                assert_eq!(hit([x, y, z], [x, y, -z]), Some(0.5), "{x} {y} {z}");
            }
        }
        assert_eq!(hit([0.25, 0.25, 0.0], [0.25, 0.25, 1.0]), Some(0.0));
    }

    #[test]
    fn clear_misses_are_misses() {
        assert_eq!(hit([0.6, 0.6, 1.0], [0.6, 0.6, -1.0]), None);
        assert_eq!(hit([0.2, 0.2, 1.0], [0.2, 0.2, 0.1]), None);
        assert_eq!(hit([-0.1, 0.2, 0.0], [-0.1, 0.9, 0.0]), None);
    }

    #[test]
    fn segments_in_the_plane_hit_where_they_enter() {
        let t = hit([-1.0, 0.25, 0.0], [1.0, 0.25, 0.0]).expect("crosses in the plane");
        assert!((t - 0.5).abs() < 1e-12, "{t}");
        assert_eq!(hit([0.2, 0.2, 0.0], [0.3, 0.3, 0.0]), Some(0.0));
        let along_an_edge = hit([-1.0, 0.0, 0.0], [2.0, 0.0, 0.0]).expect("along an edge");
        assert!((along_an_edge - 1.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_segment_that_ends_inside_a_needle_in_its_plane_is_not_missed() {
        // Exact integers: the end is strictly inside, the segment nearly along the needle.
        let at = |x: i32, y: i32| DVec3::new(f64::from(x), f64::from(y), 2_097_152.0) / 8_388_608.0;
        let needle = [at(4_304_180, 3_903_190), at(-2_053_968, -987_130), at(-2_067_330, -997_041)];
        assert!(segment_triangle(at(8_549_885, 7_170_973), at(60_960, 639_673), needle).is_some());
        assert!(!comes_within(at(8_549_885, 7_170_973), at(4_400_000, 4_000_000), needle, 1e-6));
    }

    #[test]
    fn zero_length_segments_and_flat_triangles_are_defined() {
        assert_eq!(hit([0.2, 0.2, 0.0], [0.2, 0.2, 0.0]), Some(0.0));
        assert_eq!(hit([0.2, 0.2, 0.1], [0.2, 0.2, 0.1]), None);
        let needle = [DVec3::ZERO, DVec3::X, DVec3::X * 0.5];
        assert!(
            segment_triangle(DVec3::new(0.5, 0.0, 1.0), DVec3::new(0.5, 0.0, -1.0), needle)
                .is_some()
        );
        assert!(
            segment_triangle(DVec3::new(0.5, 0.1, 1.0), DVec3::new(0.5, 0.1, -1.0), needle)
                .is_none()
        );
    }
}
