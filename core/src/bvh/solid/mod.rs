//! A convex solid and a box tree: how far apart they are, and where a solid that moves first meets
//! the surface.
//!
//! | file | owns |
//! | --- | --- |
//! | `placed_solid` | the solid in the tree's units: its corners, its extent along six directions |
//! | `box_keys` | lower bounds of its distance from the boxes of a node |
//! | `leaf_search` | its distance from the triangles of a leaf |
//! | `solid_distance`, `solid_within` | the two questions about a solid at rest |
//! | `first_contact` | the question about a solid that moves |

mod box_keys;
mod first_contact;
mod leaf_search;
mod placed_solid;
mod solid_distance;
mod solid_within;
