//! A motion of one frame into another.

use super::vector::Point;

/// A motion: `rotation · p + translation`. Each row of the matrix gives a coordinate.
///
/// The numbers are taken as they are, in real arithmetic. If the matrix is a rotation up to
/// rounding, the motion is rigid up to the same rounding. Questions about two models refuse a
/// matrix that is no rotation, unless [`is_affine`](Self::is_affine) says that it may be any. So a
/// pose that nobody filled in is no answer "clear".
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pose {
    /// Rows of the matrix. Entries are at most 1, up to rounding; of an affine one at most 2.
    pub rotation: [[f32; 3]; 3],
    /// Added to the rotated point.
    pub translation: [f32; 3],
    /// The matrix may scale, mirror or shear: see [`affine`](Self::affine). If false, it
    /// must be a rotation up to rounding: the sizes of the entries of each row of `RRᵀ − 1` add up
    /// to at most 0.003, as they do in matrices of three decimals, and it is no mirror.
    pub is_affine: bool,
}

impl Pose {
    /// No motion.
    pub const IDENTITY: Pose =
        Pose::rigid([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]);

    /// A rotation, by its rows, and then a translation. Nothing is checked before a question.
    pub const fn rigid(rotation: [[f32; 3]; 3], translation: [f32; 3]) -> Pose {
        Pose { rotation, translation, is_affine: false }
    }

    /// Any matrix, by its rows, and then a translation: one that scales, mirrors or shears. The
    /// questions say which matrices they take.
    pub const fn affine(matrix: [[f32; 3]; 3], translation: [f32; 3]) -> Pose {
        Pose { rotation: matrix, translation, is_affine: true }
    }

    /// Rows and translation in f64.
    #[inline(always)]
    pub(crate) fn wide(&self) -> ([Point<f64>; 3], Point<f64>) {
        (self.rotation.map(|row| row.map(f64::from)), self.translation.map(f64::from))
    }
}
