//! Curves of blobs: never wrong, whatever the budget, the scratch and the bytes.

mod bytes;
mod closest;
mod scenes;
mod signed;
mod within;
