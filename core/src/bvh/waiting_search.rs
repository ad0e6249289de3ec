//! A closest point on processors without floating point: triangles wait for the f32 kernel until
//! integers know no more.
//!
//! Integers bound the distance of a triangle from both sides (`geom/fan/whole.rs`). The least upper
//! bound limits the descent. So the kernel looks only at the triangles that no plane parts from the
//! query in the end, most often one, and not at each triangle that was the nearest for a while.
//! Proof: `core/docs/rounding.md` §8, "Limits by upper bounds".

use crate::bvh::descent::LeafVisit;
use crate::bvh::format::{FanLeaf, FullRing, LeafShape};
use crate::bvh::leaf_nearest::LeafNearest;
use crate::bvh::leaf_plane::{LeafPlane, Way};
use crate::bvh::nearest_search::{Best, Closest, NearestOfLeaf};
use crate::bvh::waiting::{Waiting, WaitingTriangle};
use crate::bvh::whole_leaf::{leaf_bounds, nearness_by_corner, sharp_lower_of};
use crate::geom::fan::{
    Corner, Nearness, WIDTH, WholeBounds, WholeLimit, WholePoint, vertex_bounds,
};
use crate::num::Real;

/// Added to the bits of a squared upper bound: at least 2^-12 of it.
const GROWTH_BITS: u32 = 1 << 12;

/// Factor of [`PointQuery::allowance`](crate::bvh::point_query::PointQuery::allowance) in a limit
/// by an upper bound. Proved: 2 (`core/docs/rounding.md` §8).
const SLACK: f32 = 8.0;

impl<N: NearestOfLeaf> Closest<'_, N> {
    /// Takes the triangles of a leaf that may be the nearest.
    #[inline(never)]
    pub(super) fn wait(&mut self, visit: &LeafVisit<'_>, point: &WholePoint) -> Option<()> {
        let mut bounds = [WholeBounds::NONE; WIDTH];
        let wanted = self.bound(&visit.leaf, point, &mut bounds)?;
        for (lane, bounds) in bounds.iter().enumerate() {
            // The first of several with the same square is the answer.
            let is_first = wanted >> lane & 1 != 0 && usize::from(bounds.first) == lane;
            if !is_first || bounds.lower.is_beyond(self.waiting.limit) {
                continue;
            }
            if !self.waiting.makes_room() {
                self.look_at_waiting()?;
            }
            if let Some(slot) = self.waiting.triangles.get_mut(self.waiting.count) {
                let Corner { number, is_certain } = bounds.corner;
                let corner = u32::from(number) | u32::from(is_certain) << 2;
                let place = visit.child | (lane as u32) << 3 | corner << 6;
                let (node, key, upper) = (visit.node, visit.key, bounds.upper);
                *slot = WaitingTriangle { node, place, key, upper, lower: bounds.lower };
                self.waiting.count += 1;
            }
        }
        Some(())
    }

    /// Lowers the limit by the triangles of a leaf. Those that are not behind the plane have
    /// `bounds`: their bits.
    #[inline(never)]
    pub(super) fn bound(
        &mut self,
        leaf: &FanLeaf<'_>,
        point: &WholePoint,
        bounds: &mut [WholeBounds; WIDTH],
    ) -> Option<u32> {
        if self.has_old_plane {
            self.has_old_plane = false;
            let Waiting { way, limit, .. } = self.waiting;
            self.beyond.plane = LeafPlane::new(point, way.whole(), limit);
        } else if self.waiting.upper == u32::MAX {
            // The first leaf: a vertex gives the first plane.
            let (ring, shape) = (leaf.full_ring()?, leaf.shape());
            let near = nearest_vertex(point, &ring, shape)?;
            let limit = WholeLimit::of(self.limit_by(near.upper));
            self.beyond.plane = LeafPlane::new(point, near.direction, limit);
        }
        let wanted = leaf_bounds(leaf, point, &self.beyond.plane, bounds)?;
        let mut nearest = None;
        for here in &*bounds {
            if here.upper < self.waiting.upper {
                self.waiting.upper = here.upper;
                nearest = Some(here.direction);
            }
        }
        if let Some(direction) = nearest {
            self.waiting.way = Way::of_whole(direction);
            let limit = self.limit_by(self.waiting.upper);
            if Real(limit) < Real(self.beyond.distance_sq) {
                self.beyond.distance_sq = limit;
                self.limit = self.query.key_limit(limit);
                self.waiting.limit = WholeLimit::of(limit);
            }
            self.has_old_plane = true;
        }
        Some(wanted)
    }

    #[inline(never)]
    fn nearness_of(&self, here: &WaitingTriangle, point: &WholePoint) -> Option<Nearness> {
        let [node, child] = here.leaf();
        let leaf = self.tree.leaf(node, child)?;
        nearness_by_corner(&leaf, self.query.p, point, here.lane(), here.corner())
    }

    /// Whether a sharper bound tells that a triangle is beyond the limit. Two that wait most often
    /// share the nearest edge, and no bound parts them.
    #[inline(never)]
    fn is_sharply_beyond(&self, here: &WaitingTriangle, point: &WholePoint) -> Option<bool> {
        if self.waiting.count <= 2 || here.corner().number != Corner::NONE.number {
            return Some(false);
        }
        let [node, child] = here.leaf();
        let lower = sharp_lower_of(&self.tree.leaf(node, child)?, point, here.lane())?;
        Some(lower.is_beyond(self.waiting.limit))
    }

    /// The squared limit by a squared upper bound.
    fn limit_by(&self, upper: u32) -> f32 {
        let slack = Real(self.query.allowance).times_power(SLACK);
        (Real(f32::from_bits(upper + GROWTH_BITS)) + slack).0
    }

    /// Looks at the triangles that wait: at the likeliest, then leaf by leaf, the latest first.
    #[inline(never)]
    pub(super) fn look_at_waiting(&mut self) -> Option<()> {
        let Some(point) = &self.query.whole else { return Some(()) };
        let mut end = self.waiting.count;
        let mut likeliest = (end, None);
        if end > 1 {
            let waiting = self.waiting.triangles.iter().take(end).enumerate();
            let (at, here) = waiting.min_by_key(|(_, here)| here.upper)?;
            let near = self.nearness_of(here, point)?;
            let limit = self.query.limit(near.distance_sq);
            if Real(limit) < Real(self.beyond.distance_sq) {
                self.beyond.distance_sq = limit;
                self.waiting.limit = WholeLimit::of(limit);
            }
            likeliest = (at, Some(near));
        }
        while let Some(last) = self.waiting.triangles.get(end.wrapping_sub(1)).copied() {
            let [node, child] = last.leaf();
            let mut nearest = LeafNearest::NONE;
            while let Some(here) = self.waiting.triangles.get(end.wrapping_sub(1))
                && here.leaf() == last.leaf()
            {
                end -= 1;
                if here.lower.is_beyond(self.waiting.limit) {
                    continue;
                }
                let near = match likeliest {
                    (at, Some(near)) if at == end => near,
                    _ if self.is_sharply_beyond(here, point)? => continue,
                    _ => self.nearness_of(here, point)?,
                };
                nearest.take(here.lane(), &near, self.beyond.low_sq);
            }
            let Best { distance_sq, lanes, .. } = &self.best;
            // A part of the leaf may have been looked at before.
            let (here, best) = (Real(nearest.distance_sq), Real(*distance_sq));
            let is_later = here == best
                && [self.best.node, self.best.child] == [node, child]
                && lanes.at(*distance_sq).0 < nearest.lanes.at(*distance_sq).0;
            if here <= best && !is_later {
                self.improve(nearest.distance_sq, &nearest.lanes, [node, child]);
                self.waiting.limit = WholeLimit::of(self.beyond.distance_sq);
            }
            if Real(nearest.lower_bound_sq) < Real(self.refine_below) {
                self.refine([node, child], last.key, nearest.low)?;
            }
        }
        self.waiting.count = 0;
        Some(())
    }
}

/// Bounds of the vertex of a leaf that is about the nearest.
#[inline(never)]
fn nearest_vertex(
    point: &WholePoint,
    ring: &FullRing<'_>,
    shape: LeafShape,
) -> Option<WholeBounds> {
    let [one, other] = ring.centres(shape);
    let mut nearest = one;
    let mut least = point.about(one);
    let mut take = |vertex| {
        let square = point.about(vertex);
        if square < least {
            (nearest, least) = (vertex, square);
        }
    };
    take(other);
    for at in 0..=shape.triangles() {
        take(ring.vertex(at)?);
    }
    Some(vertex_bounds(point, nearest))
}
