//! Blobs that are wrong on purpose, with checksums that are right.

mod ask;
mod damage;
mod seal;
mod sections;

pub use ask::Asker;
pub use damage::{
    Outcome, assert_damage_is_safe, assert_only_the_whole_opens, edited, flip_bits, replace_bytes,
};
pub use seal::{crc32, seal};
pub use sections::{Entry, entries, entry, put_u32, swap_entries, word};
