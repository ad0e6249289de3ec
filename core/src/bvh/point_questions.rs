//! Questions about points, compiled for the instructions of one kind of processor.

use super::closest_point::Hint;
use super::closest_points::closest_points_by;
use crate::bvh::format::Bvh;
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry};

/// Closest points for the instructions of one kind of processor. The bits of the answers are those
/// of the methods of [`Bvh`] with the same names.
///
/// The crate `meshsweep` has a front that asks the processor and chooses
/// (`meshsweep::bvh::FastBvh`).
#[derive(Clone, Copy, Debug)]
pub struct PointQuestions {
    closest_point_from: fn(&Bvh<'_>, [f32; 3], &mut Hint, Budget, &mut [ScratchEntry]) -> Answer,
}

type Answer = Result<ClosestPoint, QueryError>;

impl PointQuestions {
    /// For the instructions that the crate is compiled for.
    pub const COMPILED: PointQuestions = PointQuestions {
        closest_point_from: |tree, point, hint, budget, scratch| {
            tree.closest_point_from(point, hint, budget, scratch)
        },
    };

    /// For processors with AVX2. The value may be used anywhere.
    ///
    /// # Safety
    /// A function that is not compiled for these features needs `unsafe` to call it. The processor
    /// must have them: the caller asks it first.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    pub fn avx2() -> PointQuestions {
        use super::avx2;
        PointQuestions {
            closest_point_from: |tree, point, hint, budget, scratch| {
                avx2::closest_point_from(tree, point, hint, budget, scratch)
            },
        }
    }

    /// [`Bvh::closest_point`].
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`].
    #[inline]
    pub fn closest_point(
        &self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        (self.closest_point_from)(tree, point, &mut Hint::NONE.clone(), budget, scratch)
    }

    /// [`Bvh::closest_point_from`].
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`].
    #[inline]
    pub fn closest_point_from(
        &self,
        tree: &Bvh<'_>,
        point: [f32; 3],
        hint: &mut Hint,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        (self.closest_point_from)(tree, point, hint, budget, scratch)
    }
    /// [`Bvh::closest_points`].
    ///
    /// # Errors
    /// Those of [`Bvh::closest_points`].
    pub fn closest_points(
        &self,
        tree: &Bvh<'_>,
        points: &[[f32; 3]],
        hint: &mut Hint,
        answers: &mut [ClosestPoint],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<(), QueryError> {
        closest_points_by(
            tree,
            points,
            hint,
            answers,
            budget,
            scratch,
            |point, scratch| self.closest_point(tree, point, budget, scratch),
            |point, hint, scratch| {
                self.closest_point_from(tree, point, hint, Budget::EXACT, scratch)
            },
        )
    }
}
