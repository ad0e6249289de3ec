//! What a leaf says of a point: its nearest triangle, and which triangles are to be refined.
//!
//! Vector targets keep all lanes of a leaf, and search the nearest one for the answer. Others keep
//! the nearest triangle.

#[cfg(not(meshsweep_wide))]
pub(crate) use narrow::Lanes;
#[cfg(meshsweep_wide)]
pub(crate) use wide::Lanes;

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
    /// Bits, one for each triangle. Zero: the triangle was left out, or its squared lower bound is
    /// above [`LeafLimit::low_sq`].
    pub(crate) low: u32,
}

impl LeafNearest {
    /// The least lane at this distance, and the closest point on its triangle (see
    /// [`FanLeaf::point`]).
    #[inline(always)]
    pub(crate) fn lane(&self) -> (usize, f32, f32) {
        self.lanes.at(self.distance_sq)
    }
}

#[cfg(meshsweep_wide)]
mod wide {
    use crate::geom::fan::Lanes as Register;
    use crate::geom::fan::{LANES, LaneNearness, Nearness, PIECES, WIDTH};
    use wide::bytemuck::cast;

    /// All lanes of a leaf. The nearest lane is searched once, for the final answer: no branch
    /// predictor can guess it.
    #[derive(Clone, Copy)]
    pub(crate) struct Lanes {
        pub(crate) distance_sq: [Register; PIECES],
        pub(crate) v: [Register; PIECES],
        pub(crate) w: [Register; PIECES],
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
}

#[cfg(not(meshsweep_wide))]
mod narrow {
    use super::LeafNearest;
    use crate::bvh::point::leaf::plane::Residual;
    use crate::geom::fan::Nearness;
    use crate::num::Real;

    /// The nearest triangle of a leaf.
    #[derive(Clone, Copy)]
    pub(crate) struct Lanes {
        lane: usize,
        v: f32,
        w: f32,
        residual: Residual,
    }

    impl Lanes {
        /// None. Not all of it is zeros: so many would be a call of `memclr`, for which alone
        /// firmware links it.
        pub(crate) const NONE: Lanes = Lanes { lane: 0, v: 0.0, w: 1.0, residual: Residual::NONE };

        /// One triangle alone.
        pub(crate) fn one(lane: usize, near: &Nearness) -> Lanes {
            Lanes { lane, v: near.v, w: near.w, residual: Residual::NONE }
        }

        /// Tells the way to a triangle, if it is this one.
        #[inline(always)]
        pub(crate) fn tell(&mut self, lane: usize, residual: Residual) {
            if self.lane == lane {
                self.residual = residual;
            }
        }

        #[inline(always)]
        pub(crate) fn at(&self, _: f32) -> (usize, f32, f32) {
            (self.lane, self.v, self.w)
        }

        /// The way from the closest point to the query.
        #[inline(always)]
        pub(crate) fn residual(&self) -> Residual {
            self.residual
        }
    }

    impl LeafNearest {
        /// All triangles left out.
        pub(crate) const NONE: LeafNearest = LeafNearest {
            distance_sq: f32::INFINITY,
            lower_bound_sq: f32::INFINITY,
            lanes: Lanes::NONE,
            low: 0,
        };

        #[inline(always)]
        pub(crate) fn take(&mut self, lane: usize, near: &Nearness, low_sq: f32) {
            let (here, best) = (Real(near.distance_sq), Real(self.distance_sq));
            if here < best || here == best && lane < self.lanes.lane {
                self.distance_sq = near.distance_sq;
                self.lanes = Lanes::one(lane, near);
            }
            self.bound(lane, near, low_sq);
        }

        /// Takes the lower bound of a triangle.
        #[inline(always)]
        pub(crate) fn bound(&mut self, lane: usize, near: &Nearness, low_sq: f32) {
            if Real(near.lower_bound_sq) < Real(self.lower_bound_sq) {
                self.lower_bound_sq = near.lower_bound_sq;
            }
            if Real(near.lower_bound_sq) <= Real(low_sq) {
                self.low |= 1 << (lane & 31);
            }
        }
    }
}
