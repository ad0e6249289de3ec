//! Hierarchical triboxes: a mesh as unions of 1, 2, 4, … triboxes that hold it (Crosnier &
//! Rossignac 1999, section 4).
//!
//! ```text
//! polygons, winding   the surface in a cell, clipped; points inside the solid
//! cell                a cell's tribox, and its parts on both sides of a plane
//! choose, extrema     the plane of a split
//! split               the tree: the cell of the greatest gain is split first
//! level               unions as levels of detail: faces, volume, error, distance
//! surface             their triangles
//! orient, grown       the orientation of least volume or area, and the better of two splits
//! gain                what an option changed
//! lattice, store      the same on a blob's grid, and the section's bytes
//! ```
//!
//! Triangles are cut at the planes of cells, so triboxes of a level do not overlap. If the mesh is
//! closed they hold its inside too.
//!
//! *Planes.* Void beside the solid in %, at 8 / 64 triboxes, by `SplitOptions` with these values
//! and no least gain. Historical: no command sets them. A test of this folder keeps the order.
//!
//! | measure, planes | rocker arm | cow | fandisk | `fixtures/torus.ply` |
//! | --- | --- | --- | --- | --- |
//! | area, thickest slab (the paper's) | 135.1 / 135.1 | 103.7 / 103.7 | 79.5 / 79.5 | 32.6 / 31.4 |
//! | area, nine directions | 143.7 / 143.7 | 141.6 / 141.6 | 89.5 / 89.5 | 62.0 / 62.0 |
//! | volume, thickest slab | 117.5 / 52.2 | 79.1 / 28.6 | 59.8 / 32.6 | 32.6 / 18.9 |
//! | volume, nine directions: the default | 76.4 / 22.5 | 54.9 / 15.7 | 33.0 / 8.4 | 29.5 / 10.7 |
//!
//! Volume never grows when a cell is split. Area mostly does, for the plane is new area on both
//! sides. The least loss of area is a thin slice off an end, and its slices are sliced again. Under
//! the paper's own stop rule (area, with a least gain) rocker arm is not split at all. Area is the
//! measure of flat meshes only.
//!
//! *Extrema.* Planes just beyond local extrema, beside the even ones ([`Planes::Extrema`]), cut
//! steps off exactly: `fixtures/groove.obj` has 0.03 % void with 6 triboxes in place of 16. Void at
//! 8 / 64 triboxes is 14.6 / 6.4 % on a robot's forearm, 32.5 / 8.3 on fandisk, 76.5 / 21.9 on
//! rocker arm, in place of 15.0 / 6.8, 33.0 / 8.5 and 76.5 / 22.6 (`build --for triboxes
//! --extrema`). Parts without steps gain nothing: horse 17.8 for 17.2 at 64. Extrema alone leave
//! 43.4 % on rocker arm, 23 even planes 23.5 (both historical).
//!
//! *Foresight.* No single plane shows a hole: halves of a ring have most of the ring's hull. Where
//! the best plane saves less than 5 %, the splits of both parts are tried too. Without foresight 64
//! triboxes have 39.5 % void (torus), 39.0 (rocker arm), 5.6 (`fixtures/bracket.stl`) in
//! place of 10.7, 22.5 and 0.3. Three planes a direction in place of seven, looking ahead at 3 %:
//! 25.8 (rocker arm; seven: 24.8), 18.0 (cow; 15.4).

mod cell;
mod choose;
mod excess;
mod extent;
mod extrema;
mod gain;
mod grown;
mod lattice;
mod level;
mod orient;
mod polygons;
mod span;
mod split;
mod store;
mod surface;
#[cfg(test)]
mod tests;
mod union;
mod winding;

pub use crate::bvh::exact_blob as box_tree;
pub use choose::{Measure, Planes};
pub use extent::Extent;
pub use gain::{Gain, Total};
pub use grown::Grown;
pub use lattice::Lattice;
pub use level::{Level, level, proxies};
pub use orient::Turn;
pub use split::{Hierarchy, Node, Split, SplitOptions};
pub use store::{TriboxOptions, TriboxReport, build, cut, volume};
pub use surface::surface;
