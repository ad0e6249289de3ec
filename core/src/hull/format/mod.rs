//! The bytes of the hull hierarchy.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and limits of the sections |
//! | `index` | one type for each kind of index |
//! | `view` | the tables where they lie |
//! | `check` | the check of `Hull::open` |

mod check;
mod index;
pub mod layout;
mod view;

pub use index::{NodeIdx, SplitIdx, TriIdx, VertIdx};
pub use view::{Children, Hull, Level, Node, Split};
