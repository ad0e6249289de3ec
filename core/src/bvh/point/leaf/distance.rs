//! The nearest triangle of a leaf.
//!
//! Targets with vectors look at eight triangles at once (`wide`), others at one after the other
//! (`narrow`). Both give the same bits.

use super::limit::LeafLimit;
use super::nearest::LeafNearest;
use super::squares::LeafSquares;
use crate::bvh::point::query::PointQuery;
use crate::bvh::tree::format::FanLeaf;
#[cfg(not(meshsweep_wide))]
use crate::num::SOFT_FLOAT;

#[cfg(meshsweep_avx2)]
pub(crate) use avx2::nearest_avx2;
#[cfg(not(meshsweep_wide))]
pub(crate) use narrow::{nearest_and_edges, nearest_within, nearest_within_inlined};
#[cfg(meshsweep_wide)]
pub(crate) use wide::nearest_within as nearest_within_inlined;
#[cfg(meshsweep_wide)]
pub(crate) use wide::{LeafEdges, leaf_edges, nearest_and_edges, nearest_within};

/// The nearest triangle of a leaf, without a limit.
#[inline(always)]
pub(crate) fn nearest_triangle(leaf: &FanLeaf<'_>, query: &PointQuery) -> Option<LeafNearest> {
    #[cfg(not(meshsweep_wide))]
    if !SOFT_FLOAT && !leaf.is_f32() {
        return narrow::nearest_of_all(leaf, query.p);
    }
    nearest_within(leaf, query, &LeafLimit::NONE, None)
}

/// Edges are not kept.
#[cfg(not(meshsweep_wide))]
pub(crate) type LeafEdges = core::convert::Infallible;

/// The nearest triangle of a leaf. On vector targets also the edges of the leaf's triangles, seen
/// from the query point.
pub(crate) type LeafSeen = (LeafNearest, Option<LeafEdges>);

#[cfg(meshsweep_wide)]
mod wide {
    use super::{FanLeaf, LeafLimit, LeafNearest, LeafSeen, LeafSquares, PointQuery};
    use crate::bvh::point::leaf::nearest::Lanes;
    use crate::bvh::tree::format::LanePoint;
    use crate::geom::fan::Lanes as Register;
    use crate::geom::fan::{Edges, LANES, LaneNearness, PIECES, lanes_below, least, point_lanes};

    /// Edges of a leaf's triangles, seen from the query point.
    pub(crate) type LeafEdges = [Edges; PIECES];

    #[inline(always)]
    pub(crate) fn nearest_within(
        leaf: &FanLeaf<'_>,
        query: &PointQuery,
        limit: &LeafLimit,
        _: Option<&mut LeafSquares>,
    ) -> Option<LeafNearest> {
        let &LeafLimit { distance_sq: limit, low_sq, .. } = limit;
        let limit = if limit < f32::INFINITY { Some(limit) } else { None };
        let near = if leaf.is_f32() {
            f32_nearest(leaf, &query.lanes)?
        } else {
            let lanes = leaf.grid_lanes(&query.lanes)?;
            let used = lanes_below(leaf.shape().triangles())?;
            let mut near = [LaneNearness::NONE; PIECES];
            for piece in 0..PIECES {
                if let Some(here) = point_lanes(&lanes.edges(piece), used[piece], limit) {
                    near[piece] = here;
                }
            }
            near
        };
        Some(nearest_of(near, low_sq))
    }

    #[inline(always)]
    pub(crate) fn nearest_and_edges(leaf: &FanLeaf<'_>, query: &PointQuery) -> Option<LeafSeen> {
        let edges = leaf_edges(leaf, &query.lanes)?;
        Some((nearest_of(nearness(leaf, &edges)?, 0.0), Some(edges)))
    }

    /// Edges of all triangles.
    #[inline(always)]
    pub(crate) fn leaf_edges(leaf: &FanLeaf<'_>, point: &LanePoint) -> Option<LeafEdges> {
        if leaf.is_f32() {
            return f32_edges(leaf, point);
        }
        let lanes = leaf.grid_lanes(point)?;
        let mut edges = [Edges::NONE; PIECES];
        for (piece, edges) in edges.iter_mut().enumerate() {
            *edges = lanes.edges(piece);
        }
        Some(edges)
    }

    #[inline(always)]
    fn nearness(leaf: &FanLeaf<'_>, edges: &LeafEdges) -> Option<[LaneNearness; PIECES]> {
        let used = lanes_below(leaf.shape().triangles())?;
        let mut near = [LaneNearness::NONE; PIECES];
        for piece in 0..PIECES {
            if let Some(here) = point_lanes(&edges[piece], used[piece], None) {
                near[piece] = here;
            }
        }
        Some(near)
    }

    #[inline(always)]
    fn nearest_of(near: [LaneNearness; PIECES], low_sq: f32) -> LeafNearest {
        let lanes = Lanes {
            distance_sq: near.map(|near| near.distance_sq),
            v: near.map(|near| near.v),
            w: near.map(|near| near.w),
        };
        let distance_sq = least(lanes.distance_sq);
        let low_sq = Register::splat(low_sq);
        let mut low = 0;
        for (piece, near) in near.iter().enumerate() {
            low |= near.lower_bound_sq.simd_le(low_sq).to_bitmask() << (piece * LANES);
        }
        let lower_bound_sq = least(near.map(|near| near.lower_bound_sq));
        LeafNearest { distance_sq, lower_bound_sq, lanes, low }
    }

    #[inline(never)]
    fn f32_edges(leaf: &FanLeaf<'_>, point: &LanePoint) -> Option<LeafEdges> {
        let mut edges = [Edges::NONE; PIECES];
        for (piece, edges) in edges.iter_mut().enumerate() {
            *edges = leaf.f32_edges(point, piece)?;
        }
        Some(edges)
    }

    /// Not inlined, so that the two ways to read a leaf share no stack memory.
    #[inline(never)]
    fn f32_nearest(leaf: &FanLeaf<'_>, point: &LanePoint) -> Option<[LaneNearness; PIECES]> {
        nearness(leaf, &f32_edges(leaf, point)?)
    }
}

/// `wide` in registers of 256 bits, whatever the crate is compiled for.
#[cfg(meshsweep_avx2)]
mod avx2 {
    use super::wide::nearest_within;
    use super::{FanLeaf, LeafLimit, LeafNearest, PointQuery};
    use crate::bvh::point::leaf::nearest::Lanes;
    use crate::geom::fan::LaneNearness;
    use crate::geom::fan::lanes_avx2::{least, point_lanes, up_to};
    use wide::bytemuck::cast;

    /// See `nearest_within`. A call, with the whole kernel in it: inlined into the search, it takes
    /// as many registers as there are, and the search waits for its own on the stack.
    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    #[inline(never)]
    pub(crate) fn nearest_avx2(
        leaf: &FanLeaf<'_>,
        query: &PointQuery,
        limit: &LeafLimit,
    ) -> Option<LeafNearest> {
        if leaf.is_f32() {
            return nearest_within(leaf, query, limit, None);
        }
        let (edges, used) = leaf.edges_avx2(&query.lanes)?;
        let &LeafLimit { distance_sq: limit, low_sq, .. } = limit;
        let limit = if limit < f32::INFINITY { Some(limit) } else { None };
        let near = match point_lanes(&edges, used, limit) {
            Some(near) => near,
            None => LaneNearness::none_avx2(),
        };
        let LaneNearness { distance_sq, lower_bound_sq, v, w } = near;
        Some(LeafNearest {
            distance_sq: least(distance_sq),
            lower_bound_sq: least(lower_bound_sq),
            lanes: Lanes { distance_sq: cast(distance_sq), v: cast(v), w: cast(w) },
            low: up_to(lower_bound_sq, low_sq),
        })
    }
}

#[cfg(not(meshsweep_wide))]
mod narrow {
    use super::{
        FanLeaf, LeafLimit, LeafNearest, LeafSeen, LeafSquares, PointQuery, nearest_triangle,
    };
    use crate::bvh::point::leaf::bounds::nearness;
    use crate::bvh::point::leaf::integer::integer_nearest;
    use crate::bvh::point::leaf::nearest::Lanes;
    use crate::bvh::point::leaf::plane::Residual;
    use crate::bvh::point::query::limit_of;
    use crate::geom::fan::{ABOVE_ZERO, IntVector, PointFan, SpokeTerms, WIDTH};
    use crate::num::{SOFT_FLOAT, lesser};
    use glam::Vec3;

    /// A call, which questions share.
    #[inline(never)]
    pub(crate) fn nearest_within(
        leaf: &FanLeaf<'_>,
        query: &PointQuery,
        limit: &LeafLimit,
        known: Option<&mut LeafSquares>,
    ) -> Option<LeafNearest> {
        nearest_of_format::<false>(leaf, query, limit, known)
    }

    /// The same without a call, unless code is to be small.
    #[inline(always)]
    pub(crate) fn nearest_within_inlined(
        leaf: &FanLeaf<'_>,
        query: &PointQuery,
        limit: &LeafLimit,
        known: Option<&mut LeafSquares>,
    ) -> Option<LeafNearest> {
        if cfg!(meshsweep_small) {
            nearest_within(leaf, query, limit, known)
        } else {
            nearest_of_format::<true>(leaf, query, limit, known)
        }
    }

    #[inline(always)]
    fn nearest_of_format<const IS_CLOSEST: bool>(
        leaf: &FanLeaf<'_>,
        query: &PointQuery,
        limit: &LeafLimit,
        mut known: Option<&mut LeafSquares>,
    ) -> Option<LeafNearest> {
        let p = query.p;
        if let Some(known) = &mut known {
            known.clear();
        }
        if leaf.is_f32() {
            // Of a copy, so that the leaf itself stays in registers.
            let leaf = *leaf;
            Some(f32_nearest(&leaf, p, limit.low_sq))
        } else if SOFT_FLOAT && let Some(point) = &query.int_point {
            integer_nearest(leaf, p, point, limit, known)
        } else {
            grid_nearest::<IS_CLOSEST>(leaf, query, limit)
        }
    }

    #[inline(always)]
    pub(crate) fn nearest_and_edges(leaf: &FanLeaf<'_>, query: &PointQuery) -> Option<LeafSeen> {
        Some((nearest_triangle(leaf, query)?, None))
    }

    /// A fan of a leaf on the grid, seen from the query. Integers are subtracted before they become
    /// f32.
    struct GridFan {
        centre: IntVector,
        fan: PointFan,
    }

    impl GridFan {
        #[inline(always)]
        fn new(leaf: &FanLeaf<'_>, p: Vec3, centre: IntVector) -> Self {
            let [ox, oy, oz] = leaf.origin;
            let [x, y, z] = centre;
            let place = [x.wrapping_add(ox), y.wrapping_add(oy), z.wrapping_add(oz)];
            GridFan { centre, fan: PointFan::new(p - spoke(place, [0; 3])) }
        }

        #[inline(always)]
        fn spoke(&self, vertex: IntVector) -> SpokeTerms {
            self.fan.spoke(spoke(vertex, self.centre))
        }
    }

    /// The triangles that are not behind the limit's plane. A spoke serves the triangles on both
    /// sides.
    #[inline(always)]
    fn grid_nearest<const IS_CLOSEST: bool>(
        leaf: &FanLeaf<'_>,
        query: &PointQuery,
        limit: &LeafLimit,
    ) -> Option<LeafNearest> {
        let p = query.p;
        let mut nearest = LeafNearest::NONE;
        if IS_CLOSEST {
            nearest.distance_sq = limit.wanted_sq;
        }
        let shape = leaf.shape();
        let ring = leaf.full_ring()?;
        let left = if limit.plane.parts() {
            limit.plane.in_front(&ring, shape)
        } else {
            !(u32::MAX << (shape.triangles() & 31))
        };
        if left == 0 {
            return Some(nearest);
        }
        let (mut within, mut low_sq) = (limit.distance_sq, limit.low_sq);
        let [mut centre, second_centre] = ring.centres(shape);
        let of_first_fan = !(u32::MAX << (shape.turn() & 31));
        let (mut lanes, mut of_next_fan) = (left & of_first_fan, left & !of_first_fan);
        loop {
            if lanes != 0 {
                let fan = GridFan::new(leaf, p, centre);
                let mut culled_below = fan.fan.culled_below(within);
                // Triangles whose closest point is the centre, if it does not lie beyond the limit.
                // All are at one distance, so the first one is taken at the end.
                let mut at_centre = 0u32;
                let mut lane = lowest(lanes);
                let mut first = fan.spoke(ring.vertex(lane)?);
                loop {
                    let second = fan.spoke(ring.vertex(lane + 1)?);
                    if first.along >= culled_below || second.along >= culled_below {
                        let (near, residual) = fan.fan.off_centre(&first, &second);
                        if !IS_CLOSEST {
                            nearest.bound(lane, &near, low_sq);
                        }
                        // Lanes rise, so the first one of a distance is taken.
                        if near.distance_sq < nearest.distance_sq {
                            nearest.distance_sq = near.distance_sq;
                            nearest.lanes = Lanes::one(lane, &near);
                            nearest.lanes.tell(lane, Residual::of_float(residual));
                            within = lesser(within, limit_of(near.distance_sq, limit.allowance));
                            culled_below = fan.fan.culled_below(within);
                            if IS_CLOSEST {
                                low_sq = lesser(low_sq, query.refine_below(near.distance_sq));
                                if nearest.lower_bound_sq > low_sq {
                                    nearest.low = 0;
                                }
                            }
                        }
                        if IS_CLOSEST {
                            nearest.bound(lane, &near, low_sq);
                        }
                    } else {
                        at_centre |= 1 << lane;
                    }
                    lanes &= lanes - 1;
                    if lanes == 0 {
                        break;
                    }
                    let next = lowest(lanes);
                    first = if next == lane + 1 { second } else { fan.spoke(ring.vertex(next)?) };
                    lane = next;
                }
                if at_centre != 0 && culled_below == ABOVE_ZERO {
                    let (lane, near) = (lowest(at_centre), fan.fan.centre());
                    let distance_sq = near.distance_sq;
                    nearest.lower_bound_sq = lesser(nearest.lower_bound_sq, distance_sq);
                    if !IS_CLOSEST && distance_sq <= low_sq {
                        nearest.low |= at_centre;
                    }
                    if distance_sq < nearest.distance_sq
                        || distance_sq == nearest.distance_sq && lane < nearest.lane().0
                    {
                        nearest.distance_sq = distance_sq;
                        nearest.lanes = Lanes::one(lane, &near);
                        nearest.lanes.tell(lane, Residual::of_float(fan.fan.s));
                        within = lesser(within, limit_of(distance_sq, limit.allowance));
                    }
                }
            }
            if of_next_fan == 0 {
                return Some(nearest);
            }
            (centre, lanes, of_next_fan) = (second_centre, of_next_fan, 0);
        }
    }

    /// The first of a leaf's triangles whose bits are ones.
    #[inline(always)]
    fn lowest(lanes: u32) -> usize {
        lanes.trailing_zeros() as usize & (WIDTH - 1)
    }

    /// All triangles of a leaf on the grid, without a limit and its tests.
    #[inline(never)]
    pub(crate) fn nearest_of_all(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafNearest> {
        let mut nearest = LeafNearest::NONE;
        let (shape, ring) = (leaf.shape(), leaf.full_ring()?);
        let count = shape.triangles();
        let [mut centre, second_centre] = ring.centres(shape);
        let (mut lane, mut end) = (0, lesser(shape.turn(), count));
        loop {
            let fan = GridFan::new(leaf, p, centre);
            let mut first = fan.spoke(ring.vertex(lane)?);
            while lane < end {
                let second = fan.spoke(ring.vertex(lane + 1)?);
                nearest.take(lane, &fan.fan.triangle(&first, &second), 0.0);
                first = second;
                lane += 1;
            }
            if end == count {
                return Some(nearest);
            }
            (centre, end) = (second_centre, count);
        }
    }

    #[inline(always)]
    fn spoke([x, y, z]: [i32; 3], [cx, cy, cz]: [i32; 3]) -> Vec3 {
        Vec3::new(x.wrapping_sub(cx) as f32, y.wrapping_sub(cy) as f32, z.wrapping_sub(cz) as f32)
    }

    #[inline(never)]
    fn f32_nearest(leaf: &FanLeaf<'_>, p: Vec3, low_sq: f32) -> LeafNearest {
        let mut nearest = LeafNearest::NONE;
        let (count, turn) = (leaf.shape().triangles(), leaf.shape().turn());
        let (mut centre, mut from) = (leaf.centre(0), leaf.ring(0));
        for lane in 0..count {
            if lane == turn {
                centre = leaf.centre(1);
            }
            let to = leaf.ring(lane + 1);
            let near = nearness(&[p - centre, from - centre, to - centre]);
            nearest.take(lane, &near, low_sq);
            from = to;
        }
        nearest
    }
}
