//! Whether and where the surfaces of two models meet.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | the two questions |
//! | `descent` | the descent of both trees |

mod descent;
mod query;
