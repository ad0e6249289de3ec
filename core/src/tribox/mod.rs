//! Triboxes: bounds of eighteen planes, after Crosnier & Rossignac, *Tribox bounds for
//! three-dimensional objects* (1999).
//!
//! A tribox is the intersection of nine slabs, along the axes and the diagonals of the coordinate
//! planes: a box whose twelve edges are chamfered. Its parameters are the least and greatest values
//! of the object's points along nine directions. The directions need no unit length, because values
//! are only compared along the same one. Uses: a first reject that is tighter than a box for three
//! times the comparisons, and a proxy that can be drawn.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `directions` | the nine directions |
//! | `bounds` | 18 parameters: of points, unions, intersections, translations; containment, overlap |
//! | `closure` | parameters that no other ones imply: the strong closure of octagons |
//! | `boundary` | faces, as loops of vertices, corner by corner |
//! | `snap` | planes moved outward until small faces vanish |
//! | `measure` | distance, segments |
//! | `moved` | bounds of rotated points |
//! | `support` | the extent of triboxes along any direction |
//! | `format/` | the bytes of the hierarchy |
//! | `separating_axes`, `separation` | two hierarchies, one of them moved |
//! | `distance` | a point or a segment against the hierarchy |
//! | `turned` | places and motions in the frame of turned triboxes |

mod boundary;
mod bounds;
mod closure;
mod directions;
mod distance;
pub mod format;
mod measure;
mod moved;
mod separating_axes;
mod separation;
mod snap;
mod support;
mod turned;

pub use boundary::{Boundary, BoundaryOf, LOOP, Scalar, VERTICES, boundary};
pub use bounds::{Tribox, TriboxError};
pub use directions::{DIRECTIONS, FACES, SLABS};
pub use distance::TriboxBound;
pub use format::{TriboxLevel, Triboxes};
pub use separation::{NodePair, Separation, TriboxCandidates};
