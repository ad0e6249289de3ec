//! Local edits of a hull. Each edit is placed in floating point and made only if it is proved.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `editor.rs` | the hull with its obstacle and counters; what every edit must satisfy |
//! | `shell.rs` | the hull's surface: connectivity, positions, boxes of faces |
//! | `placement.rs` | the linear program that places the vertex of a star |
//! | `margin_planes.rs` | planes of that program where the hull keeps a margin |
//! | `vertex.rs` | moves one vertex |
//! | `collapse.rs` | edge collapses, cheapest first |
//! | `exchange.rs` | edge splits, and a split exchanged for a collapse |
//! | `flip.rs` | edge flips |
//! | `kick.rs` | random kicks, and polishing |
//! | `within.rs` | edits that keep or bring the hull within a distance of the mesh |
//! | `memo.rs` | answers about stars that were asked before |
//! | `rounding.rs` | rounding to stored coordinates |

pub(crate) mod collapse;
pub(crate) mod editor;
mod exchange;
mod flip;
pub(crate) mod kick;
mod margin_planes;
mod memo;
pub(crate) mod placement;
pub(crate) mod rounding;
pub(crate) mod shell;
mod vertex;
pub(crate) mod within;
