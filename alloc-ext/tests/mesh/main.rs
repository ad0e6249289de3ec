//! Mesh files: reading and repair.

mod formats;
mod read;
mod repair;
mod scenes;
