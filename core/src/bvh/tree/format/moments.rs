//! The bytes of a node's moments.

use super::layout::MOMENTS_BYTES;
use glam::Vec3;

/// Moments of the triangles below a node, as they are stored. Integrals run over the area; n is the
/// unit normal and h the way from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeMoments {
    /// The centre of a ball that contains the triangles, grid units.
    pub centre: Vec3,
    /// The ball's radius, grid units.
    pub radius: f32,
    /// ∫ n, grid units².
    pub area: Vec3,
    /// The symmetric part of ∫ h nᵀ without its trace: xx, xy, xz, yy, yz. zz is −xx − yy. Grid
    /// units³.
    pub first: [f32; 5],
    /// Upper bound of 3·∫ |h|², grid units⁴.
    pub spread: f32,
    /// Upper bound of the error of `area`, and of three times that of `first` over the radius. Grid
    /// units².
    pub area_error: f32,
    /// Upper bound of the length of the edges along which the triangles end, grid units.
    pub boundary: f32,
}

/// Largest magnitude of a moment. With it no sum of a query overflows.
const MOST: f32 = (1u128 << 100) as f32;

impl NodeMoments {
    /// The record's numbers.
    pub(super) fn read(record: &[u8; MOMENTS_BYTES]) -> NodeMoments {
        let (words, _) = record.as_chunks::<4>();
        let mut numbers = [0f32; MOMENTS_BYTES / 4];
        numbers.iter_mut().zip(words).for_each(|(slot, word)| *slot = f32::from_le_bytes(*word));
        let [x, y, z, radius, ax, ay, az, xx, xy, xz, yy, yz, spread, area_error, boundary] =
            numbers;
        NodeMoments {
            centre: Vec3::new(x, y, z),
            radius,
            area: Vec3::new(ax, ay, az),
            first: [xx, xy, xz, yy, yz],
            spread,
            area_error,
            boundary,
        }
    }

    /// The record's bytes.
    pub fn write(&self) -> [u8; MOMENTS_BYTES] {
        let numbers = (self.centre.to_array().into_iter())
            .chain([self.radius])
            .chain(self.area.to_array())
            .chain(self.first)
            .chain([self.spread, self.area_error, self.boundary]);
        let mut record = [0; MOMENTS_BYTES];
        let (words, _) = record.as_chunks_mut::<4>();
        words.iter_mut().zip(numbers).for_each(|(word, x)| *word = x.to_le_bytes());
        record
    }

    /// Whether all numbers are finite and have the signs and sizes that a query needs.
    pub(super) fn is_sound(&self) -> bool {
        let small = |x: f32| x.abs() <= MOST;
        let bound = |x: f32| (0.0..=MOST).contains(&x);
        self.centre.to_array().into_iter().all(small)
            && self.area.to_array().into_iter().all(small)
            && self.first.into_iter().all(small)
            && [self.radius, self.spread, self.area_error, self.boundary].into_iter().all(bound)
    }
}
