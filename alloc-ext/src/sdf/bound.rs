//! Bounds of the difference between a distance and a function in a box.
//!
//! The function is linear about the box's centre, but for a rest that is bounded. All bounds are of
//! the second order of the box's size, where the surface is smooth as seen from there.
//!
//! *Symbols.* d: distance from the surface; s: signed distance, negative inside. F: the cell's
//! function, g its gradient at the centre c. h: half extents of the box, r: half its diagonal. q: a
//! point of the surface, at first the nearest to c. n: unit vector from a triangle to c, D: how far
//! c is above the triangle along it.
//!
//! *Least.* d(x) is the least distance of a triangle, and each is at least linear
//! ([`super::region`]). So d − F is at least the least of D − Σ |n − g|ₖ hₖ.
//!
//! *Most.* d(x) ≤ |x − q| for each point *q* of the surface, also for a mean of such bounds. They
//! are convex: the eight corners are all to be looked at. A mean of two points on both sides of a
//! ridge of the distance is of second order there, where each alone is not. The distance of the
//! nearest triangle is such a bound too. Over a flat triangle it is the distance itself, whatever
//! the box's size: by points alone, boxes at a height t could only be as large as √(t · slack).
//!
//! *Flat.* Let all of the surface within R = d(c) + 2.3r of the centre lie between the planes
//! |n·(y − q)| ≤ δ ≤ r/4, and let all of its triangles there have winding number 0 in front, 1
//! behind, and face along *n*. Then |s(x) − n·(x − q)| ≤ δ in the box. For d(x) ≤ d(c) + r, so the
//! nearest point is in the ball, and between the planes. Above both planes there is no surface in
//! the ball, and what is above is connected; so is what is below. A line along *n* through a place
//! inside the nearest triangle meets the uppermost triangle from its front: above is outside,
//! below inside. The line along *n* through *x* leads from one to the other within the ball, for
//! it ends at most d(c) + 2r + δ from the centre. So it meets the surface between the planes.

use super::function::Linear;
use super::region::{Facets, MARGIN, Near, Region, corners};
use glam::DVec3;

/// Points of which a mean is made, besides the nearest.
const MEANS: usize = 2;

fn extent(of: DVec3, half: DVec3) -> f64 {
    of.abs().dot(half)
}

/// The most of F in the box.
pub(super) fn greatest(linear: &Linear, region: &Region) -> f64 {
    linear.value + linear.rest + extent(linear.gradient, region.half) + MARGIN
}

/// d − F is at least this in the box.
pub(super) fn least(linear: &Linear, region: &Region, nears: &[Near]) -> f64 {
    let least = nears
        .iter()
        .fold(f64::INFINITY, |least, near| least.min(near.least(linear.gradient, region.half)));
    least - linear.value - linear.rest - MARGIN
}

/// d − F is at most this in the box. Bounds better than `enough` are not looked for.
pub(super) fn most(linear: &Linear, region: &Region, nears: &[Near], enough: f64) -> f64 {
    let offset = linear.rest - linear.value + MARGIN;
    let corners = corners(region.half);
    let mut rises = [0.0; 8];
    for (rise, corner) in rises.iter_mut().zip(corners) {
        *rise = linear.gradient.dot(corner);
    }
    let worst = |ends: &[f64; 8]| {
        let mut worst = (f64::NEG_INFINITY, 0);
        for corner in 0..8 {
            let over = ends[corner] - rises[corner];
            if over > worst.0 {
                worst = (over, corner);
            }
        }
        worst
    };
    let mut ends = region.ends;
    let (mut over, mut corner) = worst(&ends);
    let mut best = over + offset;
    let away = region.centre - region.point;
    let mut normal = away / away.length().max(MARGIN);
    for _ in 0..MEANS {
        if best <= enough {
            break;
        }
        // At the worst corner, the triangle of the least lower bound.
        let at = |near: &Near| near.height + near.normal.dot(corners[corner]);
        let facets = nears.iter().filter(|near| near.facet().is_some());
        let Some(other) = facets.min_by(|a, b| at(a).total_cmp(&at(b))) else { break };
        let apart = normal - other.normal;
        let square = apart.length_squared();
        if square < 1e-12 {
            break;
        }
        // The mean of both normals that is nearest to the gradient.
        let part = ((linear.gradient - other.normal).dot(apart) / square).clamp(0.0, 1.0);
        for (end, corner) in ends.iter_mut().zip(corners) {
            let far = (region.centre + corner - other.point).length() + MARGIN;
            *end = part * *end + (1.0 - part) * far;
        }
        normal = part * normal + (1.0 - part) * other.normal;
        (over, corner) = worst(&ends);
        best = best.min(over + offset);
    }
    best
}

/// As [`most`], by the distance of the nearest triangle.
pub(super) fn most_of_facet(linear: &Linear, region: &Region, facets: &Facets) -> f64 {
    let facet = facets.facet(region.facet);
    let over = corners(region.half).into_iter().fold(f64::NEG_INFINITY, |over, corner| {
        let p = region.centre + corner;
        over.max((p - facet.closest(p)).length() - linear.gradient.dot(corner))
    });
    over + linear.rest - linear.value + 2.0 * MARGIN
}

/// Bounds of s − F in the box where the surface is nearly flat, and tells sides.
pub(super) fn flat(
    linear: &Linear,
    region: &Region,
    facets: &Facets,
    nears: &[Near],
) -> Option<[f64; 2]> {
    let ball = region.ball().filter(|_| region.is_open)?;
    // Groups in the ball are open.
    let within = || {
        let of = |near: &'_ &Near| near.height <= ball + MARGIN;
        let facet = |near: &Near| Some((*near, facets.facet(near.facet()?)));
        nears.iter().filter(of).filter_map(facet)
    };
    if !facets.facet(region.facet).tells_side {
        return None;
    }
    let sum: DVec3 = within().map(|(_, facet)| facet.normal).sum();
    let normal = sum.try_normalize()?;
    let mut off = MARGIN;
    for (near, facet) in within() {
        if !(facet.tells_side && facet.normal.dot(normal) > facet.doubt + MARGIN) {
            return None;
        }
        let length = (region.centre - near.point).length();
        let [low, high] = facet.heights(region.point, normal, near.point, ball + length + MARGIN);
        off = off.max(high + MARGIN).max(MARGIN - low);
        if off > 0.25 * region.radius {
            return None;
        }
    }
    let middle = normal.dot(region.centre - region.point) - linear.value;
    let room = extent(normal - linear.gradient, region.half) + off + linear.rest + MARGIN;
    Some([middle - room, middle + room])
}
