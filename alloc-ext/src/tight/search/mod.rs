//! Searches for a goal: which initial hull, and which edits in which order.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `faces.rs` | the best hull with a given number of faces |
//! | `fewest.rs` | the fewest faces for a void or for a slack |

pub(crate) mod faces;
mod fewest;
