//! Builds `meshsweep` blobs from mesh files. The program `meshsweep` is its command line.
//!
//! ```text
//! mesh file ─ mesh ─ surface ─┬─ bvh      boxes over triangle fans      ─┐
//!                             ├─ hull     edge collapses, split tables   │
//!                             ├─ tight    hulls shrunk onto the mesh     ├─ emit ─ blob
//!                             ├─ tribox   bounds of 18 planes            │
//!                             └─ sdf      a lattice of distances         │
//! CSV of points ─────────────── curve     runs of points in capsules     ─┘
//! ```
//!
//! [`Builder`] goes all of this way, for the questions that a blob has to serve.
//!
//! Each stage takes a value and returns a value with one invariant more. Kernels are those of
//! `meshsweep-core`, so builder and reader compute the same bits.
//!
//! | room | owns |
//! | --- | --- |
//! | [`lp`] | the linear program in three variables |
//! | [`mesh`] | mesh files, defects of a mesh, repair, report |
//! | `geom` | exact predicates on triangles, and the static tree that finds them |
//! | [`surface`] | the triangle surface that all builders share |
//! | [`collapse`] | edge collapses: the loop, the star, where the vertex goes |
//! | [`load`] | a mesh file in one unit, on a hull's grid, repaired |
//! | `hausdorff` | certified distances between two meshes |
//! | [`bvh`], [`hull`], [`tight`], [`tribox`], [`curve`], [`sdf`] | one structure each, as in core |
//! | [`emit`] | sections to bytes; it knows no builder |
//! | [`builder`] | from options or a recipe, and a mesh, to a blob in memory: what the program does |
//! | [`progress`] | how much of a build is done, and whether to go on |
//! | [`robot`] | a robot's description: links, joints, pairs, and firmware's module of them |
//! | [`cut`] | a coarser blob out of a finer one |
//! | [`distances`] | a structure of a blob that answers distances, whichever it is |
//! | [`worst`] | a search for the query that costs most |
//! | [`check`] | proofs of a blob again, from its bytes and the mesh; it uses `mesh` only |
//! | [`trade`] | errors and costs of a mesh's structures and settings, measured |
//!
//! A room uses those to its left in this line, and no other: `geom` ← `{emit, lp, mesh}` ←
//! `progress` ← `surface` ← `{collapse, bvh, load}` ← `hausdorff` ← `{tight, tribox, curve, sdf}` ←
//! `hull` ← `{cut, builder}` ← `{trade, robot}` ← `worst` ← the program. `trade` also uses the
//! distance of `check`, and `distances` uses no room. A test keeps that (`host-tests/tests/house`).

#[macro_use]
mod setters;

pub mod builder;
pub mod bvh;
pub mod check;
mod clock;
pub mod collapse;
pub mod counted;
pub mod curve;
pub mod cut;
pub mod distances;
pub mod emit;
mod error;
mod geom;
pub mod hausdorff;
pub mod hull;
pub mod load;
pub mod lp;
pub mod mesh;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod pose;
pub mod progress;
mod random;
pub mod robot;
pub mod sdf;
pub mod surface;
pub mod tight;
pub mod trade;
pub mod tribox;
pub mod worst;

pub use builder::{Builder, Built};
pub use error::BuildError;
#[doc(hidden)]
pub use error::io_remedy;
pub use hausdorff::Farthest;
