//! What a proof of a box tree counts.

/// What was proved, in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TreeProof {
    /// Triangles found in the mesh, each once.
    pub triangles: usize,
    /// Vertices of the leaves.
    pub vertices: usize,
    /// Corners whose distance from the input's `f64` could not compare with the surface error.
    pub exact_corners: usize,
    /// Frames that make no distance longer.
    pub frames: usize,
    /// Coordinates of vertices found between two planes of a box above them.
    pub contained: usize,
    /// Of these, the ones that `f64` could not decide.
    pub exact_contained: usize,
    /// Nodes whose moments are those of their triangles.
    pub moments: usize,
    /// Leaves whose normals lie in the leaf's cone.
    pub cones: usize,
    /// Nodes.
    pub nodes: usize,
}
