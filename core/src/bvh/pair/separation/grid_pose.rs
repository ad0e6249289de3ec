//! Two models in the grid of the first one, in f32, and what rounding does to it.

use crate::bvh::tree::extended::unit_exponent;
use crate::bvh::tree::format::Bvh;
use crate::geom::{Pose, Rows, turned};
use crate::num::tolerance::{SEPARATION_BOX, SEPARATION_FARTHEST, SEPARATION_VERTEX, U32};
use crate::num::{dot, exp2_f32, sqrt_approx};
use crate::query::UNITS_APART;
use crate::query::{longest, skew};
use glam::Vec3;

/// The second of two models in the grid of the first: grid units, from the grid's origin.
pub(crate) struct GridPose<'a> {
    pub(crate) trees: [&'a Bvh<'a>; 2],
    /// The grids' origins, each in its own units.
    pub(crate) origins: [Vec3; 2],
    /// A place `q` of the second model, its grid units from its origin, is at `rows·q + shift`.
    pub(crate) rows: Rows,
    pub(crate) shift: Vec3,
    /// Units of the first grid in one of the second: a power of two.
    pub(crate) ratio: f32,
    /// A computed gap of triangles, or distance of two of their points, differs by less than this
    /// from that of the input meshes. Units of the first grid.
    pub(crate) error: f32,
    /// The same, compared with the stored surfaces: `error` without surface errors and pose error.
    pub(crate) rounding: f32,
    /// How much more a gap of two boxes may be off.
    pub(crate) box_error: f32,
}

/// Where the second model is: from its frame to the first one's, input units.
#[derive(Clone, Copy)]
pub(crate) struct FramePose {
    pub(crate) rows: Rows,
    pub(crate) shift: Vec3,
    /// A distance may be off by this because the pose was rounded.
    pub(crate) error: f32,
}

impl FramePose {
    /// The pose's numbers are exact.
    #[inline(always)]
    pub(crate) fn of(pose: &Pose) -> FramePose {
        FramePose {
            rows: pose.rotation.map(Vec3::from_array),
            shift: Vec3::from_array(pose.translation),
            error: 0.0,
        }
    }
}

impl<'a> GridPose<'a> {
    /// `None` if this search cannot be used: a tree does not store its vertices on a grid, or a
    /// length is beyond 2^29 units of the first grid or NaN, or one unit is more than 2^40 times
    /// the other. The caller has checked that entries of the matrix are at most 2.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(crate) fn of([a, b]: [&'a Bvh<'a>; 2], pose: &FramePose) -> Option<GridPose<'a>> {
        let ratio_exponent = unit_exponent(b) - unit_exponent(a);
        if a.header().is_f32() || b.header().is_f32() || ratio_exponent.abs() > UNITS_APART {
            return None;
        }
        let (units, ratio) = (a.units(), exp2_f32(ratio_exponent));
        let origins = [a, b].map(|tree| {
            let [x, y, z] = tree.header().grid_origin.map(|x| x as f32);
            Vec3::new(x, y, z)
        });
        let extent = |tree: &Bvh<'_>, origin: Vec3| (tree.grid_bounds().1 - origin) + 1.0;
        let [origin_a, origin_b] = origins;
        let rows = pose.rows.map(|row| row * ratio);
        let place = units.inward_point(pose.shift.to_array());
        let shift = (turned(&rows, origin_b) + place) - origin_a;
        // Along each axis no term of a place, and no sum of terms, is longer than this.
        let size = turned(&rows.map(Vec3::abs), origin_b.abs() + extent(b, origin_b))
            + (place.abs() + origin_a.abs())
            + extent(a, origin_a);
        let far = sqrt_approx(dot(size, size)) * (1.0 + 8.0 * U32);
        let surfaces =
            a.units().surface_error + b.units().surface_error * (ratio * longest(skew(&pose.rows)));
        let up = 1.0 + 16.0 * U32;
        let error = ((surfaces + units.inward(pose.error)) + far * (SEPARATION_VERTEX * U32)) * up;
        (far <= SEPARATION_FARTHEST).then_some(GridPose {
            trees: [a, b],
            origins,
            rows,
            shift,
            ratio,
            error,
            rounding: far * (SEPARATION_VERTEX * U32) * up,
            box_error: far * ((SEPARATION_BOX - SEPARATION_VERTEX) * U32) * up,
        })
    }

    /// A place of the second model in the first grid.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(crate) fn moved(&self, place: Vec3) -> Vec3 {
        turned(&self.rows, place) + self.shift
    }
}
