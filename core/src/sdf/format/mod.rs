//! The bytes of the distance field.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes, limits and offsets of the section |
//! | `view` | the field where it lies |
//! | `check` | the check of `Sdf::open` |
//! | `shape` | the check of a tree's entries |

mod check;
pub mod layout;
mod shape;
mod view;

pub use view::{Sdf, SdfHeader, SdfKind, SdfLayout};
