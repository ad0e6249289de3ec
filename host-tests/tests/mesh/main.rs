//! Mesh files and generated meshes.

mod fixtures;
mod generators;
mod hausdorff;
mod hostile;
