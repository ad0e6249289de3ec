//! The nearest triangle of a leaf.
//!
//! Targets with vectors look at eight triangles at once (`wide`), others at one after the other
//! (`narrow`). Both give the same bits.

use crate::bvh::format::FanLeaf;
use glam::Vec3;

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(crate) use narrow::{Lanes, nearest_and_edges, nearest_within};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) use wide::{Lanes, LeafEdges, leaf_edges, nearest_and_edges, nearest_within};

/// The nearest triangle of a leaf, without a limit.
#[inline(always)]
pub(crate) fn nearest_triangle(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafNearest> {
    nearest_within(leaf, p, f32::INFINITY)
}

/// Edges are not kept.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(crate) type LeafEdges = core::convert::Infallible;

/// The nearest triangle of a leaf. On vector targets also the edges of the leaf's triangles, seen
/// from the query point.
pub(crate) type LeafSeen = (LeafNearest, Option<LeafEdges>);

/// The nearest triangle of a leaf. Triangles that are proved to be beyond the squared limit may be
/// left out.
#[derive(Clone, Copy)]
pub(crate) struct LeafNearest {
    /// Its squared distance.
    pub(crate) distance_sq: f32,
    /// Least squared lower bound of the triangles that were not left out.
    pub(crate) lower_bound_sq: f32,
    /// From this [`lane`](Self::lane) finds the triangle.
    pub(crate) lanes: Lanes,
}

impl LeafNearest {
    /// The least lane at this distance, and the closest point on its triangle (see
    /// [`FanLeaf::point`]).
    #[inline(always)]
    pub(crate) fn lane(&self) -> (usize, f32, f32) {
        self.lanes.at(self.distance_sq)
    }
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod wide {
    use super::{FanLeaf, LeafNearest, LeafSeen, Vec3};
    use crate::geom::fan::Lanes as Register;
    use crate::geom::fan::{
        Edges, LANES, LaneNearness, Nearness, PIECES, WIDTH, lanes_below, least, point_lanes,
    };
    use wide::bytemuck::cast;

    /// Edges of a leaf's triangles, seen from the query point.
    pub(crate) type LeafEdges = [Edges; PIECES];

    /// All lanes of a leaf. The nearest lane is searched once, for the final answer: no branch
    /// predictor can guess it.
    #[derive(Clone, Copy)]
    pub(crate) struct Lanes {
        distance_sq: [Register; PIECES],
        v: [Register; PIECES],
        w: [Register; PIECES],
    }

    impl Lanes {
        pub(crate) const NONE: Lanes = Lanes {
            distance_sq: [LaneNearness::NONE.distance_sq; PIECES],
            v: [Register::ZERO; PIECES],
            w: [Register::ZERO; PIECES],
        };

        /// One triangle alone.
        pub(crate) fn one(lane: usize, near: &Nearness) -> Lanes {
            let mut distance_sq = [f32::INFINITY; WIDTH];
            if let Some(slot) = distance_sq.get_mut(lane) {
                *slot = near.distance_sq;
            }
            Lanes {
                distance_sq: cast(distance_sq),
                v: [Register::splat(near.v); PIECES],
                w: [Register::splat(near.w); PIECES],
            }
        }

        #[inline(always)]
        pub(crate) fn at(&self, distance_sq: f32) -> (usize, f32, f32) {
            let mut same = 1u32 << (WIDTH - 1);
            for (piece, distances) in self.distance_sq.iter().enumerate() {
                same |=
                    distances.simd_eq(Register::splat(distance_sq)).to_bitmask() << (piece * LANES);
            }
            let lane = same.trailing_zeros() as usize % WIDTH;
            let (v, w): ([f32; WIDTH], [f32; WIDTH]) = (cast(self.v), cast(self.w));
            (lane, v[lane], w[lane])
        }
    }

    #[inline(always)]
    pub(crate) fn nearest_within(leaf: &FanLeaf<'_>, p: Vec3, limit: f32) -> Option<LeafNearest> {
        let limit = if limit < f32::INFINITY { Some(limit) } else { None };
        let near = if leaf.is_f32() {
            f32_nearest(leaf, p)?
        } else {
            let lanes = leaf.grid_lanes(p)?;
            let used = lanes_below(leaf.shape().triangles())?;
            let mut near = [LaneNearness::NONE; PIECES];
            for piece in 0..PIECES {
                if let Some(here) = point_lanes(&lanes.edges(piece), used[piece], limit) {
                    near[piece] = here;
                }
            }
            near
        };
        Some(nearest_of(near))
    }

    #[inline(always)]
    pub(crate) fn nearest_and_edges(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafSeen> {
        let edges = leaf_edges(leaf, p)?;
        Some((nearest_of(nearness(leaf, &edges)?), Some(edges)))
    }

    /// Edges of all triangles.
    #[inline(always)]
    pub(crate) fn leaf_edges(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafEdges> {
        if leaf.is_f32() {
            return f32_edges(leaf, p);
        }
        let lanes = leaf.grid_lanes(p)?;
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
    fn nearest_of(near: [LaneNearness; PIECES]) -> LeafNearest {
        let lanes = Lanes {
            distance_sq: near.map(|near| near.distance_sq),
            v: near.map(|near| near.v),
            w: near.map(|near| near.w),
        };
        LeafNearest {
            distance_sq: least(lanes.distance_sq),
            lower_bound_sq: least(near.map(|near| near.lower_bound_sq)),
            lanes,
        }
    }

    #[inline(never)]
    fn f32_edges(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafEdges> {
        let mut edges = [Edges::NONE; PIECES];
        for (piece, edges) in edges.iter_mut().enumerate() {
            *edges = leaf.f32_edges(p, piece)?;
        }
        Some(edges)
    }

    /// Not inlined, so that the two ways to read a leaf share no stack memory.
    #[inline(never)]
    fn f32_nearest(leaf: &FanLeaf<'_>, p: Vec3) -> Option<[LaneNearness; PIECES]> {
        nearness(leaf, &f32_edges(leaf, p)?)
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod narrow {
    use super::{FanLeaf, LeafNearest, LeafSeen, Vec3};
    use crate::geom::fan::{Nearness, PointFan, SpokeTerms, point_leaf};

    /// The nearest triangle of a leaf.
    #[derive(Clone, Copy)]
    pub(crate) struct Lanes {
        lane: usize,
        v: f32,
        w: f32,
    }

    impl Lanes {
        pub(crate) const NONE: Lanes = Lanes { lane: 0, v: 0.0, w: 0.0 };

        /// One triangle alone.
        pub(crate) fn one(lane: usize, near: &Nearness) -> Lanes {
            Lanes { lane, v: near.v, w: near.w }
        }

        #[inline(always)]
        pub(crate) fn at(&self, _: f32) -> (usize, f32, f32) {
            (self.lane, self.v, self.w)
        }
    }

    #[inline(always)]
    pub(crate) fn nearest_within(leaf: &FanLeaf<'_>, p: Vec3, limit: f32) -> Option<LeafNearest> {
        let mut nearest = LeafNearest {
            distance_sq: f32::INFINITY,
            lower_bound_sq: f32::INFINITY,
            lanes: Lanes::NONE,
        };
        if leaf.is_f32() {
            f32_nearest(leaf, p, &mut nearest);
        } else {
            grid_nearest(leaf, p, limit, &mut nearest)?;
        }
        Some(nearest)
    }

    #[inline(always)]
    pub(crate) fn nearest_and_edges(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafSeen> {
        Some((nearest_within(leaf, p, f32::INFINITY)?, None))
    }

    impl LeafNearest {
        #[inline(always)]
        fn take(&mut self, lane: usize, near: &Nearness) {
            if near.distance_sq < self.distance_sq {
                self.distance_sq = near.distance_sq;
                self.lanes = Lanes { lane, v: near.v, w: near.w };
            }
            if near.lower_bound_sq < self.lower_bound_sq {
                self.lower_bound_sq = near.lower_bound_sq;
            }
        }
    }

    /// Reads every stored number once. Integers are subtracted before they become f32.
    #[inline(always)]
    fn grid_nearest(
        leaf: &FanLeaf<'_>,
        p: Vec3,
        limit: f32,
        nearest: &mut LeafNearest,
    ) -> Option<()> {
        let ring = leaf.grid_ring()?;
        let turn = leaf.shape().turn();
        let mut centre = ring.centres[0];
        let mut fan = PointFan::new(p - leaf.centre(0));
        let less = |[x, y, z]: [i32; 3], [cx, cy, cz]: [i32; 3]| {
            Vec3::new(
                x.wrapping_sub(cx) as f32,
                y.wrapping_sub(cy) as f32,
                z.wrapping_sub(cz) as f32,
            )
        };
        let mut before = [0i32; 3];
        let mut a: Option<SpokeTerms> = None;
        for (i, ((x, y), z)) in ring.x.iter().zip(ring.y).zip(ring.z).enumerate() {
            let here = [x, y, z].map(|pair| i32::from(u16::from_le_bytes(*pair)));
            if let Some(mut first) = a {
                if i == turn + 1 {
                    centre = ring.centres[1];
                    fan = PointFan::new(p - leaf.centre(1));
                    first = fan.spoke(less(before, centre));
                }
                let second = fan.spoke(less(here, centre));
                if !fan.is_beyond(&first, &second, limit) {
                    nearest.take(i - 1, &fan.triangle(&first, &second));
                }
                a = Some(second);
            } else {
                a = Some(fan.spoke(less(here, centre)));
            }
            before = here;
        }
        Some(())
    }

    #[inline(never)]
    fn f32_nearest(leaf: &FanLeaf<'_>, p: Vec3, nearest: &mut LeafNearest) {
        let (count, turn) = (leaf.shape().triangles(), leaf.shape().turn());
        let s = [p - leaf.centre(0), p - leaf.centre(leaf.shape().centres() - 1)];
        point_leaf(
            count,
            turn,
            s,
            |i, which| leaf.spoke(i, which),
            |lane, near| nearest.take(lane, &near),
        );
    }
}
