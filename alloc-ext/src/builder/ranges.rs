//! The ranges of the builder's numbers. The program's arguments have the same.

/// Faces of a base hull.
pub const BASE_FACES: [u32; 2] = [4, u32::MAX];
/// Triboxes of a blob. More take too long.
pub const TRIBOX_COUNT: [u32; 2] = [1, 4096];
/// Faces of a stored tight hull.
pub const TIGHT_FACES: [u32; 2] = [4, 1_000_000];
/// Bytes of a distance field.
pub const SDF_BYTES: [u32; 2] = [256, 1 << 18];
/// The factor of the time to polish.
pub const EFFORT: [f64; 2] = [0.0, 1e6];
/// Edges of a hull vertex.
pub const MAX_VALENCE: [u32; 2] = [3, 255];
/// The ratio of a star's worst compactness after a collapse to that before it.
pub const COMPACTNESS: [f64; 2] = [0.0, 1.0];
/// The change of a face's normal in a collapse, in degrees.
pub const NORMAL_DEVIATION: [f64; 2] = [0.0, 180.0];
