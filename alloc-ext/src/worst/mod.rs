//! The query that costs most, or leaves the widest interval, found by hill climbing.
//!
//! A search proves nothing: a costlier query may exist. The caller who needs a bound sets
//! [`Budget::with_steps`](meshsweep_core::Budget::with_steps) and looks for the widest interval.
//!
//! | file | owns |
//! | --- | --- |
//! | `climb` | hill climbing in a box of numbers |
//! | `goal` | what a search maximises, its result, the call of the climb |
//! | `search` | the box and the seeds of points, balls and segments |
//! | `subject` | a question to a structure, and what its worst query costs |
//! | `pair` | the same of two models: the worst pose |

mod climb;
mod goal;
mod pair;
mod search;
mod subject;

pub use climb::{Climb, Domain, Summit, climb};
pub use goal::{Found, Goal, Worst};
pub use pair::{Pair, PairQuestion};
pub use subject::{Question, Subject};
