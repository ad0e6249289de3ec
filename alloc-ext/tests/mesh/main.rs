//! Mesh files: reading and repair.

mod read;
mod repair;
