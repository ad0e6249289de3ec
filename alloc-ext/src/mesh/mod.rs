//! Mesh input.
