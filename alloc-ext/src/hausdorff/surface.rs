//! The surface that distances are measured to: queries in f32 by its box tree, bounds in f64.

use super::piece::ROUNDED_UP;
use crate::mesh::Mesh;
use glam::DVec3;
use meshsweep_core::internal::geom::point_triangle;
use meshsweep_core::{Budget, Bvh, Ended, Neighbor, ScratchEntry};

/// The surface that distances are measured to.
pub(super) struct Surface<'a> {
    pub(super) tree: &'a Bvh<'a>,
    pub(super) triangles: Vec<[DVec3; 3]>,
    pub(super) sources: Vec<u32>,
}

/// The distance of a point from a surface.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// A triangle that is at most `upper` away.
    pub(super) triangle: usize,
}

/// One thread's memory for queries.
pub(super) struct QueryScratch {
    entries: Vec<ScratchEntry>,
    neighbors: Vec<Neighbor>,
}

impl<'a> Surface<'a> {
    pub(super) fn new(tree: &'a Bvh<'a>, mesh: &Mesh) -> Self {
        Surface {
            tree,
            triangles: mesh.all_corners_f64().collect(),
            sources: mesh.all_sources().collect(),
        }
    }

    pub(super) fn scratch(&self) -> QueryScratch {
        let entries = vec![ScratchEntry::EMPTY; self.tree.scratch_entries()];
        QueryScratch { entries, neighbors: vec![Neighbor::EMPTY; 64] }
    }

    /// Bounds from above in f64, from below in f32. Nothing is known if the query fails.
    pub(super) fn near(&self, p: DVec3, scratch: &mut QueryScratch) -> Near {
        let asked = p.as_vec3();
        let nothing = Near { lower: 0.0, upper: f64::INFINITY, triangle: 0 };
        let Ok(answer) =
            self.tree.closest_point(asked.to_array(), Budget::EXACT, &mut scratch.entries)
        else {
            return nothing;
        };
        let rounded = (asked.as_dvec3() - p).length();
        let lower = (f64::from(answer.distance.lower) - rounded).next_down();
        answer.triangle.map_or(nothing, |triangle| self.near_triangle(p, lower, triangle))
    }

    /// A lower bound, and the distance from a triangle.
    pub(super) fn near_triangle(&self, p: DVec3, lower: f64, triangle: u32) -> Near {
        let triangle = triangle as usize;
        let upper = self.distance_from(p, triangle);
        Near { lower: lower.max(0.0).min(upper), upper, triangle }
    }

    fn distance_from(&self, p: DVec3, triangle: usize) -> f64 {
        self.triangles
            .get(triangle)
            .map_or(f64::INFINITY, |&[a, b, c]| point_triangle(p, a, b, c).upper)
    }

    /// Both bounds in f64: against every triangle that may be nearer.
    pub(super) fn bounds_in_f64(&self, p: DVec3, near: Near, scratch: &mut QueryScratch) -> Near {
        let mut sharp = Near { lower: f64::INFINITY, ..near };
        let is_known = self.for_each_within(p, near.upper, scratch, |number, triangle| {
            let [a, b, c] = triangle;
            let distance = point_triangle(p, a, b, c);
            sharp.lower = sharp.lower.min(distance.lower);
            if distance.upper < sharp.upper {
                (sharp.upper, sharp.triangle) = (distance.upper, number);
            }
        });
        if is_known {
            Near { lower: sharp.lower.max(near.lower).min(sharp.upper), ..sharp }
        } else {
            near
        }
    }

    /// Visits all triangles that may be within a distance, and perhaps some more. `false` if they
    /// are not known, or there is none.
    pub(super) fn for_each_within(
        &self,
        p: DVec3,
        distance: f64,
        scratch: &mut QueryScratch,
        mut visit: impl FnMut(usize, [DVec3; 3]),
    ) -> bool {
        let asked = p.as_vec3();
        let reach = distance + (asked.as_dvec3() - p).length();
        let distance = ((reach * ROUNDED_UP) as f32).next_up();
        let all = loop {
            let QueryScratch { entries, neighbors } = scratch;
            let point = asked.to_array();
            let Ok(all) = self.tree.all_within(point, distance, neighbors, Budget::EXACT, entries)
            else {
                return false;
            };
            if all.dropped == 0 {
                break all;
            }
            let wanted = neighbors.len() + all.dropped as usize;
            neighbors.resize(wanted, Neighbor::EMPTY);
        };
        let Some(found) = scratch.neighbors.get(..all.stored) else { return false };
        if all.ended != Ended::Exact || found.is_empty() {
            return false;
        }
        for neighbor in found {
            let number = neighbor.triangle() as usize;
            let Some(&triangle) = self.triangles.get(number) else { return false };
            visit(number, triangle);
        }
        true
    }
}
