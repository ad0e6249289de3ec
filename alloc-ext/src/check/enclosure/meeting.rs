//! Whether triangles have points in common, in exact arithmetic.

use super::surface::Corners;
use crate::check::exact::side;

fn of_plane(t: &Corners, p: [f64; 3]) -> i8 {
    side(*t, p).0
}

/// Sign of the turn a → b → c, seen along the axis that is left out.
pub(super) fn turn([i, j]: [usize; 2], a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> i8 {
    let flat = |p: [f64; 3], z: f64| [p[i], p[j], z];
    side([flat(a, 0.0), flat(b, 0.0), flat(c, 0.0)], flat(a, 1.0)).0
}

pub(super) fn shadow(t: &Corners) -> Option<[usize; 2]> {
    [[0, 1], [0, 2], [1, 2]].into_iter().find(|&axes| turn(axes, t[0], t[1], t[2]) != 0)
}

/// Whether a triangle's corners are on a line.
pub(crate) fn area_free(t: &Corners) -> bool {
    shadow(t).is_none()
}

/// Whether the segment misses the triangle; a triangle without area counts as missed.
pub(super) fn misses(p: [f64; 3], q: [f64; 3], t: &Corners) -> bool {
    match (of_plane(t, p), of_plane(t, q)) {
        (0, 0) => {
            let Some(axes) = shadow(t) else { return true };
            let up = turn(axes, t[0], t[1], t[2]);
            let beyond = |i: usize| {
                let out = |x| turn(axes, t[i], t[(i + 1) % 3], x) == -up;
                out(p) && out(q)
            };
            let beside = [0, 1, 2].map(|i| turn(axes, p, q, t[i]));
            (0..3).any(beyond) || beside == [1; 3] || beside == [-1; 3]
        }
        (a, b) if a == b => true,
        _ => {
            let around = [0, 1, 2].map(|i| of_plane(&[p, q, t[i]], t[(i + 1) % 3]));
            around.contains(&1) && around.contains(&-1)
        }
    }
}

/// Whether two triangles, with area or not, have no point in common.
pub(super) fn apart(s: &Corners, t: &Corners) -> bool {
    let one_sided = |a: &Corners, b: &Corners| {
        let first = of_plane(a, b[0]);
        first != 0 && of_plane(a, b[1]) == first && of_plane(a, b[2]) == first
    };
    if one_sided(s, t) || one_sided(t, s) {
        return true;
    }
    (0..3).all(|i| misses(s[i], s[(i + 1) % 3], t) && misses(t[i], t[(i + 1) % 3], s))
}

/// Whether two faces with area have only the corners in common that have the same number.
pub(super) fn sharing_apart(s: &Corners, of_s: [u32; 3], t: &Corners, of_t: [u32; 3]) -> bool {
    let alone_s: Vec<usize> = (0..3).filter(|&i| !of_t.contains(&of_s[i])).collect();
    let alone_t: Vec<usize> = (0..3).filter(|&i| !of_s.contains(&of_t[i])).collect();
    match (alone_s[..].as_ref(), alone_t[..].as_ref()) {
        ([_, _, _], [_, _, _]) => apart(s, t),
        (&[a, b], &[c, d]) => misses(s[a], s[b], t) && misses(t[c], t[d], s),
        (&[a], &[c]) => {
            if of_plane(s, t[c]) != 0 {
                return true;
            }
            let Some(axes) = shadow(s) else { return false };
            let (u, v) = (s[(a + 1) % 3], s[(a + 2) % 3]);
            turn(axes, u, v, s[a]) == -turn(axes, u, v, t[c]) && turn(axes, u, v, t[c]) != 0
        }
        _ => false,
    }
}
