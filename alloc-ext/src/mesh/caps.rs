//! Triangles of zero area: removed by an edge flip where that keeps the mesh closed.
//!
//! A *cap* has its middle vertex b on the segment of its longest edge ac. If exactly one other
//! triangle (a, c, d) lies on ac, then flipping that edge gives (a, b, d) and (b, c, d): the same
//! point set, the same outer edges, no cap. Just dropping the cap would leave its two short edges
//! facing the long one, a slit.

use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

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
    // A flip between two caps shortens their common edge, so such flips end by themselves; the
    // limit is for certainty.
    let mut cap_flips_left = 8 * caps.len();
    let mut waiting = Waiting::new(caps);
    while let Some(cap) = waiting.next() {
        if !flat(triangles[cap as usize]) {
            continue;
        }
        let flip = match Flip::find(positions, triangles, &stars, cap) {
            Found::Flip(flip) => flip,
            Found::EdgeExists(edge) => {
                waiting.until_gone(edge, cap);
                continue;
            }
            Found::NoNeighbour => continue,
        };
        let neighbour_flat = flat(triangles[flip.neighbour as usize]);
        if neighbour_flat {
            // The neighbour must be flipped across its own longest edge, unless this is it.
            let own = Flip::longest_edge(positions, triangles[flip.neighbour as usize]);
            let common = [flip.from, flip.to];
            if cap_flips_left == 0 || !own.iter().all(|v| common.contains(v)) {
                continue;
            }
            cap_flips_left -= 1;
        } else {
            report.flipped_caps.triangle(source[cap as usize], positions[flip.middle as usize]);
            source[cap as usize] = source[flip.neighbour as usize];
        }
        flip.apply(triangles, &mut stars, cap);
        waiting.wake_behind([flip.from, flip.to]);
        for [a, b] in flip.sides() {
            let around = stars.on_edge(triangles, a, b);
            waiting.wake(around.filter(|&t| flat(triangles[t as usize])));
        }
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

/// Caps that may be flipped now, in turn by their numbers. One that cannot be flipped waits until a
/// flip changes a triangle on its longest edge, or removes the edge that is in its way.
struct Waiting {
    now: BTreeSet<u32>,
    /// The number after that of the cap tried last.
    next: u32,
    /// By an edge that is in the way of caps, its smaller vertex first.
    behind: FxHashMap<[u32; 2], Vec<u32>>,
}

impl Waiting {
    fn new(caps: Vec<u32>) -> Self {
        Self { now: caps.into_iter().collect(), next: 0, behind: FxHashMap::default() }
    }

    fn next(&mut self) -> Option<u32> {
        let cap = *self.now.range(self.next..).next().or_else(|| self.now.first())?;
        self.now.remove(&cap);
        self.next = cap + 1;
        Some(cap)
    }

    fn until_gone(&mut self, mut edge: [u32; 2], cap: u32) {
        edge.sort_unstable();
        self.behind.entry(edge).or_default().push(cap);
    }

    fn wake_behind(&mut self, mut gone: [u32; 2]) {
        gone.sort_unstable();
        self.now.extend(self.behind.remove(&gone).unwrap_or_default());
    }

    fn wake(&mut self, caps: impl Iterator<Item = u32>) {
        self.now.extend(caps);
    }
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

    /// Of the caps of one fan the last is flipped first, so the search begins at the end.
    fn remove(&mut self, vertex: u32, triangle: u32) {
        let star = &mut self.0[vertex as usize];
        if let Some(at) = star.iter().rposition(|&t| t == triangle) {
            star.remove(at);
        }
    }

    fn on_edge<'a>(
        &'a self,
        triangles: &'a [[u32; 3]],
        a: u32,
        b: u32,
    ) -> impl Iterator<Item = u32> + 'a {
        // Many triangles may meet in one of the vertices.
        let [around_a, around_b] = [a, b].map(|v| &self.0[v as usize]);
        let (around, other) =
            if around_a.len() <= around_b.len() { (around_a, b) } else { (around_b, a) };
        around.iter().copied().filter(move |&t| triangles[t as usize].contains(&other))
    }
}

/// What hinders a flip, if anything does.
enum Found {
    Flip(Flip),
    /// The new edge, which exists already.
    EdgeExists([u32; 2]),
    /// The long edge is not shared by exactly two triangles, or both have the same corners.
    NoNeighbour,
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

    fn find(positions: &[[f32; 3]], triangles: &[[u32; 3]], stars: &Stars, cap: u32) -> Found {
        let triangle = triangles[cap as usize];
        let edge @ [a, c] = Self::longest_edge(positions, triangle);
        let is_apex = |v: &u32| !edge.contains(v);
        let mut others = stars.on_edge(triangles, a, c).filter(|&t| t != cap);
        let (Some(neighbour), None) = (others.next(), others.next()) else {
            return Found::NoNeighbour;
        };
        let corners = triangles[neighbour as usize];
        let middle = triangle.into_iter().find(is_apex);
        let (Some(middle), Some(k)) = (middle, corners.iter().position(is_apex)) else {
            return Found::NoNeighbour;
        };
        let apex = corners[k];
        if apex == middle {
            return Found::NoNeighbour;
        }
        if stars.on_edge(triangles, middle, apex).next().is_some() {
            return Found::EdgeExists([middle, apex]);
        }
        let (from, to) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        Found::Flip(Self { neighbour, from, to, apex, middle })
    }

    /// The outer edges of the two triangles.
    fn sides(&self) -> [[u32; 2]; 4] {
        let Self { from, to, apex, middle, .. } = *self;
        [[from, middle], [middle, to], [to, apex], [apex, from]]
    }

    fn apply(&self, triangles: &mut [[u32; 3]], stars: &mut Stars, cap: u32) {
        triangles[cap as usize] = [self.from, self.middle, self.apex];
        triangles[self.neighbour as usize] = [self.middle, self.to, self.apex];
        stars.remove(self.to, cap);
        stars.remove(self.from, self.neighbour);
        stars.0[self.middle as usize].push(self.neighbour);
        stars.0[self.apex as usize].push(cap);
    }
}
