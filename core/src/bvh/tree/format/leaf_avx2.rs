//! Leaves on the grid, read into registers of 256 bits.

use super::grid_ring::GRID_WINDOW;
use super::leaf::FanLeaf;
use super::leaf_lanes::LanePoint;
use super::leaf_shape::{SHAPE_OFFSETS, ShapeOffsets};
use crate::geom::fan::lanes_avx2::{ray_lanes, shadow_lanes};
use crate::geom::fan::{Edges, FanRay, LANES_BELOW, RingLanes, WIDTH};
use core::arch::x86_64::{
    __m128i, __m256, __m256i, _mm256_add_epi32, _mm256_add_ps, _mm256_cvtepi32_ps,
    _mm256_cvtepu16_epi32, _mm256_permutevar8x32_ps, _mm256_set1_epi32, _mm256_set1_ps,
    _mm256_sub_ps,
};
use wide::bytemuck::cast;

/// For each first triangle of the second fan, where the first coordinate of each triangle's centre
/// lies in a leaf.
const CENTRES: [[u32; WIDTH]; WIDTH + 1] = {
    let mut table = [[0; WIDTH]; WIDTH + 1];
    let mut turn = 0;
    while turn <= WIDTH {
        let mut lane = turn;
        while lane < WIDTH {
            table[turn][lane] = 3;
            lane += 1;
        }
        turn += 1;
    }
    table
};

impl FanLeaf<'_> {
    /// The triangles of a leaf on the grid as seen from a point, and ones in the lanes that hold
    /// triangles.
    #[target_feature(enable = "avx2")]
    #[inline]
    pub(crate) fn edges_avx2(&self, point: &LanePoint) -> Option<(Edges<__m256>, __m256)> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let ShapeOffsets { rings, turn, triangles } = SHAPE_OFFSETS[usize::from(self.shape.0)];
        let used = *LANES_BELOW.get(usize::from(triangles))?;
        let which: __m256i = cast(*CENTRES.get(usize::from(turn))?);
        // Masks and a limit that change no offset: they spare the check of each read.
        let [x, y, z] = rings.map(usize::from);
        let rings = [x & 15, y & 31, z.min(GRID_WINDOW - 18)];
        let centres = eight(window, 0);
        let p = point.p.to_array();
        let mut edges = Edges { e: [centres; 3], g: [centres; 3], s: [centres; 3] };
        for (axis, place) in [0, 1, 2].into_iter().enumerate() {
            let place = _mm256_add_epi32(which, _mm256_set1_epi32(place));
            let centre = _mm256_permutevar8x32_ps(centres, place);
            let [origin, ..] = point.origin[axis].to_array();
            edges.e[axis] = _mm256_sub_ps(eight(window, rings[axis]), centre);
            edges.g[axis] = _mm256_sub_ps(eight(window, rings[axis] + 2), centre);
            // The sum is exact, so this is the point less the centre, rounded once.
            let centre = _mm256_add_ps(centre, _mm256_set1_ps(origin));
            edges.s[axis] = _mm256_sub_ps(_mm256_set1_ps(p[axis]), centre);
        }
        Some((edges, cast(used)))
    }

    /// Triangles of a leaf on the grid that the segment's line may meet.
    #[target_feature(enable = "avx2")]
    #[inline]
    pub(crate) fn flagged_avx2(&self, ray: &FanRay) -> Option<u32> {
        let window = self.bytes.first_chunk::<GRID_WINDOW>()?;
        let ShapeOffsets { rings, turn, triangles } = SHAPE_OFFSETS[usize::from(self.shape.0)];
        let which: __m256i = cast(*CENTRES.get(usize::from(turn))?);
        let centres = eight(window, 0);
        let mut centre = [centres; 3];
        let mut ring = RingLanes { here: centre, next: centre };
        for (k, axis) in ray.axes().into_iter().enumerate() {
            let origin = _mm256_set1_ps(self.origin[axis % 3] as f32);
            let place = _mm256_add_epi32(which, _mm256_set1_epi32((axis as u32).cast_signed()));
            // A limit that changes no offset: it spares the check of each read.
            let at = usize::from(rings[axis % 3]).min(GRID_WINDOW - 18);
            centre[k] = _mm256_add_ps(_mm256_permutevar8x32_ps(centres, place), origin);
            ring.here[k] = _mm256_add_ps(eight(window, at), origin);
            ring.next[k] = _mm256_add_ps(eight(window, at + 2), origin);
        }
        let flagged = ray_lanes(ray, &ring, shadow_lanes(ray, centre));
        Some(flagged & !(u32::MAX << triangles))
    }
}

/// Eight numbers from a byte offset on.
#[target_feature(enable = "avx2")]
#[inline]
fn eight(window: &[u8; GRID_WINDOW], at: usize) -> __m256 {
    let bytes = window.get(at..).and_then(|bytes| bytes.first_chunk::<16>());
    let numbers: __m128i = cast(bytes.copied().unwrap_or_default());
    _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(numbers))
}
