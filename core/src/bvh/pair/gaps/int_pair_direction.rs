//! Leaves along a direction in integers.
//!
//! Stored vertices and the direction are integers, so heights are exact. `core/docs/rounding.md`
//! §26, *Along w* and *Rounding along w*.

use crate::bvh::pair::direction::IntDirection;
use crate::bvh::tree::format::FanLeaf;
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{INT_DIRECTION_BITS, U32};
use crate::num::{dot, greater, sqrt_approx};
use crate::query::VertexPose;
use glam::Vec3;

/// A direction in integers, in the grids of both models.
pub(crate) struct IntPairDirection<'a> {
    pose: &'a VertexPose,
    /// From the first model to the second, in the first grid.
    direction: [i64; 3],
    /// The other way round, in the second grid, rounded up.
    back: [i64; 3],
    /// The length of one unit of `back` in units of `direction`.
    back_unit: f64,
    /// The height of the second grid's origin along `direction`.
    shift: f64,
    /// Upper bound of the length of `direction`.
    length: f64,
    /// Pairs with heights that add up to no more than this are far enough apart.
    least_sum: f64,
    /// The last leaf of each model.
    kept: [IntTops; 2],
}

impl<'a> IntPairDirection<'a> {
    /// The direction of an offset from point to point, common units. `None` if it is zero, or very
    /// long or short.
    pub(crate) fn new(pose: &'a VertexPose, offset: [f64; 3]) -> Option<IntPairDirection<'a>> {
        let (direction, _) = rounded_up(offset)?;
        let [x, y, z] = direction.map(|x| x as f64);
        IntPairDirection::along(pose, direction, libm::sqrt((x * x + y * y) + z * z))
    }

    /// Any direction in f32.
    pub(crate) fn of(pose: &'a VertexPose, direction: Vec3) -> Option<IntPairDirection<'a>> {
        let integers = IntDirection::of(direction)?;
        let [x, y, z] = integers.vector.map(|x| x as f32);
        let vector = Vec3::new(x, y, z);
        let length = sqrt_approx(dot(vector, vector)) * (1.0 + 16.0 * U32);
        IntPairDirection::along(pose, integers.vector.map(i64::from), f64::from(length))
    }

    /// `length` is not less than that of `direction`.
    #[inline(never)]
    fn along(
        pose: &'a VertexPose,
        direction: [i64; 3],
        length: f64,
    ) -> Option<IntPairDirection<'a>> {
        let [x, y, z] = direction.map(|x| x as f64);
        let VertexPose { matrix: [r, s, t], shift_f64: [u, v, w], .. } = *pose;
        let column = |k: usize| {
            let along = |row: &[f32; 3]| f64::from(row.get(k).copied().unwrap_or(0.0));
            -((x * along(&r) + y * along(&s)) + z * along(&t))
        };
        let (back, back_unit) = rounded_up([column(0), column(1), column(2)])?;
        Some(IntPairDirection {
            pose,
            direction,
            back,
            back_unit,
            shift: (x * u + y * v) + z * w,
            length,
            least_sum: f64::NEG_INFINITY,
            kept: [IntTops::NONE; 2],
        })
    }

    /// From now on pairs at least this far apart count as beyond, common units.
    pub(crate) fn set_far(&mut self, far: f64) {
        self.least_sum = self.shift - far * self.length;
    }

    /// Whether two triangles are at least so far apart, common units.
    pub(crate) fn is_beyond(
        &self,
        far: f64,
        [first, second]: [&FanLeaf<'_>; 2],
        [i, j]: [TriangleAt; 2],
    ) -> Option<bool> {
        let [unit, _] = self.pose.units.map(f64::from);
        let top = top_of(first, i.lane(), self.direction)?;
        let back = top_of(second, j.lane(), self.back)?;
        let least_sum = self.shift - far * self.length;
        Some(least_sum - back as f64 * self.back_unit >= top as f64 * unit)
    }

    /// The bits of the pairs of triangles that are far enough apart. All bits are ones if all pairs
    /// are.
    pub(crate) fn pairs_beyond(
        &mut self,
        [first, second]: [&FanLeaf<'_>; 2],
        [a, b]: [TriangleAt; 2],
    ) -> Option<u64> {
        let [unit, _] = self.pose.units.map(f64::from);
        let [tops, backs] = &mut self.kept;
        tops.set(a, first, self.direction)?;
        backs.set(b, second, self.back)?;
        let top = |x: i64| x as f64 * unit;
        let back = |x: i64| self.least_sum - x as f64 * self.back_unit;
        let least = back(backs.most);
        if least >= top(tops.most) {
            return Some(u64::MAX);
        }
        let backs = backs.each.map(back);
        let mut pairs = 0;
        for (i, &top_of) in tops.each.iter().enumerate() {
            let top = top(top_of);
            if least >= top {
                pairs |= 0xFF << (i * WIDTH);
                continue;
            }
            for (j, back) in backs.iter().enumerate() {
                pairs |= u64::from(*back >= top) << (i * WIDTH + j);
            }
        }
        Some(pairs)
    }
}

/// The greatest height of a triangle along a direction in integers.
fn top_of(leaf: &FanLeaf<'_>, lane: usize, [x, y, z]: [i64; 3]) -> Option<i64> {
    let corners = leaf.grid_ring()?.corners(lane, leaf.shape().turn())?;
    let heights = corners.map(|[p, q, r]| i64::from(p) * x + i64::from(q) * y + i64::from(r) * z);
    Some(heights.into_iter().fold(i64::MIN, greater))
}

/// The greatest heights of a leaf and of its triangles along a direction in integers.
struct IntTops {
    of: TriangleAt,
    most: i64,
    each: [i64; WIDTH],
}

impl IntTops {
    const NONE: IntTops = IntTops { of: TriangleAt::NONE, most: 0, each: [0; WIDTH] };

    /// Computes the heights of a leaf, unless they are those of this leaf already.
    #[inline(never)]
    fn set(&mut self, of: TriangleAt, leaf: &FanLeaf<'_>, direction: [i64; 3]) -> Option<()> {
        if self.of == of {
            return Some(());
        }
        let ring = leaf.grid_ring()?;
        let [x, y, z] = direction;
        let height = |[p, q, r]: [i32; 3]| i64::from(p) * x + i64::from(q) * y + i64::from(r) * z;
        let (shape, mut each, mut most) = (leaf.shape(), [i64::MIN; WIDTH], i64::MIN);
        let centres = ring.centres.map(height);
        let mut last = height(ring.vertex(0)?);
        for (lane, top) in each.iter_mut().enumerate().take(shape.triangles()) {
            let [first, second] = centres;
            let centre = if lane < shape.turn() { first } else { second };
            let next = height(ring.vertex(lane + 1)?);
            *top = greater(centre, greater(last, next));
            most = greater(most, *top);
            last = next;
        }
        *self = IntTops { of, most, each };
        Some(())
    }
}

/// A direction in integers of at most 2^45, rounded up, and the length of their unit. `None` if it
/// is zero, or very long or short.
fn rounded_up(direction: [f64; 3]) -> Option<([i64; 3], f64)> {
    let most = direction.into_iter().fold(0.0, |most, x| greater(most, x.abs()));
    let exponent = most.to_bits() >> 52;
    if !(200..1800).contains(&exponent) {
        return None;
    }
    let power = f64::from_bits((2046 + INT_DIRECTION_BITS - exponent) << 52);
    Some((
        direction.map(|x| (x * power) as i64 + 1),
        f64::from_bits((exponent - INT_DIRECTION_BITS) << 52),
    ))
}
