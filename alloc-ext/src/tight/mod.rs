//! Tight hulls: outer hulls of few faces, shrunk onto the original triangles and proved to enclose
//! them; and chains of such hulls as a section of a blob.
//!
//! ```text
//! mesh ─ initial ─ search ─┬─ Hull ─ store ─ section
//!                  moves ──┤
//!                  proof ──┘
//! ```
//!
//! | folder or file | what lies there |
//! | --- | --- |
//! | `hull.rs` | [`wrap()`]: options checked, hull built, hull measured |
//! | `outset.rs` | a hull of another kind, moved outward to hold all points near the mesh |
//! | `options.rs` | the goal and the options of a hull |
//! | `report.rs` | measures of a hull and of the work for it |
//! | `deadline.rs` | when a search has to end |
//! | `unmet.rs` | whether a hull is as tight as asked for |
//! | `shared_map.rs` | maps that searches on several threads share |
//! | `components.rs` | splits a mesh into the components that get a hull each |
//! | `initial/` | the first hull: a progressive level, a voxel closure, or the grown bounding box |
//! | `moves/` | local edits of a hull: vertex placement, collapse, flip, split, kick |
//! | `proof/` | exact predicates, distances, enclosure: whether an edit keeps the invariant |
//! | `search/` | which initial hull and which edits reach the goal: faces, void or slack |
//! | `store/` | a chain of hulls, certified distances, and the bytes of the section |
//!
//! Each folder or file uses only those to its left: `proof ← moves ← initial ← search ← hull.rs ←
//! store`.
//!
//! # What holds of every [`Hull`], exactly, for its coordinates as stored
//! - The hull is a closed manifold. Its faces share no points but common corners and edges, and
//!   face outwards.
//! - The hull has no point in common with any triangle of the mesh. Touching counts.
//! - Every vertex of the mesh is inside.
//! - With a margin, no point of the hull is within the margin of the mesh. This is proved in
//!   floating point with bounded rounding; see `proof/clearance.rs`. Every point within the margin
//!   of the mesh is therefore inside.
//!
//! The initial hull is tested as a whole. After that, a move is made only if exact predicates prove
//! that the invariant still holds. Floating point alone decides only which moves are tried.
//!
//! Unlike a level of the hull hierarchy, a tight hull does not enclose other tight hulls, and has
//! no cavities. The mesh may be open, cross itself, or be a heap of loose triangles.
//!
//! The initial hull and its linear program follow Platis & Theoharis 2003. The shrinking is our
//! own.

mod components;
mod deadline;
mod hull;
mod initial;
mod moves;
mod options;
mod outset;
mod proof;
mod report;
mod search;
mod shared_map;
mod store;
mod unmet;

pub use crate::error::{Tightness, Unmet};
pub use components::split_components;
pub use hull::{Hull, wrap};
pub use options::{FACES, Goal, Options};
pub use outset::outset;
pub use report::{Outcome, Report, Start, margin_note, no_void_note, rounded_note};
pub use store::{ChainOptions, Distances, HullReport, MAX_HULLS, build, cut, distances, hull_mesh};
