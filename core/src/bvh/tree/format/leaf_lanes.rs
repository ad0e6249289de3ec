//! Leaves read a register at a time, for the point kernel of vector targets.

use super::grid_ring::{GRID_WINDOW, short};
use super::leaf::FanLeaf;
use crate::geom::fan::{
    CentreShadows, Edges, FanRay, LANES, Lanes, PIECES, RingLanes, WIDTH, lanes_below, ray_lanes,
};
use glam::Vec3;

/// A point for the leaves of one tree, prepared once for each query. Grid units.
#[derive(Clone, Copy, Debug)]
pub struct LanePoint {
    pub(super) p: Vec3,
    /// The point's coordinates, each in all lanes.
    lanes: [Lanes; 3],
    /// The grid's origin in all lanes.
    pub(super) origin: [Lanes; 3],
}

impl LanePoint {
    /// The point `p` for a tree with this `grid_origin`.
    #[inline(always)]
    pub fn new(p: Vec3, grid_origin: [i32; 3]) -> LanePoint {
        let [lanes, origin] = [p.to_array(), grid_origin.map(|x| x as f32)].map(
            #[inline(always)]
            |[x, y, z]| [Lanes::splat(x), Lanes::splat(y), Lanes::splat(z)],
        );
        LanePoint { p, lanes, origin }
    }
}

/// A leaf on the grid and a point, ready to be read.
#[derive(Clone, Copy, Debug)]
pub struct GridLanes<'a> {
    window: &'a [u8; GRID_WINDOW],
    /// Byte of the first ring vertex.
    ring: usize,
    /// Bytes of a ring along one axis.
    step: usize,
    /// First and second centre without the grid's origin.
    centres: [[f32; 3]; 2],
    /// Ones in the lanes of the first fan.
    first: [Lanes; PIECES],
    point: &'a LanePoint,
}

impl GridLanes<'_> {
    /// The triangles in the lanes of register `piece`.
    #[inline(always)]
    pub fn edges(&self, piece: usize) -> Edges {
        let ([ex, gx, sx], [ey, gy, sy], [ez, gz, sz]) =
            (self.axis(piece, 0), self.axis(piece, 1), self.axis(piece, 2));
        Edges { e: [ex, ey, ez], g: [gx, gy, gz], s: [sx, sy, sz] }
    }

    /// The same along one axis.
    #[inline(always)]
    fn axis(&self, piece: usize, axis: usize) -> [Lanes; 3] {
        let at = self.ring + self.step * axis;
        let [c, d] = self.centres;
        let centre = self.first[piece].select(Lanes::splat(c[axis]), Lanes::splat(d[axis]));
        [
            numbers(self.window, at, piece) - centre,
            numbers(self.window, at + 2, piece) - centre,
            // The sum is exact, so this is the point less the centre, rounded once.
            self.point.lanes[axis] - (centre + self.point.origin[axis]),
        ]
    }
}

/// The numbers in the lanes of register `piece`, of eight from a byte offset on. No ring begins
/// beyond byte 48 of a window.
#[inline(always)]
fn numbers(window: &[u8; GRID_WINDOW], at: usize, piece: usize) -> Lanes {
    let at = at.min(GRID_WINDOW - 16) + 2 * LANES * piece;
    let mut numbers = [0u16; LANES];
    if let Some(bytes) = window.get(at..at + 2 * LANES) {
        for (number, &pair) in numbers.iter_mut().zip(bytes.as_chunks::<2>().0) {
            *number = u16::from_le_bytes(pair);
        }
    }
    floats(numbers)
}

/// Written for the instruction: the compiler would join rows that overlap, and take them apart
/// again.
#[cfg(target_feature = "avx")]
#[inline(always)]
fn floats(numbers: [u16; LANES]) -> Lanes {
    wide::i32x8::from_u16x8(wide::u16x8::new(numbers)).round_float()
}

#[cfg(not(target_feature = "avx"))]
#[inline(always)]
fn floats(numbers: [u16; LANES]) -> Lanes {
    let eight = wide::i32x8::from_u16x8(wide::bytemuck::cast([numbers, [0; LANES]]));
    let [four, _]: [wide::i32x4; 2] = wide::bytemuck::cast(eight);
    four.round_float()
}

/// The first eight numbers.
#[inline(always)]
fn first_eight(window: &[u8; GRID_WINDOW]) -> [f32; 8] {
    let mut out = [[0f32; LANES]; PIECES];
    for (piece, out) in out.iter_mut().enumerate() {
        *out = numbers(window, 0, piece).to_array();
    }
    wide::bytemuck::cast(out)
}

impl<'a> FanLeaf<'a> {
    /// A leaf with vertices on the grid, and a point.
    #[inline(always)]
    pub fn grid_lanes<'b>(&self, point: &'b LanePoint) -> Option<GridLanes<'b>>
    where
        'a: 'b,
    {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let [cx, cy, cz, dx, dy, dz, ..] = first_eight(window);
        Some(GridLanes {
            window,
            ring: 6 * self.shape.centres(),
            step: 2 * (self.shape.triangles() + 1).min(WIDTH + 1),
            centres: [[cx, cy, cz], [dx, dy, dz]],
            first: lanes_below(self.shape.turn())?,
            point,
        })
    }

    /// The triangles in the lanes of register `piece` as seen from a point, of a leaf with f32
    /// vertices.
    #[inline]
    pub fn f32_edges(&self, &LanePoint { p, .. }: &LanePoint, piece: usize) -> Option<Edges> {
        let first = *lanes_below(self.shape.turn())?.get(piece)?;
        let (c, d) = (self.centre(0), self.centre(self.shape.centres() - 1));
        let [cs, ds] = [p - c, p - d].map(|s| s.to_array());
        let (c, d) = (c.to_array(), d.to_array());
        let words = self.bytes.as_chunks::<4>().0;
        let axis = |k: usize| {
            let at = 3 * self.shape.centres() + (self.shape.triangles() + 1) * k + piece * LANES;
            let ring = |at: usize| {
                let words = words.get(at..)?.first_chunk::<LANES>()?;
                Some(Lanes::new(words.map(f32::from_le_bytes)))
            };
            let centre = first.select(Lanes::splat(c[k]), Lanes::splat(d[k]));
            let s = first.select(Lanes::splat(cs[k]), Lanes::splat(ds[k]));
            Some((ring(at)? - centre, ring(at + 1)? - centre, s))
        };
        let ((ex, gx, sx), (ey, gy, sy), (ez, gz, sz)) = (axis(0)?, axis(1)?, axis(2)?);
        Some(Edges { e: [ex, ey, ez], g: [gx, gy, gz], s: [sx, sy, sz] })
    }
}

impl FanLeaf<'_> {
    /// Triangles of a leaf on the grid that the segment's line may meet.
    #[inline(always)]
    pub fn grid_flagged(&self, ray: &FanRay) -> Option<u32> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let first = lanes_below(self.shape.turn())?;
        let second = 6 * (self.shape.centres() - 1);
        let step = 2 * (self.shape.triangles() + 1).min(WIDTH + 1);
        let axes = ray.axes();
        let origin = axes.map(
            #[inline(always)]
            |axis| self.origin[axis % 3] as f32,
        );
        let centre = |at: usize| {
            let number = |k: usize| short(window, at + 2 * axes[k]) as f32 + origin[k];
            [number(0), number(1), number(2)]
        };
        let centres = CentreShadows::new(ray, [centre(0), centre(second)]);
        let mut flagged = 0;
        for (piece, first) in first.into_iter().enumerate() {
            let row = |k: usize, next: usize| {
                let at = 6 + second + step * axes[k] + 2 * next;
                numbers(window, at, piece) + Lanes::splat(origin[k])
            };
            let ring = RingLanes {
                here: [row(0, 0), row(1, 0), row(2, 0)],
                next: [row(0, 1), row(1, 1), row(2, 1)],
            };
            flagged |= ray_lanes(ray, &ring, centres.of_lanes(first)) << (LANES * piece);
        }
        Some(flagged & !(u32::MAX << self.shape.triangles()))
    }
}
