#![no_std]
#![forbid(unsafe_code)]
//! One fixed list of queries, run by the host and by every firmware image, so that their answers
//! can be compared bit by bit.
//!
//! ```text
//! rng ─ place (points and segments from integers) ─ ask (the core's entry points) ─ fold (hashes)
//!                                 run: kinds × blocks × queries, told to a `Recorder`
//! ```
//! Answers are folded into one hash per block of queries: a difference is then located to a block
//! without printing every answer over a debug link. [`ask`] is the only folder that names the
//! core's questions.

pub mod arith;
pub mod ask;
pub mod fold;
pub mod kind;
pub mod observer;
pub mod place;
pub mod questions;
pub mod rng;
pub mod run;

pub use ask::Subject;
pub use kind::Kind;
pub use observer::Observer;
pub use run::{Plan, Recorder, run};
