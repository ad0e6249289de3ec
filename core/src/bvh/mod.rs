//! The box tree ([`Bvh`]): an index of triangles that answers distances, sides, segments and
//! overlaps. Each node has up to eight children, each of which is a node or a leaf of one or two
//! fans.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: header, nodes, leaves, the check of [`Bvh::open`] |
//! | `node/` | the box tests: eight boxes at a time |
//! | `point_query`, `segment_query` | a point or a segment in grid units, ready for the descent |
//! | `segment_start` | where a segment's line begins |
//! | `model_box/` | a segment against the model's box |
//! | `descent` | the descent of one tree, for a point, a segment or a solid |
//! | `block_walk`, `point_blocks`, `segment_blocks`, `prefetch` | that of exact answers, on targets with vector registers |
//! | `processor_questions`, `avx2` | questions compiled for the instructions of one processor |
//! | `leaf_distance`, `leaf_limit`, `triangle_bounds` | a point and the triangles of a leaf |
//! | `leaf_plane` | without floating point: a plane behind which no triangle counts |
//! | `whole_leaf` | without floating point: a leaf in integers, f32 only for what may be the nearest |
//! | `leaf_squares` | without floating point: distances of triangles that are looked at again |
//! | `triangle_place` | where a triangle lies, in one word |
//! | `triangle_visitor` | the visitor of point questions that look at triangles one by one |
//! | `segment_leaf` | a segment and the triangles of a leaf; the visitor of segment questions |
//! | `closest_point`, `closest_points` | one closest point, many of them |
//! | `nearest_search`, `hint` | the search of a closest point, in any order of leaves; the leaf that one query leaves to the next |
//! | `waiting`, `waiting_search` | the same search where f32 has no instructions: triangles wait for the kernel |
//! | `far_point` | a point so far away that the model's box answers |
//! | `closest_point_precise` | the closest point, its candidates measured in f64 |
//! | `within`, `all_within`, `nearest` | distance verdicts, and the nearest triangles |
//! | `neighbors` | the heap of nearest triangles in the caller's slice |
//! | `signed_distance`, `side_survey`, `side_search`, `viewed_side`, `pseudonormal` | on which side of a closed mesh a point lies |
//! | `winding/` | the winding number about a point, of a mesh that need not be closed |
//! | `first_hit`, `any_hit`, `all_hits` | segments |
//! | `front_facing` | triangles that may face an eye |
//! | `overlap/` | two trees, one of them moved |
//! | `penetration/` | two solids, one of them moved: how deep they are in each other |
//! | `solid/` | a convex solid, at rest or moving |
//! | `scene/` | a few dozen models, each moved |
//! | `input_box` | a box that holds the input's vertices |
//! | `stored_lengths` | from distances of stored surfaces to those of the input |
//! | `coherent/` | a query that moves |
//!
//! Two numbers lead to a triangle from its node: `child` is the number of the leaf among the node's
//! children, `lane` the number of the triangle in the leaf.
//!
//! A tree is *unchecked* if its view does not fit its bytes. No view that `open` returned is. So a
//! function that reads the bytes returns `None`, or
//! [`QueryError::Unchecked`](crate::QueryError::Unchecked), instead of a panic.
//!
//! A new question is a file here: an `impl Bvh` with its method, its answer type, and one of these:
//!
//! | the question looks at | it implements | short example |
//! | --- | --- | --- |
//! | triangles, by their distance from a point | `triangle_visitor::TriangleCollector` | `all_within` |
//! | triangles that a segment meets | `segment_leaf::CrossingCollector` | `any_hit` |
//! | leaves as a whole | `descent::LeafVisitor` | `closest_point` |
//!
//! `core/docs/guide.md` lists the other places.

mod all_hits;
mod all_within;
mod any_hit;
#[cfg(meshsweep_avx2)]
mod avx2;
#[cfg(meshsweep_wide)]
mod block_walk;
mod closest_point;
mod closest_point_precise;
mod closest_points;
mod coherent;
mod descent;
mod far_point;
mod first_hit;
pub mod format;
mod front_facing;
mod hint;
mod input_box;
mod leaf_distance;
mod leaf_limit;
mod leaf_nearest;
mod leaf_plane;
mod leaf_squares;
mod model_box;
mod nearest;
mod nearest_search;
mod neighbors;
pub mod node;
mod overlap;
mod penetration;
#[cfg(meshsweep_wide)]
mod point_blocks;
mod point_query;
#[cfg(meshsweep_wide)]
mod prefetch;
mod processor_questions;
mod pseudonormal;
mod scene;
#[cfg(meshsweep_wide)]
mod segment_blocks;
mod segment_leaf;
mod segment_query;
mod segment_start;
mod side_search;
mod side_survey;
mod signed_distance;
mod solid;
mod stored_lengths;
mod triangle_bounds;
mod triangle_place;
mod triangle_visitor;
mod viewed_side;
#[cfg(not(meshsweep_wide))]
mod waiting;
#[cfg(not(meshsweep_wide))]
mod waiting_search;
#[cfg(not(meshsweep_wide))]
mod whole_leaf;
mod winding;
mod within;

pub use all_within::AllWithin;
pub use any_hit::AnyHit;
pub use coherent::{CoherentClosest, CoherentQuery};
pub use format::Bvh;
pub use front_facing::{Eye, FrontFacing};
pub use hint::Hint;
pub use nearest::KNearest;
pub use neighbors::Neighbor;
pub use overlap::CoherentPair;
pub use processor_questions::ProcessorQuestions;
pub use scene::{Placed, Scene, SceneDistance, SceneWithin};
pub use segment_leaf::Facing;
pub use signed_distance::SignedDistance;
pub use winding::WindingNumber;
pub use within::Within;
