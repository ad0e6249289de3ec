//! How far two surfaces are apart.

use super::answer::{Ended, Interval};
use super::work::Work;

/// The distance of two surfaces, and where they are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct PairDistance {
    /// The least distance of the input meshes, input units. `0 ..= 0` if it is proved that they
    /// meet.
    pub distance: Interval,
    /// A point of each surface, the first mesh's first, both in the first mesh's frame and rounded
    /// to f32. They are at most `distance.upper` apart, up to this rounding. Of two triangles that
    /// pass through each other, both are one common point.
    pub points: [[f32; 3]; 2],
    /// The triangles of these points, by their numbers in the input files.
    pub triangles: [u32; 2],
    /// The work of the search: pairs of boxes as `bounds`, pairs of triangles bounded as
    /// `triangles`, pairs of triangles whose distance was computed in f64 as `exact`, nodes
    /// and pairs of nodes as `opened`.
    pub work: Work,
    /// Why the search ended. [`Ended::Resolution`]: the meshes are so far apart that their boxes
    /// answered.
    pub ended: Ended,
}

/// Where a model that moves first comes near another one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct PairContact {
    /// The part of the motion, from 0 to 1, before which the surfaces are proved to keep the
    /// distance. Infinite if they do during the whole motion.
    pub clear_until: f32,
    /// A point of each surface, nearest to each other at that time, in the frame of the first mesh:
    /// they may stop the motion. If it is clear, those of the last distance that was asked for.
    pub points: [[f32; 3]; 2],
    /// The triangles of these points, by their numbers in the input files.
    pub triangles: [u32; 2],
    /// The work of all distances, as in [`PairDistance::work`].
    pub work: Work,
    /// Why the search ended. [`Ended::Exact`]: the motion is clear. [`Ended::Resolution`]: at
    /// `clear_until` the surfaces are at the distance to keep, as far as surface errors and
    /// rounding tell, or 512 distances did not suffice.
    pub ended: Ended,
}

impl PairContact {
    /// Whether it is proved that the surfaces keep the distance during the whole motion.
    pub fn is_clear(&self) -> bool {
        self.clear_until == f32::INFINITY
    }
}
