//! The bytes of the tight hulls.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and flags of the section |
//! | `view` | the hulls where they lie |
//! | `check` | the check of `TightHulls::open` |

mod check;
pub mod layout;
mod view;

pub use view::{TightHull, TightHulls, TightRecord};
