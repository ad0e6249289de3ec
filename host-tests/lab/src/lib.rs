//! The laboratory: meshsweep measured beside its peers, on any mesh.

pub mod measure;
pub mod race;
