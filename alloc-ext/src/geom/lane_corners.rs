//! Corners of triangles, eight triangles at a time, for the static tree: a triangle that lies
//! oblique in its box often misses a plane that its box reaches.

use super::order::WIDTH;
use glam::Vec3;

/// A plane in the tree's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub normal: [f32; 3],
    /// Magnitudes of the normal.
    pub along: [f32; 3],
    pub offset: f32,
}

/// Corners of the triangles of a node, in the tree's frame.
#[derive(Clone, Debug, Default)]
pub(super) struct LaneCorners {
    /// By corner and axis.
    at: [[[f32; WIDTH]; 3]; 3],
    /// Lanes that hold a triangle, one bit each.
    pub lanes: u32,
}

impl LaneCorners {
    /// Puts a triangle into a lane.
    pub fn set(&mut self, lane: usize, triangle: [Vec3; 3]) {
        self.lanes |= 1 << lane;
        for (at, corner) in self.at.iter_mut().zip(triangle) {
            for (at, x) in at.iter_mut().zip(corner.to_array()) {
                at[lane] = x;
            }
        }
    }

    /// The lanes whose triangles reach all planes, one bit each.
    #[inline]
    pub fn reached(&self, cuts: &[Cut]) -> u32 {
        let mut out = [f32::NEG_INFINITY; WIDTH];
        for &Cut { normal: [x, y, z], offset, .. } in cuts {
            let mut most = [f32::NEG_INFINITY; WIDTH];
            for at in &self.at {
                for (k, most) in most.iter_mut().enumerate() {
                    let reach = x * at[0][k] + y * at[1][k] + z * at[2][k];
                    *most = if *most > reach { *most } else { reach };
                }
            }
            for (out, most) in out.iter_mut().zip(most) {
                let below = offset - most;
                *out = if *out > below { *out } else { below };
            }
        }
        let mut reached = 0;
        for (k, out) in out.iter().enumerate() {
            reached |= u32::from(*out <= 0.0) << k;
        }
        reached & self.lanes
    }
}
