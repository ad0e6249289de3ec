//! Questions about a point.
//!
//! | question | file |
//! | --- | --- |
//! | the closest point | `closest_point` |
//! | the closest point, its candidates measured in f64 | `closest_point_precise` |
//! | whether the surface is within a distance, and all triangles that are | `within`, `all_within` |
//! | the nearest triangles | `nearest` |
//! | on which side of a closed mesh a point lies | `side/` |
//! | the closest point of a query that moves | `coherent/` |
//! | triangles that may face an eye | `front_facing` |
//!
//! | file | what the questions share |
//! | --- | --- |
//! | `query` | a point in grid units, ready for the descent, or far: `Asked` has a case for each |
//! | `far_point` | the closest point of a point so far away that the model's box answers |
//! | `leaf/` | a point and the triangles of a leaf |
//! | `search/` | the search of a closest point |
//! | `triangle_visitor` | the visitor of questions that look at triangles one by one |
//! | `neighbors` | the heap of nearest triangles in the caller's slice |
//! | `hint` | the leaf that one query leaves to the next |

mod all_within;
mod closest_point;
mod closest_point_precise;
mod coherent;
mod far_point;
mod front_facing;
pub(super) mod hint;
pub(super) mod leaf;
mod nearest;
mod neighbors;
pub(super) mod query;
pub(super) mod search;
mod side;
mod triangle_visitor;
mod within;

pub use coherent::{CoherentClosest, CoherentQuery};
pub use front_facing::{Eye, FrontFacing};
pub use hint::Hint;
pub use neighbors::Neighbor;
