//! Blobs that are wrong on purpose, with checksums that are right.

mod ask;
mod damage;
mod hull;
mod seal;
mod sections;

pub use ask::Asker;
pub use damage::{
    Outcome, assert_damage_is_safe, assert_only_the_whole_opens, edited, flip_bits, replace_bytes,
};
pub use hull::{ask_hull, every_face_has_corners};
pub use meshsweep::check::{Entry, crc32, entries, word};
pub use seal::seal;
pub use sections::{entry, put_u32, swap_entries};
