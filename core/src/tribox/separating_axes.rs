//! Directions along which two triboxes may be apart, prepared for one motion and one distance.

use super::bounds::TriboxError;
use super::directions::{DIRECTIONS, FACES, SLABS};
use super::support::Support;
use super::turned::between;
use crate::geom::{Pose, dot, norm_1};
use crate::num;
use crate::num::tolerance::{PRODUCT_UNDERFLOW, TRIBOX_AXIS, TRIBOX_DISTANCE, U32};
use crate::query::{QueryError, checked_skew, longest, skew_of};
use crate::tribox::format::Triboxes;

/// A direction of one tribox's own slabs in the other's frame.
///
/// A point p of the other one has the value `towards` · p + `offset` along the slab, up to
/// `margin`. The margin is more than the rounding of a comparison, and the distance that is asked
/// about is in it.
#[derive(Clone, Copy)]
struct Axis {
    /// Along `towards`; prepared when it is first wanted.
    support: Support,
    towards: [f32; 3],
    offset: f32,
    margin: f32,
}

/// The nine directions of the first one and the nine of the second.
pub(crate) struct Axes {
    sides: [[Axis; SLABS]; 2],
}

/// Largest coordinate of a hierarchy.
fn largest_coordinate(triboxes: &Triboxes<'_>) -> Result<f32, QueryError> {
    let planes = triboxes.planes(0).ok_or(QueryError::Unchecked)?;
    Ok(planes
        .iter()
        .take(6)
        .fold(0f32, |most, plane| if plane.abs() > most { plane.abs() } else { most }))
}

/// A tribox prepared for the tests.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    /// Outward: of slab k the least value, negated, at 2k and the greatest at 2k + 1.
    planes: [f32; FACES],
    /// Centre of its box. It is inside, because it is inside the projection along each axis, a
    /// tight octagon.
    centre: [f32; 3],
}

impl Body {
    #[inline(always)]
    pub(crate) fn of(triboxes: &Triboxes<'_>, node: u32) -> Option<Body> {
        let planes = triboxes.planes(node)?;
        let [x, xx, y, yy, z, zz, ..] = planes;
        Some(Body { planes, centre: [0.5 * (xx - x), 0.5 * (yy - y), 0.5 * (zz - z)] })
    }

    /// Sum of the box's edges.
    #[inline(always)]
    pub(crate) fn size(&self) -> f32 {
        let [x, xx, y, yy, z, zz, ..] = self.planes;
        ((x + xx) + (y + yy)) + (z + zz)
    }
}

impl Axes {
    /// Before [`prepare`](Self::prepare).
    pub(crate) const NONE: Axes = {
        let none = Axis { support: Support::NONE, towards: [0.0; 3], offset: 0.0, margin: 0.0 };
        Axes { sides: [[none; SLABS]; 2] }
    };

    /// Prepares the directions for a motion of `b`, to tell apart nodes that are farther than
    /// `distance` from each other.
    ///
    /// Let w be a direction, M and t the motion. The value of a moved point is w·(Mp + t), which is
    /// (Mᵀw)·p and w·t. Along the slabs of `a`, w is a direction of small integers, and e = Mᵀw is
    /// computed. Along the slabs of `b`, w = Mf is computed from a direction f, and Mᵀw is f up to
    /// the rounding of M. This rounding and the rounding of e count with the largest coordinate of
    /// `b`. No gap is rounded by more than [`TRIBOX_AXIS`] units of the sum of its terms. Points
    /// that are `distance` apart or nearer have a gap of at most |w| times it
    /// (`core/docs/rounding.md` §10). Of turned triboxes the motion is that between their frames.
    pub(crate) fn prepare(
        &mut self,
        a: &Triboxes<'_>,
        b: &Triboxes<'_>,
        pose: &Pose,
        distance: f32,
    ) -> Result<(), QueryError> {
        pose.check().map_err(|error| match error {
            TriboxError::NotFinite => QueryError::NotFinite,
            TriboxError::OutOfDomain => QueryError::PoseOutOfDomain,
        })?;
        let (largest_a, largest_b) = (largest_coordinate(a)?, largest_coordinate(b)?);
        let skew = checked_skew(pose)?;
        let turned;
        let (pose, distance, skew) = if a.is_turned() || b.is_turned() {
            turned = between([a, b], pose, distance, largest_b)?;
            (&turned.pose, turned.distance, skew_of(&turned.pose.rotation))
        } else {
            (pose, distance, skew)
        };
        let [p, q, r] = pose.rotation;
        let largest = norm_1(pose.translation);
        // Mᵀw, and the same of sizes.
        let back = |[x, y, z]: [f32; 3]| {
            let mut to = [0f32; 3];
            let rows = p.into_iter().zip(q).zip(r);
            to.iter_mut().zip(rows).for_each(|(to, ((p, q), r))| *to = (p * x + q * y) + r * z);
            to
        };
        let back_sizes = |[x, y, z]: [f32; 3]| {
            let mut sum = 0f32;
            for ((p, q), r) in p.into_iter().zip(q).zip(r) {
                sum += ((p * x).abs() + (q * y).abs()) + (r * z).abs();
            }
            sum
        };
        let kept = distance * TRIBOX_DISTANCE;
        let kept = [kept, kept * longest(skew)];
        let [first, second] = &mut self.sides;
        for ((of_a, of_b), direction) in first.iter_mut().zip(second.iter_mut()).zip(DIRECTIONS) {
            let f = direction.map(f32::from);
            let length = if norm_1(f) > 1.0 { core::f32::consts::SQRT_2 } else { 1.0 };
            let [kept_a, kept_b] = kept.map(|kept| kept * length);
            let margin = |w: [f32; 3]| {
                TRIBOX_AXIS * U32 * (back_sizes(w) * largest_b + norm_1(w) * (largest_a + largest))
                    + PRODUCT_UNDERFLOW
            };
            let e = back(f);
            (of_a.towards, of_a.offset, of_a.margin) =
                (e, dot(f, pose.translation), margin(f) + kept_a);
            let w = [dot(p, f), dot(q, f), dot(r, f)];
            let [x, y, z] = back(w);
            let [fx, fy, fz] = f;
            // Bound of the matrix's difference from a rotation.
            let rest = norm_1([x - fx, y - fy, z - fz]) * largest_b;
            (of_b.towards, of_b.offset, of_b.margin) =
                (w, -dot(w, pose.translation), margin(w) + rest + kept_b);
        }
        Ok(())
    }

    /// Whether one of the directions proves that two nodes are farther than the distance from each
    /// other. It tests the side and slab in `*hint` first, and leaves there the one that proved it.
    #[inline]
    pub(crate) fn separate(&mut self, a: &Body, b: &Body, hint: &mut (usize, usize)) -> bool {
        let [of_a, of_b] = &mut self.sides;
        let (side, slab) = *hint;
        let (axes, own, other) = if side == 0 { (&mut *of_a, a, b) } else { (&mut *of_b, b, a) };
        if axes.get_mut(slab).is_some_and(|axis| axis.separates(own, other, slab)) {
            return true;
        }
        for (side, (axes, own, other)) in [(of_a, a, b), (of_b, b, a)].into_iter().enumerate() {
            for (slab, axis) in axes.iter_mut().enumerate() {
                if axis.separates(own, other, slab) {
                    *hint = (side, slab);
                    return true;
                }
            }
        }
        false
    }
}

impl Axis {
    /// Whether there is a gap beyond the margin along the direction, between the slab of `own` and
    /// the other one's extent.
    #[inline(always)]
    fn separates(&mut self, own: &Body, other: &Body, slab: usize) -> bool {
        let plane = |plane: usize| own.planes.get(plane).copied().unwrap_or(f32::INFINITY);
        let (low, high) = (plane(2 * slab), plane(2 * slab + 1));
        // The same bits as `geom::dot`, and fewer instructions on boards.
        let centre = num::dot(self.towards.into(), other.centre.into()) + self.offset;
        // A gap beyond a plane needs the centre beyond it.
        let is_above = centre > high;
        if !(is_above || -centre > low) {
            return false;
        }
        if self.support.is_none() {
            self.support = Support::along(self.towards);
        }
        if is_above {
            (self.offset - self.support.greatest_against(&other.planes)) - high > self.margin
        } else {
            (-self.offset - self.support.greatest(&other.planes)) - low > self.margin
        }
    }
}
