//! Whether the mesh is within a distance.
//!
//! This costs less than the distance. The search ends at the first triangle that is certainly near
//! enough, and it opens no node that is certainly too far.

use super::closest_point::closest_point;
use super::descent::{Descent, LeafVisit, LeafVisitor, descend};
use super::leaf_distance::nearest_triangle;
use super::point_query::PointQuery;
use super::triangle_bounds::{each_triangle, limit_within, lower_of, nearness, seen_from};
use crate::bvh::format::Bvh;
use crate::num::sqrt_approx;
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry, Undecided, Verdict, Work};

/// Whether the mesh is within a distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Within {
    /// `Yes`: a point of the mesh is not farther. `No`: the whole mesh is farther; of a tight hull,
    /// the inside of the mesh too. Undecided for [`Resolution`](Undecided::Resolution): the
    /// difference from the distance asked about is within the surface error and rounding. For a
    /// tight hull: a tighter hull may decide.
    pub verdict: Verdict,
    /// With `Yes` a triangle that is not farther, by its number in the input file. It is not always
    /// the closest one. `None` of a tight hull, which knows no triangles.
    pub triangle: Option<u32>,
    /// The work of the search.
    pub work: Work,
}

impl Within {
    /// Whether it is proved that nothing of the mesh is within the distance.
    pub fn is_clear(&self) -> bool {
        self.verdict == Verdict::No
    }
}

impl Bvh<'_> {
    /// Whether the input mesh is at most `distance` from `point`, both in input units.
    ///
    /// It ends as soon as one triangle is certainly near enough. A distance of 0 asks whether the
    /// point touches the surface: the answer is `No` or, as f32 cannot prove a contact, undecided.
    /// The verdict is undecided for lack of precision only if the distance is within
    /// [`surface_error`](Bvh::surface_error) and rounding of the one asked about. Farther than a
    /// million model sizes the model's box answers.
    ///
    /// `scratch` as for [`closest_point`](Bvh::closest_point). A shorter one may leave the question
    /// undecided; it never makes the answer wrong. Of the budget only `steps` matters.
    ///
    /// Cost: one node if the model's box is beyond the distance. Else everything within `distance`,
    /// and no more than a few leaves where the answer is yes.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let near = part.within([3.0, 0.0, 400.0], 5.0, Budget::EXACT, &mut scratch)?;
    /// assert!(near.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::Tolerance`] also for a distance that is negative,
    /// NaN or infinite; [`QueryError::NoScratch`]; [`QueryError::NotServed`].
    #[inline]
    pub fn within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Within, QueryError> {
        budget.check()?;
        within(self, point, distance, budget.steps, scratch)
    }
}

fn within(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<Within, QueryError> {
    if !(distance >= 0.0 && distance.is_finite()) {
        return Err(QueryError::Tolerance);
    }
    if scratch.is_empty() {
        return Err(QueryError::NoScratch);
    }
    let query = PointQuery::new(tree, point)?;
    if query.far {
        return from_afar(tree, point, distance, scratch);
    }
    let mut work = Work::default();
    let limit = limit_within(&query, distance);
    let mut visitor =
        Threshold { tree, query: &query, distance, limit, near: None, undecided: false };
    let descent = descend(tree, &query, steps, scratch, &mut visitor, &mut work)?;
    if let Some(number) = visitor.near {
        let triangle = Some(tree.source(number).ok_or(QueryError::Unchecked)?);
        return Ok(Within { verdict: Verdict::Yes, triangle, work });
    }
    let verdict = match descent {
        Descent::Truncated { ended, .. } => Verdict::Undecided(ended.undecided()),
        _ if visitor.undecided => Verdict::Undecided(Undecided::Resolution),
        _ => Verdict::No,
    };
    Ok(Within { verdict, triangle: None, work })
}

#[cold]
fn from_afar(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    scratch: &mut [ScratchEntry],
) -> Result<Within, QueryError> {
    let ClosestPoint { distance: found, triangle, work, .. } =
        closest_point(tree, point, &Budget::EXACT, scratch)?;
    let (verdict, triangle) = match triangle {
        Some(_) if found.upper <= distance => (Verdict::Yes, triangle),
        _ if found.lower > distance => (Verdict::No, None),
        _ => (Verdict::Undecided(Undecided::Resolution), None),
    };
    Ok(Within { verdict, triangle, work })
}

struct Threshold<'a> {
    tree: &'a Bvh<'a>,
    query: &'a PointQuery,
    /// Input units.
    distance: f32,
    /// Squared bound above which everything is certainly farther.
    limit: f32,
    /// A triangle that is certainly within, by its number in the blob.
    near: Option<u32>,
    /// A triangle may be within.
    undecided: bool,
}

impl LeafVisitor for Threshold<'_> {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn leaf(&mut self, visit: &LeafVisit<'_>) -> Option<bool> {
        let near = nearest_triangle(&visit.leaf, self.query.p)?;
        if near.distance_sq <= self.limit
            && self.query.upper(sqrt_approx(near.distance_sq)) <= self.distance
        {
            self.near = Some(self.number(visit, near.distance_sq)?);
            return Some(false);
        }
        if near.lower_bound_sq <= self.limit && !self.undecided {
            self.look_closer(visit)?;
        }
        Some(self.near.is_none())
    }
}

impl Threshold<'_> {
    /// Number in the blob of the first triangle at `distance_sq`.
    #[cold]
    #[inline(never)]
    fn number(&self, visit: &LeafVisit<'_>, distance_sq: f32) -> Option<u32> {
        let first = self.tree.links(visit.node)?.triangle(visit.lane);
        let here = |lane: &usize| {
            nearness(&seen_from(&visit.leaf, *lane, self.query.p)).distance_sq == distance_sq
        };
        let lane = (0..visit.leaf.shape().triangles()).find(here)?;
        Some(first.wrapping_add(lane as u32))
    }

    /// Looks at each triangle of a leaf near the limit. One that is not certainly beyond the
    /// distance leaves the verdict undecided. A refined sliver may be certainly within.
    #[cold]
    #[inline(never)]
    fn look_closer(&mut self, visit: &LeafVisit<'_>) -> Option<()> {
        let Threshold { query, limit, distance, .. } = *self;
        let (mut undecided, mut within) = (false, None);
        each_triangle(query, &visit.leaf, |lane, distance_sq, lower_bound_sq| {
            if lower_bound_sq > limit {
                return;
            }
            if within.is_none() && query.upper(sqrt_approx(distance_sq)) <= distance {
                within = Some(lane);
            }
            if !undecided {
                let lower = lower_of(&visit.leaf, lane, query.p, distance_sq, lower_bound_sq);
                undecided = query.lower(lower) <= distance;
            }
        });
        self.undecided = undecided;
        if let Some(lane) = within {
            self.near =
                Some(self.tree.links(visit.node)?.triangle(visit.lane).wrapping_add(lane as u32));
        }
        Some(())
    }
}
