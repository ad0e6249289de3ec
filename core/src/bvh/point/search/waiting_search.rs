//! A closest point on processors without floating point: triangles wait for the f32 kernel until
//! integers know no more.
//!
//! Integers bound the distance of a triangle from both sides (`geom/fan/integer.rs`). The least
//! upper bound limits the descent. So the kernel looks only at the triangles that no plane parts
//! from the query in the end, most often one, and not at each triangle that was the nearest for a
//! while. Proof: `core/docs/rounding.md` §8, "Limits by upper bounds".

use super::closest::{Closest, NearestOfLeaf};
use super::waiting::{Waiting, WaitingTriangle};
use crate::bvh::point::leaf::integer::{leaf_bounds, nearness_by_corner, sharp_lower_of};
use crate::bvh::point::leaf::nearest::Lanes;
use crate::bvh::point::leaf::plane::{LeafPlane, Residual};
use crate::bvh::tree::descent::LeafVisit;
use crate::bvh::tree::format::{FanLeaf, FullRing, LeafShape, lanes_of};
use crate::geom::fan::{Corner, IntBounds, IntLimit, IntPoint, IntVector, Nearness, vertex_bounds};
use crate::num::Real;
use crate::num::tolerance::{INT_LIMIT_GROWTH_BITS, INT_LIMIT_SLACK};

impl<N: NearestOfLeaf> Closest<'_, N> {
    /// Takes the triangles of a leaf that may be the nearest.
    #[inline(never)]
    pub(crate) fn wait(&mut self, visit: &LeafVisit<'_>, point: &IntPoint) -> Option<()> {
        let wanted = self.bound(&visit.leaf, point)?;
        for lane in lanes_of(wanted) {
            let &IntBounds { upper, corner, first, lower, .. } = self.waiting.bounds.get(lane)?;
            // The first of several with the same square is the answer.
            let is_first = usize::from(first) == lane;
            if !is_first || lower.is_beyond(self.waiting.limit) {
                continue;
            }
            if !self.waiting.makes_room() {
                // An answer that is too far is told by the last look: limits only fall.
                self.look_at_waiting()?;
            }
            let Corner { number, is_certain } = corner;
            let corner = u32::from(number) | u32::from(is_certain) << 2;
            let place = visit.child | (lane as u32) << 3 | corner << 6;
            let (node, key) = (visit.node, visit.key);
            let here = WaitingTriangle { node, place, key, upper, lower };
            // There is room.
            self.waiting.triangles.push(here).ok();
        }
        Some(())
    }

    /// Lowers the limit by the triangles of a leaf. Those that are not behind the plane have bounds:
    /// their bits.
    #[inline(never)]
    pub(crate) fn bound(&mut self, leaf: &FanLeaf<'_>, point: &IntPoint) -> Option<u32> {
        if self.has_old_plane {
            self.has_old_plane = false;
            let Waiting { residual, limit, .. } = self.waiting;
            self.beyond.plane = LeafPlane::new(point, residual.integers(), limit);
        } else if self.waiting.upper == u32::MAX {
            // The first leaf: a vertex gives the first plane.
            let (ring, shape) = (leaf.full_ring()?, leaf.shape());
            let near = self.waiting.bounds.first_mut()?;
            vertex_bounds(point, nearest_vertex(point, &ring, shape)?, near);
            let &mut IntBounds { upper, direction, .. } = near;
            let limit = IntLimit::of(self.limit_by(upper));
            self.beyond.plane = LeafPlane::new(point, direction, limit);
        }
        let bounds = self.waiting.bounds.first_chunk_mut()?;
        let (wanted, likeliest) = leaf_bounds(leaf, point, &self.beyond.plane, bounds)?;
        // One by one: else it would be a call of `memmove`, for which alone firmware links it.
        let &IntBounds { upper, direction: [x, y, z], .. } = bounds.get(likeliest)?;
        if wanted != 0 && upper < self.waiting.upper {
            self.waiting.upper = upper;
            self.waiting.residual = Residual::of_integers([x, y, z]);
            let limit = self.limit_by(self.waiting.upper);
            if Real(limit) < Real(self.beyond.distance_sq) {
                self.beyond.distance_sq = limit;
                self.limit = self.query.key_limit(limit);
                self.waiting.limit = IntLimit::of(limit);
            }
            self.has_old_plane = true;
        }
        Some(wanted)
    }

    #[inline(never)]
    fn nearness_of(&self, here: &WaitingTriangle, point: &IntPoint) -> Option<Nearness> {
        let [node, child] = here.leaf();
        let leaf = self.tree.leaf(node, child)?;
        nearness_by_corner(&leaf, self.query.p, point, here.lane(), here.corner())
    }

    /// Whether a sharper bound tells that a triangle is beyond the limit. Two that wait most often
    /// share the nearest edge, and no bound parts them. Small code does without it.
    #[inline(never)]
    fn is_sharply_beyond(&self, here: &WaitingTriangle, point: &IntPoint) -> Option<bool> {
        let is_inner = here.corner().number == Corner::NONE.number;
        if cfg!(meshsweep_small) || self.waiting.triangles.len() <= 2 || !is_inner {
            return Some(false);
        }
        let [node, child] = here.leaf();
        let lower = sharp_lower_of(&self.tree.leaf(node, child)?, point, here.lane())?;
        Some(lower.is_beyond(self.waiting.limit))
    }

    /// The squared limit by a squared upper bound.
    fn limit_by(&self, upper: u32) -> f32 {
        let slack = Real(self.query.allowance).times_power(INT_LIMIT_SLACK);
        (Real(f32::from_bits(upper + INT_LIMIT_GROWTH_BITS)) + slack).0
    }

    /// Looks at the triangles that wait: at the likeliest, then at the others, the latest first.
    ///
    /// False: the kernel found the nearest one farther than integers had promised. What was left
    /// out may be nearer, so the search has to begin anew without waiting. A triangle with two
    /// corners in one place of the grid and an edge of one unit can do so.
    #[inline(never)]
    pub(crate) fn look_at_waiting(&mut self) -> Option<bool> {
        let Some(point) = &self.query.int_point else { return Some(true) };
        let count = self.waiting.triangles.len();
        let waiting = self.waiting.triangles.iter().enumerate();
        let likeliest = waiting.min_by_key(|(_, here)| here.upper).map_or(0, |(at, _)| at);
        for turn in 0..count + 1 {
            let at = if turn == 0 { likeliest } else { count - turn };
            let is_again = turn > 0 && at == likeliest;
            if count == 0 || is_again {
                continue;
            }
            let here = self.waiting.triangles.get(at)?;
            if here.lower.is_beyond(self.waiting.limit) {
                continue;
            }
            if turn > 0 && self.is_sharply_beyond(here, point)? {
                continue;
            }
            let (leaf, lane, key) = (here.leaf(), here.lane(), here.key);
            let near = self.nearness_of(here, point)?;
            let (square, best) = (Real(near.distance_sq), Real(self.best.distance_sq));
            // The least triangle of a leaf is the answer. `improve` looks at leaves.
            let is_later = square == best
                && [self.best.node, self.best.child] == leaf
                && self.best.lanes.at(best.0).0 < lane;
            if square <= best && !is_later {
                self.improve(near.distance_sq, &Lanes::one(lane, &near), leaf);
                self.waiting.limit = IntLimit::of(self.beyond.distance_sq);
            }
            if Real(near.lower_bound_sq) < Real(self.refine_below) {
                self.refine(leaf, key, 1 << (lane & 31))?;
            }
        }
        self.waiting.triangles.clear();
        let (upper, limit) = (self.waiting.upper, self.query.limit(self.best.distance_sq));
        Some(upper == u32::MAX || Real(limit) <= Real(self.limit_by(upper)))
    }
}

/// The vertex of a leaf that is about the nearest.
#[inline(never)]
fn nearest_vertex(point: &IntPoint, ring: &FullRing<'_>, shape: LeafShape) -> Option<IntVector> {
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
    for at in 0..shape.triangles() + 1 {
        take(ring.vertex(at)?);
    }
    Some(nearest)
}
