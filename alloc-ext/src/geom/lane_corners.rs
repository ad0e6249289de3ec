//! Leaves of the static tree over triangles or points: corners of eight of them, to pass over them
//! at once. A triangle that lies oblique in its box often misses a plane that its box reaches. A
//! point takes less memory than a box.

use super::order::WIDTH;
use glam::Vec3;
use wide::f32x8;

/// A plane in the tree's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub normal: [f32; 3],
    /// Magnitudes of the normal.
    pub along: [f32; 3],
    pub offset: f32,
}

/// Corners of the items of a node that has nothing else, in the tree's frame.
#[derive(Clone, Debug)]
pub(super) struct LaneCorners<const CORNERS: usize> {
    /// By corner and axis.
    at: [[[f32; WIDTH]; 3]; CORNERS],
    /// Lanes that hold an item, one bit each.
    lanes: u32,
    /// The node with the boxes of the items.
    pub node: u32,
    /// The entries of that node, for searches that need no boxes.
    pub entry: [u32; WIDTH],
}

impl<const CORNERS: usize> LaneCorners<CORNERS> {
    /// Of a node without items yet.
    pub fn new(node: u32, entry: [u32; WIDTH]) -> Self {
        Self { at: [Default::default(); CORNERS], lanes: 0, node, entry }
    }

    /// Puts an item into a lane.
    pub fn set(&mut self, lane: usize, corners: [Vec3; CORNERS]) {
        self.lanes |= 1 << lane;
        for (at, corner) in self.at.iter_mut().zip(corners) {
            for (at, x) in at.iter_mut().zip(corner.to_array()) {
                at[lane] = x;
            }
        }
    }

    /// The lanes whose items reach all planes and a box, by its middle and half extent; one bit
    /// each.
    #[inline]
    pub fn reached(&self, cuts: &[Cut], middle: [f32; 3], half: [f32; 3]) -> u32 {
        let at = self.at.map(|corner| corner.map(f32x8::from));
        let mut lanes = self.lanes;
        for &Cut { normal, offset, .. } in cuts {
            let [x, y, z] = normal.map(f32x8::splat);
            let most =
                at.map(|p| x * p[0] + y * p[1] + z * p[2]).into_iter().reduce(f32x8::fast_max);
            let Some(most) = most else { return 0 };
            lanes &= most.simd_ge(f32x8::splat(offset)).to_bitmask();
            if lanes == 0 {
                return 0;
            }
        }
        for axis in 0..3 {
            let corners = || at.iter().map(|p| p[axis]);
            let Some(low) = corners().reduce(f32x8::fast_min) else { return 0 };
            let Some(high) = corners().reduce(f32x8::fast_max) else { return 0 };
            let reaches_low = high.simd_ge(f32x8::splat(middle[axis] - half[axis]));
            let reaches_high = low.simd_le(f32x8::splat(middle[axis] + half[axis]));
            lanes &= (reaches_low & reaches_high).to_bitmask();
        }
        lanes
    }
}
