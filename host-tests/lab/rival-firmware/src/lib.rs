#![no_std]
//! Races between engines on a board: the same mesh, the same questions, one image an engine.
//!
//! ```text
//! carried (what the host wrote) ─┐
//! engine  (trait) ───────────────┼─ race (asks, counts, prints) ─ bin/race_NAME
//! heap    (counting allocator) ──┘
//! ```
//! Another engine is another `bin/race_NAME.rs` that implements [`race::Engine`].

pub mod race;
pub mod records;
