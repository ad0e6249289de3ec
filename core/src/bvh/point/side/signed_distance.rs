//! Signed distance.
//!
//! *What the sign means.* In a closed mesh, triangles run through every edge as often in one
//! direction as in the other. It has a winding number at every point off the surface. The number
//! rises by one where a triangle is crossed from its front to its back. `Outside` says that the
//! number is 0, `Inside` that it is 1. A cavity's winding decides its side, as for any surface. The
//! winding is that of the mesh as the builder wound it: triangles that the file winds otherwise are
//! marked in the tree, and show the side that they turn away.
//!
//! *What a triangle tells.* If the winding number is 0 in front of the nearest triangle and 1
//! behind it, a point that sees its front is outside, and one that sees its back is inside. The
//! builder proves this of each triangle of the stored surface. It does not hold of triangles that
//! cross others, of those that lie inside another part of the surface, and of a component that is
//! inside out. Such triangles are marked *sideless*. Where one may be the nearest, the side is
//! undecided. If all are sideless, the tree says so ([`Bvh::has_sides`]), and every side is
//! undecided.
//!
//! *Why the stored surface's side is the input's.* Move every vertex on a straight line from its
//! input place to its stored place. Every point of every triangle moves by at most `surface_error`.
//! So the surface never touches a point farther from the stored surface, and the point's winding
//! number cannot change. At a smaller distance the side is undecided. What is proved of the stored
//! surface alone so holds for the input: also where a wall or a gap is thinner than the error, and
//! its two faces changed places.
//!
//! *How it is found.* Let q be the closest point, and w₀ the winding number at the query p. No
//! surface is nearer than q. So the winding number is w₀ in a half-space of directions about q. Let
//! triangles i about q have unit normals nᵢ and angles αᵢ at q (π where q lies on an edge, 2π
//! within a face). The divergence theorem on a small ball about q gives Σ αᵢ·nᵢ = −2·∫(w(x) − w₀)·x
//! over the directions x. It holds for any arrangement of triangles, manifold or not. Only
//! directions with x·(p − q) ≤ 0 contribute. So (p − q)·Σ αᵢ·nᵢ is positive if the winding number
//! is greater behind q than at p, that is, if p is outside. (Bærentzen & Aanæs, *Signed Distance
//! Computation Using the Angle Weighted Pseudonormal*, 2005, prove it for manifolds.)
//!
//! *Rounding.* In f32 the closest triangle is not certain. So all triangles that may be the closest
//! are candidates. The side is searched in four steps, until one decides:
//! 1. Every candidate clearly has its front to p, or every one its back. Then all terms of the sum
//!    at the true q have one sign. This decides faces, smooth edges and vertices, and ties.
//! 2. [`pseudonormal`](super::pseudonormal) sums about the feature that all candidates share.
//! 3. A point outside the model's box is replaced by one outside that is nearer to the box. All
//!    points outside the box are on one side.
//! 4. The search starts again from a place nearer to the surface, within the empty ball about p.
//!    High above a face and next to its edge, rounding cannot tell this face from the one beyond
//!    the edge. From a sixteenth of the distance it can.

use super::pseudonormal::{Candidates, side_of_shared_feature};
use super::search::{Searched, SideSearch};
use super::survey::Survey;
use crate::bvh::point::query::{Asked, FarPoint, PointQuery, PreparedPoint};
use crate::bvh::tree::format::Bvh;
use crate::num::greater;
use crate::query::{
    Budget, Ended, QueryError, ScratchEntry, Side, SignedDistance, Undecided, Work,
};
use glam::Vec3;

impl Bvh<'_> {
    /// Signed distance of `point` (input units), negative inside: where the nearest surface has its
    /// back to the point.
    ///
    /// For a mesh that bounds a solid this is the usual signed distance. A cavity's winding decides
    /// its side. If several surfaces are equally near up to rounding and the surface error, one of
    /// them decides.
    ///
    /// The side is never wrong. It is undecided:
    /// - if the mesh is not closed and consistently wound ([`is_closed`](Bvh::is_closed));
    /// - where the nearest triangle may be one that crosses another, lies inside another part of
    ///   the surface, or belongs to a part that is inside out; if there are no other triangles,
    ///   everywhere ([`has_sides`](Bvh::has_sides));
    /// - if the distance is not clear of the surface error and rounding;
    /// - next to walls and gaps thinner than these;
    /// - next to slivers so flat that they have no certain normal;
    /// - where a triangle without area is certainly the nearest, because it has no sides.
    ///
    /// `scratch` as for [`closest_point`](Bvh::closest_point). If it is too short, or the steps too
    /// few, the side is undecided too. Of the budget only `steps` matters: a side needs the closest
    /// point itself. Triangle and point are those of [`closest_point`](Bvh::closest_point).
    ///
    /// Cost: about that of the closest point. Two to three times as much next to sharp edges and
    /// vertices, and for points far outside. Up to four times more above a face and next to its
    /// edge, where the side is searched from nearer places. At most 44 descents: four for each of
    /// eleven places, of which damaged meshes may need all. Source: Bærentzen & Aanæs 2005.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch, Side};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
    /// let (part, mut scratch) = (Bvh::open(bytes)?, Scratch::<64>::new());
    /// let far = part.signed_distance([300.0, 0.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert_eq!(far.side, Side::Outside);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`],
    /// [`QueryError::NotServed`].
    #[inline(never)]
    pub fn signed_distance(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<SignedDistance, QueryError> {
        let tree = self;
        // Here and below in place: queries, surveys and answers are large.
        let prepared = PreparedPoint::prepare(tree, point, &budget, scratch);
        let asked = prepared.as_ref().map_err(|&refused| refused)?.asked();
        let closed = tree.is_closed();
        let (steps, stack) = (budget.steps, scratch);
        let mut search = SideSearch { tree, steps, stack, work: Work::default(), truncated: None };
        let (Asked::Near(query) | Asked::Far(FarPoint { query })) = asked;
        let mut survey = Survey::of(query);
        // Of a point that is far away it stays empty: the model's box answers.
        if matches!(asked, Asked::Near(_)) {
            search.survey_with_area(&mut survey).ok_or(QueryError::Unchecked)?;
        }
        let mut found = survey.closest(&search, point);
        let closest = found.as_mut().ok_or(QueryError::Unchecked)?;
        let mut side = None;
        if tree.has_sides() && closest.distance.lower > 0.0 && survey.has_sides() {
            side = search.clear_side(&survey).ok_or(QueryError::Unchecked)?;
        }
        closest.work = search.work;
        if let Some(why) = search.truncated {
            closest.ended = why;
        } else if side.is_none() && closed {
            closest.ended = Ended::Resolution;
        }
        let side = side.unwrap_or(Side::Undecided(match search.truncated {
            _ if !closed => Undecided::OpenMesh,
            Some(why) => why.undecided(),
            None if !tree.has_sides() => Undecided::Resolution,
            None if closest.distance.lower > 0.0 => Undecided::Feature,
            None => Undecided::OnSurface,
        }));
        Ok(SignedDistance::new(*closest, side))
    }
}

/// Searches from nearer places, at most.
const NEARER: usize = 3;

/// A place outside the model's box, a quarter of the model's size from it, input units. `None` if
/// the query is not outside.
fn outside_of_box(tree: &Bvh<'_>, query: &PointQuery) -> Option<[f32; 3]> {
    let (low, high) = tree.grid_bounds();
    let size = (high - low).max_element();
    let gap = if size > 0.0 { 0.25 * size } else { 1.0 };
    let (p, low, high) = (query.p.to_array(), low.to_array(), high.to_array());
    let most = beyond(tree, query.p);
    if most <= 0.0 {
        return None;
    }
    let mut near = p;
    let mut moved = false;
    for axis in 0..3 {
        let (x, low, high) = (p[axis], low[axis], high[axis]);
        let (end, gap) = if x > high { (high, gap) } else { (low, -gap) };
        if !moved && greater(x - high, low - x) == most {
            moved = true;
            near[axis] = end + gap;
        } else if x > high || x < low {
            near[axis] = end;
        }
    }
    let near = query.units.point(Vec3::from_array(near));
    let is_outside = moved && beyond(tree, query.units.inward_point(near)) > 0.0;
    is_outside.then_some(near)
}

/// How far a place is outside of the model's box, grid units: along the axis on which that is the
/// most. At most 0 within.
#[cfg_attr(meshsweep_small, inline(never))]
fn beyond(tree: &Bvh<'_>, p: Vec3) -> f32 {
    let (low, high) = tree.grid_bounds();
    let (below, above) = (low - p, p - high);
    let along_x = greater(below.x, above.x);
    greater(greater(along_x, greater(below.y, above.y)), greater(below.z, above.z))
}

impl SideSearch<'_, '_> {
    /// The side of a surveyed point that is clear of the surface.
    fn clear_side(&mut self, survey: &Survey<'_>) -> Searched<Side> {
        let mut side = self.side(survey)?;
        if side.is_none() && self.truncated.is_none() {
            side = self.side_of_places(outside_of_box(self.tree, survey.query), 1)?;
        }
        if side.is_none() && self.truncated.is_none() {
            side = self.side_from_nearer(survey)?;
        }
        Some(side)
    }

    /// The side of points on the way to the surface, if it is proved.
    ///
    /// The ball about the surveyed point that touches the surface is empty, so the winding number
    /// is the same in all of it. Nearer to the surface, the distances of two features differ more.
    /// Where components overlap, equally near surfaces may show different sides. So the ways to the
    /// closest triangles of either side must agree.
    fn side_from_nearer(&mut self, survey: &Survey<'_>) -> Searched<Side> {
        let band = survey.band_of(survey.with_area.distance_sq);
        let mut agreed = None;
        for (place, lower) in survey.by_side.iter().zip(&survey.least) {
            if place.is_none() || *lower > band {
                continue;
            }
            let side = self.side_of_places(survey.nearer(self.tree, *place), NEARER)?;
            if side.is_none() || agreed.is_some() && agreed != side {
                return Some(None);
            }
            agreed = side;
        }
        Some(agreed)
    }

    /// The first decided side of at most `count` places: of this one, and of those on the ways from
    /// there to the closest triangle.
    #[inline(never)]
    fn side_of_places(&mut self, mut place: Option<[f32; 3]>, count: usize) -> Searched<Side> {
        for _ in 0..count {
            let Some(point) = place else { break };
            let prepared = PreparedPoint::new(self.tree, point);
            let Ok(Asked::Near(query)) = prepared.as_ref().map(PreparedPoint::asked) else { break };
            let mut survey = Survey::of(query);
            self.survey_with_area(&mut survey)?;
            let side = self.side(&survey)?;
            if side.is_some() || self.truncated.is_some() {
                return Some(side);
            }
            place = survey.nearer(self.tree, survey.best);
        }
        Some(None)
    }

    /// The side of the surveyed point, if it is proved. The point is clear of the surface.
    fn side(&mut self, survey: &Survey<'_>) -> Searched<Side> {
        let &Survey { query, with_area, least, .. } = survey;
        if self.truncated.is_some() || with_area.is_none() {
            return Some(None);
        }
        let band = survey.band_of(with_area.distance_sq);
        let [front, back, unclear, _] = least;
        match (front <= band, back <= band, unclear <= band) {
            (true, false, false) => Some(Some(Side::Outside)),
            (false, true, false) => Some(Some(Side::Inside)),
            _ => {
                let leaf = with_area.place.leaf(self.tree);
                let leaf = leaf.as_ref()?;
                let candidates = Candidates::new(query, with_area.distance_sq);
                side_of_shared_feature(self, &candidates, leaf.corners(with_area.place.lane()))
            }
        }
    }
}
