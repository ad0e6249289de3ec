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
//! *Where instructions go* (*historical*, Cortex-M4F, `opt-level = 3`, 20 faces of the bracket, by
//! function). A closest point beyond the box takes 4,100: 2,800 in its 2.7 leaves, where 13 faces
//! are looked at and 8.5 computed; 480 for the boxes; 140 for each plane that leaves out a leaf's
//! faces; 150 to prepare; 400 for the answer. A signed distance took 10,800: 10 faces a second
//! time, 4 as slivers, and a look at the corner that faces share. The ray takes a thousand in its
//! place.
//!
//! | means of the suite's places | 20 faces | 160 | 200 |
//! | --- | --- | --- | --- |
//! | closest point, far: before, now | 4,974, 4,736 | 6,410, 6,320 | 6,844, 6,780 |
//! | the same near the hull | 11,279, 8,013 | 9,949, 8,840 | 10,959, 10,000 |
//! | the costliest of these | 73,000, 13,520 | 140,680, 18,520 | 100,040, 19,200 |
//! | within a distance | 2,337, 1,769 | 2,343, 1,254 | 2,616, 1,243 |
//!
//! *Lost* (*historical*, Cortex-M4F, 1,000 places each). A table beside the hull: a ball for each
//! leaf and a plane in bytes for each face, which leave faces out in integers. Of 20 faces it took
//! 20 to 60 % off (bracket, far: 5,148 to 4,044 instructions; within a fiftieth of the diagonal:
//! 2,176 to 1,090). The dearest places got a quarter to a half dearer, because the tree decides
//! there after the table; 200 faces got 12 % dearer; and a quarter of the hull's bytes came on top.
//! A distance field answers by one look-up, in a lattice in 200 instructions.
//!
//! Also lost: the ray past every leaf, without boxes (160 faces, near: 11,395, and 9,843 with the
//! leaf's corners told apart by sign bits); the plane of the final limit before faces of a leaf are
//! looked at again (signed distance of 160 faces −1 %, of the bracket's tree +3.5 %). A hull
//! without boxes for segments pays for the ray past every leaf: of 150 faces, 6 % more near the
//! hull than a signed distance took, and 20 % less for `within`.

mod closest_point;
mod crossings;
pub mod format;
mod side;
mod within;

pub use format::{TightHull, TightHulls, TightRecord};
