//! The search for the nearest pair of triangles of two models.
//!
//! | file | owns |
//! | --- | --- |
//! | `nearest_first` | the descent of both trees, nearest pair first |
//! | `leaf_gaps` | the distances of the triangles of two leaves |
//! | `int_pair_direction` | leaves along a direction in integers |
//! | `nearest_along` | leaves that may have the nearest triangles, along such directions |
//! | `skipped` | what a descent does not look at, for the next one |
//! | `question` | the two questions, as one type for the search |
//! | `answers` | what the questions say after a search |

pub(super) mod answers;
pub(super) mod int_pair_direction;
pub(super) mod leaf_gaps;
pub(super) mod nearest_along;
pub(super) mod nearest_first;
pub(super) mod question;
pub(super) mod skipped;
