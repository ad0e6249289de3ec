//! Questions compiled for the instructions of one kind of processor. `avx2` has those for AVX2.

#[cfg(meshsweep_avx2)]
mod avx2;

use crate::bvh::point::hint::Hint;
use crate::bvh::segment::leaf::Facing;
use crate::bvh::tree::format::Bvh;
use crate::query::{Budget, ClosestPoint, Decided, FirstHit, QueryError, ScratchEntry};

/// Questions compiled for the instructions of one kind of processor: functions with the arguments,
/// errors and bits of the methods of [`Bvh`] with the same names.
///
/// The crate `meshsweep` has a front that asks the processor and chooses
/// (`meshsweep::bvh::FastBvh`).
#[derive(Clone, Copy, Debug)]
pub struct ProcessorQuestions {
    /// [`Bvh::closest_point_from`]; with [`Hint::NONE`] it is [`Bvh::closest_point`].
    pub closest_point_from: ClosestPointFrom,
    /// [`Bvh::first_hit`].
    pub first_hit: OfSegment<FirstHit>,
    /// [`Bvh::any_hit`].
    pub any_hit: OfSegment<Decided<()>>,
}

type ClosestPointFrom = fn(
    &Bvh<'_>,
    [f32; 3],
    &mut Hint,
    Budget,
    &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError>;

type OfSegment<A> =
    fn(&Bvh<'_>, [f32; 3], [f32; 3], Facing, Budget, &mut [ScratchEntry]) -> Result<A, QueryError>;

/// Whether this processor has all features of [`ProcessorQuestions::avx2`]. The caller's standard
/// library asks it once and keeps the answer.
#[cfg(meshsweep_avx2)]
#[macro_export]
macro_rules! has_avx2 {
    () => {
        ::std::is_x86_feature_detected!("avx2")
            && ::std::is_x86_feature_detected!("bmi1")
            && ::std::is_x86_feature_detected!("bmi2")
            && ::std::is_x86_feature_detected!("lzcnt")
            && ::std::is_x86_feature_detected!("popcnt")
    };
}

impl ProcessorQuestions {
    /// For the instructions that the crate is compiled for.
    pub const COMPILED: ProcessorQuestions = ProcessorQuestions {
        closest_point_from: |tree, point, hint, budget, scratch| {
            tree.closest_point_from(point, hint, budget, scratch)
        },
        first_hit: |tree, a, b, facing, budget, scratch| {
            tree.first_hit(a, b, facing, budget, scratch)
        },
        any_hit: |tree, a, b, facing, budget, scratch| tree.any_hit(a, b, facing, budget, scratch),
    };

    /// For processors with AVX2. The value may be used anywhere.
    ///
    /// # Safety
    /// A function that is not compiled for these features needs `unsafe` to call it. The processor
    /// must have them: [`has_avx2!`](crate::has_avx2) asks it.
    #[cfg(meshsweep_avx2)]
    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    pub fn avx2() -> ProcessorQuestions {
        ProcessorQuestions {
            closest_point_from: |tree, point, hint, budget, scratch| {
                avx2::closest_point_from(tree, point, hint, budget, scratch)
            },
            first_hit: |tree, a, b, facing, budget, scratch| {
                avx2::first_hit(tree, a, b, facing, budget, scratch)
            },
            any_hit: |tree, a, b, facing, budget, scratch| {
                avx2::any_hit(tree, a, b, facing, budget, scratch)
            },
        }
    }
}
