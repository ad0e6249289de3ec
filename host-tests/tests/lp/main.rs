//! The linear program of a hull's vertex.

mod invariance;
mod oracle;
mod regularised;
