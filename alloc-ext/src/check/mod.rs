//! Proofs from a blob's bytes and the mesh: a parser, exact arithmetic and a replay that share no
//! code with reader or builder. [`verify()`] is the way in; the rest is for tests.
//!
//! | file | proves or owns |
//! | --- | --- |
//! | `verify` | which structures a blob has, and what came of each proof |
//! | `tree`, `hull`, `tight`, `triboxes`, `curve`, `sdf` | the claims of one structure each |
//! | `repair` | that a mesh is that of its file |
//! | `enclosure` | that a hull encloses a mesh |
//! | `file` | the file's triangles, before they were rounded, and surface errors of them |
//! | `input` | that stored corners are those of the mesh |
//! | `near` | that all points of a triangle are near a surface |
//! | `planar` | convex polygons cut in exact arithmetic |
//! | `dyadic`, `vector`, `exact` | numbers that do not round |
//! | `bytes` | header, section table, CRC |

mod bytes;
mod curve;
mod distance;
#[doc(hidden)]
pub mod dyadic;
mod enclosure;
mod exact;
mod file;
mod finding;
mod hull;
mod input;
mod manifold;
mod near;
mod planar;
mod repair;
mod sdf;
mod tight;
mod tree;
mod triboxes;
#[doc(hidden)]
pub mod vector;
mod verify;

pub use curve::FilePolyline;
pub(crate) use distance::distance;
pub use finding::{Finding, Outcome};
pub use repair::verify_repair;
pub use verify::{Against, verify, verify_file};

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
pub use repair::{RepairProof, prove_repair};
#[doc(hidden)]
pub use tree::{TreeProof, check_tree};
