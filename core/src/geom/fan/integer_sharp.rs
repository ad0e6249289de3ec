//! A sharper lower bound of a point and a triangle, in integers of 64 bits: for the few triangles
//! that [`integer_bounds`](super::integer_bounds()) leaves.
//!
//! Its plane is across the triangle's normal, or across the way that is orthogonal to the nearest
//! edge. The direction of `integer_bounds` is off by the rounding of the estimated point, which a
//! long needle multiplies. Proof: `core/docs/rounding.md` §8, "Whole numbers".

use super::integer::{FINE_BITS, IntPoint};
use super::integer_limit::IntLower;
use super::integer_vector::{IntVector, less};
use super::integer_weights::{ONE, weights};

type Wide = [i64; 3];

/// Bits of the components of the direction.
const DIRECTION_BITS: u32 = 15;

fn wide([x, y, z]: IntVector) -> Wide {
    [i64::from(x), i64::from(y), i64::from(z)]
}

fn dot([a, b, c]: Wide, [x, y, z]: Wide) -> i64 {
    a * x + b * y + c * z
}

/// A lower bound of the distance of a triangle. Its corners are on the grid, from the grid's
/// origin.
#[inline(never)]
pub fn sharp_lower(p: &IntPoint, &[a, b, c]: &[IntVector; 3]) -> IntLower {
    let (s, e, g) = (less(p.at, a), less(b, a), less(c, a));
    let (v, w) = weights(s, e, g);
    // From the first corner, in units of 2^-FINE_BITS.
    let offset = wide(less(p.fine(), a.map(|x| x << FINE_BITS)));
    let (rim, e, g) = (wide(less(c, b)), wide(e), wide(g));
    let away = if w == 0 {
        across(offset, e)
    } else if v == 0 {
        across(offset, g)
    } else if v + w >= ONE - 1 {
        let [x, y, z] = e.map(|x| x << FINE_BITS);
        across([offset[0] - x, offset[1] - y, offset[2] - z], rim)
    } else {
        let ([ex, ey, ez], [gx, gy, gz]) = (e, g);
        let normal = [ey * gz - ez * gy, ez * gx - ex * gz, ex * gy - ey * gx];
        if dot(normal, offset) < 0 { normal.map(|x| -x) } else { normal }
    };
    let [x, y, z] = away.map(i64::unsigned_abs);
    let size = 64 - (x | y | z).leading_zeros();
    let direction = away.map(|x| x >> size.saturating_sub(DIRECTION_BITS));
    // The point is rounded down by a unit at most, and its difference from the grid's origin by
    // two.
    let room = 3 * direction.into_iter().fold(0, |sum, x| sum + x.abs());
    let corners = dot(direction, e).max(dot(direction, g)).max(0) << FINE_BITS;
    let least = dot(direction, offset) - room;
    // In units of 16: so a product has 32 bits.
    let along = ((least - corners) >> (FINE_BITS + 4)).clamp(0, i64::from(i32::MAX));
    IntLower::new(along as i32, (dot(direction, direction) >> 8) as u32 + 1)
}

/// The part of a way that is orthogonal to an edge, times the edge's square.
fn across(offset: Wide, edge: Wide) -> Wide {
    let (square, along) = (dot(edge, edge), dot(offset, edge));
    let [x, y, z] = offset.map(|x| x * square);
    [x - along * edge[0], y - along * edge[1], z - along * edge[2]]
}
