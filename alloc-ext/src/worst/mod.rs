//! The query that costs most, or leaves the widest interval, found by hill climbing.
//!
//! A search proves nothing: a dearer query may exist. The caller who needs a bound sets
//! [`Budget::with_steps`](meshsweep_core::Budget::with_steps) and looks for the widest interval.
//!
//! | file | owns |
//! | --- | --- |
//! | `climb` | hill climbing in a box of numbers |
//! | `search` | the box and the seeds of points, balls and segments |
//! | `subject` | a question to a structure, and what its worst query costs |

mod climb;
mod search;
mod subject;

pub use climb::{Climb, Domain, Summit, climb};
pub use search::{Found, Goal, Worst};
pub use subject::{Question, Subject};
