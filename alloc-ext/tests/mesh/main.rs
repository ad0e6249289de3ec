//! Mesh files: reading and repair.

mod collada;
mod formats;
mod left_out;
mod lost_words;
mod orientation;
mod polygons;
mod read;
mod repair;
mod scenes;
