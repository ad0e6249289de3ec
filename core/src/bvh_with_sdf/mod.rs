//! A box tree and the distance field of the same mesh: the field is asked first.
//!
//! The field answers in one look-up, with an interval as wide as its cell. The tree searches, and
//! its interval is as narrow as its vertices allow. Most questions do not need the second: whether
//! a point keeps a distance, a distance to some percent, on which side a point is. So the tree is
//! asked only where the field's interval leaves the question open, and then the interval limits the
//! search.
//!
//! *What both must share.* Field and tree bound the distance to one mesh. One blob's field and tree
//! do: `meshsweep verify` proves both against the file.
//!
//! *What the field tells of the surface.* The tree's questions are about the surface. A field of
//! kind surface or signed bounds its distance everywhere. One of kind solid bounds it where the
//! lower end is above 0, which is outside; inside and next to the surface the tree answers.
//!
//! *What it spares.* B is a blob of `bracket.stl` with a box tree and a signed field of 16 KiB in
//! the tree layout: `meshsweep build fixtures/bracket.stl --for closest,sdf -o B`. Mean instructions of
//! a Cortex-M4F at points up to a tenth of the diagonal from the surface, by
//! `cargo xtask count --board "within B D" "within-both B D" "near B T" "near-both B T"
//! "bounds-both B T"`, D a part of the diagonal and T a tolerance:
//!
//! | question | box tree | field first |
//! | --- | --- | --- |
//! | within 1 / 2 / 5 % of the diagonal | 1,895 / 2,315 / 3,001 | 682 / 495 / 351 |
//! | closest point to 10 % / 1 % / exact | 7,075 / 8,045 / 9,317 | 5,848 / 6,276 / 7,398 |
//! | distance without a point to 10 % / 1 % | 7,075 / 8,045 | 3,357 / 6,098 |
//!
//! Where the field decides `within`, 240 instructions are the least. Where it does not, the
//! distance is nearly the one asked about, and the box tree searches as for a closest point.
//!
//! *Lost* (*historical*). A second look-up at a point towards or away from the surface decides one
//! such question in ten. The look-up inlined in the question saves 2 % on a Cortex-M4F and takes
//! more stack on a Cortex-M0.
//!
//! | file | owns |
//! | --- | --- |
//! | `pair` | the type, and what the field tells of the surface |
//! | `within` | is the surface within a distance of a point |
//! | `closest` | the closest point, and the side |
//! | `bounds` | intervals without a closest point, which the field may answer alone |
//! | `swept` | a sphere or a capsule, at rest or moving |

mod bounds;
mod closest;
mod pair;
mod swept;
mod within;

pub use bounds::{DistanceBounds, SignedBounds};
pub use pair::BvhWithSdf;
