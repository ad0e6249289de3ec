//! Proofs from a blob's bytes alone.
