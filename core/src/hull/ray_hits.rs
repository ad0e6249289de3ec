//! First hit and all hits of a ray, on the split tables.

use super::segment_hits::{All, Collect, First, Space, Traced, trace_line};
use crate::hull::format::Hull;
use crate::num::tolerance::{HULL_FAR, U64};
use crate::query::{AllHits, Behind, Budget, FirstHit, QueryError, Ray, ScratchEntry, TriangleHit};
use glam::DVec3;

impl Hull<'_> {
    /// First common point of a ray and the surface, both facings. Parameters are those of `origin +
    /// t·direction`, `t ≥ 0`, in input units: the direction need not be a unit vector.
    ///
    /// The answer is that of [`first_hit`](Hull::first_hit) about a segment that begins at `origin`
    /// and ends behind the model. If no hit is proved, `t.upper` is the parameter of an end behind
    /// the model, or infinite. A parameter that f32 cannot hold is rounded outward, to its largest
    /// number or to infinity. `scratch` and cost as for `first_hit`.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let (from, away) = ([400.0, 0.0, 0.0], [0.5, 0.0, 0.0]);
    /// assert!(part.first_hit_of_ray(from, away, Budget::EXACT, &mut scratch)?.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NoDirection`] of a direction of zeros. [`QueryError::OutOfDomain`] if the
    /// origin is farther than 2^38 times the model's size from its origin. Else those of
    /// `first_hit`.
    #[inline(never)]
    pub fn first_hit_of_ray(
        &self,
        origin: [f32; 3],
        direction: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        let mut first = First::NONE;
        let (traced, end) = trace(self, [origin, direction], &budget, scratch, &mut first)?;
        Ok(first.answer(self, &traced).of_ray(end))
    }

    /// All common points of a ray and the surface, by rising parameter, into `hits`: the answer of
    /// [`all_hits`](Hull::all_hits).
    ///
    /// Parameters and other arguments as for [`first_hit_of_ray`](Hull::first_hit_of_ray).
    ///
    /// # Errors
    /// Those of [`first_hit_of_ray`](Hull::first_hit_of_ray).
    #[inline(never)]
    pub fn all_hits_of_ray(
        &self,
        origin: [f32; 3],
        direction: [f32; 3],
        hits: &mut [TriangleHit],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllHits, QueryError> {
        let mut all = All::new(self, &mut *hits);
        let (traced, end) = trace(self, [origin, direction], &budget, scratch, &mut all)?;
        let found = all.answer(&traced);
        Ok(found.of_ray(hits, end))
    }
}

/// What a ray meets, and its parameter of the end of the segment that was asked.
#[cfg_attr(not(meshsweep_wide), inline(never))]
fn trace<C: Collect>(
    model: &Hull<'_>,
    [origin, direction]: [[f32; 3]; 2],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    collect: &mut C,
) -> Result<(Traced, f64), QueryError> {
    let space = Space::of(model, budget, scratch)?;
    let ray = Ray::new(origin, direction)?;
    let start = space.frame.local_end(ray.origin)?;
    // Four times as far away are the ends of segments at most.
    if start.abs().max_element() > 0.25 * HULL_FAR {
        return Err(QueryError::OutOfDomain);
    }
    let (low, high) = (space.bounds.min.as_dvec3(), space.bounds.max.as_dvec3());
    let far = (start - low).abs().max((high - start).abs());
    // Longer than the model too, so that the rounding of the end is one of the way
    // (`core/docs/rounding.md` §5, "Rays").
    let beyond = (far.x + far.y + far.z) * (1.0 + 8.0 * U64) + 8.0;
    let Behind { way, parameter } = ray.behind(space.frame.length(1.0), beyond);
    let way = DVec3::from_array(way);
    let traced = trace_line(model, &space, [start, start + way, way], budget, scratch, collect)?;
    Ok((traced, parameter))
}
