//! One triangle surface for all builders.

mod precision;

pub use precision::{Grid, Stored, VertexBits, snap, store};
pub(crate) use precision::{scale_exponent, split_exponent};
