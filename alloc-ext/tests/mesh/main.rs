//! Mesh files: reading and repair.

mod formats;
mod polygons;
mod read;
mod repair;
mod scenes;
