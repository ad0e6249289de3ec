//! Tight hulls: the builder's, and those stored in a blob.

mod hulls;
mod margins;
mod stored;
mod written;
