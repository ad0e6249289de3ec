//! Whether a convex solid and the surface are within a distance of each other.

use super::box_keys::ByDistance;
use super::leaf_search::LeafSearch;
use super::placed_solid::PlacedSolid;
use crate::bvh::tree::descent::descend;
use crate::bvh::tree::format::Bvh;
use crate::bvh::tree::gap::GapThreshold;
use crate::query::{Budget, Decided, QueryError, ScratchEntry, Solid, Work};

impl Bvh<'_> {
    /// Whether a point of `solid` is at most `distance` from the surface. All lengths in input
    /// units, in the mesh's frame.
    ///
    /// Both verdicts are proved for the input mesh. A distance of 0 asks whether the solid and the
    /// surface meet. The verdict is undecided for lack of precision only if the true distance is
    /// within the surface error and rounding of the one asked about, or if the solid enters the
    /// surface by less than that, or if a flat solid without radius passes through it. A small
    /// radius avoids the last one. For collision avoidance, treat an undecided answer as `Yes`.
    /// Only the surface counts: a solid inside of a closed mesh may be clear.
    ///
    /// `scratch` and degenerate cases as for [`solid_distance`](Bvh::solid_distance). It ends at
    /// the first triangle that is certainly near enough. The witness of a `Yes` is this triangle;
    /// that of an undecided [`Resolution`](crate::Undecided::Resolution) is one that may be near
    /// enough. Numbers are those of the input file. `work` as in
    /// [`SolidDistance::work`](crate::SolidDistance::work). Of the budget only `steps` matters.
    ///
    /// Cost: less than the distance. One node if the model's boxes are farther; all triangles
    /// within the distance if the answer is nearly `Yes`.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch, Solid};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let clamp = Solid::box_corners([900.0, 0.0, 0.0], [950.0, 20.0, 10.0]);
    /// let clamp = Solid::new(&clamp, 0.0)?;
    /// assert!(part.solid_within(&clamp, 2.0, Budget::EXACT, &mut scratch)?.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: that of [`solid_distance`](Bvh::solid_distance).
    ///
    /// # Errors
    /// Those of [`solid_distance`](Bvh::solid_distance); [`QueryError::Tolerance`] also for a
    /// distance that is negative, NaN or infinite.
    #[inline(never)]
    pub fn solid_within(
        &self,
        solid: &Solid<'_>,
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        budget.check_about(distance, scratch)?;
        let mut placed = PlacedSolid::NONE;
        placed.set(self, solid, None)?;
        let threshold = GapThreshold::new(&placed.lengths, placed.radius, distance);
        let mut work = Work::default();
        let mut search = LeafSearch::new(&placed, threshold);
        let query = ByDistance(&placed);
        let descent = descend(self, &query, budget.steps, scratch, &mut search, &mut work)?;
        work.exact = search.measured;
        let (verdict, place) = search.visitor.found.answer(descent.cut());
        let witness =
            place.map(|place| place.source(self).ok_or(QueryError::Unchecked)).transpose()?;
        Ok(Decided { verdict, witness, work })
    }
}
