//! The lower end of the depth: a point that is far inside both solids.
//!
//! Let a point be `a` deep in the first solid and `b` deep in the second. Balls of these radii
//! around it are inside of one solid each. After a translation by less than `a + b` the balls still
//! meet. So no shorter translation separates the solids. On its way the search passes points
//! outside: there a depth is minus the distance, and nothing is proved.

use super::pair_queries::PairQueries;
use crate::bvh::tree::input_box::{bounds_of, corners_of_input};
use crate::num::{greater, lesser};
use crate::query::{Interval, QueryError, Side};

type Vector = [f64; 3];

/// Most points that a climb asks about, before those beyond walls ([`BEYOND`]).
const MOST_SAMPLES: u32 = 160;

/// The first steps of the search, as a fraction of the smaller model's size.
const FIRST_STEP: f64 = 0.25;

/// The search ends where a step is this fraction of the first one.
const LAST_STEP: f64 = 1.0 / 1024.0;

/// How far a last point goes beyond a wall, as fractions of the smaller model's size.
const BEYOND: [f64; 3] = [1.0 / 4096.0, 1.0 / 512.0, 1.0 / 64.0];

/// A point, and how deep it is in both solids together.
#[derive(Clone, Copy)]
pub(super) struct Deepest {
    pub(super) point: [f32; 3],
    /// A lower bound of the sum of both depths, input units.
    pub(super) depth: f64,
    /// Lower bounds of both depths. Positive ones are proved.
    depths: [f64; 2],
    /// For each surface the direction that leads deeper: from its nearest point inside, to it
    /// outside.
    pub(super) deeper: [Vector; 2],
}

impl Deepest {
    /// The deeper point; one that is proved to be inside both before all others.
    fn deeper_of(self, other: Deepest) -> Deepest {
        let is_other = (other.is_inside(), other.depth) > (self.is_inside(), self.depth);
        if is_other { other } else { self }
    }

    /// Whether it is proved to be inside both.
    fn is_inside(&self) -> bool {
        let [first, second] = self.depths;
        first > 0.0 && second > 0.0
    }

    /// What it proves of the depth of the solids.
    pub(super) fn proved(&self) -> f64 {
        if self.is_inside() { greater(self.depth, 0.0) } else { 0.0 }
    }
}

/// The deeper of two points. One search starts at the first surface's nearest point, the other at
/// the middle of what both boxes have in common.
pub(super) fn search(
    queries: &mut PairQueries<'_, '_>,
    start: [f32; 3],
) -> Result<Deepest, QueryError> {
    let (middle, size) = common_box(queries);
    let first = climb(queries, start, size)?;
    let second = climb(queries, middle, size)?;
    Ok(first.deeper_of(second))
}

/// A third of the root of three, rounded: the entries of a unit vector along a diagonal.
const D: f64 = 0.577_350_269_189_625_8;

/// Directions into the corners: a wedge between two walls may hold no axis.
pub(super) const DIAGONALS: [Vector; 8] = [
    [D, D, D],
    [-D, D, D],
    [D, -D, D],
    [-D, -D, D],
    [D, D, -D],
    [-D, D, -D],
    [D, -D, -D],
    [-D, -D, -D],
];

/// Both directions along each axis.
pub(super) const AXES: [Vector; 6] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
];

/// Goes to deeper points while there are any.
fn climb(
    queries: &mut PairQueries<'_, '_>,
    start: [f32; 3],
    size: f64,
) -> Result<Deepest, QueryError> {
    let mut best = sample(queries, start)?;
    let mut proved = best;
    let (mut step, mut samples) = (size * FIRST_STEP, 1);
    'climb: while step > size * FIRST_STEP * LAST_STEP {
        let before = best.depth;
        let [a, b] = best.deeper.map(normalized);
        let ([ax, ay, az], [bx, by, bz]) = (a, b);
        let both = normalized([ax + bx, ay + by, az + bz]);
        let directions = [both, a, b].into_iter().chain(AXES).chain(DIAGONALS);
        let from = best.point;
        for direction in directions {
            if samples >= MOST_SAMPLES || queries.is_spent() {
                break 'climb;
            }
            let Some(point) = moved(from, direction, step) else { continue };
            samples += 1;
            let found = sample(queries, point)?;
            proved = proved.deeper_of(found);
            if found.depth > best.depth {
                best = found;
                break;
            }
        }
        if best.depth <= before {
            step *= 0.5;
        }
    }
    // A point outside of one solid, and far inside the other: across the wall is one inside both.
    for (depth, deeper) in best.depths.into_iter().zip(best.deeper) {
        if proved.is_inside() || depth > 0.0 {
            continue;
        }
        for beyond in BEYOND {
            let across = size * beyond - depth;
            if let Some(point) = moved(best.point, normalized(deeper), across) {
                proved = proved.deeper_of(sample(queries, point)?);
            }
        }
    }
    Ok(proved)
}

/// A point moved along a unit vector. `None` if f32 has no such point.
pub(super) fn moved(point: [f32; 3], direction: Vector, length: f64) -> Option<[f32; 3]> {
    let mut moved = point;
    let sides = moved.iter_mut().zip(direction);
    sides.for_each(|(x, along)| *x = (f64::from(*x) + along * length) as f32);
    (moved != point && moved.iter().all(|x| x.is_finite())).then_some(moved)
}

/// How deep a point of the first model's frame is.
fn sample(queries: &mut PairQueries<'_, '_>, point: [f32; 3]) -> Result<Deepest, QueryError> {
    let ([a, b], pose) = (queries.trees, queries.pose);
    let here = queries.signed(a, point)?;
    let posed = pose.to_model(point)?;
    let there = queries.signed(b, posed.point)?;
    let depth = |side: Side, distance: Interval| {
        let is_inside = side == Side::Inside && distance.lower > 0.0;
        f64::from(if is_inside { distance.lower } else { -distance.upper })
    };
    let in_first = depth(here.side, here.closest.distance);
    let in_second = depth(there.side, posed.distance(there.closest.distance));
    let deeper = |near: [f32; 3], is_inside: bool| {
        let [x, y, z] = point.map(f64::from);
        let [u, v, w] = near.map(f64::from);
        let from = [x - u, y - v, z - w];
        if is_inside { from } else { from.map(|x| -x) }
    };
    Ok(Deepest {
        point,
        depth: (in_first + in_second).next_down(),
        depths: [in_first, in_second],
        deeper: [
            deeper(here.closest.point, here.side == Side::Inside),
            deeper(pose.to_world(there.closest.point), there.side == Side::Inside),
        ],
    })
}

/// The middle of what the boxes of both models have in common, and the size of the smaller one.
fn common_box(queries: &PairQueries<'_, '_>) -> ([f32; 3], f64) {
    let [a, b] = queries.trees;
    let [low, high] = bounds_of(corners_of_input(a));
    let [least, most] = bounds_of(corners_of_input(b).map(|corner| queries.pose.carry(corner)));
    let size = |low: Vector, high: Vector| {
        low.into_iter().zip(high).fold(0.0, |size, (low, high)| greater(size, high - low))
    };
    let mut middle = [0.0; 3];
    let sides = low.iter().zip(&high).zip(least.iter().zip(&most));
    for (x, ((low, high), (least, most))) in middle.iter_mut().zip(sides) {
        *x = (0.5 * greater(*low, *least) + 0.5 * lesser(*high, *most)) as f32;
    }
    (middle, lesser(size(low, high), size(least, most)))
}

/// The vector divided by its length; zero if it has none.
pub(super) fn normalized(vector: Vector) -> Vector {
    let [x, y, z] = vector;
    let length = libm::sqrt((x * x + y * y) + z * z);
    if length > 0.0 && length.is_finite() { vector.map(|x| x / length) } else { [0.0; 3] }
}
