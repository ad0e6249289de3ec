//! Procedural meshes with known properties, the same bits on every machine.
//!
//! All are closed, wound counter-clockwise seen from outside, and share their vertices exactly,
//! unless a function says otherwise. Sines and cosines come from `libm`, since those of the
//! standard library differ between platforms.

mod bracket;
mod builder;
pub mod corpus;
pub mod curves;
pub mod evil;
pub mod extremes;
pub mod fields;

pub mod defects;
mod extrude;
pub mod fixtures;
pub mod rays;
mod rng;
pub mod scenes;
mod solids;
mod transform;
pub mod writers;

pub use bracket::bracket;
pub use extrude::{clamps, groove_block, link, needle_comb, table};
pub use rng::Rng;
pub use solids::{block, coil, cube, icosphere, plate, rough_sphere, torus, uv_sphere};
pub use transform::{EXTREME_SCALES, inverted, joined, scaled, transformed, two_parts};

/// Positions and triangles.
pub type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);
