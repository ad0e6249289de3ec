//! Leaves of the box tree: one or two triangle fans, read where they lie.
//!
//! A leaf of an opened tree lies within the fans' section. No read can panic all the same.

#[cfg(not(meshsweep_wide))]
use super::grid_ring::FullRing;
use super::grid_ring::{GRID_WINDOW, GridRing, ring_row, short, short_of, three};
use super::leaf_shape::LeafShape;
#[cfg(meshsweep_wide)]
use crate::geom::fan::{Ring8, WIDTH};
#[cfg(meshsweep_small)]
use crate::num::SOFT_FLOAT;
use crate::num::{Real, float, reals};
use glam::Vec3;

/// Numbers of the triangles whose bits are ones.
#[inline(always)]
pub fn lanes_of(bits: u32) -> impl Iterator<Item = usize> {
    let mut left = bits & 0xFF;
    core::iter::from_fn(move || {
        if left == 0 {
            return None;
        }
        let lane = left.trailing_zeros() as usize;
        left &= left - 1;
        Some(lane)
    })
}

/// A leaf: one or two fans.
#[derive(Clone, Copy, Debug)]
pub struct FanLeaf<'a> {
    /// To the end of the section, whose padding lets every leaf be read at full width.
    pub(crate) bytes: &'a [u8],
    pub(crate) shape: LeafShape,
    pub(crate) is_f32: bool,
    pub(crate) origin: [i32; 3],
}

/// Vertices of the largest leaf: two centres and nine ring vertices.
pub const CORNERS: usize = 11;

/// Slots of a triangle's corners among a leaf's [stored vertices](FanLeaf::stored_vertices); `turn`
/// is the first triangle of the second fan.
#[inline(always)]
pub fn slots(lane: usize, turn: usize) -> [usize; 3] {
    [usize::from(lane >= turn), RING + lane, RING + 1 + lane]
}

/// Slot of the first ring vertex.
pub const RING: usize = 2;

#[inline(always)]
fn f32_at(bytes: &[u8], at: usize) -> f32 {
    match bytes.get(at..).and_then(|b| b.first_chunk::<4>()) {
        Some(&word) => f32::from_le_bytes(word),
        None => 0.0,
    }
}

impl<'a> FanLeaf<'a> {
    /// No leaf: a place for one.
    pub(crate) const NONE: FanLeaf<'static> =
        FanLeaf { bytes: &[], shape: LeafShape(0), is_f32: false, origin: [0; 3] };

    /// Its shape.
    #[inline(always)]
    pub fn shape(&self) -> LeafShape {
        self.shape
    }

    /// Centre 0 or 1, grid units, exactly. Here and below, an index past the leaf's centres, ring
    /// or triangles gives some number.
    #[inline(always)]
    pub fn centre(&self, which: usize) -> Vec3 {
        self.vertex(6 * which, 2)
    }

    /// The vertex with coordinates at bytes `at`, `at + step` and `at + 2·step` of a leaf on the
    /// grid. An f32 leaf has twice the offsets. On boards a call: reading a vertex is much code.
    #[cfg_attr(meshsweep_wide, inline(always))]
    fn vertex(&self, at: usize, step: usize) -> Vec3 {
        if self.is_f32 {
            // Every number is twice as long.
            let (at, step) = (2 * at, 2 * step);
            return Vec3::new(
                f32_at(self.bytes, at),
                f32_at(self.bytes, at + step),
                f32_at(self.bytes, at + 2 * step),
            );
        }
        let [x, y, z] = self.stored(at, step);
        let [ox, oy, oz] = self.origin;
        let sum = |x: i32, o: i32| float(x.wrapping_add(o));
        Vec3::new(sum(x, ox), sum(y, oy), sum(z, oz))
    }

    /// All vertices without the grid's origin, as stored, exactly: both centres, alike if there is
    /// one fan, then nine of the ring. Vertices past the last triangle have no meaning but are
    /// finite. `[axis][vertex]`.
    #[inline(always)]
    pub fn stored_vertices(&self) -> [[f32; CORNERS]; 3] {
        let mut out = [[0f32; CORNERS]; 3];
        if self.is_f32 {
            self.f32_vertices(&mut out);
            return out;
        }
        let Some(window) = self.bytes.first_chunk::<GRID_WINDOW>() else { return out };
        let second = 6 * (self.shape.centres() - 1);
        let step = 2 * (self.shape.triangles() + 1);
        for (axis, out) in out.iter_mut().enumerate() {
            let ring = (6 + second + step * axis).min(GRID_WINDOW - 18);
            let [first, next, rest @ ..] = out;
            *first = short(window, 2 * axis) as f32;
            *next = short(window, second + 2 * axis) as f32;
            if let Some(chunk) = window.get(ring..).and_then(|b| b.first_chunk::<18>()) {
                for (x, pair) in rest.iter_mut().zip(chunk.as_chunks::<2>().0) {
                    *x = f32::from(u16::from_le_bytes(*pair));
                }
            }
        }
        out
    }

    /// The corners of a triangle as stored, without the grid's origin, exactly. Of an unchecked
    /// leaf with too few bytes some numbers.
    #[inline(always)]
    pub fn stored_corners(&self, lane: usize) -> [Vec3; 3] {
        let which = usize::from(lane >= self.shape.turn());
        if let (false, Some(stored)) = (self.is_f32, self.stored_triangle(lane, which)) {
            let [(cx, [ax, bx]), (cy, [ay, by]), (cz, [az, bz])] = stored;
            let corner = |x, y, z| Vec3::new(float(x), float(y), float(z));
            return [corner(cx, cy, cz), corner(ax, ay, az), corner(bx, by, bz)];
        }
        [self.centre(which), self.ring(lane), self.ring(lane + 1)]
    }

    #[inline(never)]
    fn f32_vertices(&self, out: &mut [[f32; CORNERS]; 3]) {
        let second = self.shape.centres() - 1;
        let used = self.shape.triangles() + 3;
        for slot in 0..CORNERS {
            let vertex = match slot {
                0 => self.centre(0),
                1 => self.centre(second),
                _ if slot < used => self.ring(slot - 2),
                _ => self.centre(0),
            };
            for (axis, x) in out.iter_mut().zip(vertex.to_array()) {
                if let Some(place) = axis.get_mut(slot) {
                    *place = x;
                }
            }
        }
    }

    #[inline(always)]
    fn stored(&self, at: usize, step: usize) -> [i32; 3] {
        [short(self.bytes, at), short(self.bytes, at + step), short(self.bytes, at + 2 * step)]
    }

    /// Ring vertex `i ≤ triangles`, grid units, exactly.
    #[inline(always)]
    pub fn ring(&self, i: usize) -> Vec3 {
        self.vertex(6 * self.shape.centres() + 2 * i, 2 * (self.shape.triangles() + 1))
    }

    /// Ring vertex `i` less centre `which`: exact on the grid, rounded once with f32 vertices.
    #[inline(always)]
    pub fn spoke(&self, i: usize, which: usize) -> Vec3 {
        if self.is_f32 {
            return self.ring(i) - self.centre(which);
        }
        let step = 2 * (self.shape.triangles() + 1);
        let [cx, cy, cz] = self.stored(6 * which, 2);
        let [x, y, z] = self.stored(6 * self.shape.centres() + 2 * i, step);
        Vec3::new(x.wrapping_sub(cx) as f32, y.wrapping_sub(cy) as f32, z.wrapping_sub(cz) as f32)
    }

    /// [`spoke`](Self::spoke) from centre `which` for many ring vertices.
    #[cfg(meshsweep_wide)]
    #[inline(always)]
    pub fn spokes_from(&self, which: usize) -> impl Fn(usize) -> Vec3 {
        move |i| self.spoke(i, which)
    }

    /// [`spoke`](Self::spoke) from centre `which` for many ring vertices.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    pub fn spokes_from(&self, which: usize) -> impl Fn(usize) -> Vec3 {
        self.fan(which).1
    }

    /// Centre `which`, and [`spoke`](Self::spoke) from it for many ring vertices.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    pub fn fan(&self, which: usize) -> (Vec3, impl Fn(usize) -> Vec3) {
        let ring = if self.is_f32 { None } else { self.full_ring() };
        let [cx, cy, cz] = ring.map_or([0; 3], |ring| ring.centres(self.shape)[which & 1]);
        let centre = match ring {
            Some(_) => {
                let [ox, oy, oz] = self.origin;
                let sum = |x: i32, ox: i32| x.wrapping_add(ox) as f32;
                Vec3::new(sum(cx, ox), sum(cy, oy), sum(cz, oz))
            }
            None => self.centre(which),
        };
        let spoke = move |i| match ring.and_then(|ring| ring.vertex(i)) {
            Some([x, y, z]) => {
                let less = |x: i32, cx: i32| x.wrapping_sub(cx) as f32;
                Vec3::new(less(x, cx), less(y, cy), less(z, cz))
            }
            None => self.f32_spoke(i, which),
        };
        (centre, spoke)
    }

    #[cfg(not(meshsweep_wide))]
    #[inline(never)]
    fn f32_spoke(&self, i: usize, which: usize) -> Vec3 {
        self.ring(i) - self.centre(which)
    }

    /// The stored integers of a leaf on the grid.
    #[inline(always)]
    pub fn grid_ring(&self) -> Option<GridRing<'a>> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let entries = self.shape.triangles() + 1;
        let ring = self.bytes.get(6 * self.shape.centres()..)?;
        let (x, rest) = ring.split_at_checked(2 * entries)?;
        let (y, rest) = rest.split_at_checked(2 * entries)?;
        let z = rest.get(..2 * entries)?;
        let (x, y, z) = (x.as_chunks().0, y.as_chunks().0, z.as_chunks().0);
        Some(GridRing {
            origin: self.origin,
            centres: [three(window, 0), three(window, 6 * (self.shape.centres() - 1))],
            x,
            y,
            z,
        })
    }

    /// Bits of the ring vertices of a leaf on the grid whose stored coordinate is above `floor`,
    /// the first vertex's lowest, and the same of both centres. Bits past the ring have no meaning.
    #[inline(always)]
    pub(crate) fn above(&self, axis: usize, floor: i32) -> Option<(u32, u32, u32)> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let (centres, step) = (self.shape.centres(), 2 * (self.shape.triangles() + 1));
        // The sign of the difference.
        let is_above = |x: i32| floor.wrapping_sub(x).cast_unsigned() >> 31;
        let mut ring = 0;
        for pair in ring_row(window, 6 * centres + step * axis)?.iter().rev() {
            ring = ring << 1 | is_above(short_of(*pair));
        }
        let centre = |which: usize| is_above(short(window, 6 * which + 2 * axis));
        Some((ring, centre(0), centre(centres - 1)))
    }

    /// The same of a leaf with f32 vertices, whose coordinates are moved down to the grid.
    #[inline(never)]
    pub(crate) fn f32_above(&self, axis: usize, floor: i32) -> Option<(u32, u32, u32)> {
        let (centres, step) = (self.shape.centres(), 2 * (self.shape.triangles() + 1));
        let origin = Real(float(*self.origin.get(axis)?));
        let least = Real(float(floor.wrapping_add(1)));
        // Every number is twice as long as on the grid.
        let is_above = |at: usize| u32::from(Real(f32_at(self.bytes, 2 * at)) - origin >= least);
        let mut ring = 0;
        for vertex in (0..=self.shape.triangles()).rev() {
            ring = ring << 1 | is_above(6 * centres + step * axis + 2 * vertex);
        }
        let centre = |which: usize| is_above(6 * which + 2 * axis);
        Some((ring, centre(0), centre(centres - 1)))
    }

    /// The stored integers of a leaf on the grid, as many as the largest leaf has.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    pub fn full_ring(&self) -> Option<FullRing<'a>> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let first = 6 * self.shape.centres();
        let step = 2 * (self.shape.triangles() + 1);
        let row = |at| ring_row(window, at);
        Some(FullRing { window, rows: [row(first)?, row(first + step)?, row(first + 2 * step)?] })
    }

    /// The same, with rows in the order of `axes`: to be read by
    /// [`vertices`](FullRing::vertices) and [`centres_in_order`](FullRing::centres_in_order) alone.
    #[cfg(not(meshsweep_wide))]
    #[inline(always)]
    pub fn full_ring_in_order(&self, [u, v, w]: [usize; 3]) -> Option<FullRing<'a>> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let first = 6 * self.shape.centres();
        let step = 2 * (self.shape.triangles() + 1);
        let row = |axis: usize| ring_row(window, first + step * axis);
        Some(FullRing { window, rows: [row(u)?, row(v)?, row(w)?] })
    }

    /// The point `centre + v·e + w·g` of triangle `lane`, grid units.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub fn point(&self, lane: usize, v: f32, w: f32) -> Vec3 {
        #[cfg(meshsweep_soft_float)]
        if !self.is_f32
            && let Some(corners) = self.full_ring().and_then(|it| it.corners(self.shape, lane))
        {
            return self.point_of(&corners, [v, w]);
        }
        let [centre, e, g] = self.spokes(lane);
        let ([cx, cy, cz], [ex, ey, ez], [gx, gy, gz]) = (reals(centre), reals(e), reals(g));
        let (v, w) = (Real(v), Real(w));
        let (x, y, z) = (cx + ex * v + gx * w, cy + ey * v + gy * w, cz + ez * v + gz * w);
        Vec3::new(x.0, y.0, z.0)
    }

    /// [`point`](Self::point) on the grid. A spoke that counts nothing is not converted. No
    /// coordinate of the grid is -0, so a zero that is added would change nothing.
    #[cfg(meshsweep_soft_float)]
    #[inline(always)]
    fn point_of(&self, [centre, a, b]: &[[i32; 3]; 3], shares: [f32; 2]) -> Vec3 {
        let mut point = [0f32; 3];
        for axis in 0..3 {
            let mut sum = Real(float(centre[axis].wrapping_add(self.origin[axis])));
            for (vertex, share) in [a, b].into_iter().zip(shares) {
                if !Real(share).is_at_most_zero() {
                    let spoke = Real(float(vertex[axis].wrapping_sub(centre[axis])));
                    sum = sum + spoke * Real(share);
                }
            }
            point[axis] = sum.0;
        }
        Vec3::from_array(point)
    }

    /// Centre and both spokes of triangle `lane`. A call, for questions with few triangles: reading
    /// them is much code.
    #[inline(never)]
    pub fn spokes(&self, lane: usize) -> [Vec3; 3] {
        let which = usize::from(lane >= self.shape.turn());
        if let (false, Some(stored)) = (self.is_f32, self.stored_triangle(lane, which)) {
            let [(cx, [ax, bx]), (cy, [ay, by]), (cz, [az, bz])] = stored;
            return self.spokes_of(&[[cx, cy, cz], [ax, ay, az], [bx, by, bz]]);
        }
        let centre = self.centre(which);
        [centre, self.ring(lane) - centre, self.ring(lane + 1) - centre]
    }

    /// Centre and both spokes of a triangle on the grid whose corners are stored so.
    #[cfg_attr(all(meshsweep_soft_float, meshsweep_small), inline(never))]
    #[cfg_attr(not(all(meshsweep_soft_float, meshsweep_small)), inline(always))]
    pub fn spokes_of(&self, &[[cx, cy, cz], a, b]: &[[i32; 3]; 3]) -> [Vec3; 3] {
        let ([ox, oy, oz], [ax, ay, az], [bx, by, bz]) = (self.origin, a, b);
        let sum = |x: i32, o: i32| float(x.wrapping_add(o));
        let less = |x: i32, c: i32| float(x.wrapping_sub(c));
        [
            Vec3::new(sum(cx, ox), sum(cy, oy), sum(cz, oz)),
            Vec3::new(less(ax, cx), less(ay, cy), less(az, cz)),
            Vec3::new(less(bx, cx), less(by, cy), less(bz, cz)),
        ]
    }

    /// By axis the stored integers of centre `which`, and of ring vertices `lane` and `lane + 1`.
    #[inline(always)]
    fn stored_triangle(&self, lane: usize, which: usize) -> Option<[(i32, [i32; 2]); 3]> {
        // Less code, because one length is compared.
        #[cfg(meshsweep_small)]
        {
            let ring = self.full_ring()?;
            if SOFT_FLOAT {
                let [[cx, cy, cz], [ax, ay, az], [bx, by, bz]] = ring.corners(self.shape, lane)?;
                return Some([(cx, [ax, bx]), (cy, [ay, by]), (cz, [az, bz])]);
            }
            let ([ax, ay, az], [bx, by, bz]) = (ring.vertex(lane)?, ring.vertex(lane + 1)?);
            let [cx, cy, cz] = ring.centre(which);
            Some([(cx, [ax, bx]), (cy, [ay, by]), (cz, [az, bz])])
        }
        #[cfg(not(meshsweep_small))]
        self.stored_triangle_by_axis(lane, which)
    }

    #[cfg(not(meshsweep_small))]
    #[inline(always)]
    fn stored_triangle_by_axis(&self, lane: usize, which: usize) -> Option<[(i32, [i32; 2]); 3]> {
        let &[a, b, c, d, e, f] = self.bytes.get(6 * which..)?.first_chunk::<6>()?;
        let step = 2 * (self.shape.triangles() + 1);
        let first = 6 * self.shape.centres() + 2 * lane;
        let axis = |centre: [u8; 2], at: usize| {
            let &[a, b, c, d] = self.bytes.get(at..)?.first_chunk::<4>()?;
            let short = |pair| i32::from(u16::from_le_bytes(pair));
            Some((short(centre), [short([a, b]), short([c, d])]))
        };
        Some([axis([a, b], first)?, axis([c, d], first + step)?, axis([e, f], first + 2 * step)?])
    }

    /// Corners of triangle `lane`, grid units, in the input's winding.
    pub fn corners(&self, lane: usize) -> [Vec3; 3] {
        let second = lane >= self.shape.turn();
        let centre = self.centre(usize::from(second));
        let (a, b) = (self.ring(lane), self.ring(lane + 1));
        if second && self.shape.second_reversed() { [centre, b, a] } else { [centre, a, b] }
    }

    /// Whether vertices are f32.
    #[inline(always)]
    pub fn is_f32(&self) -> bool {
        self.is_f32
    }

    /// Ring and centres of a leaf with f32 vertices in the order of `axes`, for the wide segment
    /// kernel.
    #[cfg(meshsweep_wide)]
    #[inline(never)]
    pub fn f32_ring8(&self, axes: [usize; 3]) -> Option<Ring8> {
        let second = 12 * (self.shape.centres() - 1);
        let step = 4 * (self.shape.triangles() + 1);
        let mut ring =
            Ring8 { here: [[0.0; WIDTH]; 3], next: [[0.0; WIDTH]; 3], centres: [[0.0; 3]; 2] };
        for (k, axis) in axes.into_iter().enumerate() {
            let chunk = self.bytes.get(12 + second + step * axis..)?.first_chunk::<36>()?;
            let word =
                |k: usize| f32::from_le_bytes([chunk[k], chunk[k + 1], chunk[k + 2], chunk[k + 3]]);
            for i in 0..WIDTH {
                ring.here[k][i] = word(4 * i);
                ring.next[k][i] = word(4 * i + 4);
            }
            ring.centres[0][k] = f32_at(self.bytes, 4 * axis);
            ring.centres[1][k] = f32_at(self.bytes, second + 4 * axis);
        }
        Some(ring)
    }
}
