//! The linear program of a hull's vertex.

mod invariance;
mod levels;
mod oracle;
mod regularised;
