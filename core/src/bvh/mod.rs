//! The box tree ([`Bvh`]): an index of triangles that answers distances, sides, segments and
//! overlaps. Each node has up to eight children, each of which is a node or a leaf of one or two
//! fans.
//!
//! | room | what lies there |
//! | --- | --- |
//! | `tree/` | what all questions stand on: the bytes, the box tests, the descent, places of triangles |
//! | `point/` | questions about a point: the closest, within, nearest, signed, coherent |
//! | `segment/` | questions about a segment: the first hit, any, all |
//! | `pair/` | two models, one of them moved: overlap, distance, contact, penetration |
//! | `solid/` | a convex solid, at rest or moving |
//! | `winding/` | the winding number about a point, of a mesh that need not be closed |
//! | `scene` | a few dozen models, each moved |
//! | `coherent_scene` | the same, moved a little from one question to the next |
//! | `processor/` | questions compiled for the instructions of one processor |
//!
//! Each room's `mod.rs` lists its files. A question's file holds its public method; what
//! several questions need lies beside them.
//!
//! Two numbers lead to a triangle from its node: `child` is the number of the leaf among the node's
//! children, `lane` the number of the triangle in the leaf.
//!
//! A tree is *unchecked* if its view does not fit its bytes. No view that `open` returned is. So a
//! function that reads the bytes returns `None`, or
//! [`QueryError::Unchecked`](crate::QueryError::Unchecked), instead of a panic.
//!
//! A new question is a file in its room: an `impl Bvh` with its method, its answer type, and one of
//! these:
//!
//! | the question looks at | it implements | short example |
//! | --- | --- | --- |
//! | triangles, by their distance from a point | `point::triangle_visitor::TriangleCollector` | `point/all_within` |
//! | triangles that a segment meets | `segment::leaf::CrossingCollector` | `segment/any_hit` |
//! | leaves as a whole | `tree::descent::LeafVisitor` | `solid/leaf_search` |
//!
//! `core/docs/guide.md` lists the other places.

mod coherent_scene;
mod pair;
mod point;
mod processor;
mod scene;
mod segment;
mod solid;
pub mod tree;
mod winding;

pub use coherent_scene::{CoherentScene, ErasedScene, KeptPair, ModelPath, RememberedPair};
pub use pair::{CoherentPair, MovingModel, PlacedModel};
pub use point::{CoherentClosest, CoherentQuery, Eye, FrontFacing, Hint, Neighbor};
pub use processor::ProcessorQuestions;
pub use scene::{Scene, SceneDistance};
pub use segment::Facing;
pub use tree::format::Bvh;
pub use winding::WindingNumber;
