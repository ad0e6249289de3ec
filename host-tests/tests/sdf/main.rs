//! Distance fields: what the builder proves and the interval of every point, whatever the bytes.

mod bytes;
mod kernel;
mod options;
mod proof;
mod size;
mod tree;
mod truth;
mod width;
mod with_tree;
mod with_tree_moving;
mod within;
