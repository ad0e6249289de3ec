//! Which triangles of a leaf have a corner at a place.

use super::FanLeaf;
use glam::Vec3;

#[cfg(meshsweep_small)]
impl FanLeaf<'_> {
    /// The triangles with a corner at a vertex of the tree: bits, the first triangle's lowest.
    #[inline(never)]
    pub(crate) fn lanes_at(&self, at: Vec3) -> u32 {
        let mut lanes = 0;
        for lane in 0..self.shape().triangles() {
            if self.corners(lane).contains(&at) {
                lanes |= 1 << (lane & 31);
            }
        }
        lanes
    }
}

#[cfg(not(meshsweep_small))]
impl FanLeaf<'_> {
    /// The triangles with a corner at a vertex of the tree: bits, the first triangle's lowest.
    /// `at`: see [`corners`](Self::corners).
    #[inline(never)]
    pub(crate) fn lanes_at(&self, at: Vec3) -> u32 {
        let [ox, oy, oz] = self.origin;
        let whole = |x: f32, o: i32| (x as i32).wrapping_sub(o);
        let place = [whole(at.x, ox), whole(at.y, oy), whole(at.z, oz)];
        #[cfg(meshsweep_wide)]
        let ring = self.grid_ring().map(|ring| (ring, ring.centres));
        #[cfg(not(meshsweep_wide))]
        let ring = self.full_ring().map(|ring| (ring, ring.centres(self.shape())));
        match ring {
            Some((ring, [first, second])) if !self.is_f32() => {
                let is_there = |vertex: [i32; 3]| differ(vertex, place) == 0;
                let of_ring = |i| ring.vertex(i).is_some_and(is_there);
                self.lanes_beside(of_ring, [is_there(first), is_there(second)])
            }
            _ => {
                let second = self.centre(self.shape().centres() - 1);
                let of_ring = |i| self.ring(i) == at;
                self.lanes_beside(of_ring, [self.centre(0) == at, second == at])
            }
        }
    }

    /// The triangles with a corner that is meant: one of the ring, or the centre of their fan.
    #[inline(always)]
    fn lanes_beside(&self, is_meant: impl Fn(usize) -> bool, [one, other]: [bool; 2]) -> u32 {
        let shape = self.shape();
        let all = !(u32::MAX << (shape.triangles() & 31));
        let first_fan = !(u32::MAX << (shape.turn() & 31));
        let mut lanes = (if one { first_fan } else { 0 }) | (if other { !first_fan } else { 0 });
        if lanes & all != all {
            for i in 0..=shape.triangles() {
                if is_meant(i) {
                    lanes |= 1 << (i & 31) | 1 << (i & 31) >> 1;
                }
            }
        }
        lanes & all
    }
}

/// Zero if two vertices are the same.
#[cfg(not(meshsweep_small))]
#[inline(always)]
fn differ([a, b, c]: [i32; 3], [x, y, z]: [i32; 3]) -> i32 {
    (a ^ x) | (b ^ y) | (c ^ z)
}
