//! The recipes of the guide, run unchanged. They name blobs as `core/docs` does, one folder up: so
//! this module is a folder, beside the link `fixtures`.

#![doc = include_str!("../../../core/docs/guide.md")]
