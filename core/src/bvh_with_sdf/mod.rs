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
//! *What it spares.* On `bracket.stl` with a signed field of 16 KiB, a lattice about 0.6 % of the
//! diagonal wide, at points up to a tenth of the diagonal from the surface, a Cortex-M4F takes in
//! mean (`cargo xtask count --board "within B 0.02" "within-both B 0.02" "near B 0.01" "near-both B
//! 0.01" "bounds-both B 0.01"` of that blob B):
//!
//! | question | tree | field first |
//! | --- | --- | --- |
//! | within 1 / 2 / 5 % of the diagonal | 1,896 / 2,315 / 3,001 | 1,077 / 738 / 346 |
//! | closest point to 10 % / 1 % / exact | 7,076 / 8,044 / 9,315 | 5,831 / 6,343 / 7,509 |
//! | distance without a point to 10 % / 1 % | 7,076 / 8,044 | 4,719 / 6,381 |
//!
//! *Historical*: since then `within` compares whole units. With a tree of 16 KiB, at 2 % of the
//! diagonal, it takes 489 in place of 509, and on a Cortex-M0 2,746 in place of 3,450. *Lost*: a
//! second look-up where the first is open, at a point towards or away from the surface. It decides
//! one question in ten.
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
