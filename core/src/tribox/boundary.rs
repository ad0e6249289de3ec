//! The boundary of a tribox, corner by corner (Crosnier & Rossignac 1999, sections 2.2 and 3).
//!
//! Three planes of the box and three chamfers meet at each of its eight corners, in one of four
//! ways. The chamfers' common point decides which. No corner depends on another. A corner has four
//! vertices. So there are always 32 vertices, 48 edges and 18 faces, some of them perhaps without
//! extent.

use super::bounds::Tribox;
use super::directions::FACES;
use super::directions::SLABS;
use crate::num::greater;
use core::ops::{Add, Neg, Sub};

/// Vertices: four of each corner.
pub const VERTICES: usize = 32;

/// Most vertices of a face.
pub const LOOP: usize = 8;

/// The numbers of a boundary: f32, integers that can be divided by four, or a type that counts
/// operations.
pub trait Scalar:
    Copy + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self>
{
    /// The value of unused slots.
    const ZERO: Self;
    /// Half of it.
    #[must_use]
    fn half(self) -> Self;
}

impl Scalar for f32 {
    const ZERO: f32 = 0.0;

    #[inline(always)]
    fn half(self) -> f32 {
        0.5 * self
    }
}

/// Vertices, and faces as loops of their numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryOf<S> {
    /// Four vertices of each corner; corner `i` is where x is least if bit 0 is set, y if bit 1
    /// is, z if bit 2 is. Vertices may coincide.
    pub vertices: [[S; 3]; VERTICES],
    faces: [Loop; FACES],
}

/// The boundary of a [`Tribox`]: vertices, and faces as loops of their numbers.
pub type Boundary = BoundaryOf<f32>;

/// Planes of a corner, in coordinates that grow towards it: box planes at the least three, chamfers
/// between the first and second, second and third, third and first.
#[derive(Clone, Copy)]
struct Corner<S> {
    planes: [S; 3],
    chamfers: [S; 3],
}

/// By case (the chamfers' point is inside; beyond the first, second, third plane), and by axis: the
/// part of a box face's loop.
const PLANE_PARTS: [[&[u8]; 3]; 4] =
    [[&[1], &[2], &[3]], [&[0, 1], &[2], &[3]], [&[3], &[0, 1], &[2]], [&[2], &[3], &[0, 1]]];

/// The same for the chamfers after each axis: from the side of its first plane to that of its
/// second.
const CHAMFER_PARTS: [[&[u8]; 3]; 4] = [
    [&[1, 0, 2], &[2, 0, 3], &[3, 0, 1]],
    [&[0, 2], &[2, 0, 1, 3], &[3, 1]],
    [&[3, 1], &[0, 2], &[2, 0, 1, 3]],
    [&[2, 0, 1, 3], &[3, 1], &[0, 2]],
];

/// A part of a loop: slots of a corner, and their count.
#[derive(Clone, Copy)]
struct Part {
    slots: u32,
    length: usize,
}

/// Parts that a corner has in its six faces, box planes first, each forward and backward.
const PARTS: [[Part; 12]; 4] = {
    let mut parts = [[Part { slots: 0, length: 0 }; 12]; 4];
    let mut case = 0;
    while case < 4 {
        let mut which = 0;
        while which < 12 {
            let face = which / 2;
            let slots =
                if face < 3 { PLANE_PARTS[case][face] } else { CHAMFER_PARTS[case][face - 3] };
            let mut i = 0;
            while i < slots.len() {
                let from = if which % 2 == 0 { i } else { slots.len() - 1 - i };
                parts[case][which].slots |= (slots[from] as u32) << (8 * i);
                i += 1;
            }
            parts[case][which].length = slots.len();
            which += 1;
        }
        case += 1;
    }
    parts
};

/// Most corners of a face.
const CORNERS: usize = 4;

/// For each face its corners in the order of the loop, each with the number of its part; chamfers
/// have two.
const CORNERS_OF_FACES: [[(usize, usize); CORNERS]; FACES] = {
    let mut faces = [[(0, 0); CORNERS]; FACES];
    let mut axis = 0;
    while axis < 3 {
        let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut low = 0;
        while low < 2 {
            // Corners of a box plane, counter-clockwise about the axis; the other way where it is
            // least.
            let around = [[0, 0], [1, 0], [1, 1], [0, 1]];
            let mut i = 0;
            while i < 4 {
                let [b, c] = around[if low == 1 { 3 - i } else { i }];
                let backward = (b != c) != (low == 1);
                let corner = low << axis | b << second | c << third;
                faces[2 * axis + 1 - low][i] = (corner, 2 * axis + backward as usize);
                i += 1;
            }
            let mut other = 0;
            while other < 2 {
                // Up one side of the chamfer and down the other.
                let turned = low != other;
                let slab = 3 + 2 * axis + turned as usize;
                let mut i = 0;
                while i < 2 {
                    let far = if turned { 1 - i } else { i };
                    let backward = (far == 0) != turned;
                    let corner = low << axis | other << second | far << third;
                    faces[2 * slab + 1 - low][i] = (corner, 6 + 2 * axis + backward as usize);
                    i += 1;
                }
                other += 1;
            }
            low += 1;
        }
        axis += 1;
    }
    faces
};

impl<S: Scalar> Corner<S> {
    /// Its four vertices, and its case.
    #[inline(always)]
    fn vertices(&self) -> ([[S; 3]; 4], u8) {
        let Corner { planes: [a, b, c], chamfers: [ab, bc, ca] } = *self;
        let p = [(ab + ca - bc).half(), (ab + bc - ca).half(), (bc + ca - ab).half()];
        if p[0] > a {
            (beyond([a, b, c], [ab, bc, ca]), 1)
        } else if p[1] > b {
            (beyond([b, c, a], [bc, ca, ab]).map(|[y, z, x]| [x, y, z]), 2)
        } else if p[2] > c {
            (beyond([c, a, b], [ca, ab, bc]).map(|[z, x, y]| [x, y, z]), 3)
        } else {
            ([p, [a, ab - a, ca - a], [ab - b, b, bc - b], [ca - c, bc - c, c]], 0)
        }
    }
}

/// Vertices where the chamfers' point lies beyond the first plane: two on it, and those on the
/// other planes.
#[inline(always)]
fn beyond<S: Scalar>([a, b, c]: [S; 3], [ab, bc, ca]: [S; 3]) -> [[S; 3]; 4] {
    let (y, z) = (ab - a, ca - a);
    [[a, y, bc - y], [a, bc - z, z], [ab - b, b, bc - b], [ca - c, bc - c, c]]
}

/// The boundary of the intersection of nine slabs. Every plane has to touch it, as
/// [`Tribox::tightened`] gives it.
///
/// Faces are counter-clockwise from outside. Between 96 and 112 additions, 24 halvings and at most
/// 24 comparisons. In f32 each coordinate of a vertex is off by at most 10·2^-24 of the greatest
/// parameter. It is exact for parameters that are multiples of 2^-20 of a power of two above all of
/// them ([`Tribox::on_grid`]). Planes that do not touch give vertices beyond other planes, in loops
/// that still close.
///
/// [`BoundaryOf::compute`] does the same in place and saves a copy of 600 bytes.
#[inline]
pub fn boundary<S: Scalar>(low: &[S; SLABS], high: &[S; SLABS]) -> BoundaryOf<S> {
    let mut boundary = BoundaryOf::EMPTY;
    boundary.compute(low, high);
    boundary
}

/// Puts the vertices of corner `I` into its slots. Returns its case.
#[inline(always)]
fn at<S: Scalar, const I: usize>(
    low: &[S; SLABS],
    high: &[S; SLABS],
    slots: &mut [[S; 3]; 4],
) -> u8 {
    let [x, y, z] = [I & 1 != 0, I & 2 != 0, I & 4 != 0];
    let side = |low: S, high: S, is_low: bool| if is_low { -low } else { high };
    // If two coordinates grow in the same direction, the sum's slab bounds the edge, else the
    // difference's.
    let planes = [side(low[0], high[0], x), side(low[1], high[1], y), side(low[2], high[2], z)];
    let chamfers = [
        if x == y { side(low[3], high[3], x) } else { side(low[4], high[4], x) },
        if y == z { side(low[5], high[5], y) } else { side(low[6], high[6], y) },
        if z == x { side(low[7], high[7], z) } else { side(low[8], high[8], z) },
    ];
    let (found, case) = Corner { planes, chamfers }.vertices();
    for (slot, [px, py, pz]) in slots.iter_mut().zip(found) {
        *slot = [if x { -px } else { px }, if y { -py } else { py }, if z { -pz } else { pz }];
    }
    case
}

/// A face's loop.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Loop {
    /// A part is written four bytes wide, so that the last one may reach beyond the loop.
    vertices: [u8; LOOP + 3],
    length: u8,
}

impl Loop {
    const EMPTY: Loop = Loop { vertices: [0; LOOP + 3], length: 0 };

    /// Makes it the loop of face `F`. One function for each face, so that the tables are constants:
    /// half the instructions of a loop over the tables.
    #[inline(always)]
    fn join<const F: usize>(&mut self, parts: &[&[Part; 12]; 8]) {
        let mut end = 0usize;
        // Four constants. A loop would read them from a table.
        let [a, b, c, d] = const { CORNERS_OF_FACES[F] };
        end = self.put(a, parts, end);
        end = self.put(b, parts, end);
        if F < 6 {
            end = self.put(c, parts, end);
            end = self.put(d, parts, end);
        }
        self.length = end as u8;
    }

    /// Writes a part of a corner from `start` on. Returns its end.
    #[inline(always)]
    fn put(
        &mut self,
        (corner, part): (usize, usize),
        parts: &[&[Part; 12]; 8],
        start: usize,
    ) -> usize {
        let found = parts.get(corner).and_then(|parts| parts.get(part));
        let Some(&Part { slots, length }) = found else { return start };
        if let Some(place) =
            self.vertices.get_mut(start..).and_then(|rest| rest.first_chunk_mut::<4>())
        {
            *place = (slots + corner as u32 * 0x0404_0404).to_le_bytes();
        }
        start + length
    }

    fn as_slice(&self) -> &[u8] {
        self.vertices.get(..usize::from(self.length)).unwrap_or(&[])
    }

    /// Adds a vertex unless it is the last one. If it is the one before the last, it removes the
    /// last: the loop went there and back.
    fn push(&mut self, vertex: u8) {
        match self.as_slice() {
            [.., before, _] if *before == vertex => self.length -= 1,
            [.., last] if *last == vertex => {}
            _ => {
                if let Some(slot) = self.vertices.get_mut(usize::from(self.length)) {
                    *slot = vertex;
                    self.length += 1;
                }
            }
        }
    }
}

impl<S: Scalar> BoundaryOf<S> {
    /// All vertices at the origin, no faces: to be [computed](Self::compute).
    pub const EMPTY: Self =
        BoundaryOf { vertices: [[S::ZERO; 3]; VERTICES], faces: [Loop::EMPTY; FACES] };

    /// [`boundary()`], in place.
    #[inline]
    pub fn compute(&mut self, low: &[S; SLABS], high: &[S; SLABS]) {
        let Some([a, b, c, d, e, f, g, h]) =
            self.vertices.as_chunks_mut::<4>().0.first_chunk_mut::<8>()
        else {
            return;
        };
        let cases = [
            at::<S, 0>(low, high, a),
            at::<S, 1>(low, high, b),
            at::<S, 2>(low, high, c),
            at::<S, 3>(low, high, d),
            at::<S, 4>(low, high, e),
            at::<S, 5>(low, high, f),
            at::<S, 6>(low, high, g),
            at::<S, 7>(low, high, h),
        ];
        let parts = cases.map(|case| &PARTS[usize::from(case & 3)]);
        let [x, xx, y, yy, z, zz, chamfers @ ..] = &mut self.faces;
        x.join::<0>(&parts);
        xx.join::<1>(&parts);
        y.join::<2>(&parts);
        yy.join::<3>(&parts);
        z.join::<4>(&parts);
        zz.join::<5>(&parts);
        let [a, b, c, d, e, f, g, h, i, j, k, l] = chamfers;
        a.join::<6>(&parts);
        b.join::<7>(&parts);
        c.join::<8>(&parts);
        d.join::<9>(&parts);
        e.join::<10>(&parts);
        f.join::<11>(&parts);
        g.join::<12>(&parts);
        h.join::<13>(&parts);
        i.join::<14>(&parts);
        j.join::<15>(&parts);
        k.join::<16>(&parts);
        l.join::<17>(&parts);
    }

    /// The loop of a face, counter-clockwise from outside; empty for numbers from [`FACES`] on, and
    /// for faces that were [cleaned](Self::cleaned) away.
    pub fn face(&self, face: usize) -> &[u8] {
        self.faces.get(face).map_or(&[], Loop::as_slice)
    }

    /// Corners of the vertices of a face.
    pub fn corners(&self, face: usize) -> impl Iterator<Item = [S; 3]> + '_ {
        self.face(face).iter().filter_map(|&vertex| self.vertices.get(vertex as usize).copied())
    }

    /// The same without edges of no length and faces of fewer than three vertices. Of vertices that
    /// coincide the first one's number is used; equality is exact.
    #[must_use]
    pub fn cleaned(&self) -> BoundaryOf<S> {
        let mut first = [0u8; VERTICES];
        for (i, (slot, vertex)) in first.iter_mut().zip(&self.vertices).enumerate() {
            *slot = self.vertices.iter().position(|other| other == vertex).unwrap_or(i) as u8;
        }
        let mut cleaned = *self;
        for face in &mut cleaned.faces {
            let mut found = Loop::EMPTY;
            for &vertex in face.as_slice() {
                found.push(first.get(usize::from(vertex)).copied().unwrap_or(vertex));
            }
            while let [start, _, .., end] = found.as_slice()
                && start == end
            {
                found.length -= 1;
            }
            *face = if found.length > 2 { found } else { Loop::EMPTY };
        }
        cleaned
    }
}

impl Boundary {
    /// The greatest `direction · v` of all vertices, as computed.
    #[must_use]
    pub fn support(&self, [x, y, z]: [f32; 3]) -> f32 {
        let along = self.vertices.iter().map(|v| v[0] * x + v[1] * y + v[2] * z);
        along.fold(f32::NEG_INFINITY, greater)
    }
}

impl Tribox {
    /// Its [`boundary()`]. All vertices of an empty one are NaN.
    #[must_use]
    pub fn boundary(&self) -> Boundary {
        boundary(&self.low, &self.high)
    }

    /// Points whose convex hull holds this tribox, for a [`Solid`](crate::Solid): the vertices of
    /// [`on_grid`](Self::on_grid), which f32 holds exactly. Each plane of the hull lies at most one
    /// unit of that grid outside: 2^-20 of the power of two above all parameters. Some points may
    /// coincide. All are NaN if the tribox is empty.
    ///
    /// ```
    /// use meshsweep_core::{Solid, Tribox};
    /// let tool = Tribox::of_points([[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [1.0, 2.0, 9.0]])?;
    /// let corners = tool.corners();
    /// assert!(Solid::new(&corners, 0.5).is_ok());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn corners(&self) -> [[f32; 3]; VERTICES] {
        self.on_grid().boundary().vertices
    }
}
