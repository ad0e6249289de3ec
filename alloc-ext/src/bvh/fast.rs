//! Questions at the pace of this processor.

use core::ops::Deref;
use meshsweep_core::{
    Budget, Bvh, ClosestPoint, Decided, Facing, FirstHit, Hint, ProcessorQuestions, QueryError,
    ScratchEntry,
};

/// A box tree whose closest points and segments use the vector instructions of this processor,
/// whatever the program was compiled for. The bits of the answers are those of [`Bvh`]. All other
/// questions are those of [`Bvh`] too.
///
/// A program for x86-64 without `-C target-cpu` is compiled for processors without AVX2. Here the
/// processor is asked, and a closest point takes two thirds of the time. A budget of steps, a
/// tolerance or less memory than [`Bvh::scratch_entries`] takes the time of [`Bvh`].
///
/// ```
/// use meshsweep::bvh::FastBvh;
/// use meshsweep_core::{Budget, Bvh, ScratchEntry};
/// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../core/fixtures/groove.msw"));
/// let part = FastBvh::new(Bvh::open(bytes)?);
/// let mut scratch = vec![ScratchEntry::EMPTY; part.scratch_entries()];
/// let near = part.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch)?;
/// assert!(near.distance.lower <= near.distance.upper);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FastBvh<'a> {
    tree: Bvh<'a>,
    questions: ProcessorQuestions,
}

impl<'a> FastBvh<'a> {
    /// The tree, for this processor.
    #[must_use]
    pub fn new(tree: Bvh<'a>) -> FastBvh<'a> {
        FastBvh { tree, questions: questions() }
    }

    /// [`Bvh::closest_point`].
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`].
    #[inline]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        self.closest_point_from(point, &mut Hint::NONE.clone(), budget, scratch)
    }

    /// [`Bvh::closest_point_from`]. On hosts this is also the fastest way along a path.
    ///
    /// # Errors
    /// Those of [`Bvh::closest_point`].
    #[inline]
    pub fn closest_point_from(
        &self,
        point: [f32; 3],
        hint: &mut Hint,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        (self.questions.closest_point_from)(&self.tree, point, hint, budget, scratch)
    }

    /// [`Bvh::first_hit`].
    ///
    /// # Errors
    /// Those of [`Bvh::first_hit`].
    #[inline]
    pub fn first_hit(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        (self.questions.first_hit)(&self.tree, a, b, facing, budget, scratch)
    }

    /// [`Bvh::any_hit`].
    ///
    /// # Errors
    /// Those of [`Bvh::first_hit`].
    #[inline]
    pub fn any_hit(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<()>, QueryError> {
        (self.questions.any_hit)(&self.tree, a, b, facing, budget, scratch)
    }
}

impl<'a> Deref for FastBvh<'a> {
    type Target = Bvh<'a>;

    fn deref(&self) -> &Bvh<'a> {
        &self.tree
    }
}

/// The questions for this processor.
fn questions() -> ProcessorQuestions {
    #[cfg(target_arch = "x86_64")]
    if meshsweep_core::has_avx2!() {
        // SAFETY: the processor has all features of the function's list.
        return unsafe { ProcessorQuestions::avx2() };
    }
    ProcessorQuestions::COMPILED
}
