//! Triboxes whose directions are turned against the mesh, so that they bound less volume or area
//! (Crosnier & Rossignac 1999, section 3). Places and motions of the mesh's frame are carried into
//! the triboxes'. Derivation: `core/docs/rounding.md` §10.

use super::bounds::Tribox;
use crate::geom::Pose;
use crate::num::tolerance::{POSE_UP, PRODUCT_UNDERFLOW, TRIBOX_COORDINATE, U32};
use crate::query::{QueryError, RoundedPose, longest, skew_of};
use crate::tribox::format::Triboxes;

/// How places of the mesh's frame are carried into that of its triboxes.
pub(super) struct Turn {
    pose: Pose,
    /// A bound of the factor by which the matrix makes lengths longer.
    longest: f32,
}

/// The motion between the frames of two hierarchies, one of which is turned at least.
pub(super) struct Between {
    pub(super) pose: Pose,
    /// The distance to ask about, in the frame of the first.
    pub(super) distance: f32,
}

impl Turn {
    /// `None` if the triboxes are not turned.
    #[inline(always)]
    pub(super) fn of(triboxes: &Triboxes<'_>) -> Option<Turn> {
        if triboxes.is_turned() { Some(Turn::read(triboxes)) } else { None }
    }

    #[cold]
    fn read(triboxes: &Triboxes<'_>) -> Turn {
        let pose = Pose::rigid(triboxes.orientation(), [0.0; 3]);
        Turn { longest: longest(skew_of(&pose.rotation)), pose }
    }

    /// A point's place, rounded, and how far it may be from the exact one.
    pub(super) fn place(&self, point: [f32; 3]) -> ([f32; 3], f32) {
        let (place, [x, y, z]) = self.pose.apply(point);
        (place, ((x + y) + z) * (TRIBOX_COORDINATE * U32) + PRODUCT_UNDERFLOW)
    }

    /// A lower bound of a distance in the mesh's frame, from one of a place that is off by `error`.
    pub(super) fn shorter(&self, distance: f32, error: f32) -> f32 {
        let shorter = (distance - error) / self.longest * (1.0 - 8.0 * U32);
        // Below f32's normal range roundings are not relative.
        if shorter >= f32::MIN_POSITIVE { shorter } else { 0.0 }
    }
}

impl Tribox {
    /// Where a segment whose ends may be off by `error` enters, as [`clip`](Tribox::clip) tells.
    pub(super) fn enter(&self, a: [f32; 3], b: [f32; 3], error: f32) -> Option<f32> {
        match self.padded(error) {
            Ok(padded) => padded.clip(a, b).map(|(enter, _)| enter),
            // So far away that nothing is known.
            Err(_) => Some(0.0),
        }
    }
}

/// The motion of `b`'s frame into `a`'s, for a pose of the second mesh in the frame of the first.
/// The distance to ask about there includes the rounding of the motion. `largest` is the largest
/// coordinate of `b`'s triboxes.
///
/// # Errors
/// Those of [`RoundedPose::inverse`]; triboxes that opened have a rotation.
#[cold]
#[inline(never)]
pub(super) fn between(
    [a, b]: [&Triboxes<'_>; 2],
    pose: &Pose,
    distance: f32,
    largest: f32,
) -> Result<Between, QueryError> {
    let of =
        |triboxes: &Triboxes<'_>| RoundedPose::exact(Pose::rigid(triboxes.orientation(), [0.0; 3]));
    let into = of(a);
    let moved = of(b).inverse()?.then(&RoundedPose::exact(*pose)).then(&into);
    // No point is farther from the origin than √3 times the largest coordinate.
    let off = moved.motion(2.0 * largest);
    let distance = (distance * longest(skew_of(&into.pose.rotation)) + off) * POSE_UP;
    Ok(Between { pose: moved.pose, distance })
}
