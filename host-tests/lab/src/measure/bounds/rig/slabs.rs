//! Slabs in f32: their ranges about moved points, and the comparisons.

use glam::DVec3;
use meshsweep_core::Tribox;

use super::{Motion, Moving, Rig, single};
use crate::measure::bounds::dop::Slabs;

/// Extents along N directions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ranges<const N: usize> {
    low: [f32; N],
    high: [f32; N],
}

impl<const N: usize> Ranges<N> {
    const EMPTY: Self = Self { low: [f32::INFINITY; N], high: [f32::NEG_INFINITY; N] };

    #[inline(always)]
    fn of(points: impl Iterator<Item = [f32; 3]>, along: impl Fn([f32; 3]) -> [f32; N]) -> Self {
        points.fold(Self::EMPTY, |mut all, point| {
            let here = along(point);
            for ((low, high), x) in all.low.iter_mut().zip(&mut all.high).zip(here) {
                *low = if x < *low { x } else { *low };
                *high = if x > *high { x } else { *high };
            }
            all
        })
    }

    #[inline(always)]
    fn meets(&self, other: &Self) -> bool {
        let other = other.low.iter().zip(&other.high);
        self.low
            .iter()
            .zip(&self.high)
            .zip(other)
            .all(|((low, high), (other_low, other_high))| (low <= other_high) & (other_low <= high))
    }
}

/// Slabs about the moved points: a hull's vertices, or the slabs' own. Directions as in [`Slabs`];
/// no product, sums are shared.
pub fn about(slabs: &Slabs, points: &[DVec3], hull: &[DVec3]) -> Option<Box<dyn Rig>> {
    let corners = |[x, y, z]: [f32; 3]| {
        let (sum, difference) = (x + y, x - y);
        [sum + z, sum - z, difference + z, z - difference]
    };
    let edges = |[x, y, z]: [f32; 3]| [x + y, x - y, y + z, y - z, x + z, z - x];
    Some(match slabs.label {
        "box" => rig(points, hull, |p| p),
        "14-DOP" => rig(points, hull, move |p: [f32; 3]| join::<3, 4, 7>(p, corners(p))),
        "tribox" => rig(points, hull, move |p| join::<3, 6, 9>(p, edges(p))),
        "24-DOP" => rig(points, hull, move |p| {
            let [_, b, c, d] = corners(p);
            join::<9, 3, 12>(join::<3, 6, 9>(p, edges(p)), [b, c, d])
        }),
        "26-DOP" => {
            rig(points, hull, move |p| join::<7, 6, 13>(join::<3, 4, 7>(p, corners(p)), edges(p)))
        }
        _ => return None,
    })
}

#[inline(always)]
fn join<const A: usize, const B: usize, const N: usize>(a: [f32; A], b: [f32; B]) -> [f32; N] {
    const { assert!(A + B == N) };
    std::array::from_fn(|k| if k < A { a[k] } else { b[k - A] })
}

fn rig<const N: usize>(
    points: &[DVec3],
    hull: &[DVec3],
    along: impl Fn([f32; 3]) -> [f32; N] + 'static,
) -> Box<dyn Rig> {
    let rest = Ranges::of(hull.iter().map(|p| single(*p)), &along);
    let points: Vec<[f32; 3]> = points.iter().map(|p| single(*p)).collect();
    let update = move |motion: &Motion| Ranges::of(points.iter().map(|p| motion.apply(*p)), &along);
    Box::new(Moving::new(rest, update, Ranges::meets))
}

/// The box about a moved box: its centre moves, and the matrix's absolute values take half its
/// extents to the new ones (Arvo 1990). The same as about its eight corners.
#[must_use]
pub fn box_about_box(hull: &[DVec3]) -> Box<dyn Rig> {
    let rest = Ranges::of(hull.iter().map(|p| single(*p)), |p| p);
    let at = |k: usize, sign: f32| 0.5 * rest.high[k] + sign * 0.5 * rest.low[k];
    let (centre, half) = ([0, 1, 2].map(|k| at(k, 1.0)), [0, 1, 2].map(|k| at(k, -1.0)));
    let update = move |motion: &Motion| {
        let middle = motion.apply(centre);
        let reach = motion
            .matrix
            .rotation
            .map(|[a, b, c]| a.abs() * half[0] + b.abs() * half[1] + c.abs() * half[2]);
        Ranges {
            low: [0, 1, 2].map(|k| middle[k] - reach[k]),
            high: [0, 1, 2].map(|k| middle[k] + reach[k]),
        }
    };
    Box::new(Moving::new(rest, update, Ranges::meets))
}

/// The library's triboxes, every parameter rounded outward, about a hull's moved vertices.
#[must_use]
pub fn outward_about_hull(rest: Tribox, hull: &[DVec3]) -> Box<dyn Rig> {
    let points: Vec<[f32; 3]> = hull.iter().map(|p| single(*p)).collect();
    // Empty, were it refused: that meets nothing, and the f64 verdicts would tell.
    let update =
        move |motion: &Motion| motion.matrix.bound(points.iter().copied()).unwrap_or(Tribox::EMPTY);
    Box::new(Moving::new(rest, update, Tribox::overlaps))
}

/// The library's triboxes about their own moved vertices, which are computed anew from the eighteen
/// parameters.
#[must_use]
pub fn outward_about_own(rest: Tribox) -> Box<dyn Rig> {
    let update = move |motion: &Motion| rest.moved(&motion.matrix).unwrap_or(Tribox::EMPTY);
    Box::new(Moving::new(rest, update, Tribox::overlaps))
}
