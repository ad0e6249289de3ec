//! The format: the only place that reads bytes. `core/FORMAT.md` says what they are, `core/DESIGN.md` why.

mod check;
mod error;
mod header;
mod index;
pub mod layout;
mod model;
mod open;
mod read;

pub use error::OpenError;
pub use header::Header;
pub use index::{NodeIdx, SplitIdx, TriIdx, VertIdx};
pub use model::{Capacities, Children, Level, Model, Node, Section, Split};
pub use open::section_crc;
