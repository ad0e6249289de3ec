//! Structures that answer about segments and contacts: the box tree, else the hull hierarchy.

use crate::error::NotServedError;
use crate::model::{BESIDE_HULL, Model, beyond, grown};
use crate::rounding::{Way, moved};
use crate::segments::ends;
use crate::solids::SolidQueries;
use meshsweep::bvh::FastBvh;
use meshsweep_core::{
    AllHits, AllOverlaps, Budget, Bvh, Decided, Facing, FirstHit, Hull, Pose, QueryError,
    ScratchEntry, TriangleHit, TrianglePair,
};
use pyo3::prelude::*;

/// A structure that answers about segments and rays.
pub enum Engine<'a> {
    Tree(FastBvh<'a>),
    Hull(Hull<'a>),
}

/// Structures of the same kind of two models.
pub enum Both<'a> {
    Trees([FastBvh<'a>; 2]),
    Hulls([Hull<'a>; 2]),
}

impl Model {
    /// The box tree; without one the hull hierarchy, which knows no facing.
    pub fn engine(&self, facing: Facing) -> PyResult<Engine<'_>> {
        match (self.tree("segment"), self.blob().hull()) {
            (Err(_), Ok(hull)) if facing == Facing::Both => Ok(Engine::Hull(hull)),
            (tree, _) => tree.map(Engine::Tree),
        }
    }

    /// The box trees; where one is missing, and both have one, the hull hierarchies.
    pub fn both<'a>(&'a self, other: &'a Model) -> PyResult<Both<'a>> {
        match (self.pair(other, "segment"), self.blob().hull(), other.blob().hull()) {
            (Err(_), Ok(first), Ok(second)) => Ok(Both::Hulls([first, second])),
            (pair, ..) => pair.map(Both::Trees),
        }
    }
}

impl Engine<'_> {
    /// With so many scratch entries no question ends for lack of memory.
    pub fn entries(&self) -> usize {
        match self {
            Self::Tree(tree) => tree.scratch_entries(),
            Self::Hull(hull) => hull.scratch_entries() + BESIDE_HULL,
        }
    }

    /// Of a ray both ends are its origin and its direction.
    pub fn first_hit(
        &self,
        [a, b]: [[f32; 3]; 2],
        is_ray: bool,
        facing: Facing,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        match (self, is_ray) {
            (Self::Tree(tree), true) => tree.first_hit_of_ray(a, b, facing, budget, scratch),
            (Self::Tree(tree), false) => tree.first_hit(a, b, facing, budget, scratch),
            (Self::Hull(hull), true) => hull.first_hit_of_ray(a, b, budget, scratch),
            (Self::Hull(hull), false) => hull.first_hit(a, b, budget, scratch),
        }
    }

    /// A clear first hit of a rounded segment or ray, carried over to the caller's one. Rows have
    /// both points, and how far rounding moved each. The caller's one is clear if a ball of the
    /// rounding's radius passes along the rounded one. The ball stops at triangles of either
    /// facing.
    pub fn as_given(
        &self,
        row: &[f32; 8],
        is_ray: bool,
        mut clear: FirstHit,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        let points = ends(row);
        let off = [row[6].into(), row[7].into()];
        let bounds = match self {
            Self::Tree(tree) => grown(tree.bounds(), beyond(tree.surface_error())),
            Self::Hull(hull) => grown(hull.bounds(), beyond(hull.surface_error())),
        };
        let way = match is_ray {
            true => Way::of_ray(points, off, bounds),
            false => Way::of_segment(points, moved(row)),
        };
        if way.misses(bounds) {
            return Ok(clear);
        }
        let tree = match self {
            Self::Tree(tree) => SolidQueries { tree: **tree, with_field: None },
            Self::Hull(hull) => {
                return way.by_balls(clear, |centre| {
                    let near = hull.closest_point(centre, budget, scratch)?;
                    Ok((near.distance.lower, near.work))
                });
            }
        };
        let [a, b] = way.ends;
        let passed = tree.first_contact([&[a], &[b]], 0.0, way.moved, budget, scratch);
        // Solids have a smaller domain. Beyond it nothing is known.
        let Ok(passed) = passed else { return Ok(way.undecided(clear, 0.0)) };
        clear.work = clear.work.and(passed.work);
        if passed.is_clear() {
            return Ok(clear);
        }
        clear.hit = passed.hit;
        let mut found = way.undecided(clear, passed.t.lower.into());
        found.ended = passed.ended;
        Ok(found)
    }

    pub fn all_hits(
        &self,
        [a, b]: [[f32; 3]; 2],
        is_ray: bool,
        facing: Facing,
        answers: &mut [TriangleHit],
        scratch: &mut [ScratchEntry],
    ) -> Result<AllHits, QueryError> {
        let budget = Budget::EXACT;
        match (self, is_ray) {
            (Self::Tree(tree), true) => {
                tree.all_hits_of_ray(a, b, facing, answers, budget, scratch)
            }
            (Self::Tree(tree), false) => tree.all_hits(a, b, facing, answers, budget, scratch),
            (Self::Hull(hull), true) => hull.all_hits_of_ray(a, b, answers, budget, scratch),
            (Self::Hull(hull), false) => hull.all_hits(a, b, answers, budget, scratch),
        }
    }
}

impl Both<'_> {
    /// With so many scratch entries no question ends for lack of memory.
    pub fn entries(&self) -> usize {
        match self {
            Self::Trees(_) => Bvh::OVERLAP_ENTRIES,
            Self::Hulls([first, second]) => first.overlap_entries(second),
        }
    }

    pub fn overlap(
        &self,
        pose: Pose,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<[u32; 2]>, QueryError> {
        match self {
            Self::Trees([a, b]) => a.overlap(b, pose, Budget::EXACT, scratch),
            Self::Hulls([a, b]) => a.overlap(b, pose, Budget::EXACT, scratch),
        }
    }

    pub fn all_overlaps(
        &self,
        pose: Pose,
        answers: &mut [TrianglePair],
        scratch: &mut [ScratchEntry],
    ) -> Result<AllOverlaps, QueryError> {
        match self {
            Self::Trees([a, b]) => a.all_overlaps(b, pose, answers, Budget::EXACT, scratch),
            Self::Hulls([a, b]) => a.all_overlaps(b, pose, answers, Budget::EXACT, scratch),
        }
    }

    /// Refuses a hierarchy that was cut: it knows no triangles.
    pub fn knows_triangles(self) -> PyResult<Self> {
        match &self {
            Self::Hulls(hulls) if hulls.iter().any(Hull::is_cut) => Err(NotServedError::new_err(
                "a hull hierarchy that was cut knows no triangles: ask for overlap",
            )),
            _ => Ok(self),
        }
    }
}
