//! The bytes of the tight hulls.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and flags of the section |
//! | `view` | the hulls where they lie |
//! | `check` | what `TightHulls::open` makes sure of |

mod check;
pub mod layout;
mod view;

pub use view::{TightHull, TightHulls, TightRecord};
