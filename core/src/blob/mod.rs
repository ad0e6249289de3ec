//! The format: the only place that reads bytes. `core/FORMAT.md` says what they are,
//! `core/DESIGN.md` why.

mod check;
mod error;
mod header;
mod index;
pub mod layout;
mod model;
mod open;
mod patch;
mod read;
mod sections;
mod tight;
mod tight_open;
mod tree;
mod tree_header;
mod tree_open;
mod triboxes;
mod triboxes_open;

pub use error::OpenError;
pub use header::Header;
pub use index::{NodeIdx, SplitIdx, TriIdx, VertIdx};
pub use model::{Capacities, Children, Level, Model, Node, Split};
pub use patch::{CORNERS, FanLeaf, GridRing, LeafShape};
pub use sections::{Section, section_crc};
pub use tight::{TightHull, TightHulls, TightRecord};
pub use tree::{Bvh, BvhChild, Links};
pub use tree_header::BvhHeader;
pub use triboxes::{TriboxLevel, Triboxes, TriboxesHeader};
