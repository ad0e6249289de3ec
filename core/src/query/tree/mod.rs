//! Questions to the box tree.

mod aim;
mod all_within;
mod batch;
mod closest;
mod cull;
mod follow;
mod front;
mod interval;
mod leaf;
mod nearest;
mod overlap;
mod plane;
mod probe;
mod pseudonormal;
mod ranked;
mod segment;
mod session;
mod shape;
mod signed;
mod walk;
mod within;

pub use crate::geom::Contact;
pub use all_within::{AllWithin, all_within};
pub use batch::{BatchError, closest_points};
pub use closest::{Hint, closest_point, closest_point_from};
pub use cull::{FrontFacing, Sight, front_facing};
pub use nearest::{Nearest, nearest};
pub use overlap::{Overlap, Overlaps, PairEntry, TrianglePair, all_overlaps, overlap};
pub use ranked::Neighbor;
pub use segment::{AnyHit, Facing, all_hits, any_hit, first_hit};
pub use session::{CoherentClosest, CoherentQuery};
pub use signed::{Side, SignedDistance, signed_distance};
pub use walk::ScratchEntry;
pub use within::{Verdict, Within, is_within};
