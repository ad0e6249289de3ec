//! The bodies of the fuzz targets, as plain functions: tests call them too.
//!
//! Input bytes are edits of a valid blob, whose CRCs are then computed again, followed by the
//! queries' floats. Those of `mesh` are a mesh file, those of `build` edits of a mesh. A blob that
//! opens must be safe to ask anything: no panic, and no more work than a fixed multiple of its
//! records.

mod both;
mod build;
mod corpus;
mod curves;
mod deform;
mod hull;
mod input;
mod mesh;
mod sdf;
mod suite;
mod tight;
mod tree;
mod tribox;
mod triboxes;
mod trusted;

pub use both::both_seeds;
pub use corpus::{corpus, of_hex, pack, unpack};
pub use curves::{ask_curve, curve_seeds};
pub use deform::deform_seeds;
pub use hull::seeds;
pub use input::random_input;
pub use sdf::{ask_sdf, sdf_seeds};
pub use tight::{ask_tight, tight_seeds};
pub use tree::tree_seeds;
pub use triboxes::{ask_triboxes, triboxes_seeds};

/// A fuzz target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, also that of its corpus.
    pub name: &'static str,
    /// Takes any bytes. A panic is a finding.
    pub run: fn(&[u8]),
}

macro_rules! targets {
    ($($module:ident: $($name:ident)*;)*) => {
        /// Every target.
        pub const TARGETS: &[Target] =
            &[$($(Target { name: stringify!($name), run: $module::$name },)*)*];
    };
}

targets! {
    hull: open closest segment outer overlap refine;
    tree: tree_open tree_closest tree_segment tree_coherent tree_overlap;
    trusted: tree_trusted tight_trusted;
    tribox: tribox;
    triboxes: triboxes;
    tight: tight;
    curves: curves;
    deform: deform;
    sdf: sdf;
    both: both;
    mesh: mesh;
    build: build;
}

/// The target of this name.
///
/// # Errors
/// No target has this name. The message lists the names.
pub fn target(name: &str) -> Result<Target, String> {
    TARGETS.iter().find(|target| target.name == name).copied().ok_or_else(|| {
        let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
        format!("no fuzz target `{name}`; there are {}", names.join(", "))
    })
}
