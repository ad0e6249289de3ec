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
//! not certainly farther. So is the centre of a piece that is almost on the surface: there f32 does
//! not tell the nearest triangle from one next to it. So the precision ends where f64 does.
//!
//! Branch and bound after Tang, Lee and Kim, *Interactive Hausdorff distance computation for
//! general polygonal models* (2009). The order of the bounds, cheap ones first, is that of Sacht
//! and Jacobson, *Cascading upper bounds for triangle soup Pompeiu-Hausdorff distance* (2024).

use super::farthest::WIDE;
use super::piece::{
    CUT_ROUNDING, MAX_DEPTH, Piece, ROUNDED_UP, bounding_ball, farthest_corner, greater,
};
use super::surface::{Near, QueryScratch, Surface};
use crate::bvh::{blob_for, closest_points};
use crate::error::BuildError;
use crate::mesh::Mesh;
use glam::{DVec3, Vec3};
use meshsweep_core::internal::geom::point_triangle;
use meshsweep_core::{Budget, Bvh};
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

/// The farthest point that was found, and the point of the other mesh that is closest to it. Both
/// lie on the meshes with their coordinates rounded to f32.
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
    /// The farthest point that was found; nothing if no point is known to be apart.
    pub attained: Option<Attained>,
    /// Pieces of triangles that were bounded.
    pub pieces: usize,
    /// Why the search ended.
    pub ended: Ended,
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The bounds are as close as asked for, or the limit is decided.
    Precision,
    /// The bounds are as close as rounding allows, and farther apart than asked for.
    Rounding,
    /// 50 million pieces, or four million that wait, did not suffice.
    Pieces,
}

/// Which mesh was refused, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The second mesh.
    pub is_second: bool,
    /// The reason.
    pub error: BuildError,
}

/// The Hausdorff distance of two meshes, open or closed, with any number of connected components.
///
/// `progress(lower, upper)` is called once a round. Lengths are in the unit of the files. Bounds
/// come no closer than the rounding of coordinates to f32, and some 10^-11 of the largest
/// coordinate. [`Hausdorff::ended`] says whether the precision was reached. The answer does not
/// depend on the number of threads.
///
/// Cost: a box tree for each mesh, one query for each vertex, and some dozens to some thousand
/// more, next to the farthest point. Meshes that are equally far apart everywhere take most.
///
/// # Errors
/// [`BuildError::Empty`] if a mesh has no triangle, and those of [`blob_for`].
pub fn hausdorff(
    first: &Mesh,
    second: &Mesh,
    direction: Direction,
    precision: &Precision,
    progress: &mut dyn FnMut(f64, f64),
) -> Result<Hausdorff, Refused> {
    let refused = |is_second| move |error| Refused { is_second, error };
    for (mesh, is_second) in [(first, false), (second, true)] {
        if mesh.all_triangles().next().is_none() {
            return Err(refused(is_second)(BuildError::Empty));
        }
    }
    let (to_second, to_first) = rayon::join(
        || blob_for(second, first.positions.len()).map_err(refused(true)),
        || match direction {
            Direction::Both => {
                blob_for(first, second.positions.len()).map(Some).map_err(refused(false))
            }
            Direction::Forward => Ok(None),
        },
    );
    let (to_second, to_first) = (to_second?, to_first?);
    let open =
        |blob, is_second| Bvh::open(blob).map_err(BuildError::Reopen).map_err(refused(is_second));
    let trees = [
        Some(open(&to_second, true)?),
        to_first.as_deref().map(|blob| open(blob, false)).transpose()?,
    ];
    let sides: Vec<Side<'_>> = trees
        .iter()
        .zip([(first, second, false), (second, first, true)])
        .filter_map(|(tree, (from, to, is_backward))| {
            let surface = Surface::new(tree.as_ref()?, to);
            Some(Side { from, sources: from.all_sources().collect(), surface, is_backward })
        })
        .collect();
    let largest = |mesh: &Mesh| {
        f64::from(mesh.positions.iter().flatten().fold(0f32, |most, x| most.max(x.abs())))
    };
    let mut search = Search {
        sides: &sides,
        precision: *precision,
        rounding: largest(first).max(largest(second)) * CUT_ROUNDING,
        // Repair moved no vertex by more than its rounding.
        moved: first.rounding + second.rounding,
        lower: 0.0,
        attained: None,
        pieces: 0,
    };
    let (upper, ended) = search.run(progress);
    let Search { attained, pieces, .. } = search;
    let [lower, upper] = search.told(upper);
    Ok(Hausdorff { lower, upper, attained, pieces, ended })
}

/// Pieces that are cut in one round. More make threads busier, fewer cut less in vain.
const ROUND: usize = 512;

/// Most pieces of a search.
const MOST_PIECES: usize = 50_000_000;

/// Most pieces that wait. They take 480 MB.
const MOST_WAITING: usize = 4_000_000;

/// The triangle of a piece.
#[derive(Clone, Copy)]
struct Place {
    /// In [`Search::sides`].
    side: usize,
    /// In the side's mesh.
    triangle: u32,
    /// In the side's surface: next to the piece.
    next_to: u32,
}

/// State of the search.
struct Search<'a> {
    sides: &'a [Side<'a>],
    precision: Precision,
    /// Rounding of cut points.
    rounding: f64,
    /// Rounding of both meshes.
    moved: f64,
    /// The largest distance that was found.
    lower: f64,
    attained: Option<Attained>,
    pieces: usize,
}

impl Search<'_> {
    /// Cuts the piece with the largest bound until the bounds are close enough. The upper bound.
    fn run(&mut self, progress: &mut dyn FnMut(f64, f64)) -> (f64, Ended) {
        let sides = self.sides;
        let mut scratch: Vec<QueryScratch> =
            sides.iter().map(|side| side.surface.scratch()).collect();
        let vertices: Vec<Vec<Near>> = sides.iter().map(|side| side.vertex_distances()).collect();
        for (index, (side, near)) in sides.iter().zip(&vertices).enumerate() {
            self.raise(index, side.vertex_candidates(near), &mut scratch[index]);
        }
        let mut heap = BinaryHeap::new();
        for (index, (side, near)) in sides.iter().zip(&vertices).enumerate() {
            heap.extend(side.first_pieces(index, near, self.lower));
        }
        loop {
            let upper = heap.peek().map_or(0.0, |piece: &Piece<Place>| piece.bound);
            let upper = greater(upper, self.lower);
            progress(self.lower, upper);
            if let Some(ended) = self.ended(upper, &heap) {
                return (upper, ended);
            }
            let mut round = Vec::with_capacity(ROUND);
            while round.len() < ROUND
                && let Some(piece) = heap.peek()
                && piece.depth < MAX_DEPTH
            {
                round.extend(heap.pop().filter(|piece| piece.bound > self.lower));
            }
            let parts: Vec<(Piece<Place>, Candidate)> = round
                .par_iter()
                .map_init(
                    || sides.iter().map(|side| side.surface.scratch()).collect::<Vec<_>>(),
                    |scratch, piece| match scratch.get_mut(piece.of.side) {
                        Some(scratch) => sides[piece.of.side].cut(piece, scratch),
                        None => Vec::new(),
                    },
                )
                .flatten_iter()
                .collect();
            self.pieces += parts.len();
            for (index, scratch) in scratch.iter_mut().enumerate() {
                let here = parts.iter().filter(|(part, _)| part.of.side == index);
                self.raise(index, here.map(|(_, candidate)| *candidate), scratch);
            }
            let parts = parts.into_iter().map(|(part, _)| part);
            heap.extend(parts.filter(|part| part.bound > self.lower));
        }
    }

    /// The bounds as they are given: with the rounding of cuts and of the meshes.
    fn told(&self, upper: f64) -> [f64; 2] {
        let lower = (self.lower - self.moved).next_down();
        let upper = ((upper + self.rounding).next_up() + self.moved).next_up();
        [lower.max(0.0), upper]
    }

    /// Whether an upper bound is as close as asked for.
    fn is_close(&self, upper: f64) -> bool {
        let [least, most] = self.told(upper);
        let Precision { relative, absolute, at_most } = self.precision;
        match at_most {
            Some(limit) => most <= limit || least > limit,
            None => most <= least * (1.0 + relative) || most - least <= absolute,
        }
    }

    /// Whether an upper bound is as close as rounding allows.
    fn is_rounding(&self, upper: f64) -> bool {
        upper - self.lower <= (self.rounding + self.moved) / 4.0
    }

    fn ended(&self, upper: f64, heap: &BinaryHeap<Piece<Place>>) -> Option<Ended> {
        let is_deepest = heap.peek().is_none_or(|piece| piece.depth >= MAX_DEPTH);
        if self.is_close(upper) {
            Some(Ended::Precision)
        } else if self.is_rounding(upper) || is_deepest {
            Some(Ended::Rounding)
        } else if self.pieces >= MOST_PIECES || heap.len() > MOST_WAITING {
            Some(Ended::Pieces)
        } else {
            None
        }
    }

    /// Raises the lower bound to the farthest candidate of a side.
    fn raise(
        &mut self,
        side: usize,
        candidates: impl Iterator<Item = Candidate>,
        scratch: &mut QueryScratch,
    ) {
        let mut wanted: Vec<Candidate> =
            candidates.filter(|candidate| candidate.near.upper > self.lower).collect();
        wanted.sort_by(|a, b| b.near.upper.total_cmp(&a.near.upper));
        for (number, Candidate { point, triangle, near }) in wanted.into_iter().enumerate() {
            // The first one gives a point even where nothing more is to be gained.
            let is_enough = self.is_close(near.upper) || self.is_rounding(near.upper);
            if near.upper <= self.lower || number > 0 && is_enough {
                break;
            }
            let side = &self.sides[side];
            let near = side.surface.bounds_in_f64(point, near, scratch);
            if near.lower > self.lower {
                self.lower = near.lower;
                self.attained = side.attained(point, triangle, near);
            }
        }
    }
}

/// A point that may be the farthest.
#[derive(Clone, Copy)]
struct Candidate {
    point: DVec3,
    /// Its triangle in the mesh.
    triangle: u32,
    near: Near,
}

/// One side of the distance.
struct Side<'a> {
    from: &'a Mesh,
    /// Numbers of its triangles in the input file.
    sources: Vec<u32>,
    surface: Surface<'a>,
    is_backward: bool,
}

impl Side<'_> {
    fn vertex(&self, v: usize) -> DVec3 {
        Vec3::from(self.from.positions[v]).as_dvec3()
    }

    /// The distances of all vertices.
    fn vertex_distances(&self) -> Vec<Near> {
        let positions = &self.from.positions;
        match closest_points(self.surface.tree, positions, &Budget::EXACT) {
            Ok(answers) => answers
                .par_iter()
                .enumerate()
                .map(|(v, answer)| {
                    let lower = f64::from(answer.distance.lower);
                    let triangle = answer.triangle.unwrap_or(u32::MAX);
                    self.surface.near_triangle(self.vertex(v), lower, triangle)
                })
                .collect(),
            Err(_) => {
                let mut scratch = self.surface.scratch();
                (0..positions.len())
                    .map(|v| self.surface.near(self.vertex(v), &mut scratch))
                    .collect()
            }
        }
    }

    /// The vertices of triangles.
    fn vertex_candidates(&self, near: &[Near]) -> impl Iterator<Item = Candidate> {
        let mut owner = vec![u32::MAX; near.len()];
        for (number, corners) in (0u32..).zip(self.from.all_triangles()) {
            corners.iter().for_each(|&v| owner[v as usize] = number);
        }
        let owned = owner.into_iter().zip(near).enumerate();
        let owned = owned.filter(|(_, (triangle, _))| *triangle != u32::MAX);
        owned.map(|(v, (triangle, &near))| Candidate { point: self.vertex(v), triangle, near })
    }

    fn attained(&self, point: DVec3, triangle: u32, near: Near) -> Option<Attained> {
        let &[a, b, c] = self.surface.triangles.get(near.triangle)?;
        let closest = point_triangle(point, a, b, c);
        Some(Attained {
            from: point.to_array(),
            from_triangle: *self.sources.get(triangle as usize)?,
            to: (a + (b - a) * closest.u + (c - a) * closest.v).to_array(),
            to_triangle: *self.surface.sources.get(near.triangle)?,
            is_backward: self.is_backward,
        })
    }

    /// The triangles whose bounds exceed the lower bound. `side` is the number of this one.
    fn first_pieces(&self, side: usize, vertices: &[Near], lower: f64) -> Vec<Piece<Place>> {
        let piece = |(triangle, vertex): (usize, &[u32; 3])| {
            let near = vertex.map(|v| vertices[v as usize]);
            let corners = vertex.map(|v| self.vertex(v as usize));
            let [a, b, c] = corners;
            let longest = (b - a)
                .length_squared()
                .max((c - b).length_squared())
                .max((a - c).length_squared());
            let farthest = near.iter().fold(0.0, |most, near| greater(most, near.upper));
            // Every point of a triangle is within longest / √3 of a corner.
            let mut bound = (farthest + (longest / 3.0).sqrt()) * ROUNDED_UP;
            for next_to in near {
                if bound <= lower {
                    break;
                }
                bound = bound.min(self.bound_by(next_to.triangle, &corners));
            }
            let place = Place { side, triangle: triangle as u32, next_to: u32::MAX };
            Piece { bound, corners, depth: 0, is_wide: false, of: place }
        };
        let triangles: Vec<[u32; 3]> = self.from.all_triangles().collect();
        let pieces = triangles.par_iter().enumerate().map(piece);
        pieces.filter(|piece| piece.bound > lower).collect()
    }

    /// Upper bound of a triangle's distance, from one triangle of the surface.
    fn bound_by(&self, triangle: usize, corners: &[DVec3; 3]) -> f64 {
        let surface = self.surface.triangles.get(triangle);
        surface.map_or(f64::INFINITY, |&surface| farthest_corner(corners, surface) * ROUNDED_UP)
    }

    /// The parts of a piece, each with its centre.
    fn cut(
        &self,
        piece: &Piece<Place>,
        scratch: &mut QueryScratch,
    ) -> Vec<(Piece<Place>, Candidate)> {
        let triangle = |index: usize| self.surface.triangles.get(index).copied();
        let bounded = |corners: [DVec3; 3]| {
            let (centre, _) = bounding_ball(&corners);
            let mut near = self.surface.near(centre, scratch);
            // Below the precision of f32 the tree may name a triangle that is far from the nearest:
            // the bound would not fall.
            if near.upper - near.lower > WIDE * near.upper {
                near = self.surface.bounds_in_f64(centre, near, scratch);
            }
            let place = Place { next_to: near.triangle as u32, ..piece.of };
            let depth = piece.depth + 1;
            let part = Piece::new(corners, depth, near.upper, triangle(near.triangle), place);
            let part = Piece { bound: part.bound.min(piece.bound), ..part };
            (part, Candidate { point: centre, triangle: place.triangle, near })
        };
        piece.parts(triangle(piece.of.next_to as usize)).into_iter().map(bounded).collect()
    }
}
