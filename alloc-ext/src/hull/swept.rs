//! The tightest of a few swept triangles around a set of vertices.

use super::forest::cover_radius;
use glam::DVec3;

/// Faces that are tried as they are.
const FACES_TRIED: usize = 8;

/// The triangle that covers `vertices` with the least radius, and that radius. Candidates are the
/// first faces, the corner nearest the middle, a long segment and the largest triangle on it.
/// All numbers are indices into `positions`.
pub fn best_cover(
    positions: &[DVec3],
    faces: &[[u32; 3]],
    corners: &[u32],
    vertices: &[u32],
) -> ([u32; 3], f64) {
    let at = |l: u32| positions[l as usize];
    let (low, high) = vertices
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), &v| (l.min(at(v)), h.max(at(v))));
    let middle = (low + high) * 0.5;
    // Ties go to the least index, so that a build is reproducible.
    let greatest = |key: &dyn Fn(u32) -> f64| {
        corners.iter().copied().max_by(|&a, &b| key(a).total_cmp(&key(b)).then(b.cmp(&a)))
    };
    let mut candidates: Vec<[u32; 3]> = Vec::new();
    candidates.extend(greatest(&|l| -at(l).distance_squared(middle)).map(|v| [v; 3]));
    if let Some(p) = greatest(&|l| at(l).distance_squared(middle))
        && let Some(q) = greatest(&|l| at(l).distance_squared(at(p)))
    {
        candidates.push([p, q, q]);
        let area = |l: u32| (at(q) - at(p)).cross(at(l) - at(p)).length_squared();
        candidates.extend(greatest(&area).map(|r| [p, q, r]));
    }
    candidates.extend(faces.iter().take(FACES_TRIED));
    candidates
        .into_iter()
        .map(|corners| (corners, cover_radius(positions, vertices, corners.map(at))))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or(([0; 3], f64::INFINITY))
}
