//! Crossings of a ray with triangles, by exact predicates.

use robust::{Coord, Coord3D, orient2d, orient3d};

/// How the ray from `p` along +z crosses a triangle: 1 from its back to its front, −1 from its
/// front to its back, 0 if it misses. The sum over a closed surface is the winding number of `p`.
///
/// The ray is moved by an infinitesimal step along +x (and one infinitely smaller along +y), so it
/// meets no edge and no vertex: each edge is judged by one exact predicate that both of its
/// triangles share. A triangle that holds `p` counts as missed.
pub(crate) fn ray_crossing(p: [f64; 3], triangle: &[[f64; 3]; 3]) -> i32 {
    // Comparisons alone rule out most triangles.
    let reaches = |axis: usize| triangle.iter().any(|corner| corner[axis] > p[axis]);
    if !reaches(2) || !reaches(0) {
        return 0;
    }
    let [a, b, c] = *triangle;
    let hits = [(a, b), (b, c), (c, a)].iter().filter(|(u, v)| passes_right_of(p, *u, *v)).count();
    if hits % 2 == 0 {
        return 0;
    }
    let flat = |v: [f64; 3]| Coord { x: v[0], y: v[1] };
    let solid = |v: [f64; 3]| Coord3D { x: v[0], y: v[1], z: v[2] };
    // `orient3d` is positive if p lies below a plane whose corners turn counter-clockwise as seen
    // from above.
    let above = orient3d(solid(a), solid(b), solid(c), solid(p));
    let turn = orient2d(flat(a), flat(b), flat(c));
    if above > 0.0 && turn > 0.0 {
        1
    } else if above < 0.0 && turn < 0.0 {
        -1
    } else {
        0
    }
}

/// In the xy plane: does edge uv cross the line through p parallel to x, to the right of p moved
/// infinitesimally right?
fn passes_right_of(p: [f64; 3], u: [f64; 3], v: [f64; 3]) -> bool {
    let (below, above) = match (u[1] > p[1], v[1] > p[1]) {
        (false, true) => (u, v),
        (true, false) => (v, u),
        _ => return false,
    };
    let flat = |v: [f64; 3]| Coord { x: v[0], y: v[1] };
    orient2d(flat(below), flat(above), flat(p)) > 0.0
}
