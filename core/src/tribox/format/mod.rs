//! The bytes of the tribox hierarchy.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and limits of the section |
//! | `view` | the hierarchy where it lies |
//! | `check` | the check of `Triboxes::open` |

mod check;
pub mod layout;
mod view;

pub use view::{TriboxLevel, Triboxes, TriboxesHeader};
