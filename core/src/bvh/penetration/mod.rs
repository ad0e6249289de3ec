//! Two solids, one of them moved: how they lie to each other, and how deep they are in each other.
//!
//! The least translation that parts two solids of any shape is out of reach: their Minkowski sum
//! has a face for each pair of faces. Both ends of the interval need no such sum.
//!
//! | file | owns |
//! | --- | --- |
//! | this one | the question |
//! | `asking` | the questions about points that the searches share |
//! | `inside` | whether a part of one surface lies inside the other |
//! | `deepest` | the lower end: a point that is far inside both |
//! | `way_out` | the upper end: translations that part them |

mod asking;
mod deepest;
mod inside;
mod way_out;

use asking::Asking;

use crate::bvh::format::Bvh;
use crate::geom::Pose;
use crate::num::{down_to_f32, greater, lesser, up_to_f32};
use crate::query::{
    Budget, Ended, Interval, Penetration, QueryError, Relation, ScratchEntry, Undecided, Work,
};

impl Bvh<'_> {
    /// How the solid that `other` bounds, moved by `pose` from its frame to this tree's (both in
    /// input units), lies to the solid that this tree bounds, and how deep they are in each other.
    ///
    /// Both ends of [`Penetration::depth`] are proved for the input meshes as they were after
    /// repair. The upper end is the length of a translation after which the solids are apart. The
    /// model keeps clear on the whole way from there to infinity. The lower end is proved by a
    /// point that is inside both. Both are found by searches that may miss the best: the interval
    /// always holds, and its width is the measure of it. The pose's numbers are taken as exact.
    ///
    /// Inside and outside are the sides of [`signed_distance`](Bvh::signed_distance): of meshes
    /// whose parts overlap, the nearest surface decides. If a mesh has no sides, the relation is
    /// undecided ([`Undecided::OpenMesh`]). Surfaces that touch are undecided too.
    ///
    /// `scratch`: [`DISTANCE_ENTRIES`](Bvh::DISTANCE_ENTRIES), or
    /// [`scratch_entries`](Bvh::scratch_entries) of the larger tree if that is more, are always
    /// enough. The steps of the budget are those of all searches together. With a tolerance the
    /// search ends as soon as the interval meets it.
    ///
    /// Cost: of solids that are apart, a [`distance`](Bvh::distance), and a signed distance for
    /// each part of either surface that is nearer to the other than it is large. Of others some
    /// two hundred signed distances, and a [`first_contact_of`](Bvh::first_contact_of) for each of
    /// a dozen translations.
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
    /// Those of [`distance`](Bvh::distance), [`signed_distance`](Bvh::signed_distance) and
    /// [`Pose::to_model`].
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
        let mut asking = Asking::new([self, other], pose, budget.steps, scratch);
        let near = asking.distance(&pose)?;
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
                asking.relation()?
            } else if near.distance.upper == 0.0 {
                Relation::Overlap
            } else {
                Relation::Undecided(Undecided::Resolution)
            };
            if found.relation == Relation::Apart {
                (found.depth, found.apart) = (Interval::new(0.0, 0.0), Some(pose));
            } else {
                part(&mut asking, &mut found, near.points, &budget)?;
            }
            found.ended = asking.ended();
        }
        found.work = asking.work;
        Ok(found)
    }
}

/// Bounds the depth of two solids that are not known to be apart.
fn part(
    asking: &mut Asking<'_, '_>,
    found: &mut Penetration,
    near: [[f32; 3]; 2],
    budget: &Budget,
) -> Result<(), QueryError> {
    let deepest = deepest::search(asking, near)?;
    let way = way_out::search(asking, &deepest, budget)?;
    found.relation = match found.relation {
        Relation::Undecided(_) if deepest.depth > 0.0 => Relation::Overlap,
        // The whole way to the pose itself is clear.
        Relation::Undecided(_) if way.length == 0.0 => Relation::Apart,
        relation => relation,
    };
    found.depth = Interval::new(
        down_to_f32(lesser(greater(deepest.depth, 0.0), way.length)),
        up_to_f32(way.length),
    );
    found.apart = way.apart;
    found.deepest = (deepest.depth > 0.0).then_some(deepest.point);
    Ok(())
}
