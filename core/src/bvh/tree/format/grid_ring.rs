//! The stored integers of a leaf on the grid.

#[cfg(not(meshsweep_wide))]
use super::leaf_shape::LeafShape;
use crate::geom::fan::WIDTH;

/// Bytes of the largest leaf on the grid: two centres and nine ring vertices.
pub(super) const GRID_WINDOW: usize = 66;

/// Stored integers of a leaf on the grid. They do not include the grid's origin.
#[derive(Clone, Copy, Debug)]
pub struct GridRing<'a> {
    /// The grid's origin.
    pub origin: [i32; 3],
    /// First and second centre, alike if there is one fan.
    pub centres: [[i32; 3]; 2],
    /// First coordinates of the ring.
    pub x: &'a [[u8; 2]],
    /// Second coordinates.
    pub y: &'a [[u8; 2]],
    /// Third coordinates.
    pub z: &'a [[u8; 2]],
}

impl GridRing<'_> {
    /// Corners of triangle `lane`; `turn` is the first of the second fan. `None` past the last
    /// triangle.
    #[inline(always)]
    pub fn corners(&self, lane: usize, turn: usize) -> Option<[[i32; 3]; 3]> {
        let [first, second] = self.centres;
        let centre = if lane < turn { first } else { second };
        Some([centre, self.vertex(lane)?, self.vertex(lane + 1)?])
    }

    /// Ring vertex `i`.
    #[inline(always)]
    pub fn vertex(&self, i: usize) -> Option<[i32; 3]> {
        let (x, y, z) = (self.x.get(i)?, self.y.get(i)?, self.z.get(i)?);
        Some([short_of(*x), short_of(*y), short_of(*z)])
    }
}

/// Ring vertices of the largest leaf.
pub(super) const RING_VERTICES: usize = WIDTH + 1;

/// Stored integers of a leaf on the grid with the greatest number of ring vertices. They do not
/// include the grid's origin.
#[cfg(not(meshsweep_wide))]
#[derive(Clone, Copy, Debug)]
pub struct FullRing<'a> {
    pub(super) window: &'a [u8; GRID_WINDOW],
    /// Coordinates of the ring, axis by axis, in the order that was asked for. Those past the last
    /// triangle have no meaning.
    pub(crate) rows: [&'a [[u8; 2]; RING_VERTICES]; 3],
}

/// A row of ring coordinates. The last row of the largest leaf ends with the window.
#[inline(always)]
pub(super) fn ring_row(window: &[u8; GRID_WINDOW], at: usize) -> Option<&[[u8; 2]; RING_VERTICES]> {
    window.get(at.min(GRID_WINDOW - 2 * RING_VERTICES)..)?.as_chunks::<2>().0.first_chunk()
}

#[cfg(not(meshsweep_wide))]
impl FullRing<'_> {
    /// First and second centre, alike if there is one fan.
    #[inline(always)]
    pub fn centres(&self, shape: LeafShape) -> [[i32; 3]; 2] {
        [three(self.window, 0), three(self.window, 6 * (shape.centres() - 1))]
    }

    /// The same in the order of `axes`.
    #[inline(always)]
    pub fn centres_in_order(&self, shape: LeafShape, [u, v, w]: [usize; 3]) -> [[i32; 3]; 2] {
        // A mask that changes nothing costs less than a bounds check.
        let stored = |which: usize, axis: usize| {
            let at = (6 * which + 2 * axis) & 63;
            short_of([self.window[at], self.window[at + 1]])
        };
        let centre = |which: usize| [stored(which, u), stored(which, v), stored(which, w)];
        [centre(0), centre(shape.centres() - 1)]
    }

    /// First or second centre of a leaf that has so many.
    #[inline(always)]
    pub fn centre(&self, which: usize) -> [i32; 3] {
        three(self.window, 6 * (which & 1))
    }

    /// The ring vertices of a leaf of this shape.
    #[inline(always)]
    pub fn vertices(&self, shape: LeafShape) -> impl Iterator<Item = [i32; 3]> {
        let [x, y, z] = self.rows;
        let vertices = x.iter().zip(y).zip(z).take(shape.triangles() + 1);
        vertices.map(|((x, y), z)| grid_point([x, y, z]))
    }

    /// Ring vertex `i`, at most 8.
    #[inline(always)]
    pub fn vertex(&self, i: usize) -> Option<[i32; 3]> {
        let [x, y, z] = self.rows;
        Some(grid_point([x.get(i)?, y.get(i)?, z.get(i)?]))
    }

    /// Centre and ring vertices of a triangle.
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub fn corners(&self, shape: LeafShape, lane: usize) -> Option<[[i32; 3]; 3]> {
        let centre = self.centre(usize::from(lane >= shape.turn()));
        Some([centre, self.vertex(lane)?, self.vertex(lane + 1)?])
    }

    /// A bit of each ring vertex, the first one's lowest. Those past the last one of a leaf have no
    /// meaning. The compiler unrolls the loop where speed counts, for its length is known: three
    /// times as fast as one over the vertices there are, which is for small code.
    #[inline(always)]
    pub fn bits(&self, shape: LeafShape, bit: impl Fn([i32; 3]) -> u32) -> u32 {
        let [x, y, z] = self.rows;
        let used = if cfg!(meshsweep_small) { shape.triangles() + 1 } else { RING_VERTICES };
        let mut bits = 0;
        for i in 0..used.min(RING_VERTICES) {
            bits |= bit(grid_point([&x[i], &y[i], &z[i]])) << i;
        }
        bits
    }
}

#[cfg(not(meshsweep_wide))]
#[inline(always)]
fn grid_point([x, y, z]: [&[u8; 2]; 3]) -> [i32; 3] {
    [short_of(*x), short_of(*y), short_of(*z)]
}

#[inline(always)]
pub(super) fn short_of(pair: [u8; 2]) -> i32 {
    i32::from(u16::from_le_bytes(pair))
}

#[inline(always)]
pub(super) fn short(bytes: &[u8], at: usize) -> i32 {
    match bytes.get(at..).and_then(|b| b.first_chunk::<2>()) {
        Some(&pair) => short_of(pair),
        None => 0,
    }
}

/// Three u16 at a byte offset.
#[inline(always)]
pub(super) fn three(window: &[u8; GRID_WINDOW], at: usize) -> [i32; 3] {
    match window.get(at..).and_then(|b| b.first_chunk::<6>()) {
        Some(&[a, b, c, d, e, f]) => [short_of([a, b]), short_of([c, d]), short_of([e, f])],
        None => [0; 3],
    }
}
