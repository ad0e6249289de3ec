//! Mesh files and generated meshes.

mod defects;
mod fixtures;
mod generators;
mod hausdorff;
mod hostile;
mod readers;
