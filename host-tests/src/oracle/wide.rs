//! Distance of a mesh that moves, in f64.

use glam::DVec3;

/// Distance of `p` and a triangle, to some 1e-15 of the lengths: the foot on the plane if it lies
/// inside, else the nearest edge.
fn to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_edge = |from: DVec3, to: DVec3| {
        let (d, s) = (to - from, p - from);
        let t = if d == DVec3::ZERO { 0.0 } else { (d.dot(s) / d.dot(d)).clamp(0.0, 1.0) };
        (s - d * t).length()
    };
    let normal = (b - a).cross(c - a);
    let within = |from: DVec3, to: DVec3| (to - from).cross(normal).dot(p - from) <= 0.0;
    let edges = to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a));
    // The plane of a needle is not trusted.
    let longest = (b - a).length_squared().max((c - a).length_squared());
    if normal.length() > 1e-7 * longest && within(a, b) && within(b, c) && within(c, a) {
        return edges.min((normal.dot(p - a) / normal.length()).abs());
    }
    edges
}

/// Distance of a mesh whose vertices are f64, to some 1e-15 of its lengths.
#[must_use]
pub fn distance_to_wide_mesh(p: [f32; 3], positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let p = DVec3::from(p.map(f64::from));
    let corners = triangles.iter().map(|t| t.map(|v| positions[v as usize]));
    corners.map(|corners| to_triangle(p, corners)).fold(f64::INFINITY, f64::min)
}
