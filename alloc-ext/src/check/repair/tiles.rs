//! Whether triangles tile a triangle, in exact arithmetic.

use super::cover::is_between;
use super::place::{Place, place};
use std::collections::HashMap;

/// Whether `parts` tile the triangle `whole`, each wound as `whole` is.
///
/// The boundary of their sum is that of the whole: inner edges cancel, and every edge that is left
/// lies on an edge of the whole and runs along it. A sum in a plane whose boundary lies on that of
/// a triangle is a multiple of the triangle. It is the triangle itself if one edge more leaves the
/// first corner along the first edge than enters it.
pub(super) fn tile(whole: [[f32; 3]; 3], parts: &[[[f32; 3]; 3]]) -> bool {
    let sides = [[0, 1], [1, 2], [2, 0]].map(|[i, j]: [usize; 2]| [whole[i], whole[j]]);
    let is_on_boundary = |p: [f32; 3]| sides.iter().any(|&[a, b]| is_between(p, a, b));
    if !parts.iter().flatten().all(|&p| is_on_boundary(p)) {
        return false;
    }
    // Net uses of each edge, from the lesser place to the greater one.
    let mut uses: HashMap<[Place; 2], (i32, [[f32; 3]; 2])> = HashMap::new();
    for &[a, b, c] in parts {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let (ends, way) =
                if place(from) < place(to) { ([from, to], 1) } else { ([to, from], -1) };
            uses.entry(ends.map(place)).or_insert((0, ends)).0 += way;
        }
    }
    let mut leaving = 0;
    for &(way, [low, high]) in uses.values().filter(|(way, _)| *way != 0) {
        let [from, to] = if way > 0 { [low, high] } else { [high, low] };
        // Along the side: the start is no farther from the side's start than the end is.
        let along = sides.iter().position(|&[a, b]| {
            is_between(from, a, to) && is_between(to, from, b) && is_between(from, a, b)
        });
        match along {
            None => return false,
            Some(0) if place(from) == place(whole[0]) => leaving += way.abs(),
            Some(_) => {}
        }
    }
    leaving == 1
}
