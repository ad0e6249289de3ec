//! Triboxes: the figure, and hierarchies stored in a blob.

mod figure;
mod stored;
