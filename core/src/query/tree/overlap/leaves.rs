//! Two leaves: which of their triangles may meet, then each such pair, in f32, and where that leaves it open in f64.

use super::placement::Placement;
use crate::blob::Patch;
use crate::blob::layout::WIDTH;
use crate::fan::LANES_BELOW;
use crate::geom::{Contact, determinant_margin, triangles_meet};
use crate::query::Work;

/// Places for a patch's vertices: two centres and the ring, and some to spare so that eight are read at shift 1.
pub(super) const SLOTS: usize = 12;

/// Slot of the first ring vertex.
const RING: usize = 2;

/// Vertices of a leaf: both centres, alike if there is one fan, then the ring, then the first centre again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    at: [[f32; SLOTS]; 3],
    /// Vertices in use.
    used: usize,
    triangles: usize,
    turn: usize,
}

impl Corners {
    /// As stored: grid units from the grid's origin.
    #[inline(always)]
    fn stored(patch: &Patch<'_>) -> Corners {
        let tag = patch.tag();
        let triangles = tag.triangles().min(WIDTH);
        let mut corners = Corners {
            at: [[0.0; SLOTS]; 3],
            used: (RING + triangles + 1).min(SLOTS),
            triangles,
            turn: tag.turn(),
        };
        let second = tag.centres() - 1;
        let [xs, ys, zs] = &mut corners.at;
        for (slot, ((x, y), z)) in xs.iter_mut().zip(ys).zip(zs).enumerate() {
            let vertex = match slot {
                0 => patch.stored_centre(0),
                1 => patch.stored_centre(second),
                _ if slot <= RING + triangles => patch.stored_ring(slot - RING),
                _ => patch.stored_centre(0),
            };
            [*x, *y, *z] = vertex;
        }
        corners
    }

    #[inline(always)]
    fn corner(&self, slot: usize) -> [f32; 3] {
        self.at.map(|axis| axis.get(slot).copied().unwrap_or(0.0))
    }

    #[inline(always)]
    fn slots(&self, triangle: usize) -> [usize; 3] {
        [usize::from(triangle >= self.turn), RING + triangle, RING + 1 + triangle]
    }

    /// Largest 1-norm.
    #[inline(always)]
    fn reach(&self) -> f32 {
        let [x, y, z] = &self.at;
        let mut far = [0f32; SLOTS];
        for i in 0..SLOTS {
            far[i] = x[i].abs() + y[i].abs() + z[i].abs();
        }
        far.iter().fold(0.0, |most, &far| if far > most { far } else { most })
    }
}

/// Planes of a leaf's triangles.
struct Facets {
    normal: [[f32; WIDTH]; 3],
    height: [f32; WIDTH],
    margin: [f32; WIDTH],
}

impl Facets {
    /// `far` is the largest 1-norm of a vertex of either leaf, `shift` what a difference of two may be off by.
    #[inline(always)]
    fn of(corners: &Corners, far: f32, shift: f32) -> Option<Facets> {
        let first = LANES_BELOW.get(corners.turn)?;
        let [x, y, z] = &corners.at;
        let mut facets = Facets { normal: [[0.0; WIDTH]; 3], height: [0.0; WIDTH], margin: [0.0; WIDTH] };
        for i in 0..WIDTH {
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

    /// For each triangle of the other leaf the planes that have it on one side.
    #[inline(always)]
    fn part(&self, other: &Corners) -> [u32; WIDTH] {
        let [nx, ny, nz] = &self.normal;
        let [x, y, z] = &other.at;
        let (mut above, mut below) = ([[0u32; WIDTH]; SLOTS], [[0u32; WIDTH]; SLOTS]);
        for (k, (above, below)) in above.iter_mut().zip(&mut below).enumerate().take(other.used) {
            if k >= SLOTS {
                break;
            }
            let (x, y, z) = (x[k], y[k], z[k]);
            for i in 0..WIDTH {
                let height = nx[i] * x + ny[i] * y + nz[i] * z - self.height[i];
                above[i] = if height > self.margin[i] { u32::MAX } else { 0 };
                below[i] = if height < -self.margin[i] { u32::MAX } else { 0 };
            }
        }
        let mut parted = [0u32; WIDTH];
        for (j, parted) in parted.iter_mut().enumerate().take(other.triangles) {
            let centre = usize::from(j >= other.turn);
            let (Some(a), Some(b), Some(c)) =
                (above.get(centre), above.get(RING + j), above.get(RING + 1 + j))
            else {
                continue;
            };
            let (Some(d), Some(e), Some(f)) =
                (below.get(centre), below.get(RING + j), below.get(RING + 1 + j))
            else {
                continue;
            };
            for i in 0..WIDTH {
                *parted |= (a[i] & b[i] & c[i] | d[i] & e[i] & f[i]) & (1 << i);
            }
        }
        parted
    }
}

/// The first or the second centre.
#[inline(always)]
fn blend(mask: u32, axis: &[f32; SLOTS]) -> f32 {
    f32::from_bits(axis[0].to_bits() & mask | axis[1].to_bits() & !mask)
}

/// A leaf of the first tree, and one of the second, in common units from a vertex of the first.
pub(super) struct LeafPair<'a> {
    place: &'a Placement,
    patches: [Patch<'a>; 2],
    a: Corners,
    b: Corners,
}

impl<'a> LeafPair<'a> {
    #[inline(always)]
    pub(super) fn new(place: &'a Placement, a: &Patch<'a>, b: &Patch<'a>) -> LeafPair<'a> {
        let (mut first, mut second) = (Corners::stored(a), Corners::stored(b));
        let [side, _] = &place.sides;
        let unit = side.unit;
        let base = first.corner(0).map(|x| x * unit);
        for (axis, base) in first.at.iter_mut().zip(base) {
            for x in axis {
                *x = *x * unit - base;
            }
        }
        let [x, y, z] = second.at;
        let rows = place.matrix.iter().zip(place.shift).zip(base);
        for (axis, ((row, shift), base)) in second.at.iter_mut().zip(rows) {
            let [a, b, c] = *row;
            for i in 0..SLOTS {
                axis[i] = ((a * x[i] + b * y[i]) + (c * z[i] + shift)) - base;
            }
        }
        LeafPair { place, patches: [*a, *b], a: first, b: second }
    }

    /// Pairs that no plane of a triangle parts: for each triangle of the first leaf the other's.
    #[inline(always)]
    pub(super) fn candidates(&self) -> Option<[u32; WIDTH]> {
        let (far_a, far_b) = (self.a.reach(), self.b.reach());
        let far = if far_a > far_b { far_a } else { far_b };
        let shift = self.place.doubt + self.place.doubt;
        let by_first = Facets::of(&self.a, far, shift)?.part(&self.b);
        let by_second = Facets::of(&self.b, far, shift)?.part(&self.a);
        let all = u32::MAX >> (32 - self.b.triangles.min(WIDTH));
        let mut candidates = [0u32; WIDTH];
        for (i, (candidates, parted)) in
            candidates.iter_mut().zip(by_second).enumerate().take(self.a.triangles)
        {
            let mut bits = all & !parted;
            for (j, parted) in by_first.iter().enumerate() {
                bits &= !((parted >> i & 1) << j);
            }
            *candidates = bits;
        }
        Some(candidates)
    }

    /// What is known of triangle `i` of the first leaf and `j` of the second.
    #[inline(never)]
    pub(super) fn settle(&self, i: usize, j: usize, work: &mut Work) -> Contact {
        work.triangles = work.triangles.saturating_add(1);
        let a = self.a.slots(i).map(|slot| self.a.corner(slot));
        let b = self.b.slots(j).map(|slot| self.b.corner(slot));
        let contact = triangles_meet(a, b, self.place.doubt);
        if contact != Contact::Open {
            return contact;
        }
        work.exact = work.exact.saturating_add(1);
        self.settle_exactly(i, j)
    }

    /// The same in f64.
    #[cold]
    #[inline(never)]
    fn settle_exactly(&self, i: usize, j: usize) -> Contact {
        let Placement { matrix, shift_exact, doubt_exact, .. } = *self.place;
        let [first, second] = &self.patches;
        let unit = f64::from(self.place.sides[0].unit);
        let wide = |patch: &Patch<'_>, slots: [usize; 3]| {
            slots.map(|slot| {
                let vertex =
                    if slot < RING { patch.stored_centre(slot) } else { patch.stored_ring(slot - RING) };
                vertex.map(f64::from)
            })
        };
        let a = wide(first, self.a.slots(i));
        let [[cx, cy, cz], ..] = a;
        let b = wide(second, self.b.slots(j)).map(|[x, y, z]| {
            let along = |[a, b, c]: [f32; 3], shift: f64, centre: f64| {
                let [a, b, c] = [a, b, c].map(f64::from);
                ((a * x + b * y) + (c * z + shift)) - centre * unit
            };
            let [r, s, t] = matrix;
            let [u, v, w] = shift_exact;
            [along(r, u, cx), along(s, v, cy), along(t, w, cz)]
        });
        let a = a.map(|[x, y, z]| [(x - cx) * unit, (y - cy) * unit, (z - cz) * unit]);
        triangles_meet(a, b, doubt_exact)
    }
}
