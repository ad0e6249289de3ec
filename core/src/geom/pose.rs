//! A motion of one frame into another.

/// A motion: `rotation · p + translation`, each row of the matrix gives a coordinate.
///
/// It is taken as it is, in real arithmetic: if the matrix is a rotation up to rounding only, then
/// so is the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
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
