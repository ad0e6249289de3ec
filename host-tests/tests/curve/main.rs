//! Curves of blobs: never wrong, whatever the budget, the scratch and the bytes.

mod bytes;
mod closest;
mod examples;
mod kept_sweep;
mod neighbors;
mod scenes;
mod signed;
mod within;
