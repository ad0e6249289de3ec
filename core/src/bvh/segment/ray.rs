//! The questions about a segment, of a ray: an origin and a direction without an end.

use super::start::SegmentStart;
use super::{Facing, all_hits, any_hit, first_hit};
use crate::bvh::tree::format::Bvh;
use crate::query::{AllHits, Budget, Decided, FirstHit, QueryError, ScratchEntry, TriangleHit};

impl Bvh<'_> {
    /// First common point of a ray and the surface. Parameters are those of `origin + t·direction`,
    /// `t ≥ 0`, in input units: the direction need not be a unit vector.
    ///
    /// The answer is that of [`first_hit`](Bvh::first_hit) about a segment that begins at `origin`
    /// and ends behind the model. It is about the ray itself, whose far end is nowhere rounded. If
    /// no hit is proved, `t.upper` is the parameter of an end behind the model, or infinite. A
    /// parameter that f32 cannot hold is rounded outward, to its largest number or to infinity: a
    /// hit beyond it is never called clear.
    ///
    /// Facing, hits, degenerate cases and cost as for `first_hit`, and two divisions for each axis
    /// more. Hosts do not look at four or eight children's boxes at once.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Facing, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let (from, down) = ([0.0, 0.0, 400.0], [0.0, 0.0, -2.0]);
    /// let hit = part.first_hit_of_ray(from, down, Facing::Both, Budget::EXACT, &mut scratch)?;
    /// assert!(!hit.is_clear() && hit.t.lower > 100.0);
    /// let up = [0.0, 0.0, 1e-30];
    /// let away = part.first_hit_of_ray(from, up, Facing::Both, Budget::EXACT, &mut scratch)?;
    /// assert!(away.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NoDirection`] of a direction of zeros. [`QueryError::OutOfDomain`] if the ways
    /// along the axes to the model's farthest corner are more than 2^36 grid units together. Else
    /// those of `first_hit`.
    #[inline(never)]
    pub fn first_hit_of_ray(
        &self,
        origin: [f32; 3],
        direction: [f32; 3],
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        let ray = [origin, direction];
        let Some((start, end)) = SegmentStart::of_ray(self, ray, &budget, scratch)? else {
            return Ok(FirstHit::CLEAR);
        };
        Ok(first_hit::along(self, &start, facing, &budget, scratch)?.of_ray(end))
    }

    /// Whether a ray meets the surface: the answer of [`any_hit`](Bvh::any_hit).
    ///
    /// Arguments as for [`first_hit_of_ray`](Bvh::first_hit_of_ray).
    ///
    /// # Errors
    /// Those of [`first_hit_of_ray`](Bvh::first_hit_of_ray).
    #[inline(never)]
    pub fn any_hit_of_ray(
        &self,
        origin: [f32; 3],
        direction: [f32; 3],
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<()>, QueryError> {
        let ray = [origin, direction];
        let Some((start, _)) = SegmentStart::of_ray(self, ray, &budget, scratch)? else {
            return Ok(Decided::CLEAR);
        };
        any_hit::along(self, &start, facing, &budget, scratch)
    }

    /// All common points of a ray and the stored surface, by rising parameter, into `hits`: the
    /// answer of [`all_hits`](Bvh::all_hits).
    ///
    /// Parameters and other arguments as for [`first_hit_of_ray`](Bvh::first_hit_of_ray).
    ///
    /// # Errors
    /// Those of [`first_hit_of_ray`](Bvh::first_hit_of_ray).
    #[inline(never)]
    pub fn all_hits_of_ray(
        &self,
        origin: [f32; 3],
        direction: [f32; 3],
        facing: Facing,
        hits: &mut [TriangleHit],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllHits, QueryError> {
        let ray = [origin, direction];
        let Some((start, end)) = SegmentStart::of_ray(self, ray, &budget, scratch)? else {
            return Ok(AllHits::NONE);
        };
        let all = all_hits::along(self, &start, facing, &mut *hits, &budget, scratch)?;
        Ok(all.of_ray(hits, end))
    }
}
