//! What a proof of a hull hierarchy counts.

/// What was proved, in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckReport {
    /// Splits replayed.
    pub splits: usize,
    /// Planes that a replaced vertex was found to lie on or outside.
    pub planes: usize,
    /// Of these, the ones that `f64` could not decide.
    pub exact_planes: usize,
    /// Triangles of the finest mesh.
    pub triangles: usize,
    /// Pairs of a triangle of any level and a vertex of the surface that it stands for.
    pub covered: usize,
    /// Pairs of a triangle and a vertex that were followed through all key frames.
    pub key_pairs: usize,
    /// Points of the levels' hulls whose distance to the surface was measured.
    pub samples: usize,
}
