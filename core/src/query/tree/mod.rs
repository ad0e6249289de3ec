//! Questions to the box tree.

mod closest;
mod probe;
mod walk;

pub use closest::{Hint, closest_point, closest_point_from};
pub use walk::TreeEntry;
