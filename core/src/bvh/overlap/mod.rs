//! Two box trees, one of them moved: whether and where their surfaces meet; how far they are apart.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | the two questions about contact |
//! | `axis_intervals` | the boxes of two nodes as intervals along these directions |
//! | `leaf_pair` | the triangles of two leaves |
//! | `descent` | the descent of both trees |
//! | `distance`, `within_of` | the two questions about distance |
//! | `coherent_pair` | both of models that move from one question to the next |
//! | `first_contact_of` | the question about a model that moves |
//! | `pair_keys` | lower bounds of the distances of all pairs of boxes of two nodes |
//! | `leaf_gaps` | the distances of the triangles of two leaves |
//! | `nearest_first` | the descent of both trees, nearest pair first |
//! | `left_out` | what a descent does not look at, for the next one |
//! | `stored_pair` | two models in one frame, and the way back to input units |
//! | `from_afar` | two models that are very far from each other |

mod axis_intervals;
mod coherent_pair;
mod descent;
mod distance;
mod first_contact_of;
mod from_afar;
mod leaf_gaps;
mod leaf_pair;
mod left_out;
mod nearest_first;
mod pair_keys;
mod query;
mod stored_pair;
mod within_of;

pub(super) use axis_intervals::AxisIntervals;
pub use coherent_pair::CoherentPair;
pub(super) use descent::extended;
pub(super) use first_contact_of::longest_path;
pub(super) use stored_pair::StoredPair;
