//! The Hausdorff distance of two meshes, to any precision, with the points that attain it.
//!
//! One side: how far the farthest point of `from` is from `to`.
//! 1. The closest points of all vertices, in one batch. The largest distance is a lower bound.
//! 2. A bound for each triangle from its corners: their distances and the longest edge, and the
//!    corners' distances from one triangle of `to` next to them. Few triangles exceed the lower
//!    bound.
//! 3. Those are cut, the one with the largest bound first, in rounds that all threads share. A
//!    piece is bounded from its centre.
//!
//! The box tree answers in f32. Bounds from above are then computed in f64 against the triangle
//! that it names. A point that may be the farthest is compared in f64 with every triangle that is
//! not certainly farther. So the precision ends where f64 does.
//!
//! Branch and bound after Tang, Lee and Kim, *Interactive Hausdorff distance computation for
//! general polygonal models* (2009). The order of the bounds, cheap ones first, is that of Sacht
//! and Jacobson, *Cascading upper bounds for triangle soup Pompeiu-Hausdorff distance* (2024).

use super::piece::{CUT_ROUNDING, MAX_DEPTH, Piece, ROUNDED_UP, bounding_ball, farthest_corner};
use crate::bvh::{closest_points, exact_blob};
use crate::error::BuildError;
use crate::mesh::Mesh;
use glam::{DVec3, Vec3};
use meshsweep_core::internal::geom::point_triangle;
use meshsweep_core::{Budget, Bvh, Ended, Neighbor, ScratchEntry};
use rayon::prelude::*;
use std::collections::BinaryHeap;

/// Which farthest points count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Those of the first mesh.
    Forward,
    /// Those of both meshes.
    Both,
}

/// When the bounds are close enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// The search ends when `upper ≤ lower · (1 + relative)`.
    pub relative: f64,
    /// Or when `upper − lower ≤ absolute`, in the meshes' unit.
    pub absolute: f64,
    /// In place of both: it ends when `upper` is at most this, or `lower` is above it.
    pub at_most: Option<f64>,
}

/// The farthest point that was found, and the point of the other mesh that is closest to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attained {
    /// The farthest point.
    pub from: [f64; 3],
    /// Number of its triangle in its input file.
    pub from_triangle: u32,
    /// The closest point of the other mesh.
    pub to: [f64; 3],
    /// Number of its triangle in its input file.
    pub to_triangle: u32,
    /// The farthest point lies on the second mesh.
    pub is_backward: bool,
}

/// Bounds of a Hausdorff distance: `lower ≤ distance ≤ upper` in real arithmetic, between the
/// meshes as their files have them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hausdorff {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// Where `lower` is attained; nothing if the meshes are the same up to rounding.
    pub attained: Option<Attained>,
    /// Pieces of triangles that were bounded.
    pub pieces: usize,
}

/// The Hausdorff distance of two meshes, open or closed, in any number of parts.
///
/// `progress(lower, upper)` is called once a round; `upper` is that of the side being searched.
/// Lengths are in the unit of the files. Bounds closer than about 10^-11 of the largest coordinate
/// are not reached. After 50 million pieces the bounds are given as they are. The answer does not
/// depend on the number of threads.
///
/// Cost: a box tree for each mesh, one query for each vertex, and some dozens to some thousand
/// more, next to the farthest point. Meshes that are equally far apart everywhere take most.
///
/// # Errors
/// [`BuildError::Empty`] if a mesh has no triangle, and those of [`exact_blob`].
pub fn hausdorff(
    first: &Mesh,
    second: &Mesh,
    direction: Direction,
    precision: &Precision,
    mut progress: impl FnMut(f64, f64),
) -> Result<Hausdorff, BuildError> {
    if [first, second].iter().any(|mesh| mesh.all_triangles().next().is_none()) {
        return Err(BuildError::Empty);
    }
    // Repair moved no vertex by more than its rounding.
    let moved = first.rounding + second.rounding;
    let mut found = Found { precision: *precision, moved, lower: 0.0, attained: None, pieces: 0 };
    let mut upper = 0f64;
    let (forward, backward) = rayon::join(
        || exact_blob(second),
        || (direction == Direction::Both).then(|| exact_blob(first)).transpose(),
    );
    let sides = [(first, second, Some(forward?)), (second, first, backward?)];
    for ((from, to, blob), is_backward) in sides.into_iter().zip([false, true]) {
        let Some(blob) = blob else { continue };
        let tree = Bvh::open(&blob).map_err(BuildError::Reopen)?;
        let surface = Surface::new(&tree, to);
        let side = Side { from, surface, is_backward };
        upper = upper.max(side.search(&mut found, &mut progress));
    }
    let upper = if upper > found.lower { upper } else { found.lower };
    let Found { lower, attained, pieces, .. } = found;
    let (lower, upper) = ((lower - moved).max(0.0), (upper + moved) * (1.0 + 4.0 * f64::EPSILON));
    Ok(Hausdorff { lower: lower * (1.0 - 4.0 * f64::EPSILON), upper, attained, pieces })
}

/// Pieces that are cut in one round. More make threads busier, fewer cut less in vain.
const ROUND: usize = 512;

/// Most pieces of a search.
const MOST_PIECES: usize = 50_000_000;

/// State of the search, shared by both sides.
struct Found {
    precision: Precision,
    /// Rounding of both meshes.
    moved: f64,
    lower: f64,
    attained: Option<Attained>,
    pieces: usize,
}

impl Found {
    /// Whether bounds up to `upper` are close enough.
    fn suffices(&self, upper: f64) -> bool {
        let Precision { relative, absolute, at_most } = self.precision;
        if let Some(most) = at_most {
            return upper + self.moved <= most || self.lower - self.moved > most;
        }
        upper <= self.lower * (1.0 + relative) || upper - self.lower <= absolute
    }
}

/// The surface that distances are measured to.
struct Surface<'a> {
    tree: &'a Bvh<'a>,
    triangles: Vec<[DVec3; 3]>,
    sources: Vec<u32>,
}

/// The distance of a point from a surface.
#[derive(Clone, Copy)]
struct Near {
    lower: f64,
    upper: f64,
    /// A triangle that is at most `upper` away.
    triangle: usize,
}

/// QueryScratch of one thread's queries.
struct QueryScratch {
    entries: Vec<ScratchEntry>,
    neighbors: Vec<Neighbor>,
}

impl<'a> Surface<'a> {
    fn new(tree: &'a Bvh<'a>, mesh: &Mesh) -> Self {
        Surface {
            tree,
            triangles: mesh.all_corners_f64().collect(),
            sources: mesh.all_sources().collect(),
        }
    }

    fn scratch(&self) -> QueryScratch {
        let entries = vec![ScratchEntry::EMPTY; self.tree.scratch_entries()];
        QueryScratch { entries, neighbors: vec![Neighbor::EMPTY; 64] }
    }

    /// Bounds from above in f64, from below in f32. Nothing is known if the query fails.
    fn near(&self, p: DVec3, scratch: &mut QueryScratch) -> Near {
        let asked = p.as_vec3();
        let nothing = Near { lower: 0.0, upper: f64::INFINITY, triangle: 0 };
        let Ok(answer) =
            self.tree.closest_point(asked.to_array(), Budget::EXACT, &mut scratch.entries)
        else {
            return nothing;
        };
        let rounded = (asked.as_dvec3() - p).length();
        let lower = f64::from(answer.distance.lower) - rounded;
        answer.triangle.map_or(nothing, |triangle| self.seen(p, lower, triangle))
    }

    /// A lower bound, and the distance from a triangle.
    fn seen(&self, p: DVec3, lower: f64, triangle: u32) -> Near {
        let triangle = triangle as usize;
        let upper = self.distance_from(p, triangle);
        Near { lower: lower.max(0.0).min(upper), upper, triangle }
    }

    fn distance_from(&self, p: DVec3, triangle: usize) -> f64 {
        self.triangles
            .get(triangle)
            .map_or(f64::INFINITY, |&[a, b, c]| point_triangle(p, a, b, c).upper)
    }

    /// Both bounds in f64: against every triangle that may be nearer.
    fn sharpen(&self, p: DVec3, near: Near, scratch: &mut QueryScratch) -> Near {
        let asked = p.as_vec3();
        let reach = near.upper + (asked.as_dvec3() - p).length();
        let distance = ((reach * ROUNDED_UP) as f32).next_up();
        let mut all = loop {
            let QueryScratch { entries, neighbors } = scratch;
            let point = asked.to_array();
            let Ok(all) = self.tree.all_within(point, distance, neighbors, Budget::EXACT, entries)
            else {
                return near;
            };
            if all.dropped == 0 {
                break all;
            }
            let wanted = neighbors.len() + all.dropped as usize;
            neighbors.resize(wanted, Neighbor::EMPTY);
        };
        if all.ended != Ended::Exact || all.stored == 0 {
            return near;
        }
        all.stored = all.stored.min(scratch.neighbors.len());
        let mut sharp = Near { lower: f64::INFINITY, ..near };
        for neighbor in &scratch.neighbors[..all.stored] {
            let triangle = neighbor.triangle() as usize;
            let Some(&[a, b, c]) = self.triangles.get(triangle) else { return near };
            let distance = point_triangle(p, a, b, c);
            sharp.lower = sharp.lower.min(distance.lower);
            if distance.upper < sharp.upper {
                (sharp.upper, sharp.triangle) = (distance.upper, triangle);
            }
        }
        Near { lower: sharp.lower.max(near.lower).min(sharp.upper), ..sharp }
    }
}

/// A point that may be the farthest.
#[derive(Clone, Copy)]
struct Candidate {
    point: DVec3,
    /// Its triangle in the mesh.
    triangle: usize,
    near: Near,
}

/// One side of the distance.
struct Side<'a> {
    from: &'a Mesh,
    surface: Surface<'a>,
    is_backward: bool,
}

impl Side<'_> {
    /// Raises `found` and returns an upper bound of this side.
    fn search(&self, found: &mut Found, progress: &mut impl FnMut(f64, f64)) -> f64 {
        let mut scratch = self.surface.scratch();
        let triangles: Vec<[u32; 3]> = self.from.all_triangles().collect();
        let vertices = self.vertices(&triangles, found, &mut scratch);
        let mut heap = self.first_pieces(&triangles, &vertices, found);
        let size = self.from.positions.iter().flatten().fold(0f32, |most, x| most.max(x.abs()));
        let rounding = f64::from(size) * CUT_ROUNDING;
        loop {
            let upper =
                heap.peek().map_or(0.0, |piece: &Piece<usize>| piece.bound).max(found.lower);
            progress(found.lower, upper);
            let is_spent = found.pieces >= MOST_PIECES
                || heap.peek().is_none_or(|piece| piece.depth >= MAX_DEPTH);
            if is_spent || found.suffices(upper + rounding) || upper - found.lower <= rounding {
                return upper + rounding;
            }
            let mut round = Vec::with_capacity(ROUND);
            while round.len() < ROUND
                && let Some(piece) = heap.pop()
            {
                if piece.bound > found.lower {
                    round.push(piece);
                }
            }
            let parts: Vec<(Piece<usize>, Candidate)> = round
                .par_iter()
                .map_init(|| self.surface.scratch(), |scratch, piece| self.cut(piece, scratch))
                .flatten_iter()
                .collect();
            found.pieces += parts.len();
            self.raise(found, parts.iter().map(|(_, candidate)| *candidate), &mut scratch);
            heap.extend(parts.into_iter().map(|(part, _)| part).filter(|p| p.bound > found.lower));
        }
    }

    /// The distances of all vertices. Raises `found` to the largest.
    fn vertices(
        &self,
        triangles: &[[u32; 3]],
        found: &mut Found,
        scratch: &mut QueryScratch,
    ) -> Vec<Near> {
        let Surface { tree, .. } = self.surface;
        let positions = &self.from.positions;
        let at = |v: usize| Vec3::from(positions[v]).as_dvec3();
        let near: Vec<Near> = match closest_points(tree, positions, &Budget::EXACT) {
            Ok(answers) => answers
                .par_iter()
                .enumerate()
                .map(|(v, answer)| {
                    let lower = f64::from(answer.distance.lower);
                    self.surface.seen(at(v), lower, answer.triangle.unwrap_or(u32::MAX))
                })
                .collect(),
            Err(_) => (0..positions.len()).map(|v| self.surface.near(at(v), scratch)).collect(),
        };
        let mut owner = vec![usize::MAX; positions.len()];
        for (number, corners) in triangles.iter().enumerate() {
            corners.iter().for_each(|&v| owner[v as usize] = number);
        }
        let candidate =
            |(v, &near): (usize, &Near)| Candidate { point: at(v), triangle: owner[v], near };
        let used = near.iter().enumerate().filter(|(v, _)| owner[*v] != usize::MAX);
        self.raise(found, used.map(candidate), scratch);
        near
    }

    /// Raises `found` to the farthest candidate.
    fn raise(
        &self,
        found: &mut Found,
        candidates: impl Iterator<Item = Candidate>,
        scratch: &mut QueryScratch,
    ) {
        let mut wanted: Vec<Candidate> =
            candidates.filter(|candidate| candidate.near.upper > found.lower).collect();
        wanted.sort_by(|a, b| b.near.upper.total_cmp(&a.near.upper));
        for Candidate { point, triangle, near } in wanted {
            if near.upper <= found.lower || found.suffices(near.upper) {
                break;
            }
            let near = self.surface.sharpen(point, near, scratch);
            if near.lower > found.lower {
                found.lower = near.lower;
                found.attained = self.attained(point, triangle, near);
            }
        }
    }

    fn attained(&self, point: DVec3, triangle: usize, near: Near) -> Option<Attained> {
        let &[a, b, c] = self.surface.triangles.get(near.triangle)?;
        let closest = point_triangle(point, a, b, c);
        Some(Attained {
            from: point.to_array(),
            from_triangle: self.from.all_sources().nth(triangle)?,
            to: (a + (b - a) * closest.u + (c - a) * closest.v).to_array(),
            to_triangle: *self.surface.sources.get(near.triangle)?,
            is_backward: self.is_backward,
        })
    }

    /// The triangles whose bounds exceed the lower bound.
    fn first_pieces(
        &self,
        triangles: &[[u32; 3]],
        vertices: &[Near],
        found: &Found,
    ) -> BinaryHeap<Piece<usize>> {
        let piece = |(triangle, &corners): (usize, &[u32; 3])| {
            let near = corners.map(|v| vertices[v as usize]);
            let corners = corners.map(|v| Vec3::from(self.from.positions[v as usize]).as_dvec3());
            let [a, b, c] = corners;
            let longest = (b - a)
                .length_squared()
                .max((c - b).length_squared())
                .max((a - c).length_squared());
            let farthest = near.iter().fold(0f64, |most, near| most.max(near.upper));
            // Every point of a triangle is within longest / √3 of a corner.
            let mut bound = (farthest + (longest / 3.0).sqrt()) * ROUNDED_UP;
            for next_to in near {
                if bound <= found.lower {
                    break;
                }
                bound = bound.min(self.bound_by(next_to.triangle, &corners));
            }
            Piece { bound, corners, depth: 0, along: None, of: triangle }
        };
        let pieces: Vec<Piece<usize>> = triangles
            .par_iter()
            .enumerate()
            .map(piece)
            .filter(|piece| piece.bound > found.lower)
            .collect();
        BinaryHeap::from(pieces)
    }

    /// Upper bound of a triangle's distance, from one triangle of the surface.
    fn bound_by(&self, triangle: usize, corners: &[DVec3; 3]) -> f64 {
        let surface = self.surface.triangles.get(triangle);
        surface.map_or(f64::INFINITY, |&surface| farthest_corner(corners, surface) * ROUNDED_UP)
    }

    /// The parts of a piece, each with its centre.
    fn cut(
        &self,
        piece: &Piece<usize>,
        scratch: &mut QueryScratch,
    ) -> Vec<(Piece<usize>, Candidate)> {
        let bounded = |corners: [DVec3; 3]| {
            let (centre, _) = bounding_ball(&corners);
            let near = self.surface.near(centre, scratch);
            let next_to = self.surface.triangles.get(near.triangle).copied();
            let part = Piece::new(corners, piece.depth + 1, near.upper, next_to, piece.of);
            let part = Piece { bound: part.bound.min(piece.bound), ..part };
            (part, Candidate { point: centre, triangle: piece.of, near })
        };
        piece.parts().into_iter().map(bounded).collect()
    }
}
