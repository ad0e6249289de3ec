//! Local edits of a hull. Each edit is placed in floating point and made only if it is proved.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `editor.rs` | [`HullEditor`]: the hull, its obstacle, and the conditions of every edit |
//! | `shell.rs` | [`Shell`]: the hull's surface, with boxes of its faces |
//! | `star.rs` | [`StarFace`]: a face of the star that an edit replaces |
//! | `placement.rs` | the linear program that places the vertex of a star |
//! | `mesh_planes.rs` | planes of that program that keep new faces above the mesh |
//! | `margin_planes.rs` | the same where the hull keeps a margin |
//! | `vertex.rs` | moves one vertex |
//! | `collapse.rs` | edge collapses, cheapest first |
//! | `exchange.rs` | edge splits, and a split exchanged for a collapse |
//! | `flip.rs` | edge flips |
//! | `kick.rs` | random kicks of vertices |
//! | `side_by_side.rs` | flips and kicks that are tried on several threads |
//! | `tolerance.rs` | least gains and clearances of edits |
//! | `within.rs` | edits that keep or bring the hull within a distance of the mesh |
//! | `ahead.rs` | placements that are computed side by side |
//! | `memo.rs` | answers about stars that were asked for before |
//! | `rounding.rs` | rounding to stored coordinates |

mod ahead;
mod collapse;
mod editor;
mod exchange;
mod flip;
mod kick;
mod margin_planes;
mod memo;
mod mesh_planes;
mod placement;
mod rounding;
mod shell;
mod side_by_side;
mod star;
mod tolerance;
mod vertex;
mod within;

pub(crate) use editor::{HullEditor, Shape};
pub(crate) use rounding::Rounding;
pub(crate) use shell::Shell;
pub(crate) use star::StarFace;
pub(crate) use within::slack;
