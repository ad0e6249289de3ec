//! The bytes of the hull hierarchy.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and limits of the sections |
//! | `instance` | numbers of the triangles of all levels |
//! | `index` | one type for each kind of index |
//! | `view` | the tables where they lie |
//! | `deform` | numbers of vertices and key frames, for hulls that deform |
//! | `check` | the check of `Hull::open` |

mod check;
mod deform;
mod index;
mod instance;
pub mod layout;
mod view;

pub use deform::DeformableHull;
pub(crate) use deform::Key;
pub use index::{SplitIdx, TriIdx, VertIdx};
pub use instance::{Instance, Named};
pub use view::{Hull, HullLevel, Split};
