//! Proofs from a blob's bytes and the mesh: a parser, exact arithmetic and a replay that share no
//! code with reader or builder.

mod bytes;
mod curve;
mod distance;
#[doc(hidden)]
pub mod dyadic;
mod enclosure;
mod exact;
mod finding;
mod hull;
mod input;
mod manifold;
mod near;
mod planar;
mod tight;
mod tree;
mod triboxes;
#[doc(hidden)]
pub mod vector;
mod verify;

pub use finding::{Finding, Outcome};
pub use verify::{Against, verify};

#[doc(hidden)]
pub use bytes::{Entry, crc32, entries, word};
#[doc(hidden)]
pub use enclosure::{EnclosureProof, Surface, Winding, check_enclosure, check_margin};
#[doc(hidden)]
pub use exact::side;
#[doc(hidden)]
pub use hull::{Blob, CheckReport, check_blob};
#[doc(hidden)]
pub use manifold::{Manifold, canonical};
#[doc(hidden)]
pub use tree::{TreeProof, check_tree};
