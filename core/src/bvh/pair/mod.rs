//! Two box trees, one of them moved.
//!
//! `separation/` searches in f32. `gaps/` bounds in f32 and measures in f64. `distance_to` measures
//! the candidates of f32. `distance_to` and `within_of` search again from the roots if f32 gives no
//! verdict.
//!
//! | question | file |
//! | --- | --- |
//! | whether and where the surfaces meet | `overlap/` |
//! | how far apart the surfaces are | `distance_to` |
//! | whether the surfaces are within a distance | `within_of` |
//! | these two questions, about models that move in small steps | `coherent_pair` |
//! | where a model that moves first comes near | `first_contact_of` |
//! | how deep two solids are in each other | `penetration/` |
//!
//! Lengths in *common units* are in the unit of the coarser grid (`query/pose/common_units.rs`).
//! The *surface error* is how far the input may be from the stored surface.
//!
//! | file | what the questions share |
//! | --- | --- |
//! | `models` | two trees: which of two nodes a descent opens, the places of triangles |
//! | `stored_pair` | two models in one frame, and the way back to input units |
//! | `model_box` | the box of a model, and what the boxes of two prove |
//! | `model_ball` | a small ball that holds a model |
//! | `placed_model` | a model at its place in the world: its ball and its box |
//! | `moving_model` | a placed model that moves, and how far its points went |
//! | `world_box` | the box of a placed model along the axes of the world |
//! | `placed_pair` | two models placed in the world, in the frame of one of them |
//! | `direction` | a direction along which pairs are apart, also in integers |
//! | `pair_keys` | lower bounds of the distances of all pairs of boxes of two nodes |
//! | `leaf_pair` | the triangles of two leaves |
//! | `leaf_keys` | which of these may be near, by their boxes and along a direction |
//! | `separation/` | descent in f32: models within a distance, candidates for the nearest triangles |
//! | `gaps/` | descent with bounds in f32 and triangles in f64, nearest pair first |
//! | `from_afar` | two models very far from each other, or of which no pair was measured |
//! | `advance` | how far a moving model certainly goes without contact |
//!
//! A *direction* has no length of its own: places are compared along it. An *offset* goes from one
//! place to another at the same time, a *displacement* from a place to where it is later. A *way*
//! is what a point travels.
//!
//! These words say what was not looked at.
//!
//! | word | what was not looked at |
//! | --- | --- |
//! | `Missed` | pairs within the limit, because steps or memory ended: the answer is wider |
//! | `SkippedPairs` | pairs beyond the limit, kept for the next question of a `CoherentPair` |
//! | `has_beyond` | pairs of triangles beyond a bound that the question was not told of yet |
//! | `is_truncated` | a list of pairs is not complete: some did not fit its memory |
//! | `drop_beyond` | candidates beyond a limit that fell: none can be the answer |

mod advance;
mod coherent_pair;
mod direction;
mod distance_to;
mod first_contact_of;
mod from_afar;
mod gaps;
mod leaf_keys;
mod leaf_pair;
mod model_ball;
mod model_box;
mod models;
mod moving_model;
mod overlap;
mod pair_keys;
mod penetration;
pub(super) mod placed_model;
pub(super) mod placed_pair;
pub(super) mod separation;
pub(super) mod stored_pair;
mod within_of;
pub(super) mod world_box;

pub use coherent_pair::CoherentPair;
pub use moving_model::MovingModel;
pub use placed_model::PlacedModel;
