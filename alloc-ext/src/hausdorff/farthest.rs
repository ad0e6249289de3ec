//! Bounds of the distance of the farthest point of some triangles, within a few percent. The
//! builders use them.

use super::piece::{CUT_ROUNDING, MAX_DEPTH, Piece, ROUNDED_UP, bounding_ball, greater};
use super::surface::Surface;
use crate::mesh::Mesh;
use glam::{DVec3, Vec3};
use meshsweep_core::Bvh;
use std::collections::BinaryHeap;

/// The bound may exceed the true distance by this factor.
const TOLERANCE: f64 = 1.05;

/// Most cuts of a search. They suffice where each triangle of a mesh cuts a close hull a few times.
/// The pieces that are left keep their bounds.
const MAX_CUTS: usize = 200_000;

/// Where a point's nearest surface is.
pub struct Nearest {
    /// Lower bound of the distance.
    pub lower: f64,
    /// Upper bound of the distance.
    pub upper: f64,
    /// Corners of the nearest triangle of the surface, or of one that is almost as near.
    pub triangle: Option<[DVec3; 3]>,
}

/// Bounds of the largest distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Farthest {
    /// Lower bound: the distance of some point.
    pub lower: f64,
    /// Upper bound; infinite if a query failed.
    pub upper: f64,
}

/// A piece, bounded from its centre. Raises `found` to the centre's distance.
fn bounded(
    corners: [DVec3; 3],
    depth: u32,
    found: &mut f64,
    nearest: &mut impl FnMut(DVec3) -> Option<Nearest>,
) -> Piece<Option<[DVec3; 3]>> {
    let Some(near) = nearest(bounding_ball(&corners).0) else {
        return Piece { bound: f64::INFINITY, corners, depth, is_wide: false, of: None };
    };
    *found = found.max(near.lower);
    Piece::new(corners, depth, near.upper, near.triangle, near.triangle)
}

/// Bounds of the largest distance from a point of `triangles` to the surface of `nearest`. `upper`
/// exceeds `lower` by at most a twentieth and twice the rounding of cuts, unless `upper` is at most
/// `enough`, or 200,000 cuts or the depth of a piece do not suffice.
///
/// Cost: one query for each triangle, and some dozens more for the farthest.
pub fn farthest(
    triangles: impl Iterator<Item = [DVec3; 3]>,
    enough: f64,
    mut nearest: impl FnMut(DVec3) -> Option<Nearest>,
) -> Farthest {
    let mut found = 0f64;
    let mut heap = BinaryHeap::new();
    let mut size = 0f64;
    for corners in triangles {
        size = corners.iter().fold(size, |size, p| size.max(p.abs().max_element()));
        heap.push(bounded(corners, 0, &mut found, &mut nearest));
    }
    cut_down(heap, found, size, enough, nearest)
}

/// Triangles that [`farthest_of_many`] bounds together.
const GROUP: usize = 16;

/// As [`farthest`], for many triangles, of which those near each other follow each other.
///
/// Cost: one query for sixteen triangles, and for each triangle of those that may hold the
/// farthest point.
pub fn farthest_of_many(
    triangles: &[[Vec3; 3]],
    mut nearest: impl FnMut(DVec3) -> Option<Nearest>,
) -> Farthest {
    let wide = |t: &[Vec3; 3]| t.map(|p| p.as_dvec3());
    let size =
        triangles.as_flattened().iter().fold(0f32, |size, p| size.max(p.abs().max_element()));
    // No piece of a group has a greater bound.
    let mut group_bound = |group: &[[Vec3; 3]]| {
        let (centre, _) = bounding_ball(&wide(&group[0]));
        let radius = |triangle| {
            let (at, radius) = bounding_ball(&wide(triangle));
            (at - centre).length() + radius
        };
        let upper = nearest(centre).map_or(f64::INFINITY, |near| near.upper);
        (upper + group.iter().map(radius).fold(0.0, greater)) * ROUNDED_UP * ROUNDED_UP
    };
    let mut groups: Vec<(f64, &[[Vec3; 3]])> =
        triangles.chunks(GROUP).map(|group| (group_bound(group), group)).collect();
    groups.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut found = 0f64;
    let mut heap = BinaryHeap::new();
    for (bound, group) in groups {
        // The search ends at a piece with a bound of at least `found`.
        if bound < found {
            break;
        }
        heap.extend(group.iter().map(|t| bounded(wide(t), 0, &mut found, &mut nearest)));
    }
    cut_down(heap, found, size.into(), 0.0, nearest)
}

/// Cuts the piece of the largest bound until that is close to the distance `found`, or at most
/// `enough`. `size` is the largest coordinate.
fn cut_down(
    mut heap: BinaryHeap<Piece<Option<[DVec3; 3]>>>,
    mut found: f64,
    size: f64,
    enough: f64,
    mut nearest: impl FnMut(DVec3) -> Option<Nearest>,
) -> Farthest {
    let mut cuts = MAX_CUTS;
    while let Some(piece) = heap.pop() {
        let rounding = size * CUT_ROUNDING;
        let is_spent = cuts == 0 || piece.depth >= MAX_DEPTH;
        // A bound within the rounding that is added to it would gain nothing.
        if piece.bound <= (found * TOLERANCE).max(enough).max(rounding) || is_spent {
            return Farthest { lower: found, upper: piece.bound.max(found) + rounding };
        }
        cuts -= 1;
        for part in piece.parts(piece.of) {
            let part = bounded(part, piece.depth + 1, &mut found, &mut nearest);
            heap.push(Piece { bound: part.bound.min(piece.bound), ..part });
        }
    }
    Farthest { lower: found, upper: found }
}

/// Whether `budget` pieces of a triangle prove that none of its points is farther than `most` from
/// the surface of `nearest`. `about` gives cheaper, wider bounds of a point's distance, which often
/// suffice.
pub fn is_within(
    triangle: [DVec3; 3],
    most: f64,
    budget: usize,
    mut about: impl FnMut(DVec3) -> [f64; 2],
    mut nearest: impl FnMut(DVec3) -> Option<Nearest>,
) -> bool {
    let size = triangle.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let most = most - size * CUT_ROUNDING;
    let mut found = 0f64;
    // No piece is deeper than their number, so the rounding of cuts is bounded.
    let mut budget = budget.min(MAX_DEPTH as usize);
    let mut open = vec![triangle];
    while let Some(corners) = open.pop() {
        let (centre, radius) = bounding_ball(&corners);
        let [lower, upper] = about(centre);
        if lower > most || most.is_nan() || budget == 0 {
            return false;
        }
        budget -= 1;
        if (upper + radius) * ROUNDED_UP <= most {
            continue;
        }
        let piece = bounded(corners, 0, &mut found, &mut nearest);
        if found > most {
            return false;
        }
        if piece.bound > most {
            open.extend(piece.parts(piece.of));
        }
    }
    true
}

/// An interval wider than this fraction of its upper end is computed again in f64. A search could
/// not end on it.
pub(super) const WIDE: f64 = 1.0 / 64.0;

/// Where the nearest triangle of a mesh is, by the mesh's [box tree](crate::bvh::exact_blob).
pub fn nearest_in<'a>(
    tree: &'a Bvh<'a>,
    mesh: &'a Mesh,
) -> impl FnMut(DVec3) -> Option<Nearest> + 'a {
    let surface = Surface::new(tree, mesh);
    let mut scratch = surface.scratch();
    move |point| {
        let mut near = surface.near(point, &mut scratch);
        if near.upper - near.lower > WIDE * near.upper {
            near = surface.bounds_in_f64(point, near, &mut scratch);
        }
        let triangle = surface.triangles.get(near.triangle).copied();
        near.upper.is_finite().then_some(Nearest { lower: near.lower, upper: near.upper, triangle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix;
    use meshsweep_core::internal::geom::point_triangle;

    const SURFACE: [[[f64; 3]; 3]; 3] = [
        [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
        [[4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]],
        [[4.0, 0.0, 0.0], [4.0, 0.0, 3.0], [4.0, 4.0, 0.0]],
    ];

    fn nearest(p: DVec3) -> Option<Nearest> {
        let of = |t: [[f64; 3]; 3]| {
            let [a, b, c] = t.map(DVec3::from);
            (point_triangle(p, a, b, c), [a, b, c])
        };
        let (near, triangle) =
            SURFACE.map(of).into_iter().min_by(|a, b| a.0.upper.total_cmp(&b.0.upper))?;
        Some(Nearest { lower: near.lower, upper: near.upper, triangle: Some(triangle) })
    }

    #[test]
    fn a_triangle_is_within_what_its_farthest_point_is_and_no_less() {
        let about =
            |p: DVec3| nearest(p).map_or([0.0, f64::INFINITY], |n| [n.lower - 0.1, n.upper + 0.1]);
        for i in 0..500u32 {
            let at = |k: u32| f64::from(i.wrapping_mul(k) % 997) / 997.0 * 6.0 - 1.0;
            let corners =
                [[3, 17, 101], [5, 37, 211], [11, 71, 307]].map(|c| DVec3::from(c.map(at)));
            let far = farthest(std::iter::once(corners), 0.0, nearest);
            assert!(
                is_within(corners, far.upper * 1.01, 100_000, about, nearest),
                "{corners:?} {far:?}"
            );
            assert!(
                !is_within(corners, far.lower * 0.99, 100_000, about, nearest),
                "{corners:?} {far:?}"
            );
            assert!(!is_within(corners, far.upper * 1.01, 0, about, nearest));
        }
    }

    #[test]
    fn many_triangles_have_the_bounds_that_each_alone_gives() {
        let mut dice = SplitMix::new(5);
        let mut roll = || Vec3::new(dice.roll() as f32, dice.roll() as f32, dice.roll() as f32);
        for count in [1, 15, 16, 17, 1000] {
            // Runs of triangles near each other, and a few far from all.
            let mut at = Vec3::ZERO;
            let triangles: Vec<[Vec3; 3]> = (0..count)
                .map(|i| {
                    at = if i % 13 == 0 { roll() * 6.0 - 1.0 } else { at + roll() * 0.1 };
                    [at, at + roll() * 0.2, at + roll() * 0.2]
                })
                .collect();
            let each = triangles.iter().map(|t| t.map(|p| p.as_dvec3()));
            assert_eq!(farthest_of_many(&triangles, nearest), farthest(each, 0.0, nearest));
        }
    }
}
