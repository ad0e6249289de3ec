//! A field's tree: which boxes are leaves, and what stands in each.
//!
//! ```text
//! grid       samples of the whole domain
//! leaf       a leaf's function and bytes
//! fit        the function of a box, from samples
//! partition  the best boxes for a number of bytes
//! search     their costs, and the entries of the best
//! codes      the functions' values, as they are stored
//! build      the stages
//! encode     the section's bytes
//! narrow     the best boxes for a largest width
//! ```
//!
//! *Partition.* Dyadic boxes of a root cell are fitted from large to small, by few samples. Halves
//! of a box that is good enough are not fitted. A box costs the width of its intervals, weighted by
//! where questions are, and the price of five bytes. Or it is halved along any of the axes, and
//! costs that price and what its parts cost. So the best partition at a price follows from the
//! smallest boxes upwards, and the price is found that fills the bytes.

mod build;
mod codes;
mod encode;
mod fit;
mod grid;
mod leaf;
mod narrow;
mod partition;
mod search;

pub(super) use build::{Maker, Tree, leaves};
pub(super) use narrow::{Narrow, build as narrow};
