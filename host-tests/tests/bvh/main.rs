//! The box tree: its bytes, its kernels and its questions.

mod as_filed;
mod batch;
mod bytes;
mod check;
mod coherent;
mod coherent_scene;
mod cull;
mod distance;
mod examples;
mod fast;
mod joints;
mod kernels;
mod overlap;
mod pair_distance;
mod penetration;
mod placed;
mod posed;
mod poses;
mod refusals;
mod scene;
mod segments;
mod separation;
mod solid;
mod thresholds;
mod winding;
