//! The lower end of the depth: a point that is far inside both solids.
//!
//! Let a point be `a` deep in the first solid and `b` deep in the second. Balls of these radii
//! around it are inside of one solid each. After a translation by less than `a + b` the balls still
//! meet. So no shorter translation parts the solids. A point outside of one of them counts with its
//! distance as a negative depth: the sum shrinks at most as fast as the point moves.

use super::asking::Asking;
use crate::bvh::input_box::corners_of_input;
use crate::num::{greater, lesser};
use crate::query::{QueryError, Side};

type Point = [f64; 3];

/// Points that are looked at from each start, at most.
const MOST_SAMPLES: u32 = 120;

/// The first steps of the search, as a part of the smaller model's size.
const FIRST_STEP: f64 = 0.25;

/// The search ends where a step is this part of the first one.
const LAST_STEP: f64 = 1.0 / 1024.0;

/// A point, and how deep it is in both solids together.
#[derive(Clone, Copy)]
pub(super) struct Deepest {
    pub(super) point: [f32; 3],
    /// A lower bound of the sum of both depths, input units.
    pub(super) depth: f64,
    /// The ways from the nearest point of each surface. Inside they lead deeper.
    pub(super) from_surface: [Point; 2],
}

/// The deepest point that was found from two starts: the nearest points of the surfaces, and the
/// middle of what both boxes have in common.
pub(super) fn search(
    asking: &mut Asking<'_, '_>,
    near: [[f32; 3]; 2],
) -> Result<Deepest, QueryError> {
    let (middle, size) = common_box(asking);
    let [start, _] = near;
    let first = climb(asking, start, size)?;
    let second = climb(asking, middle, size)?;
    Ok(if second.depth > first.depth { second } else { first })
}

/// Goes to deeper points while there are any.
fn climb(asking: &mut Asking<'_, '_>, start: [f32; 3], size: f64) -> Result<Deepest, QueryError> {
    let mut best = sample(asking, start)?;
    let (mut step, mut samples) = (size * FIRST_STEP, 1);
    while step > size * FIRST_STEP * LAST_STEP {
        let before = best.depth;
        let [a, b] = best.from_surface.map(unit);
        let ([ax, ay, az], [bx, by, bz]) = (a, b);
        let both = unit([ax + bx, ay + by, az + bz]);
        let ways = [
            both,
            a,
            b,
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ];
        let from = best.point.map(f64::from);
        for way in ways {
            if samples >= MOST_SAMPLES || asking.is_spent() {
                return Ok(best);
            }
            let mut point = [0.0; 3];
            point.iter_mut().zip(from.iter().zip(way)).for_each(|(x, (from, way))| {
                *x = (from + way * step) as f32;
            });
            if point == best.point || !point.iter().all(|x| x.is_finite()) {
                continue;
            }
            samples += 1;
            let found = sample(asking, point)?;
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
fn sample(asking: &mut Asking<'_, '_>, point: [f32; 3]) -> Result<Deepest, QueryError> {
    let ([a, b], pose) = (asking.trees, asking.pose);
    let here = asking.signed(a, point)?;
    let in_first = -f64::from(here.distance.upper);
    let posed = pose.to_model(point)?;
    let there = asking.signed(b, posed.point)?;
    let distance = posed.distance(there.closest.distance);
    let is_inside = there.side == Side::Inside && distance.lower > 0.0;
    let in_second = f64::from(if is_inside { distance.lower } else { -distance.upper });
    let from = |near: [f32; 3], is_inside: bool| {
        let [x, y, z] = point.map(f64::from);
        let [u, v, w] = near.map(f64::from);
        let way = [x - u, y - v, z - w];
        // From outside, the way to the surface leads deeper.
        if is_inside { way } else { way.map(|x| -x) }
    };
    Ok(Deepest {
        point,
        depth: (in_first + in_second).next_down(),
        from_surface: [
            from(here.closest.point, here.side == Side::Inside),
            from(pose.to_world(there.closest.point), there.side == Side::Inside),
        ],
    })
}

/// The middle of what the boxes of both models have in common, and the size of the smaller one.
fn common_box(asking: &Asking<'_, '_>) -> ([f32; 3], f64) {
    let [a, b] = asking.trees;
    let whole = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let grown = |[mut low, mut high]: [Point; 2], corner: Point| {
        for ((low, high), x) in low.iter_mut().zip(&mut high).zip(corner) {
            *low = lesser(*low, x);
            *high = greater(*high, x);
        }
        [low, high]
    };
    let [low, high] = corners_of_input(a).fold(whole, grown);
    let moved = corners_of_input(b).map(|corner| asking.pose.carry(corner));
    let [least, most] = moved.fold(whole, grown);
    let size = |low: Point, high: Point| {
        low.into_iter().zip(high).fold(0.0, |size, (low, high)| greater(size, high - low))
    };
    let mut middle = [0.0; 3];
    let sides = low.iter().zip(&high).zip(least.iter().zip(&most));
    for (x, ((low, high), (least, most))) in middle.iter_mut().zip(sides) {
        *x = (0.5 * greater(*low, *least) + 0.5 * lesser(*high, *most)) as f32;
    }
    (middle, lesser(size(low, high), size(least, most)))
}

/// The unit vector, or nothing.
pub(super) fn unit(way: Point) -> Point {
    let [x, y, z] = way;
    let length = libm::sqrt((x * x + y * y) + z * z);
    if length > 0.0 && length.is_finite() { way.map(|x| x / length) } else { [0.0; 3] }
}
