//! Triangles of zero area: removed by an edge flip where that keeps the mesh closed.
//!
//! A *cap* has its middle vertex b on the segment of its longest edge ac. If exactly one other
//! triangle (a, c, d) lies on ac, then flipping that edge gives (a, b, d) and (b, c, d): the same
//! point set, the same outer edges, no cap. Just dropping the cap would leave its two short edges
//! facing the long one, a slit.

use rayon::prelude::*;
use std::collections::VecDeque;

use super::collinear::{collinear, middle};
use super::duplicate::retain;
use super::report::{PLACES_KEPT, RepairReport};
use super::wire::{TakenOut, Wire};

/// Removes all triangles with collinear corners, by a flip if possible, else by taking them out.
/// Expects three distinct vertices at distinct positions in each triangle and no duplicates.
pub(super) fn remove_caps(
    positions: &[[f32; 3]],
    triangles: &mut Vec<[u32; 3]>,
    source: &mut Vec<u32>,
    taken_out: &mut Vec<TakenOut>,
    report: &mut RepairReport,
) {
    let flat = |t: [u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        collinear(a, b, c)
    };
    let caps: Vec<u32> = (0..triangles.len() as u32)
        .into_par_iter()
        .filter(|&t| flat(triangles[t as usize]))
        .collect();
    if caps.is_empty() {
        return;
    }
    let mut stars = Stars::new(positions.len(), triangles);
    let cap_count = caps.len();
    let mut waiting = VecDeque::from(caps);
    // A flip between two caps shortens their common edge, so such flips end by themselves; the
    // limit is for certainty.
    let mut cap_flips_left = 8 * cap_count;
    let mut postponed = 0;
    while postponed < waiting.len() {
        let Some(cap) = waiting.pop_front() else { break };
        if !flat(triangles[cap as usize]) {
            postponed = 0;
            continue;
        }
        let Some(flip) = Flip::find(positions, triangles, &stars, cap) else {
            waiting.push_back(cap);
            postponed += 1;
            continue;
        };
        let neighbour_flat = flat(triangles[flip.neighbour as usize]);
        if neighbour_flat {
            // The neighbour must be flipped across its own longest edge, unless this is it.
            let own = Flip::longest_edge(positions, triangles[flip.neighbour as usize]);
            let common = [flip.from, flip.to];
            if cap_flips_left == 0 || !own.iter().all(|v| common.contains(v)) {
                waiting.push_back(cap);
                postponed += 1;
                continue;
            }
            cap_flips_left -= 1;
            waiting.push_back(flip.neighbour);
            waiting.push_back(cap);
        } else {
            report.flipped_caps.triangle(source[cap as usize], positions[flip.middle as usize]);
            source[cap as usize] = source[flip.neighbour as usize];
        }
        flip.apply(triangles, &mut stars, cap);
        postponed = 0;
    }
    take_out_flat(positions, triangles, source, taken_out, report, flat);
}

fn take_out_flat(
    positions: &[[f32; 3]],
    triangles: &mut Vec<[u32; 3]>,
    source: &mut Vec<u32>,
    taken_out: &mut Vec<TakenOut>,
    report: &mut RepairReport,
    flat: impl Fn([u32; 3]) -> bool,
) {
    let keep: Vec<bool> = triangles
        .iter()
        .zip(source.iter())
        .map(|(&triangle, &number)| {
            if !flat(triangle) {
                return true;
            }
            let corners = triangle.map(|v| positions[v as usize]);
            let wire = Wire::of(positions, triangle, number);
            taken_out.push(TakenOut { wire, first: triangle[0], repeats_corner: false });
            // As many as explain the holes that an error lists.
            if report.dropped.len() < 64 * PLACES_KEPT {
                report.dropped.push((number, corners));
            }
            false
        })
        .collect();
    retain(triangles, &keep);
    retain(source, &keep);
}

/// Triangles around each vertex, kept up to date under flips.
struct Stars(Vec<Vec<u32>>);

impl Stars {
    fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut stars = vec![Vec::new(); vertex_count];
        for (t, triangle) in triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| stars[v as usize].push(t as u32));
        }
        Self(stars)
    }

    fn on_edge<'a>(
        &'a self,
        triangles: &'a [[u32; 3]],
        a: u32,
        b: u32,
    ) -> impl Iterator<Item = u32> + 'a {
        self.0[a as usize].iter().copied().filter(move |&t| triangles[t as usize].contains(&b))
    }
}

/// The neighbour (from, to, apex), in its own winding, and the cap's middle vertex on the edge
/// from–to.
struct Flip {
    neighbour: u32,
    from: u32,
    to: u32,
    apex: u32,
    middle: u32,
}

impl Flip {
    fn longest_edge(positions: &[[f32; 3]], triangle: [u32; 3]) -> [u32; 2] {
        let m = middle(triangle.map(|v| positions[v as usize]));
        [triangle[(m + 1) % 3], triangle[(m + 2) % 3]]
    }

    /// `None` if the long edge is not shared by exactly two triangles, or the new edge exists
    /// already.
    fn find(
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        stars: &Stars,
        cap: u32,
    ) -> Option<Self> {
        let triangle = triangles[cap as usize];
        let [a, c] = Self::longest_edge(positions, triangle);
        let middle = triangle.into_iter().find(|&v| v != a && v != c)?;
        let mut others = stars.on_edge(triangles, a, c).filter(|&t| t != cap);
        let neighbour = others.next()?;
        if others.next().is_some() {
            return None;
        }
        let corners = triangles[neighbour as usize];
        let k = corners.iter().position(|&v| v != a && v != c)?;
        let apex = corners[k];
        if apex == middle || stars.on_edge(triangles, middle, apex).next().is_some() {
            return None;
        }
        Some(Self { neighbour, from: corners[(k + 1) % 3], to: corners[(k + 2) % 3], apex, middle })
    }

    fn apply(&self, triangles: &mut [[u32; 3]], stars: &mut Stars, cap: u32) {
        triangles[cap as usize] = [self.from, self.middle, self.apex];
        triangles[self.neighbour as usize] = [self.middle, self.to, self.apex];
        stars.0[self.to as usize].retain(|&t| t != cap);
        stars.0[self.from as usize].retain(|&t| t != self.neighbour);
        stars.0[self.middle as usize].push(self.neighbour);
        stars.0[self.apex as usize].push(cap);
    }
}
