//! Closest points of a query that moves little from one time to the next.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | [`CoherentQuery`]: the state of a moving query, and when it starts anew |
//! | `follow` | one search over the front |
//! | `front` | the set of nodes that is kept between queries |
//! | `planes` | planes that separate the closest triangle from the leaves around it |
//! | `leaf_shape` | leaves without slivers |

mod follow;
mod front;
mod leaf_shape;
mod planes;
mod query;

pub use query::{CoherentClosest, CoherentQuery};
