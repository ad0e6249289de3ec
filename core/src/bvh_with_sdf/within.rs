//! Whether the surface is within a distance of a point.

use super::pair::{BvhWithSdf, UNKNOWN};
use crate::query::{Budget, Decided, Interval, QueryError, ScratchEntry, Undecided, Verdict, Work};
use crate::sdf::Near;

/// The field does not decide.
const OPEN: Verdict = Verdict::Undecided(Undecided::Resolution);

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
            Some(place) => self.field().told(&place, distance, Near::Surface).unwrap_or(OPEN),
            None => self.told_from_beyond(point, distance),
        };
        if matches!(verdict, Verdict::Undecided(_)) {
            return self.tree().within(point, distance, budget, scratch);
        }
        Ok(Decided { verdict, witness: None, work: Work::NONE })
    }

    #[cold]
    #[inline(never)]
    fn told_from_beyond(&self, point: [f32; 3], distance: f32) -> Verdict {
        let found = self.field().distance_beyond(point);
        let Interval { lower, upper } =
            found.map_or(UNKNOWN, |found| self.surface_interval(&found));
        if lower > distance {
            Verdict::No
        } else if upper <= distance {
            Verdict::Yes
        } else {
            OPEN
        }
    }
}
