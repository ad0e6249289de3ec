//! Tight hulls: hulls of few triangles in place of a mesh.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: the table of hulls, the distances of faces, the check of [`TightHulls::open`] |
//! | `closest_point` | the distance of the mesh by its hull |
//! | `within` | whether the mesh is within a distance |
//! | `side` | whether a point is certainly outside a hull |
//! | `crossings` | the same within the hull's box, by the faces that a ray crosses |
//!
//! *The interval.* Let H be the hull, P the mesh, p the point. If p is outside H, every way from p
//! to P crosses H: |p P| ≥ |p H|. Wherever p is, a way to P may be continued to H: |p P| ≥ |p H| −
//! depth. With q the point of face f that is closest to p, |p P| ≤ |p q| + |q P| ≤ |p H| + slack of
//! f. All three take the box tree's interval of |p H|, which holds for the hull as it was proved to
//! enclose the mesh, and round outward (`core/docs/rounding.md` §12).
//!
//! *The side.* A point outside the box of the hull's tree is outside if it is farther from the hull
//! than storing moved it. Elsewhere the faces that a ray crosses decide. A point that is as near to
//! the hull as rounding of the ray's end counts as inside.
//!
//! *Lost* (*historical*, Cortex-M4F, 1,000 places each). A table beside the hull: a ball for each
//! leaf and a plane in bytes for each face, which leave faces out in integers. Of 20 faces it took
//! 20 to 60 % off (bracket, far: 5,148 to 4,044 instructions; within a fiftieth of the diagonal:
//! 2,176 to 1,090). The dearest places got a quarter to a half dearer, because the tree decides
//! there after the table; 200 faces got 12 % dearer; and a quarter of the hull's bytes came on top.
//! A distance field answers in 200 instructions.

mod closest_point;
mod crossings;
pub mod format;
mod side;
mod within;

pub use format::{TightHull, TightHulls, TightRecord};
