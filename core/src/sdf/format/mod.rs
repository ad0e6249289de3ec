//! The bytes of the distance field.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes, limits and offsets of the section |
//! | `view` | the field where it lies |
//! | `check` | the check of `Sdf::open` |

mod check;
pub mod layout;
mod view;

pub use view::{Sdf, SdfHeader, SdfKind};
