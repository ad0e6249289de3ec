//! The winding number about a point: how often the surface encloses it.
//!
//! A triangle that shows its back to a point adds its solid angle, one that shows its front takes
//! it away. The sum over the mesh, divided by 4π, is an integer for a closed mesh. For a mesh with
//! holes it is nearly 1 inside and nearly 0 outside, and between them in a hole.
//!
//! | file | owns |
//! | --- | --- |
//! | this one | the question |
//! | `search` | the passes |
//! | `moment_flux` | the solid angles of all triangles of a node together, from afar |
//! | `flux` | sums with bounds of their errors |
//!
//! The *flux* of a set of triangles is the sum of their solid angles. A pass takes the flux of
//! nodes that are small beside their distance from their moments, and adds up the solid angles of
//! the other triangles one by one. Each pass replaces only smaller nodes than the pass before,
//! until the side is decided. Every pass gives an interval that contains the number, and the answer
//! is their intersection. A pass is depth-first, so it needs the memory of any other descent, and
//! no queue.

mod flux;
mod moment_flux;
mod search;

use crate::bvh::point::hint::Hint;
use crate::bvh::point::query::{Asked, FarPoint, PreparedPoint};
use crate::bvh::tree::format::Bvh;

use crate::query::{
    Budget, Ended, Interval, QueryError, ScratchEntry, Side, SignedDistance, Undecided, Work,
};
use search::{WindingSearch, side_of};

/// The winding number about a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct WindingNumber {
    /// The winding number of the input file's triangles.
    pub number: Interval,
    /// `Inside` if the number is certainly above ½, `Outside` if it is certainly between −½ and ½.
    /// Undecided below −½: about the point the surface is inside out. A closed mesh that is proved
    /// to face inwards as a whole is `Inside` there, and undecided above ½.
    pub side: Side,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended. [`Ended::Exact`]: the side is decided, and no width was asked for.
    /// [`Ended::Tolerance`]: the side is decided, and the interval as narrow as asked for.
    /// [`Ended::Resolution`]: vertices that were moved, and rounding, leave no more to find out.
    pub ended: Ended,
}

impl Bvh<'_> {
    /// How often the surface encloses `point` (input units): its generalised winding number.
    ///
    /// The mesh need not be closed. Holes, flaps, parts that overlap and triangles that cross each
    /// other are fine: the side is that of the surface as a whole, where
    /// [`signed_distance`](Bvh::signed_distance) asks the nearest triangle of a closed mesh. In a
    /// hole the sides meet where the number is ½. Parts that overlap are united.
    ///
    /// The number is that of all triangles of the input file, as they are wound there. It is
    /// positive where the surface has its back to the point. A triangle that occurs twice counts
    /// twice, and one that occurs in both directions cancels: so solids that share walls are one
    /// solid. In a component that is inside out the number is about −1, and no side is proved. If
    /// the builder proved that the whole mesh is inside out, a number below −½ is `Inside`.
    /// Components that overlap and are wound against each other cancel.
    ///
    /// The search ends as soon as the side is decided and the interval is no wider than
    /// `budget.absolute`, a pure number here; 0, as in [`Budget::EXACT`], asks for the side alone.
    /// Each triangle that is looked at widens the interval by some 1e-6. A width below that takes
    /// all triangles and is not reached.
    /// `relative` is ignored. `scratch` as for [`closest_point`](Bvh::closest_point). If it is too
    /// short, or the steps too few, the interval still holds.
    ///
    /// Within some ten surface errors of the surface, and where the number is ½, the side is
    /// undecided ([`Ended::Resolution`]). Such a point costs several times as much as others.
    ///
    /// Cost: far from the mesh one node; else the nodes and triangles within a few times the
    /// distance from the surface. Source: Jacobson, Kavan & Sorkine-Hornung 2013; Barill et al.
    /// 2018 for the expansion, here with a bound of its error.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch, Side};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let inside = part.winding_number([6.0, 20.0, 15.0], Budget::EXACT, &mut scratch)?;
    /// assert_eq!(inside.side, Side::Inside);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`];
    /// [`QueryError::NotServed`] if the blob was built without moments (`--for winding`).
    #[inline(never)]
    pub fn winding_number(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<WindingNumber, QueryError> {
        budget.check_with(scratch)?;
        let prepared = PreparedPoint::new(self, point)?;
        if !self.serves_winding() {
            return Err(QueryError::NO_MOMENTS);
        }
        let asked = prepared.asked();
        let (Asked::Near(query) | Asked::Far(FarPoint { query })) = asked;
        let mut search = WindingSearch {
            tree: *self,
            p: query.p,
            error: self.units().surface_error,
            // Each triangle fills half of the sphere at most.
            most: 0.5 * self.header().triangles as f32 * (1.0 + f32::EPSILON),
            absolute: budget.absolute,
            steps: budget.steps,
            work: Work::default(),
        };
        let (number, ended) = match asked {
            Asked::Near(_) => search.number_in_passes(scratch)?,
            Asked::Far(_) => search.number_from_afar(),
        };
        let (side, ended) = match (side_of(search.of_solid(number)), ended) {
            (Some(side), _) => (side, ended),
            (None, Ended::Exact | Ended::Tolerance) => {
                (Side::Undecided(Undecided::Resolution), Ended::Resolution)
            }
            (None, _) => (Side::Undecided(ended.undecided()), ended),
        };
        Ok(WindingNumber { number, side, work: search.work, ended })
    }

    /// Signed distance of `point` (input units) to a mesh that need not be closed: its side is that
    /// of the [`winding_number`](Bvh::winding_number).
    ///
    /// For a closed mesh whose winding numbers are 0 and 1 the sides are those of
    /// [`signed_distance`](Bvh::signed_distance), which costs less. Where parts overlap the
    /// distance is that of the nearest triangle, even if it lies inside of another part. In a hole
    /// the sign changes at a distance that is not 0.
    ///
    /// Triangle and point are those of [`closest_point`](Bvh::closest_point). Of the budget only
    /// `steps` matters: the distance takes the first. If only the side is undecided,
    /// `closest.ended` says why. `scratch` as for `closest_point`.
    ///
    /// Cost: that of the closest point and of the winding number.
    ///
    /// # Errors
    /// Those of [`closest_point`](Bvh::closest_point) and of
    /// [`winding_number`](Bvh::winding_number).
    #[inline(never)]
    pub fn signed_distance_by_winding(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SignedDistance, QueryError> {
        if !self.serves_winding() {
            return Err(QueryError::NO_MOMENTS);
        }
        budget.check()?;
        let budget = Budget::EXACT.with_steps(budget.steps);
        // In one order: the steps that are left decide how far the winding number is known.
        let mut hint = Hint::NONE;
        let mut closest = self.closest_point_in_order(point, &mut hint, budget, scratch)?;
        let left = budget.steps.saturating_sub(closest.work.opened);
        let winding = self.winding_number(point, budget.with_steps(left), scratch)?;
        closest.work = closest.work.and(winding.work);
        if closest.ended == Ended::Exact {
            closest.ended = winding.ended;
        }
        Ok(SignedDistance::new(closest, winding.side))
    }
}
