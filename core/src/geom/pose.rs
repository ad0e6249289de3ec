//! A motion of one frame into another.

/// A motion: `rotation · p + translation`. Each row of the matrix gives a coordinate.
///
/// The numbers are taken as they are, in real arithmetic. If the matrix is a rotation up to
/// rounding, the motion is rigid up to the same rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pose {
    /// Rows of the matrix; entries of at most 1, up to rounding.
    pub rotation: [[f32; 3]; 3],
    /// Added to the rotated point.
    pub translation: [f32; 3],
}

impl Pose {
    /// No motion.
    pub const IDENTITY: Pose = Pose {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };
}
