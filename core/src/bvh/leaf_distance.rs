//! The nearest triangle of a leaf.
//!
//! Targets with vectors look at eight triangles at once (`wide`), others at one after the other
//! (`narrow`). Both give the same bits.

use crate::bvh::format::FanLeaf;
use crate::geom::fan::Edges8;
use glam::Vec3;

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(crate) use narrow::{Lanes, nearest_and_edges, nearest_within};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) use wide::{Lanes, nearest_and_edges, nearest_within};

/// The nearest triangle of a leaf, without a limit.
#[inline(always)]
pub(crate) fn nearest_triangle(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafNearest> {
    nearest_within(leaf, p, f32::INFINITY)
}

/// The nearest triangle of a leaf. On vector targets also the edges of all its triangles, as they
/// lie from the query point.
pub(crate) type LeafSeen = (LeafNearest, Option<Edges8>);

/// The nearest triangle of a leaf. Triangles that are proved to be beyond the squared limit may be
/// left out.
#[derive(Clone, Copy)]
pub(crate) struct LeafNearest {
    /// Its squared distance.
    pub(crate) distance_sq: f32,
    /// Least squared lower bound of all triangles of the leaf.
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
    use super::{Edges8, FanLeaf, LeafNearest, LeafSeen, Vec3};
    use crate::geom::fan::{LANES_BELOW, Nearness, Nearness8, WIDTH, point_leaf8};
    use crate::num::{lesser, of_eight};

    /// All lanes of a leaf. The nearest lane is searched once, for the final answer: no branch
    /// predictor can guess it.
    #[derive(Clone, Copy)]
    pub(crate) struct Lanes(Nearness8);

    impl Lanes {
        pub(crate) const NONE: Lanes = Lanes(Nearness8 {
            distance_sq: [0.0; WIDTH],
            lower_bound_sq: [0.0; WIDTH],
            v: [0.0; WIDTH],
            w: [0.0; WIDTH],
        });

        /// One triangle alone.
        pub(crate) fn one(lane: usize, near: &Nearness) -> Lanes {
            let mut lanes = Lanes::NONE;
            for i in 0..WIDTH {
                lanes.0.distance_sq[i] = if i == lane { near.distance_sq } else { f32::INFINITY };
                lanes.0.v[i] = near.v;
                lanes.0.w[i] = near.w;
            }
            lanes
        }

        #[inline(always)]
        pub(crate) fn at(&self, distance_sq: f32) -> (usize, f32, f32) {
            let mut lane = WIDTH - 1;
            for i in (0..WIDTH).rev() {
                lane = if self.0.distance_sq[i] == distance_sq { i } else { lane };
            }
            (lane, self.0.v[lane % WIDTH], self.0.w[lane % WIDTH])
        }
    }

    /// Ignores the limit: to leave out a lane saves nothing here.
    #[inline(always)]
    pub(crate) fn nearest_within(leaf: &FanLeaf<'_>, p: Vec3, _limit: f32) -> Option<LeafNearest> {
        let near = if leaf.is_f32() {
            f32_nearness(leaf, p)?
        } else {
            point_leaf8(&leaf.grid_edges8(p)?, LANES_BELOW.get(leaf.shape().triangles())?)
        };
        Some(nearest_of(near))
    }

    #[inline(always)]
    pub(crate) fn nearest_and_edges(leaf: &FanLeaf<'_>, p: Vec3) -> Option<LeafSeen> {
        let edges = if leaf.is_f32() { f32_edges(leaf, p)? } else { leaf.grid_edges8(p)? };
        let near = point_leaf8(&edges, LANES_BELOW.get(leaf.shape().triangles())?);
        Some((nearest_of(near), Some(edges)))
    }

    #[inline(always)]
    fn nearest_of(near: Nearness8) -> LeafNearest {
        let (distance_sq, lower_bound_sq) =
            (of_eight(near.distance_sq, lesser), of_eight(near.lower_bound_sq, lesser));
        LeafNearest { distance_sq, lower_bound_sq, lanes: Lanes(near) }
    }

    #[inline(never)]
    fn f32_edges(leaf: &FanLeaf<'_>, p: Vec3) -> Option<Edges8> {
        leaf.f32_edges8(p)
    }

    /// Not inlined, so that the two ways to read a leaf share no stack memory.
    #[inline(never)]
    fn f32_nearness(leaf: &FanLeaf<'_>, p: Vec3) -> Option<Nearness8> {
        Some(point_leaf8(&leaf.f32_edges8(p)?, LANES_BELOW.get(leaf.shape().triangles())?))
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
