//! Cascading upper bounds, cheap ones first.
//!
//! Sacht and Jacobson, *Cascading upper bounds for triangle soup Pompeiu-Hausdorff distance*
//! (2024), in the order that they found best. A bound ends the cascade when it rejects the
//! triangle. A triangle that no bound rejects is cut at the middles of its edges.

use glam::DVec3;

use super::samples::{Sample, Sampler};
use super::search::Method;

/// Sacht's and Jacobson's method.
pub struct Cascade;

impl Method for Cascade {
    fn visit(
        &self,
        points: &[DVec3],
        _: &[[u32; 3]],
        sampler: &mut Sampler<'_>,
    ) -> Result<Vec<Sample>, String> {
        points.iter().map(|&point| sampler.sample(point)).collect()
    }

    fn bound(&self, sampler: &Sampler<'_>, samples: [&Sample; 3], enough: f64) -> f64 {
        let farthest = samples.iter().map(|sample| sample.upper).fold(0.0, f64::max);
        let [a, b, c] = samples.map(|sample| sample.triangle);
        if a == b && b == c {
            return farthest;
        }
        let corners = samples.map(|sample| sample.point);
        let edges = opposite_edges(corners);
        let mut best = from_one_corner(samples, edges);
        let case = Case { sampler, samples, corners, edges, farthest };
        for bound in [from_all_corners, from_their_triangles, from_two_feet] {
            if best < enough {
                break;
            }
            best = best.min(bound(&case));
        }
        best
    }

    /// Four quarters.
    fn cut(&self, [a, b, c]: [DVec3; 3]) -> (Vec<DVec3>, Vec<[usize; 3]>) {
        let middles = vec![(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
        (middles, vec![[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])
    }
}

/// A triangle as the bounds take it.
struct Case<'a> {
    sampler: &'a Sampler<'a>,
    samples: [&'a Sample; 3],
    corners: [DVec3; 3],
    edges: [f64; 3],
    farthest: f64,
}

/// Lengths of the edges opposite to the corners.
fn opposite_edges([a, b, c]: [DVec3; 3]) -> [f64; 3] {
    [(c - b).length(), (a - c).length(), (b - a).length()]
}

/// The first bound: a corner's distance and its longer edge, of the best corner.
fn from_one_corner(samples: [&Sample; 3], edges: [f64; 3]) -> f64 {
    let from = |k: usize| samples[k].upper + edges[(k + 1) % 3].max(edges[(k + 2) % 3]);
    (0..3).map(from).fold(f64::INFINITY, f64::min)
}

/// The second: every point is within the circumradius of some corner, or half of the longest edge
/// if the triangle is not acute.
fn from_all_corners(case: &Case<'_>) -> f64 {
    let [a, b, c] = case.edges;
    let longest = a.max(b).max(c);
    let squares = a * a + b * b + c * c;
    let radius = if squares > 2.0 * longest * longest {
        let [p, q, r] = case.corners;
        a * b * c / (2.0 * (q - p).cross(r - p).length())
    } else {
        longest / 2.0
    };
    // A sliver's circumradius is rounding.
    case.farthest + if radius.is_finite() { radius } else { longest }
}

/// The third, of Kang, Kyung, Yoon and Kim (2018): parts of the triangle against the triangles next
/// to their corners. The distance from a triangle is convex, so corners of parts suffice.
fn from_their_triangles(case: &Case<'_>) -> f64 {
    let Case { sampler, samples, corners, farthest, .. } = case;
    let near = samples.map(|sample| sample.triangle);
    // The corner whose triangle is another one than the two others'.
    let odd = (0..3).find(|&k| near[(k + 1) % 3] == near[(k + 2) % 3]);
    if let Some(odd) = odd
        && are_adjacent(sampler.vertices(near[odd]), sampler.vertices(near[(odd + 1) % 3]))
    {
        let (own, other) = (near[odd], near[(odd + 1) % 3]);
        let planes = [own, other].map(|triangle| plane(sampler.corners(triangle)));
        let bounds = [1, 2].map(|k| {
            let p = crossing(corners[odd], corners[(odd + k) % 3], planes);
            sampler.distance(p, own).max(sampler.distance(p, other))
        });
        return farthest.max(bounds[0]).max(bounds[1]);
    }
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let (mut by_parts, mut by_one) = (*farthest, f64::INFINITY);
    for (k, &triangle) in near.iter().enumerate() {
        let [p, q, r] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
        for point in [middle, (p + q) * 0.5, (p + r) * 0.5] {
            by_parts = by_parts.max(sampler.distance(point, triangle));
        }
        let others = sampler.distance(q, triangle).max(sampler.distance(r, triangle));
        by_one = by_one.min(samples[k].upper.max(others));
    }
    by_parts.min(by_one)
}

fn are_adjacent(a: [u32; 3], b: [u32; 3]) -> bool {
    a.iter().filter(|vertex| b.contains(vertex)).count() == 2
}

/// Normal and offset.
fn plane([a, b, c]: [DVec3; 3]) -> (DVec3, f64) {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    (normal, normal.dot(a))
}

/// Where an edge crosses a bisector of two planes; its middle if it crosses none. Any point of the
/// edge gives a bound.
fn crossing(p: DVec3, q: DVec3, planes: [(DVec3, f64); 2]) -> DVec3 {
    let [[a, b], [c, d]] = planes.map(|(normal, at)| [p, q].map(|p| normal.dot(p) - at));
    let zero = |from: f64, to: f64| from / (from - to);
    let parameter = [zero(a - c, b - d), zero(a + c, b + d)]
        .into_iter()
        .find(|parameter| (0.0..=1.0).contains(parameter));
    p + (q - p) * parameter.unwrap_or(0.5)
}

/// The fourth: bisector planes of the foot of the corner opposite to the shortest edge, and of
/// each of the other two.
fn from_two_feet(case: &Case<'_>) -> f64 {
    let Case { samples, corners, edges, .. } = case;
    let apex = (0..3).min_by(|&i, &k| edges[i].total_cmp(&edges[k])).unwrap_or(0);
    let with = |other: usize| {
        let feet = [samples[apex].foot, samples[other].foot];
        let across = feet[1] - feet[0];
        let heights = corners.map(|p| across.dot(p - (feet[0] + feet[1]) * 0.5));
        let mut most = corners
            .iter()
            .map(|&p| {
                feet.map(|foot| (p - foot).length()).into_iter().fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max);
        for (i, k) in [(0, 1), (1, 2), (2, 0)] {
            if (heights[i] > 0.0) != (heights[k] > 0.0) {
                let parameter = (heights[i] / (heights[i] - heights[k])).clamp(0.0, 1.0);
                let p = corners[i] + (corners[k] - corners[i]) * parameter;
                most = most.max((p - feet[0]).length()).max((p - feet[1]).length());
            }
        }
        most
    };
    with((apex + 1) % 3).min(with((apex + 2) % 3))
}
