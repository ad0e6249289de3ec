//! Finds the pairs of triangles of two leaves that may meet. Tests each in f32, and in f64 where
//! f32 cannot decide.

use crate::bvh::tree::format::{FanLeaf, LeafShape, RING, slots};
use crate::bvh::tree::node::WIDE;
use crate::geom::fan::{LANES_BELOW, WIDTH};
use crate::geom::{Contact, determinant_margin, straddling_triangles_meet, triangles_meet};
use crate::num::{each, greater, lesser};
use crate::query::{VertexPose, Work};
use glam::Vec3;

/// Slots for a leaf's vertices: two centres, the ring, and spare ones so that eight can be read at
/// shift 1.
pub(crate) const SLOTS: usize = 12;

/// Vertices of a leaf: both centres, alike if there is one fan, then the ring, then the first
/// centre again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners {
    pub(crate) at: [[f32; SLOTS]; 3],
    /// Vertices in use.
    used: usize,
    pub(crate) triangles: usize,
    turn: usize,
}

impl Corners {
    /// As stored: grid units from the grid's origin.
    #[inline(always)]
    fn stored(leaf: &FanLeaf<'_>) -> Corners {
        let shape = leaf.shape();
        let triangles = shape.triangles().min(WIDTH);
        let mut at = [[0.0; SLOTS]; 3];
        let used = (RING + triangles + 1).min(SLOTS);
        for (at, stored) in at.iter_mut().zip(leaf.stored_vertices()) {
            // Unused slots repeat the first centre, so that they do not widen the box.
            *at = [stored[0]; SLOTS];
            at.iter_mut().zip(stored).take(used).for_each(|(x, stored)| *x = stored);
        }
        Corners { at, used, triangles, turn: shape.turn() }
    }

    /// These vertices of a leaf of this shape.
    #[inline(always)]
    pub(crate) fn of(vertices: &[Vec3; SLOTS], shape: LeafShape) -> Corners {
        let triangles = shape.triangles().min(WIDTH);
        let used = (RING + triangles + 1).min(SLOTS);
        let [first, ..] = vertices;
        let mut at = [[first.x; SLOTS], [first.y; SLOTS], [first.z; SLOTS]];
        let [x, y, z] = &mut at;
        for (i, vertex) in vertices.iter().enumerate().take(used) {
            [x[i], y[i], z[i]] = vertex.to_array();
        }
        Corners { at, used, triangles, turn: shape.turn() }
    }

    /// `at` has a number for each slot. Returns the least and the greatest of each triangle's
    /// three.
    #[inline(always)]
    pub(crate) fn ends(&self, at: &[f32; SLOTS]) -> Option<([f32; WIDTH], [f32; WIDTH])> {
        Some(ends_of_triangles(LANES_BELOW.get(self.turn)?, at))
    }

    #[inline(always)]
    fn corner(&self, slot: usize) -> [f32; 3] {
        let [x, y, z] = &self.at;
        each([x, y, z], |axis| axis.get(slot).copied().unwrap_or(0.0))
    }

    #[inline(always)]
    pub(crate) fn triangle(&self, triangle: usize) -> [Vec3; 3] {
        each(self.slots(triangle), |slot| Vec3::from_array(self.corner(slot)))
    }

    #[inline(always)]
    pub(crate) fn slots(&self, triangle: usize) -> [usize; 3] {
        slots(triangle, self.turn)
    }

    /// The box of all vertices.
    #[inline(always)]
    fn extent(&self) -> Extent {
        let [x, y, z] = &self.at;
        let low = |axis: &[f32; SLOTS]| axis.iter().copied().fold(f32::MAX, lesser);
        let high = |axis: &[f32; SLOTS]| axis.iter().copied().fold(f32::MIN, greater);
        Extent { low: each([x, y, z], low), high: each([x, y, z], high) }
    }

    /// Largest 1-norm.
    #[inline(always)]
    pub(crate) fn max_norm(&self) -> f32 {
        let [x, y, z] = &self.at;
        let mut far = [0f32; SLOTS];
        for i in 0..SLOTS {
            far[i] = x[i].abs() + y[i].abs() + z[i].abs();
        }
        far.iter().fold(0.0, |most, &far| greater(most, far))
    }
}

/// Planes of a leaf's triangles.
struct Facets {
    normal: [[f32; WIDTH]; 3],
    height: [f32; WIDTH],
    margin: [f32; WIDTH],
}

impl Facets {
    /// Only the planes of the triangles `wanted` are set. `far` is the largest 1-norm of a vertex
    /// of either leaf, `shift` the error of a difference of two.
    #[inline(always)]
    fn of(corners: &Corners, wanted: u32, far: f32, shift: f32) -> Option<Facets> {
        let first = LANES_BELOW.get(corners.turn)?;
        let [x, y, z] = &corners.at;
        let mut facets =
            Facets { normal: [[0.0; WIDTH]; 3], height: [0.0; WIDTH], margin: [0.0; WIDTH] };
        for i in 0..WIDTH {
            if !WIDE && wanted >> i & 1 == 0 {
                continue;
            }
            let [cx, cy, cz] = [blend(first[i], x), blend(first[i], y), blend(first[i], z)];
            let (ex, ey, ez) = (x[RING + i] - cx, y[RING + i] - cy, z[RING + i] - cz);
            let (gx, gy, gz) = (x[RING + 1 + i] - cx, y[RING + 1 + i] - cy, z[RING + 1 + i] - cz);
            let (nx, ny, nz) = (ey * gz - ez * gy, ez * gx - ex * gz, ex * gy - ey * gx);
            facets.normal[0][i] = nx;
            facets.normal[1][i] = ny;
            facets.normal[2][i] = nz;
            facets.height[i] = nx * cx + ny * cy + nz * cz;
            let (e, g) = (ex.abs() + ey.abs() + ez.abs(), gx.abs() + gy.abs() + gz.abs());
            facets.margin[i] = determinant_margin(e, g, far + far, shift);
        }
        Some(facets)
    }

    /// On which side of each plane `wanted` each vertex of the other leaf certainly lies.
    #[inline(always)]
    fn sides(&self, wanted: u32, other: &Corners) -> VertexSides {
        let [nx, ny, nz] = &self.normal;
        let [x, y, z] = &other.at;
        let mut sides = VertexSides { above: [0; SLOTS], below: [0; SLOTS] };
        let vertices = x.iter().zip(y).zip(z).zip(sides.above.iter_mut().zip(&mut sides.below));
        for (((&x, &y), &z), (above, below)) in vertices.take(other.used) {
            let height = |i: usize| nx[i] * x + ny[i] * y + nz[i] * z - self.height[i];
            if WIDE {
                let mut heights = [0f32; WIDTH];
                for (i, out) in heights.iter_mut().enumerate() {
                    *out = height(i);
                }
                for (i, (height, margin)) in heights.iter().zip(&self.margin).enumerate() {
                    *above |= if height > margin { 1 << i } else { 0 };
                    *below |= if *height < -margin { 1 << i } else { 0 };
                }
                *above &= wanted;
                *below &= wanted;
                continue;
            }
            for i in 0..WIDTH {
                if wanted >> i & 1 != 0 {
                    let (height, margin) = (height(i), self.margin[i]);
                    *above |= u32::from(height > margin) << i;
                    *below |= u32::from(height < -margin) << i;
                }
            }
        }
        sides
    }
}

/// For each vertex of a leaf the planes of the other leaf's triangles that it is above, and those
/// that it is below.
struct VertexSides {
    above: [u32; SLOTS],
    below: [u32; SLOTS],
}

impl VertexSides {
    /// The planes that have all vertices of a triangle on one side.
    #[inline(always)]
    fn separating_planes(&self, slots: [usize; 3]) -> u32 {
        let all = |bits: &[u32; SLOTS]| {
            slots.iter().fold(u32::MAX, |all, &slot| all & bits.get(slot).copied().unwrap_or(0))
        };
        all(&self.above) | all(&self.below)
    }

    /// The sides of a triangle's vertices, 0 where it is not certain.
    #[inline(always)]
    fn of(&self, slots: [usize; 3], plane: usize) -> [i8; 3] {
        let at = |bits: &[u32; SLOTS], slot: usize| {
            (bits.get(slot).copied().unwrap_or(0) >> (plane & 7) & 1) as i8
        };
        each(slots, |slot| at(&self.above, slot) - at(&self.below, slot))
    }
}

/// Boxes of a leaf's triangles.
pub(crate) struct TriangleBoxes {
    pub(crate) low: [[f32; WIDTH]; 3],
    pub(crate) high: [[f32; WIDTH]; 3],
}

/// One box.
struct Extent {
    low: [f32; 3],
    high: [f32; 3],
}

impl TriangleBoxes {
    #[inline(always)]
    pub(crate) fn of(corners: &Corners) -> Option<TriangleBoxes> {
        let first = LANES_BELOW.get(corners.turn)?;
        let mut boxes = TriangleBoxes { low: [[0.0; WIDTH]; 3], high: [[0.0; WIDTH]; 3] };
        for ((x, low), high) in corners.at.iter().zip(&mut boxes.low).zip(&mut boxes.high) {
            (*low, *high) = ends_of_triangles(first, x);
        }
        Some(boxes)
    }

    #[inline(always)]
    fn one(&self, i: usize) -> Extent {
        let at = |axes: &[[f32; WIDTH]; 3]| axes.map(|axis| axis.get(i).copied().unwrap_or(0.0));
        Extent { low: at(&self.low), high: at(&self.high) }
    }
}

impl Extent {
    /// Whether two boxes are farther than `error` from each other along an axis.
    #[inline(always)]
    fn is_beyond(&self, other: &Extent, error: f32) -> bool {
        let axes = self.low.iter().zip(&self.high).zip(other.low.iter().zip(&other.high));
        axes.into_iter().any(|((from, to), (low, high))| greater(low - to, from - high) > error)
    }

    /// Which of the first `count` boxes, among those `wanted`, are within `error` along every axis.
    #[inline(always)]
    fn near(&self, boxes: &TriangleBoxes, count: usize, wanted: u32, error: f32) -> u32 {
        let mut bits = wanted & u32::MAX >> (32 - count.clamp(1, WIDTH));
        let axes = self.low.iter().zip(&self.high).zip(boxes.low.iter().zip(&boxes.high));
        if WIDE {
            let mut gaps = [f32::MIN; WIDTH];
            for ((from, to), (low, high)) in axes {
                for (gap, (low, high)) in gaps.iter_mut().zip(low.iter().zip(high)) {
                    *gap = greater(*gap, greater(low - to, from - high));
                }
            }
            for (j, &gap) in gaps.iter().enumerate() {
                bits &= if gap <= error { u32::MAX } else { !(1 << j) };
            }
            return bits;
        }
        for ((from, to), (low, high)) in axes {
            for (j, (low, high)) in low.iter().zip(high).enumerate() {
                if bits >> j & 1 != 0 && greater(low - to, from - high) > error {
                    bits &= !(1 << j);
                }
            }
        }
        bits
    }
}

/// The least and the greatest number of each triangle's vertices.
#[cfg_attr(meshsweep_small, inline(never))]
#[cfg_attr(not(meshsweep_small), inline(always))]
fn ends_of_triangles(first: &[u32; WIDTH], at: &[f32; SLOTS]) -> ([f32; WIDTH], [f32; WIDTH]) {
    let (mut low, mut high) = ([0.0; WIDTH], [0.0; WIDTH]);
    for i in 0..WIDTH {
        let (c, e, g) = (blend(first[i], at), at[RING + i], at[RING + 1 + i]);
        low[i] = lesser(c, lesser(e, g));
        high[i] = greater(c, greater(e, g));
    }
    (low, high)
}

/// The first centre where `mask` is ones, else the second.
#[inline(always)]
fn blend(mask: u32, axis: &[f32; SLOTS]) -> f32 {
    f32::from_bits(axis[0].to_bits() & mask | axis[1].to_bits() & !mask)
}

/// A leaf of the first tree, and one of the second, in common units from a vertex of the first.
pub(crate) struct LeafPair<'a> {
    pose: &'a VertexPose,
    leaves: [FanLeaf<'a>; 2],
    pub(crate) a: Corners,
    pub(crate) b: Corners,
    /// On which sides of the second leaf's planes the first leaf's vertices lie, and the reverse.
    sides: [VertexSides; 2],
}

impl<'a> LeafPair<'a> {
    #[cfg_attr(meshsweep_small, inline(never))]
    #[cfg_attr(not(meshsweep_small), inline(always))]
    pub(crate) fn new(pose: &'a VertexPose, a: &FanLeaf<'a>, b: &FanLeaf<'a>) -> LeafPair<'a> {
        let (mut first, mut second) = (Corners::stored(a), Corners::stored(b));
        let [unit, _] = pose.units;
        let base = first.corner(0).map(|x| x * unit);
        for (axis, base) in first.at.iter_mut().zip(base) {
            for x in axis {
                *x = *x * unit - base;
            }
        }
        let [x, y, z] = second.at;
        let rows = pose.matrix.iter().zip(pose.shift).zip(base);
        for (axis, ((row, shift), base)) in second.at.iter_mut().zip(rows) {
            let [a, b, c] = *row;
            for i in 0..SLOTS {
                axis[i] = ((a * x[i] + b * y[i]) + (c * z[i] + shift)) - base;
            }
        }
        let none = || VertexSides { above: [0; SLOTS], below: [0; SLOTS] };
        LeafPair { pose, leaves: [*a, *b], a: first, b: second, sides: [none(), none()] }
    }

    /// Pairs that no coordinate and no triangle's plane separates: for each triangle of the first
    /// leaf those of the second.
    #[inline(always)]
    pub(crate) fn candidates(&mut self) -> Option<[u32; WIDTH]> {
        let near = self.pairs_of_meeting_boxes()?;
        if near.iter().all(|&bits| bits == 0) {
            return Some([0; WIDTH]);
        }
        let (far_a, far_b) = (self.a.max_norm(), self.b.max_norm());
        let far = greater(far_b, far_a);
        let shift = self.pose.vertex_error + self.pose.vertex_error;
        let (mut rows, mut lanes) = (0u32, 0u32);
        for (i, &bits) in near.iter().enumerate() {
            rows |= u32::from(bits != 0) << i;
            lanes |= bits;
        }
        let to_first = Facets::of(&self.a, rows, far, shift)?.sides(rows, &self.b);
        let to_second = Facets::of(&self.b, lanes, far, shift)?.sides(lanes, &self.a);
        let mut candidates = near;
        for (i, bits) in candidates.iter_mut().enumerate().take(self.a.triangles) {
            *bits &= !to_second.separating_planes(self.a.slots(i));
        }
        for j in 0..self.b.triangles {
            let separating_planes = to_first.separating_planes(self.b.slots(j));
            for (i, bits) in candidates.iter_mut().enumerate() {
                *bits &= !((separating_planes >> i & 1) << j);
            }
        }
        self.sides = [to_second, to_first];
        Some(candidates)
    }

    /// Pairs whose boxes along the axes meet.
    #[inline(always)]
    fn pairs_of_meeting_boxes(&self) -> Option<[u32; WIDTH]> {
        // Each vertex may be off. Differences are compared, not sums, so only their own rounding
        // counts. It is less than the excess of `vertex_error`.
        let error = self.pose.vertex_error + self.pose.vertex_error;
        let (whole, other) = (self.a.extent(), self.b.extent());
        let mut near = [0u32; WIDTH];
        if whole.is_beyond(&other, error) {
            return Some(near);
        }
        let (first, second) = (TriangleBoxes::of(&self.a)?, TriangleBoxes::of(&self.b)?);
        let rows = other.near(&first, self.a.triangles, u32::MAX, error);
        let lanes = whole.near(&second, self.b.triangles, u32::MAX, error);
        if rows == 0 || lanes == 0 {
            return Some(near);
        }
        for (i, near) in near.iter_mut().enumerate() {
            if rows >> i & 1 != 0 {
                *near = first.one(i).near(&second, self.b.triangles, lanes, error);
            }
        }
        Some(near)
    }

    /// Whether triangle `i` of the first leaf and `j` of the second meet.
    #[inline(never)]
    pub(crate) fn meet(&self, i: usize, j: usize, work: &mut Work) -> Contact {
        work.triangles = work.triangles.saturating_add(1);
        let a = each(self.a.slots(i), |slot| self.a.corner(slot));
        let b = each(self.b.slots(j), |slot| self.b.corner(slot));
        let [to_second, to_first] = &self.sides;
        let (a_sides, b_sides) =
            (to_second.of(self.a.slots(i), j), to_first.of(self.b.slots(j), i));
        let vertex_error = self.pose.vertex_error;
        let contact = if a_sides.iter().chain(&b_sides).all(|&side| side != 0) {
            straddling_triangles_meet(a, b, [a_sides, b_sides], vertex_error + vertex_error)
        } else {
            triangles_meet(a, b, vertex_error)
        };
        if contact != Contact::Undecided {
            return contact;
        }
        work.exact = work.exact.saturating_add(1);
        self.meet_exactly(i, j)
    }

    /// The same in f64.
    #[cold]
    #[inline(never)]
    fn meet_exactly(&self, i: usize, j: usize) -> Contact {
        let [a, b] = self.in_f64(i, j);
        triangles_meet(a, b, self.pose.vertex_error_f64)
    }

    /// Both triangles in f64, common units from the first vertex of the first one. No vertex is
    /// farther than `vertex_error_f64` of the pose from its place.
    #[inline(always)]
    pub(crate) fn in_f64(&self, i: usize, j: usize) -> [[[f64; 3]; 3]; 2] {
        let VertexPose { matrix, shift_f64, .. } = *self.pose;
        let [first, second] = &self.leaves;
        let unit = f64::from(self.pose.units[0]);
        let wide = |leaf: &FanLeaf<'_>, lane: usize| {
            leaf.stored_corners(lane).map(|corner| corner.to_array().map(f64::from))
        };
        let a = wide(first, i);
        let [[cx, cy, cz], ..] = a;
        let [u, v, w] = shift_f64;
        let [u, v, w] = [u - cx * unit, v - cy * unit, w - cz * unit];
        let b = wide(second, j).map(|[x, y, z]| {
            let along = |[a, b, c]: [f32; 3], shift: f64| {
                let [a, b, c] = [a, b, c].map(f64::from);
                (a * x + b * y) + (c * z + shift)
            };
            let [r, s, t] = matrix;
            [along(r, u), along(s, v), along(t, w)]
        });
        [a.map(|[x, y, z]| [(x - cx) * unit, (y - cy) * unit, (z - cz) * unit]), b]
    }

    /// The first vertex of triangle `i` of the first leaf, its units from its origin, exactly.
    #[inline(always)]
    pub(crate) fn first_vertex(&self, i: usize) -> [f64; 3] {
        let [first, _] = &self.leaves;
        let [corner, ..] = first.stored_corners(i);
        corner.to_array().map(f64::from)
    }
}
