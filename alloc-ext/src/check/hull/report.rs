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
    /// Triangles of the levels' hulls that are as near the surface as the level table says.
    pub level_triangles: usize,
    /// Levels of which that could not be decided.
    pub undecided_levels: usize,
}
