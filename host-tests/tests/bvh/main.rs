//! The box tree: its bytes, its kernels and its questions.

mod as_filed;
mod batch;
mod bytes;
mod check;
mod coherent;
mod cull;
mod distance;
mod examples;
mod fast;
mod kernels;
mod overlap;
mod pair_distance;
mod penetration;
mod posed;
mod refusals;
mod scene;
mod segments;
mod solid;
mod winding;
