//! Blobs that are wrong on purpose, with checksums that are right.

mod seal;
mod sections;

pub use seal::{crc32, seal};
pub use sections::{Entry, entries, entry, put_u32, swap_entries, word};
