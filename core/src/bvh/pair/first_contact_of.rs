//! Where a model that moves first comes near another one.

use crate::bvh::tree::format::Bvh;
use crate::query::{Budget, Motion, PairContact, QueryError, ScratchEntry};

/// Part of the motion below which an advance ends the search: half of the last bit of f32 at 1.
const LEAST_ADVANCE: f64 = 1.0 / (1u64 << 25) as f64;

impl Bvh<'_> {
    /// Where the surface of `other` first comes within `keep` of the surface of this tree during a
    /// [`Motion`] along straight lines or along a screw. The motion's poses carry `other`'s frame
    /// to this tree's. If both models move in the world, take poses of one as seen from the other
    /// ([`Pose::relative_to`](crate::Pose::relative_to)); the way between these is a screw only if
    /// one model stands still.
    ///
    /// Before `clear_until` the surfaces of the input meshes are proved to be farther than `keep`
    /// apart, at every instant. If [`is_clear`](PairContact::is_clear), they are during the whole
    /// motion. Only surfaces count: a mesh may move inside of another one.
    ///
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES) are always enough. The steps (pairs
    /// of nodes) of the budget are those of all distances together. Tolerances are ignored. If
    /// steps or scratch memory run out, `clear_until` is earlier.
    ///
    /// Cost: a [`distance_to`](Bvh::distance_to) for each advance: three to ten where the motion
    /// passes at some distance, some dozens before contact, more where the surfaces glide along
    /// each other.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Motion, Pose, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let at = |x: f32| Pose { translation: [x, 0.0, 300.0], ..Pose::IDENTITY };
    /// let motion = Motion::screw(at(-400.0), at(400.0))?;
    /// let found = part.first_contact_of(&part, &motion, 2.0, Budget::EXACT, &mut scratch)?;
    /// assert!(found.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Source: conservative advancement after Mirtich, *Impulse-based Dynamic Simulation of Rigid
    /// Body Systems* (1996), by proved distances.
    ///
    /// # Errors
    /// Those of [`distance_to`](Bvh::distance_to), also for a `keep` that is negative, NaN or
    /// infinite, and [`QueryError::NotFinite`] if a pose on the way leaves f32's range.
    #[inline(never)]
    pub fn first_contact_of(
        &self,
        other: &Bvh<'_>,
        motion: &Motion,
        keep: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<PairContact, QueryError> {
        self.advance(other, motion, (keep, LEAST_ADVANCE), budget, scratch)
    }
}
