//! The distance field: what the builder proves, against an oracle.

mod bytes;
mod decoded;
mod options;
mod truth;
