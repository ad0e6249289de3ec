//! Whether the surface is within a distance of a point.

use super::pair::BvhWithSdf;
use crate::query::{Budget, Decided, QueryError, ScratchEntry, Undecided, Verdict, Work};
use crate::sdf::Near;

/// The field does not decide.
const UNDECIDED: Verdict = Verdict::Undecided(Undecided::Resolution);

impl BvhWithSdf<'_> {
    /// Whether the input mesh is at most `distance` from `point`, both in input units. See
    /// [`Bvh::within`](crate::Bvh::within), which answers where the field does not tell it.
    ///
    /// The field proves no single triangle: a `Yes` of the field has no witness. The work of the
    /// field is 0: `work.opened` tells whether the tree was asked.
    ///
    /// Like the tree's question it asks about the surface: a point deep inside is `No`. A guard
    /// that must not call a point inside clear asks [`signed_bounds`](Self::signed_bounds).
    ///
    /// Cost: one look-up where the field decides, else that and
    /// [`Bvh::within`](crate::Bvh::within).
    ///
    /// # Errors
    /// Those of [`Bvh::within`](crate::Bvh::within).
    #[inline(never)]
    pub fn within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        budget.check_about(distance, scratch)?;
        self.check_distances()?;
        let verdict = match self.field().within_field(point) {
            // Of a field that was not checked nothing is known.
            Some(place) => self.field().told(&place, distance, Near::Surface).unwrap_or(UNDECIDED),
            // A point inside that is beyond the field is less than a unit below the surface, and
            // a `Yes` is about more. Elsewhere the solid is as far as the surface.
            None => self.field().within_from_beyond(point, distance).unwrap_or(UNDECIDED),
        };
        if matches!(verdict, Verdict::Undecided(_)) {
            return self.tree().within(point, distance, budget, scratch);
        }
        Ok(Decided { verdict, witness: None, work: Work::NONE })
    }
}
