//! A hull hierarchy and another one, or a triangle: whether their surfaces meet, and where.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | the questions and their answers |
//! | `model` | one of the two: a hull hierarchy, or a triangle |
//! | `places` | the corners of both in one frame, and what rounding leaves open |
//! | `descent` | the refinement of both where they meet |

mod descent;
mod model;
mod places;
pub(super) mod query;
