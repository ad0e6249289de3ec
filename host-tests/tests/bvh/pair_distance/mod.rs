//! The distance of two box trees against the distance of the input meshes in 106 bits.

mod coherent;
mod extremes;
mod held;
mod limits;
mod motion;
mod truth;
