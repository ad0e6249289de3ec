//! Mesh files: reading and repair.

mod formats;
mod orientation;
mod polygons;
mod read;
mod repair;
mod scenes;
