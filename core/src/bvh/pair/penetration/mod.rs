//! Two solids, one of them moved: how they lie to each other, and how deep they are in each other.
//!
//! The exact penetration depth, the length of the shortest separating translation, would need the
//! Minkowski sum of both solids, with a face for each pair of faces. The interval needs no such
//! sum.
//!
//! | file | owns |
//! | --- | --- |
//! | this one | the question |
//! | `pair_queries` | the queries that all searches share, and their work |
//! | `inside` | whether a component of one surface lies inside the other |
//! | `deepest` | the lower end: a point that is far inside both |
//! | `separating` | the upper end: separating translations |

mod deepest;
mod inside;
mod pair_queries;
mod separating;

use pair_queries::PairQueries;

use crate::bvh::tree::format::Bvh;
use crate::geom::Pose;
use crate::num::{down_to_f32, lesser, up_to_f32};
use crate::query::{
    Budget, Ended, Interval, Penetration, QueryError, Relation, ScratchEntry, Undecided, Work,
};

impl Bvh<'_> {
    /// How the solid that `other` bounds, moved by `pose` from its frame to this tree's (both in
    /// input units), lies to the solid that this tree bounds, and how deep they are in each other.
    ///
    /// Both ends of [`Penetration::depth`] are proved for the input meshes as they were after
    /// repair. The upper end is the length of a translation after which the solids are apart. The
    /// other model may be in a hole or a cavity there. The lower end is proved by the sum of a
    /// point's depths in both solids. Two searches find them, and may miss the best: the interval
    /// holds all the same. The pose's numbers are taken as exact.
    ///
    /// The solid of a mesh is where its [`winding_number`](Bvh::winding_number) is above ½: its
    /// components may overlap, contain each other and cross themselves. Both blobs need moments
    /// (`--for closest,segment,winding`). If a mesh is not closed, the relation is undecided
    /// ([`Undecided::OpenMesh`]). Solids that only touch from outside are undecided too. Triangles
    /// without area count as surface, and hold no solid.
    ///
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES), or
    /// [`scratch_entries`](Bvh::scratch_entries) of the larger tree if that is more, are always
    /// enough. The steps of the budget are those of all searches together. No more translations are
    /// tried as soon as the interval meets a tolerance.
    ///
    /// Cost: of solids that are apart, a [`distance_to`](Bvh::distance_to), and a
    /// [`signed_distance_by_winding`](Bvh::signed_distance_by_winding) for each box of either tree
    /// that is the first on its branch to be farther from the other surface than it is large. Of
    /// others at most 332 points, each asked for in both trees; a dozen translations from afar,
    /// with a [`first_contact_of`](Bvh::first_contact_of) each; and 17 short ones for each factor
    /// of 1.5 between both ends, with a [`within_of`](Bvh::within_of) each. Of solids that only
    /// touch there are 35 such factors.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Pose, Relation, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<{ Bvh::DISTANCE_ENTRIES }>::new());
    /// let pose = Pose { translation: [300.0, 0.0, 0.0], ..Pose::IDENTITY };
    /// let found = part.penetration(&part, pose, Budget::EXACT, &mut scratch)?;
    /// assert_eq!(found.relation, Relation::Apart);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`distance_to`](Bvh::distance_to),
    /// [`signed_distance_by_winding`](Bvh::signed_distance_by_winding) and [`Pose::to_model`].
    #[inline(never)]
    pub fn penetration(
        &self,
        other: &Bvh<'_>,
        pose: Pose,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Penetration, QueryError> {
        budget.check_with(scratch)?;
        if !(self.serves_distances() && other.serves_distances()) {
            return Err(QueryError::NO_DISTANCES);
        }
        if !(self.serves_winding() && other.serves_winding()) {
            return Err(QueryError::NO_MOMENTS);
        }
        let mut queries = PairQueries::new([self, other], pose, budget.steps, scratch);
        let near = queries.distance(&pose)?;
        let mut found = Penetration {
            relation: Relation::Undecided(Undecided::OpenMesh),
            depth: Interval::new(0.0, f32::INFINITY),
            apart: None,
            deepest: None,
            work: Work::default(),
            ended: Ended::Resolution,
        };
        if self.is_closed() && other.is_closed() {
            found.relation = if near.distance.lower > 0.0 {
                queries.relation(&pose)?
            } else if near.distance.upper == 0.0 {
                Relation::Overlap
            } else {
                Relation::Undecided(near.ended.undecided())
            };
            if found.relation == Relation::Apart {
                (found.depth, found.apart) = (Interval::new(0.0, 0.0), Some(pose));
            } else {
                let [start, _] = near.points;
                bound_depth(&mut queries, &mut found, start, &budget)?;
            }
            found.ended = queries.ended();
        }
        found.work = queries.work;
        Ok(found)
    }
}

/// Bounds the depth of two solids that are not known to be apart.
fn bound_depth(
    queries: &mut PairQueries<'_, '_>,
    found: &mut Penetration,
    start: [f32; 3],
    budget: &Budget,
) -> Result<(), QueryError> {
    let deepest = deepest::search(queries, start)?;
    let separating = separating::search(queries, &deepest, budget)?;
    let (lower, upper) = (deepest.proved(), separating.length);
    found.relation = match found.relation {
        Relation::Undecided(_) if lower > 0.0 => Relation::Overlap,
        // The whole motion to the pose itself is clear.
        Relation::Undecided(_) if upper == 0.0 => Relation::Apart,
        relation => relation,
    };
    // The lower end is below the upper one, unless the blob's bytes were changed.
    found.depth = Interval::new(down_to_f32(lesser(lower, upper)), up_to_f32(upper));
    found.apart = separating.apart;
    found.deepest = (lower > 0.0).then_some(deepest.point);
    Ok(())
}
