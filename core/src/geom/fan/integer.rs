//! A point and a triangle in integers of 32 bits: for processors without floating point, on which
//! the f32 kernel costs twenty times as much.
//!
//! The closest point is only estimated. Two bounds are certain whatever the estimate is worth. The
//! triangle is not farther than the estimated point, which lies on it. And it is not nearer than
//! the plane through its nearest corner across the way to the estimated point. A sliver may get a
//! weak lower bound, and the f32 kernel then decides. Proof: `core/docs/rounding.md` §8, "Whole
//! numbers".

use super::integer_limit::IntLower;
use super::integer_vector::{IntVector, as_long_as, dot, largest, less, norm_1};
use super::integer_weights::{ONE, WEIGHT_BITS, weights};
use crate::num::{bit_length as bits, each, floored};

/// The corner of a triangle that a point near the closest one is.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// 0, 1 or 2; 3 if it is none.
    pub number: u8,
    /// Whether [`is_certain`](super::CornerWay::is_certain) of a corner's way is known to hold.
    pub is_certain: bool,
}

impl Corner {
    /// No corner.
    pub const NONE: Corner = Corner::new(3);

    /// A corner that may be certain.
    #[inline(always)]
    pub const fn new(number: u8) -> Corner {
        Corner { number, is_certain: false }
    }

    /// A corner that is.
    #[inline(always)]
    pub const fn certain(number: u8) -> Corner {
        Corner { number, is_certain: true }
    }
}

/// Bits of a coordinate below a grid unit.
pub(super) const FRACTION_BITS: u32 = 3;
/// Bits of the finest coordinate below a grid unit.
pub(super) const FINE_BITS: u32 = 9;
/// Coordinates of a [`IntPoint`] are below 2^this grid units in magnitude.
pub const WHOLE_BITS: u32 = 17;
/// Bits of the components of a direction.
const DIRECTION_BITS: u32 = 12;

/// A query point: grid units from the grid's origin.
#[derive(Clone, Copy, Debug)]
pub struct IntPoint {
    /// Rounded down.
    pub at: IntVector,
    /// Eighths above `at`, 0 to 7, rounded down.
    pub eighths: IntVector,
    /// Units of 2^-[`FINE_BITS`] above those, rounded down. Bytes: targets with an FPU copy them
    /// too.
    rest: [u8; 3],
}

impl IntPoint {
    /// `None` if the point is too far from the grid's origin.
    #[inline(always)]
    pub fn new(p: [f32; 3]) -> Option<IntPoint> {
        let is_near = |x: f32| x.to_bits() << 1 >> 24 < 127 + WHOLE_BITS;
        let [x, y, z] = p;
        if !(is_near(x) && is_near(y) && is_near(z)) {
            return None;
        }
        let fine = each(p, |x| floored(x, FINE_BITS.cast_signed()));
        Some(IntPoint {
            at: each(fine, |x| x >> FINE_BITS),
            eighths: each(fine, |x| x >> (FINE_BITS - FRACTION_BITS) & ((1 << FRACTION_BITS) - 1)),
            rest: each(fine, |x| (x & ((1 << (FINE_BITS - FRACTION_BITS)) - 1)) as u8),
        })
    }

    /// In units of 2^-[`FINE_BITS`], rounded down.
    pub(super) fn fine(&self) -> IntVector {
        let mut fine = self.at;
        for ((x, eighths), rest) in fine.iter_mut().zip(self.eighths).zip(self.rest) {
            *x = ((*x << FRACTION_BITS) + eighths) << (FINE_BITS - FRACTION_BITS);
            *x += i32::from(rest);
        }
        fine
    }

    /// The way from a vertex in eighths.
    #[inline(always)]
    pub(super) fn eighths_from(&self, vertex: IntVector) -> IntVector {
        let ([x, y, z], [i, j, k]) = (less(self.at, vertex), self.eighths);
        [(x << FRACTION_BITS) + i, (y << FRACTION_BITS) + j, (z << FRACTION_BITS) + k]
    }

    /// About the squared distance of a vertex, for comparison.
    #[inline(always)]
    pub fn about(&self, vertex: IntVector) -> u32 {
        let offset = each(less(self.at, vertex), |x| x >> 4);
        dot(offset, offset).cast_unsigned()
    }

    /// A product of the point and a direction of twelve bits: not above the true one.
    #[inline(always)]
    pub fn along(&self, direction: IntVector) -> i32 {
        self.along_way(direction, self.at)
    }

    /// The same of the way from a vertex: `at` is [`Self::at`] less that.
    ///
    /// The eighths are rounded down. So the true point may lie an eighth farther along any axis,
    /// which counts where the direction is negative. The difference before was rounded too, by 2^-8
    /// at most. There is room for 2^-7 more.
    #[inline(always)]
    fn along_way(&self, direction: IntVector, at: IntVector) -> i32 {
        let all = norm_1(direction);
        let [x, y, z] = direction;
        // What is negative counts twice in the difference.
        let against = (all - (x + y + z)) >> 1;
        let eighths = dot(direction, self.eighths).wrapping_sub(against) >> FRACTION_BITS;
        dot(direction, at).wrapping_add(eighths).wrapping_sub(((3 * all) >> 8) + 1)
    }
}

/// What integers tell of a point and a triangle.
#[derive(Clone, Copy, Debug)]
pub struct IntBounds {
    /// The bits of a squared distance, square grid units: the triangle is not farther. That is so
    /// of the estimated point.
    pub upper: u32,
    /// From the estimated point to the query, of twelve bits.
    pub direction: IntVector,
    /// The corner that the estimated point is.
    pub corner: Corner,
    /// The number of the triangle in its leaf, or that of another one with the same bounds.
    pub first: u8,
    /// By the plane across the direction.
    pub lower: IntLower,
}

impl IntBounds {
    /// Of a triangle that nothing is known of, and that is looked at last.
    pub const NONE: IntBounds = IntBounds {
        upper: u32::MAX,
        direction: [0; 3],
        corner: Corner::NONE,
        first: 0,
        lower: IntLower::NONE,
    };

    /// A place for some: bits of zeros.
    pub const ZERO: IntBounds = IntBounds { upper: 0, corner: Corner::new(0), ..IntBounds::NONE };
}

/// Bounds of the distance of a triangle. Its corners are on the grid, from the grid's origin.
#[inline(never)]
pub fn integer_bounds(p: &IntPoint, [a, b, c]: &[IntVector; 3], bounds: &mut IntBounds) {
    let (s, e, g) = (less(p.at, *a), less(*b, *a), less(*c, *a));
    let (v, w) = weights(s, e, g);
    let along = |s: i32, eighths: i32, e: i32, g: i32| {
        let inside = v.wrapping_mul(e).wrapping_add(w.wrapping_mul(g));
        (s << FRACTION_BITS)
            .wrapping_add(eighths)
            .wrapping_sub(inside >> (WEIGHT_BITS - FRACTION_BITS))
    };
    let ([sx, sy, sz], [i, j, k], [ex, ey, ez], [gx, gy, gz]) = (s, p.eighths, e, g);
    upper_bound([along(sx, i, ex, gx), along(sy, j, ey, gy), along(sz, k, ez, gz)], bounds);
    let direction = bounds.direction;
    bounds.corner = match (v, w) {
        (0, 0) => Corner::new(0),
        (ONE, 0) => Corner::new(1),
        (0, ONE) => Corner::new(2),
        _ => Corner::NONE,
    };
    let farthest = dot(direction, e).max(dot(direction, g)).max(0);
    let along = p.along_way(direction, s).wrapping_sub(farthest);
    let direction_sq = dot(direction, direction).cast_unsigned();
    bounds.lower = IntLower::new(along, direction_sq);
}

/// Upper bound and direction of a point, which is the corner of a triangle.
#[inline(always)]
pub fn vertex_bounds(p: &IntPoint, vertex: IntVector, bounds: &mut IntBounds) {
    upper_bound(p.eighths_from(vertex), bounds);
}

/// Upper bound and direction of a way from a point of a triangle, in eighths.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn upper_bound(offset: IntVector, bounds: &mut IntBounds) {
    let size = bits(as_long_as(offset));
    let down = size.saturating_sub(DIRECTION_BITS);
    let direction = each(offset, |x| x >> down);
    // Along an axis the way is less than two eighths longer. Squares of 14 bits, rounded up: their
    // sum is below 2^30.
    let cut = size.saturating_sub(14);
    let square = each(offset, |x| (x.abs() + 1 + (1 << cut)) >> cut);
    let square = dot(square, square).cast_unsigned();
    let up = 32 - bits(square);
    let exponent = (127 + 30 - 2 * FRACTION_BITS + 2 * cut).wrapping_sub(up);
    bounds.upper = (exponent << 23) + ((square << (up & 31)) >> 8) + 1;
    bounds.direction = direction;
}

/// Whether the point is in front of a triangle: its corners run counter-clockwise seen from there.
/// `None` where the f32 kernel may not decide the same, because of its own roundings.
#[inline(never)]
pub fn is_in_front(p: &IntPoint, [a, b, c]: &[IntVector; 3]) -> Option<bool> {
    let offset = p.eighths_from(*a);
    let (e, g) = (less(*b, *a), less(*c, *a));
    let product = |x: i32, y: i32| i64::from(x) * i64::from(y);
    let ([ex, ey, ez], [gx, gy, gz]) = (e, g);
    let normal = [
        product(ey, gz) - product(ez, gy),
        product(ez, gx) - product(ex, gz),
        product(ex, gy) - product(ey, gx),
    ];
    let (mut volume, mut size) = (0, 0);
    for (n, x) in normal.into_iter().zip(offset) {
        volume += n * i64::from(x);
        size += n.abs();
    }
    let products = product(norm_1(e), norm_1(g));
    let rounding = ((products >> 10) + 1) * i64::from((largest(offset) >> 9) + 1);
    let room = 2 * size + rounding;
    if volume.abs() > room { Some(volume > 0) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::fan::{CornerWay, IntLimit, sharp_lower};
    use crate::geom::fan::{Nearness, PointFan};
    use crate::num::noise::Noise;
    use glam::Vec3;

    /// Squared distance in f64, by the kernel of the hull hierarchy.
    fn exact(p: [f64; 3], corners: &[IntVector; 3]) -> f64 {
        let at = |v: [f64; 3]| glam::DVec3::from_array(v);
        let [a, b, c] = corners.map(|v| at(v.map(f64::from)));
        crate::geom::point_triangle(at(p), a, b, c).distance_sq
    }

    fn bounds_of(point: &IntPoint, corners: &[IntVector; 3]) -> IntBounds {
        let mut bounds = IntBounds::NONE;
        integer_bounds(point, corners, &mut bounds);
        bounds
    }

    impl Noise {
        fn below(&mut self, most: u32) -> i32 {
            ((self.bits() >> 33) % u64::from(most)) as i32
        }

        fn whole(&mut self, size: u32) -> IntVector {
            [(); 3].map(|()| self.below(2 * size + 1) - size.cast_signed())
        }
    }

    /// A triangle of about `size` units on the grid; some are needles, some are points.
    fn triangle(noise: &mut Noise, size: u32) -> [IntVector; 3] {
        let clamp = |v: IntVector| v.map(|x| x.clamp(0, 0xFFFF));
        let a = [(); 3].map(|()| noise.below(0x1_0000));
        let add = |d: IntVector| clamp([a[0] + d[0], a[1] + d[1], a[2] + d[2]]);
        let e = noise.whole(size);
        let g = match noise.below(4) {
            0 => e.map(|x| x / 2 + noise.below(3) - 1),
            1 => noise.whole(1 + size / 50),
            _ => noise.whole(size),
        };
        [a, add(e), add(g)]
    }

    #[test]
    fn a_triangle_beyond_a_limit_is_beyond_it_and_few_are_missed() {
        let mut noise = Noise(11);
        let (mut proved, mut all, mut counts) = (0, 0, [0; 3]);
        for round in 0..400_000 {
            let size = 1 << (round % 17);
            let corners = triangle(&mut noise, size);
            let away = 1 << noise.below(17);
            let near = corners[noise.below(3) as usize];
            let off = noise.whole(away).map(|x| x as f32 + noise.below(1000) as f32 / 1000.0);
            // The grid's origin, from which the query computes the point with one rounding.
            let origin = -noise.below(100_000) as f32;
            let p = [0, 1, 2].map(|k| near[k] as f32 + off[k] + origin);
            let Some(point) = IntPoint::new(p.map(|x| x - origin)) else { continue };
            let p = p.map(|x| f64::from(x) - f64::from(origin));
            let square = exact(p, &corners);
            let (bounds, sharp) = (bounds_of(&point, &corners), sharp_lower(&point, &corners));
            assert!(square <= f64::from(f32::from_bits(bounds.upper)), "{p:?} {corners:?}");
            for share in [0.5, 0.9, 0.99, 0.999, 1.0, 1.000_01, 1.1] {
                let limit = (square * share) as f32;
                if limit < f32::MIN_POSITIVE {
                    continue;
                }
                let is_beyond = bounds.lower.is_beyond(IntLimit::of(limit));
                assert!(!is_beyond || square > f64::from(limit), "{share}: {p:?} {corners:?}");
                let is_sharp = sharp.is_beyond(IntLimit::of(limit));
                assert!(!is_sharp || square > f64::from(limit), "{share}: {p:?} {corners:?}");
                let is_inner = bounds.corner.number == Corner::NONE.number;
                if share == 0.999 && square > 1e4 && is_inner {
                    counts[0] += 1;
                    counts[1] += i32::from(is_beyond);
                    counts[2] += i32::from(is_sharp);
                }
                if share == 0.9 && square > 100.0 {
                    all += 1;
                    proved += i32::from(is_beyond);
                }
            }
        }
        assert!(proved * 10 > all * 9, "{proved} of {all}");
        // With a limit that is a thousandth less than the square, and no nearest corner.
        let [all, plain, sharp] = counts;
        assert!(sharp * 20 > all * 17 && 2 * plain < sharp, "{plain} and {sharp} of {all}");
    }

    #[test]
    fn a_certain_corner_is_the_kernels_and_few_are_missed() {
        let mut noise = Noise(13);
        let (mut certain, mut clear) = (0, 0);
        for round in 0..300_000 {
            let corners = triangle(&mut noise, 1 << (round % 17));
            let which = noise.below(3) as usize;
            let vertex = corners[which];
            let others = [corners[(which + 1) % 3], corners[(which + 2) % 3]];
            let to_others = others.map(|other| less(other, vertex));
            let away = 1 << noise.below(17);
            let off = noise.whole(away);
            let origin = -noise.below(100_000) as f32;
            let part = noise.below(1000) as f32 / 1000.0;
            let p = [0, 1, 2].map(|k| (vertex[k] + off[k]) as f32 + part + origin);
            let Some(point) = IntPoint::new(p.map(|x| x - origin)) else { continue };
            // Twice the room: within 20 units of a wall of the corner's region none is certain.
            let far = |edge: &IntVector| {
                let size = f64::from(edge.map(i32::abs).into_iter().sum::<i32>());
                f64::from(dot(*edge, off.map(|x| x.clamp(-8000, 8000)))) < -20.0 * size
            };
            let way = CornerWay::new(&point, vertex);
            let [one, other] = to_others.map(|edge| way.edge(edge));
            let is_certain = way.is_certain(one, other);
            if round % 17 < 12 && off.iter().all(|x| x.abs() < 8000) && to_others.iter().all(far) {
                clear += 1;
                certain += i32::from(is_certain);
            }
            if is_certain {
                let at = |v: IntVector| Vec3::from_array(v.map(|x| x as f32 + origin));
                let edge = |v: IntVector| Vec3::from_array(less(v, corners[0]).map(|x| x as f32));
                let s = Vec3::from_array(p) - at(corners[0]);
                let fan = PointFan::new(s);
                let [e, g] = [edge(corners[1]), edge(corners[2])];
                let near = fan.triangle(&fan.spoke(e), &fan.spoke(g));
                let offset = [s, s - e, s - g][which];
                let distance_sq = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
                let (v, w) = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)][which];
                let expected = Nearness { distance_sq, lower_bound_sq: distance_sq, v, w };
                assert_eq!(near, expected, "{p:?} {corners:?}");
            }
        }
        assert!(certain * 10 > clear * 9 && clear > 10_000, "{certain} of {clear}");
    }

    #[test]
    fn the_nearest_of_two_triangles_has_the_lesser_upper_bound() {
        let mut noise = Noise(12);
        let (mut right, mut all) = (0, 0);
        for _ in 0..100_000 {
            let size = 1 << noise.below(14);
            let [one, two] = [(); 2].map(|()| triangle(&mut noise, size));
            let p = [(); 3].map(|()| noise.below(0x1_0000) as f32);
            let point = IntPoint::new(p).expect("in range");
            let [near, far] =
                [one, two].map(|t| (exact(p.map(f64::from), &t), bounds_of(&point, &t).upper));
            if near.0 > 1.02 * far.0 || far.0 > 1.02 * near.0 {
                all += 1;
                right += i32::from((near.0 < far.0) == (near.1 < far.1));
            }
        }
        assert!(right * 100 > all * 99, "{right} of {all}");
    }

    /// The test in f32 is that of `bvh/point/side/viewed_side.rs`.
    #[test]
    fn a_side_by_integers_is_the_one_that_f32_is_sure_of_and_few_are_missed() {
        const U32: f32 = 1.0 / (1u32 << 24) as f32;
        let mut noise = Noise(23);
        let (mut told, mut all) = (0, 0);
        for round in 0..400_000 {
            let size = 1 << (round % 17);
            let corners = triangle(&mut noise, size);
            let away = 1 << noise.below(17);
            let near = corners[noise.below(3) as usize];
            let off = noise.whole(away).map(|x| x as f32 + noise.below(1000) as f32 / 1000.0);
            let origin = -noise.below(100_000) as f32;
            let p = [0, 1, 2].map(|k| near[k] as f32 + off[k] + origin);
            let Some(point) = IntPoint::new(p.map(|x| x - origin)) else { continue };
            let [a, b, c] = corners.map(|v| Vec3::from_array(v.map(|x| x as f32)));
            let (s, e, g) = (Vec3::from_array(p) - (a + origin), b - a, c - a);
            let volume = e.cross(g).dot(s);
            let (x, y) = (e.abs(), g.abs());
            let size =
                Vec3::new(x.y * y.z + x.z * y.y, x.z * y.x + x.x * y.z, x.x * y.y + x.y * y.x);
            let is_sure = volume.abs() > 16.0 * U32 * size.dot(s.abs()) * 1.01;
            let front = is_in_front(&point, &corners);
            if let Some(front) = front {
                assert!(is_sure && front == (volume > 0.0), "{p:?} {corners:?}");
            }
            (told, all) = (told + u32::from(front.is_some()), all + u32::from(is_sure));
        }
        assert!(10 * told > 9 * all, "{told} of {all}");
    }
}
