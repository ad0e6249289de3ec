//! The distance field: bounds of the distance from a point, by one look-up in a lattice.
//!
//! | where | what lies there |
//! | --- | --- |
//! | `format/` | the bytes: header, codes of the corners, errors of the cells, the check of opening |
//! | `place` | from a point to a cell and a place within it |
//! | `value` | the interval at a place, in integers, and the gradient |
//! | `distance` | the questions in input units |
//! | `units` | the questions in whole units, for processors without floating point |

mod distance;
pub mod format;
mod place;
mod units;
mod value;

pub use distance::FieldDistance;
pub use format::{Sdf, SdfKind};
pub use units::UnitDistance;
