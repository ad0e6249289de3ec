//! Closest points of a query that moves little from one time to the next.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | [`CoherentQuery`]: the state of a moving query, and when the front is used |
//! | `follow` | one search over the front |
//! | `front` | the set of nodes that is kept between queries |
//! | `planes` | planes that separate the closest triangle from the leaves around it |
//! | `sliver` | leaves without slivers |

mod follow;
mod front;
mod planes;
mod query;
mod sliver;

pub use query::{CoherentClosest, CoherentQuery};
