//! Builder.
pub mod lp;
pub mod mesh;
