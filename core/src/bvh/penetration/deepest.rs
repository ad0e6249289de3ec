//! The lower end of the depth: a point that is far inside both solids.
//!
//! Let a point be `a` deep in the first solid and `b` deep in the second. Balls of these radii
//! around it are inside of one solid each. After a translation by less than `a + b` the balls still
//! meet. So no shorter translation parts the solids. A point outside of one of them counts with its
//! distance as a negative depth: the sum shrinks at most as fast as the point moves.

use super::pair_queries::PairQueries;
use crate::bvh::input_box::{bounds_of, corners_of_input};
use crate::num::{greater, lesser};
use crate::query::{QueryError, Side};

type Vector = [f64; 3];

/// Vectors that are looked at from each start, at most.
const MOST_SAMPLES: u32 = 120;

/// The first steps of the search, as a fraction of the smaller model's size.
const FIRST_STEP: f64 = 0.25;

/// The search ends where a step is this fraction of the first one.
const LAST_STEP: f64 = 1.0 / 1024.0;

/// A point, and how deep it is in both solids together.
#[derive(Clone, Copy)]
pub(super) struct Deepest {
    pub(super) point: [f32; 3],
    /// A lower bound of the sum of both depths, input units.
    pub(super) depth: f64,
    /// For each surface the direction that leads deeper: from its nearest point inside, to it
    /// outside.
    pub(super) deeper: [Vector; 2],
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
    Ok(if second.depth > first.depth { second } else { first })
}

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
    let (mut step, mut samples) = (size * FIRST_STEP, 1);
    while step > size * FIRST_STEP * LAST_STEP {
        let before = best.depth;
        let [a, b] = best.deeper.map(normalized);
        let ([ax, ay, az], [bx, by, bz]) = (a, b);
        let both = normalized([ax + bx, ay + by, az + bz]);
        let directions = [both, a, b].into_iter().chain(AXES);
        let from = best.point.map(f64::from);
        for direction in directions {
            if samples >= MOST_SAMPLES || queries.is_spent() {
                return Ok(best);
            }
            let mut point = [0.0; 3];
            point.iter_mut().zip(from.iter().zip(direction)).for_each(|(x, (from, along))| {
                *x = (from + along * step) as f32;
            });
            if point == best.point || !point.iter().all(|x| x.is_finite()) {
                continue;
            }
            samples += 1;
            let found = sample(queries, point)?;
            if found.depth > best.depth {
                best = found;
                break;
            }
        }
        if best.depth <= before {
            step *= 0.5;
        }
    }
    Ok(best)
}

/// How deep a point of the first model's frame is.
fn sample(queries: &mut PairQueries<'_, '_>, point: [f32; 3]) -> Result<Deepest, QueryError> {
    let ([a, b], pose) = (queries.trees, queries.pose);
    let here = queries.signed(a, point)?;
    let in_first = -f64::from(here.distance.upper);
    let posed = pose.to_model(point)?;
    let there = queries.signed(b, posed.point)?;
    let distance = posed.distance(there.closest.distance);
    let is_inside = there.side == Side::Inside && distance.lower > 0.0;
    let in_second = f64::from(if is_inside { distance.lower } else { -distance.upper });
    let deeper = |near: [f32; 3], is_inside: bool| {
        let [x, y, z] = point.map(f64::from);
        let [u, v, w] = near.map(f64::from);
        let from = [x - u, y - v, z - w];
        if is_inside { from } else { from.map(|x| -x) }
    };
    Ok(Deepest {
        point,
        depth: (in_first + in_second).next_down(),
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
