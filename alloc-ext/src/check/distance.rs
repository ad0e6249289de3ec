//! Distances in `f64`, and what they may be off.

use glam::DVec3;

/// A stored radius is a bound of real numbers; these distances are rounded.
pub(crate) const ROUNDING: f64 = 1.0 + 1e-12;

/// Least distance of a point and a triangle, up to some 1e-14 of the lengths: the foot on the plane
/// if it lies inside three half-planes, else the nearest edge.
pub(crate) fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_edge = |from: DVec3, to: DVec3| {
        let d = to - from;
        let t = if d == DVec3::ZERO {
            0.0
        } else {
            (d.dot(p - from) / d.length_squared()).clamp(0.0, 1.0)
        };
        (p - from - d * t).length()
    };
    let edges = to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a));
    let normal = (b - a).cross(c - a);
    let within = |from: DVec3, to: DVec3| (to - from).cross(normal).dot(p - from) <= 0.0;
    if normal != DVec3::ZERO && within(a, b) && within(b, c) && within(c, a) {
        return edges.min(normal.dot(p - a).abs() / normal.length());
    }
    edges
}

/// What a distance in the local frame may be off.
pub(crate) const ABSOLUTE: f64 = 1e-14;
