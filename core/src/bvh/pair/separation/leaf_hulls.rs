//! The hulls of two leaves in the first grid, and their triangles.

use super::goal::Goal;
use super::grid_pose::GridPose;
use crate::bvh::pair::leaf_keys::{keys_of_triangles, pairs_along};
use crate::bvh::pair::leaf_pair::{Corners, SLOTS};
use crate::bvh::pair::pair_keys::{indices_of, key_limit};
use crate::bvh::tree::format::{LeafShape, RING};
use crate::bvh::tree::triangle_at::TriangleAt;
use crate::geom::{hull_gap, triangle_gap};
use crate::num::{each, float};
use crate::query::Work;
use glam::Vec3;

/// Vertices of a leaf, for their convex hull; units and frame of the first grid. Two centres, then
/// the ring. Of a leaf with one fan both centres are the same.
#[derive(Clone, Copy)]
pub(crate) struct LeafHull {
    of: TriangleAt,
    vertices: [Vec3; SLOTS],
    used: usize,
    shape: LeafShape,
}

impl LeafHull {
    /// Of no leaf. Not a constant: a constant is copied, and this is cleared.
    #[inline(always)]
    pub(crate) fn none() -> LeafHull {
        let vertices = [Vec3::ZERO; SLOTS];
        LeafHull { of: TriangleAt::NONE, vertices, used: 0, shape: LeafShape(0) }
    }

    /// Computes the vertices of a leaf of model 0 or 1, unless they are those of this leaf already.
    /// `None` if the tree is unchecked.
    #[inline(always)]
    pub(crate) fn set(&mut self, pose: &GridPose<'_>, model: usize, of: TriangleAt) -> Option<()> {
        if self.of == of {
            return Some(());
        }
        let leaf = of.leaf(pose.trees[model & 1])?;
        let ring = leaf.grid_ring()?;
        let place = |[x, y, z]: [i32; 3]| {
            let vertex = Vec3::new(float(x), float(y), float(z));
            if model == 0 { vertex } else { pose.moved(vertex) }
        };
        let [first, second] = ring.centres;
        let [v, w, rest @ ..] = &mut self.vertices;
        *v = place(first);
        *w = if leaf.shape().centres() == 2 { place(second) } else { *v };
        let integer = |pair: &[u8; 2]| i32::from(u16::from_le_bytes(*pair));
        let stored = ring.x.iter().zip(ring.y).zip(ring.z);
        for (vertex, ((x, y), z)) in rest.iter_mut().zip(stored) {
            *vertex = place([integer(x), integer(y), integer(z)]);
        }
        self.shape = leaf.shape();
        (self.of, self.used) = (of, (RING + self.shape.triangles() + 1).min(SLOTS));
        Some(())
    }

    #[inline(always)]
    fn all(&self) -> &[Vec3] {
        self.vertices.get(..self.used).unwrap_or(&[])
    }

    #[inline(always)]
    fn corners(&self) -> Corners {
        Corners::of(&self.vertices, self.shape)
    }

    #[inline(always)]
    fn triangle(&self, lane: usize) -> [Vec3; 3] {
        let slots = crate::bvh::tree::format::slots(lane, self.shape.turn());
        each(slots, |slot| self.vertices.get(slot).copied().unwrap_or(Vec3::ZERO))
    }

    /// A triangle with the vertex in a slot.
    #[inline(always)]
    fn triangle_with(&self, slot: usize) -> TriangleAt {
        let last = self.shape.triangles().wrapping_sub(1);
        let lane = match slot {
            0 => 0,
            1 => self.shape.turn(),
            _ => slot.wrapping_sub(RING),
        };
        // One fan has two equal centres.
        self.of.with_lane(if slot == 1 && lane > last { 0 } else { lane.min(last) })
    }
}

/// What a visit of two leaves showed.
pub(crate) struct HullVisit {
    pub(crate) goes_on: bool,
    /// A direction along which the leaves are apart. `None` if none was found.
    pub(crate) direction: Option<Vec3>,
}

/// Visits the leaves at two places. `hulls`: those of the last visit.
#[inline(never)]
pub(super) fn visit_leaves_at(
    pose: &GridPose<'_>,
    goal: &mut Goal<'_>,
    [first, second]: &mut [LeafHull; 2],
    [a, b]: [TriangleAt; 2],
    start: Vec3,
    work: &mut Work,
) -> Option<HullVisit> {
    first.set(pose, 0, a)?;
    second.set(pose, 1, b)?;
    visit_hulls([first, second], start, goal, work)
}

/// Gives the goal each pair of triangles of two leaves that may matter to it, nearest bound first.
/// `start`: the direction that is tried first. `None` if a tree is unchecked.
#[inline(never)]
fn visit_hulls(
    [a, b]: [&LeafHull; 2],
    start: Vec3,
    goal: &mut Goal<'_>,
    work: &mut Work,
) -> Option<HullVisit> {
    let hull = hull_gap(a.all(), b.all(), start, goal.limits);
    let direction = (hull.gap_sq > 0.0).then_some(hull.direction);
    let visit = |goes_on| Some(HullVisit { goes_on, direction });
    let [p, q] = hull.vertices;
    if !goal.take_vertices(hull.vertex_sq, || [a.triangle_with(p), b.triangle_with(q)]) {
        return visit(false);
    }
    if hull.gap_sq > goal.limits.far_sq || goal.keep_unopened([a.of, b.of], hull.gap_sq) {
        return visit(true);
    }
    let (first, second) = (a.corners(), b.corners());
    let far_sq = goal.limits.far_sq;
    let along = |direction: Vec3| pairs_along(direction.to_array(), far_sq, &first, &second);
    let near = direction.map_or(u64::MAX, along);
    if near == 0 {
        return visit(true);
    }
    let mut keys = keys_of_triangles(&first, &second, far_sq, near)?;
    let mut direction = hull.direction;
    loop {
        let key = keys.least();
        if key > key_limit(goal.limits.far_sq) {
            return visit(true);
        }
        keys.drop(key);
        let [i, j] = indices_of(key).map(|lane| lane as usize);
        work.triangles = work.triangles.saturating_add(1);
        let found = triangle_gap(&a.triangle(i), &b.triangle(j), direction, goal.limits);
        direction = found.direction;
        if !goal.take([a.of.with_lane(i), b.of.with_lane(j)], &found) {
            return visit(false);
        }
        if goal.keep_unopened([a.of, b.of], hull.gap_sq) {
            return visit(true);
        }
    }
}
