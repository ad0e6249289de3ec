//! Convex solids against the input mesh in 106 bits: distances, verdicts, and motion.

mod limits;
mod motion;
mod shapes;
mod truth;
