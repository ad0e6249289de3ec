//! How the distance of one surface from another is spread over its area: certified bounds of its
//! mean and of its quantiles, and the distance of each vertex.
//!
//! Each triangle is a piece. The distance is 1-Lipschitz, so that at the centre bounds it on the
//! piece. Where the surface nearby is almost flat, its slope bounds it more closely. Pieces are
//! halved, those that blur the mean most first, until the mean is known as closely as asked for. A
//! quantile of the lower bounds is below that of the distance, and one of the upper bounds above.

use super::piece::{CUT_ROUNDING, ROUNDED_UP, bisect, bounding_ball};
use super::surface::{Near, QueryScratch, Surface};
use super::two_meshes::Refused;
use crate::bvh::exact_blob;
use crate::error::BuildError;
use crate::mesh::Mesh;
use glam::{DVec3, Vec3};
use meshsweep_core::Bvh;
use meshsweep_core::internal::geom::point_triangle;
use rayon::prelude::*;

/// Distances of the points of one surface from another one. Each pair bounds a number from below
/// and from above, in the meshes' unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The mean over the area.
    pub mean: [f64; 2],
    /// For each part of the area that was asked about, the distance that this part does not exceed.
    pub quantiles: Vec<[f64; 2]>,
    /// The distance of each vertex of the first mesh.
    pub vertices: Vec<[f64; 2]>,
    /// Pieces of triangles that were measured.
    pub pieces: usize,
    /// Whether the mean is known as closely as asked for.
    pub is_close: bool,
}

/// Most pieces of a profile. They take 300 MB.
const MOST_PIECES: usize = 3_000_000;

/// Parts of all pieces that are cut in one round: those that blur the mean most.
const CUT_PART: usize = 4;

/// Distances of `from` from `to`. `parts`, from 0 to 1, ask for quantiles over the area of `from`.
/// The bounds of the mean are at most `relative` times the mean apart, or some roundings, if three
/// million pieces suffice. `progress` gets the bounds of the mean, once a round. The answer does
/// not depend on the number of threads.
///
/// Triangles without area do not count, except where the mesh has no others: then all are NaN.
///
/// Cost: a box tree of `to`, and a query for each vertex and each piece. Ten to a thousand pieces
/// a triangle, the fewer the finer the mesh.
///
/// # Errors
/// As [`hausdorff`](super::hausdorff).
pub fn profile(
    from: &Mesh,
    to: &Mesh,
    parts: &[f64],
    relative: f64,
    progress: &mut dyn FnMut(f64, f64),
) -> Result<Profile, Refused> {
    for (mesh, is_second) in [(from, false), (to, true)] {
        if mesh.all_triangles().next().is_none() {
            return Err(Refused { is_second, error: BuildError::Empty });
        }
    }
    let refused = |error| Refused { is_second: true, error };
    let blob = exact_blob(to).map_err(refused)?;
    let tree = Bvh::open(&blob).map_err(BuildError::Reopen).map_err(refused)?;
    let surface = Surface::new(&tree, to);
    let all = from.positions.iter().chain(&to.positions).flatten();
    let largest = f64::from(all.fold(0f32, |most, x| most.max(x.abs())));
    let moved = from.rounding + to.rounding + largest * CUT_ROUNDING;
    let measured = |triangles: &[[DVec3; 3]]| -> Vec<Piece> {
        let measure = |scratch: &mut QueryScratch, corners: &[DVec3; 3]| {
            Piece::new(*corners, moved, &surface, scratch)
        };
        triangles.par_iter().map_init(|| surface.scratch(), measure).collect()
    };
    let triangles: Vec<[DVec3; 3]> = from.corners_f64().collect();
    let mut pieces = measured(&triangles);
    let mut measured_pieces = pieces.len();
    let is_close = loop {
        let mean = mean(&pieces);
        progress(mean[0], mean[1]);
        let blur = mean[1] - mean[0];
        // Below some roundings nothing is gained.
        if blur <= (relative * mean[1]).max(4.0 * moved) || blur.is_nan() {
            break true;
        }
        let cut = (pieces.len() / CUT_PART).max(1);
        if pieces.len() + cut > MOST_PIECES {
            break false;
        }
        pieces.select_nth_unstable_by(cut - 1, |a, b| b.blur().total_cmp(&a.blur()));
        let halves: Vec<[DVec3; 3]> =
            pieces[..cut].iter().flat_map(|piece| bisect(piece.corners)).collect();
        let halves = measured(&halves);
        measured_pieces += halves.len();
        let rest = pieces.split_off(cut);
        pieces = halves;
        pieces.extend(rest);
    };
    let corner = |scratch: &mut QueryScratch, p: &[f32; 3]| {
        let p = Vec3::from_array(*p).as_dvec3();
        let near = surface.near(p, scratch);
        [(near.lower - moved).max(0.0), (near.upper + moved) * ROUNDED_UP]
    };
    let vertices = from.positions.par_iter().map_init(|| surface.scratch(), corner).collect();
    Ok(Profile {
        mean: mean(&pieces),
        quantiles: quantiles(&mut pieces, parts),
        vertices,
        pieces: measured_pieces,
        is_close,
    })
}

/// A part of a triangle, and bounds of the distances of its points.
#[derive(Clone, Copy)]
struct Piece {
    corners: [DVec3; 3],
    area: f64,
    lower: f64,
    upper: f64,
    /// Bounds of their mean.
    mean: [f64; 2],
}

impl Piece {
    fn new(
        corners: [DVec3; 3],
        moved: f64,
        surface: &Surface<'_>,
        scratch: &mut QueryScratch,
    ) -> Self {
        let (centre, radius) = bounding_ball(&corners);
        let near = surface.near(centre, scratch);
        let (least, most) = (near.lower - moved, near.upper + moved);
        // The distance from the centre is convex and 0 there: on each of the three triangles about
        // it the mean is at most a third of the corners' sum.
        let spread =
            corners.iter().map(|corner| (*corner - centre).length()).sum::<f64>() * 2.0 / 9.0;
        // The distance from one triangle is convex too, so its corners bound it, and their mean its
        // mean.
        let from_one =
            surface.triangles.get(near.triangle).map_or([f64::INFINITY; 3], |&[a, b, c]| {
                corners.map(|corner| point_triangle(corner, a, b, c).upper + moved)
            });
        let [x, y, z] = from_one;
        let [a, b, c] = corners;
        let (slope, bend) = slope(centre, &near, radius, surface, scratch);
        let least_corner = corners.map(|corner| slope.dot(corner - centre));
        let least_corner = least_corner.into_iter().fold(f64::INFINITY, f64::min);
        Self {
            corners,
            area: 0.5 * (b - a).cross(c - a).length(),
            lower: (least + (least_corner - bend * radius) * ROUNDED_UP).max(0.0),
            upper: (most + radius).min(x.max(y).max(z)) * ROUNDED_UP,
            mean: [
                (least - bend * spread * ROUNDED_UP).max(0.0),
                (most + spread).min((x + y + z) / 3.0) * ROUNDED_UP,
            ],
        }
    }

    /// Its share in the width of the mean's bounds.
    fn blur(&self) -> f64 {
        let [least, most] = self.mean;
        self.area * (most - least)
    }
}

/// A linear lower bound of the distance on a piece: at each point x of it the distance is at least
/// that at the centre, and `slope · (x − centre)` more, and `bend · |x − centre|` less.
///
/// The distance from one triangle is convex. So it is at least its linear part at the centre, whose
/// slope is the direction from the triangle. The triangles that may be next to the piece have other
/// slopes, by no more than `bend`.
fn slope(
    centre: DVec3,
    near: &Near,
    radius: f64,
    surface: &Surface<'_>,
    scratch: &mut QueryScratch,
) -> (DVec3, f64) {
    const UNKNOWN: (DVec3, f64) = (DVec3::ZERO, 1.0);
    // Next to large pieces there are too many triangles.
    if radius > NEAR_PIECE * near.lower {
        return UNKNOWN;
    }
    // The direction from a triangle, and how far rounding may have turned it.
    let direction = |[a, b, c]: [DVec3; 3]| {
        let found = point_triangle(centre, a, b, c);
        let way = centre - (a + (b - a) * found.u + (c - a) * found.v);
        let apart = (found.upper * found.upper - found.lower * found.lower).max(0.0).sqrt();
        (way / way.length(), (4.0 * apart + found.upper * 1e-12) / found.lower)
    };
    let Some(&nearest) = surface.triangles.get(near.triangle) else { return UNKNOWN };
    let (slope, off) = direction(nearest);
    let mut bend = 0f64;
    let reach = near.upper + 2.0 * radius;
    let is_known = surface.for_each_within(centre, reach, scratch, |_, triangle| {
        let (other, turned) = direction(triangle);
        let differs = (other - slope).length() + turned + off;
        bend = if differs > bend || differs.is_nan() { differs } else { bend };
    });
    // A plain Lipschitz bound is never worse than a bend of 1 without a slope.
    if is_known && bend < 1.0 { (slope, bend) } else { UNKNOWN }
}

/// Ratio of a piece's radius and its distance above which no slope is computed.
const NEAR_PIECE: f64 = 4.0;

/// Rounding of sums over millions of pieces, relative.
const SUMS: f64 = 1e-9;

fn mean(pieces: &[Piece]) -> [f64; 2] {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let sum = |of: fn(&Piece) -> f64| pieces.iter().map(|p| p.area * of(p)).sum::<f64>() / area;
    let (lower, upper) = (sum(|piece| piece.mean[0]), sum(|piece| piece.mean[1]));
    [(lower * (1.0 - SUMS)).max(0.0), upper * (1.0 + SUMS)]
}

fn quantiles(pieces: &mut [Piece], parts: &[f64]) -> Vec<[f64; 2]> {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let mut bounds = vec![[0.0; 2]; parts.len()];
    for (side, bound) in [(|piece: &Piece| piece.lower) as fn(&Piece) -> f64, |piece| piece.upper]
        .into_iter()
        .enumerate()
    {
        pieces.sort_unstable_by(|a, b| bound(a).total_cmp(&bound(b)));
        // So that the rounding of the areas moves each bound outward.
        let slack = if side == 0 { -SUMS } else { SUMS };
        for (slot, part) in bounds.iter_mut().zip(parts) {
            let wanted = area * (part + slack);
            let mut sum = 0.0;
            let found = pieces.iter().find(|piece| {
                sum += piece.area;
                sum >= wanted
            });
            slot[side] = found.or(pieces.last()).map_or(f64::NAN, bound);
        }
    }
    bounds
}
