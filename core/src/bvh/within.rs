//! Is the mesh within a distance? Cheaper than the distance itself: it ends as soon as one triangle
//! is certainly near enough, and looks at nothing that is certainly too far.

use super::closest_point::closest_point;
use super::descent::{Descent, LeafVisit, LeafVisitor, descend};
use super::leaf_distance::nearest_triangle;
use super::point_query::PointQuery;
use super::triangle_bounds::{each_triangle, limit_within, lower_of, nearness, seen_from};
use crate::bvh::format::Bvh;
use crate::num::sqrt_approx;
use crate::query::{Budget, Ended, QueryError, ScratchEntry, Work};

/// Whether the mesh is within a distance, about the input mesh in real arithmetic. Said by
/// [`is_within`], and by [`tight::is_within`](crate::tight::is_within) of a mesh that is
/// known by its hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Proved: a point of the mesh is not farther.
    Yes {
        /// A triangle that is not farther, by its number in the input file. Not always the closest
        /// one; `None` of a tight hull, which knows no triangles.
        triangle: Option<u32>,
    },
    /// Proved: the whole mesh is farther; of a tight hull, all that the mesh encloses too.
    No,
    /// [`Within::ended`] says why.
    Unknown,
}

/// Whether the mesh is within a distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Within {
    /// The answer.
    pub verdict: Verdict,
    /// What it cost.
    pub work: Work,
    /// [`Ended::Exact`] with `Yes` and `No`. With `Unknown`: [`Ended::Level`] if the distance is
    /// so near to the one asked about that the stored surface or rounding leaves it open, or
    /// if a tighter hull may tell; [`Ended::Steps`] or [`Ended::Capacity`] if the search was cut
    /// short.
    pub ended: Ended,
}

impl Within {
    /// Proved: nothing of the mesh is within the distance.
    pub fn is_clear(&self) -> bool {
        self.verdict == Verdict::No
    }
}

/// Is the input mesh at most `distance` (input units) from `point`?
///
/// Distance 0 asks whether the point touches the surface: `No` or, as f32 cannot prove that it
/// does, `Unknown`. `Unknown` for want of precision needs a distance within
/// [`BvhHeader::surface_error`](crate::bvh::format::BvhHeader) and rounding of the one asked about.
/// Farther than a million model sizes the model's box answers. `stack` as for [`closest_point`]; a
/// shorter one may turn an answer into `Unknown`, never into a wrong one. Of [`Budget`] only `steps`
/// matters.
///
/// Cost: one node if the model's box is out of reach; else what lies within `distance`, and no more
/// than a few leaves where the answer is yes.
///
/// # Errors
/// [`QueryError::NotFinite`]; [`QueryError::Tolerance`] also for a distance that is negative, NaN
/// or infinite; [`QueryError::NoQueue`]; [`QueryError::NotServed`].
pub fn is_within(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    stop: &Budget,
    stack: &mut [ScratchEntry],
) -> Result<Within, QueryError> {
    stop.check()?;
    if !(distance >= 0.0 && distance.is_finite()) {
        return Err(QueryError::Tolerance);
    }
    if stack.is_empty() {
        return Err(QueryError::NoQueue);
    }
    let query = PointQuery::new(tree, point)?;
    if query.far {
        return from_afar(tree, point, distance, stack);
    }
    let mut work = Work::default();
    let limit = limit_within(&query, distance);
    let mut visitor =
        Threshold { tree, query: &query, distance, limit, near: None, doubtful: false };
    let descent = descend(tree, query.p, stack, stop.steps, &mut visitor, &mut work)?;
    let (verdict, ended) = match descent {
        _ if visitor.near.is_some() => {
            let triangle =
                visitor.near.and_then(|number| tree.source(number)).ok_or(QueryError::Model)?;
            (Verdict::Yes { triangle: Some(triangle) }, Ended::Exact)
        }
        Descent::Truncated { steps: true, .. } => (Verdict::Unknown, Ended::Steps),
        Descent::Truncated { steps: false, .. } => (Verdict::Unknown, Ended::Capacity),
        _ if visitor.doubtful => (Verdict::Unknown, Ended::Level),
        _ => (Verdict::No, Ended::Exact),
    };
    Ok(Within { verdict, work, ended })
}

#[cold]
fn from_afar(
    tree: &Bvh<'_>,
    point: [f32; 3],
    distance: f32,
    stack: &mut [ScratchEntry],
) -> Result<Within, QueryError> {
    let closest = closest_point(tree, point, &Budget::EXACT, stack)?;
    let verdict = match closest.triangle {
        triangle @ Some(_) if closest.upper <= distance => Verdict::Yes { triangle },
        _ if closest.lower > distance => Verdict::No,
        _ => Verdict::Unknown,
    };
    let ended = if verdict == Verdict::Unknown { Ended::Level } else { Ended::Exact };
    Ok(Within { verdict, work: closest.work, ended })
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
    doubtful: bool,
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
        if near.lower_bound_sq <= self.limit && !self.doubtful {
            self.doubt(visit)?;
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
        let lane = (0..visit.leaf.tag().triangles()).find(here)?;
        Some(first.wrapping_add(lane as u32))
    }

    /// A leaf near the limit: is one of its triangles not certainly beyond the distance? It may be
    /// a sliver that is certainly within.
    #[cold]
    #[inline(never)]
    fn doubt(&mut self, visit: &LeafVisit<'_>) -> Option<()> {
        let Threshold { query, limit, distance, .. } = *self;
        let (mut doubtful, mut within) = (false, None);
        each_triangle(query, &visit.leaf, |lane, distance_sq, lower_bound_sq| {
            if lower_bound_sq > limit {
                return;
            }
            if within.is_none() && query.upper(sqrt_approx(distance_sq)) <= distance {
                within = Some(lane);
            }
            if !doubtful {
                let lower = lower_of(&visit.leaf, lane, query.p, distance_sq, lower_bound_sq);
                doubtful = query.lower(lower) <= distance;
            }
        });
        self.doubtful = doubtful;
        if let Some(lane) = within {
            self.near =
                Some(self.tree.links(visit.node)?.triangle(visit.lane).wrapping_add(lane as u32));
        }
        Some(())
    }
}
