//! The bytes of the curves.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes and limits of the section |
//! | `view` | the curves where they lie |
//! | `check` | the check of `Curve::open` |

mod check;
pub mod layout;
mod view;

pub use view::{Curve, CurveSegment, CurvesHeader, Zone};
pub(crate) use view::{Node, Run};
