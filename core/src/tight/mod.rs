//! Questions about a part of which only a tight hull is known: its surface is inside of the hull,
//! and no farther from a face than the face's slack.
//!
//! *The interval.* Let H be the hull, P the mesh, p the point. If p is outside of H, every way from
//! p to P crosses H: |p P| ≥ |p H|. Wherever p is, a way to P may be continued to H: |p P| ≥ |p H|
//! − depth. With q the point of face f that is closest to p, |p P| ≤ |p q| + |q P| ≤ |p H| + slack
//! of f. All three take the box tree's interval of |p H|, which holds for the hull as it was proved
//! to enclose the mesh, and round outward (`core/docs/rounding.md` §12).
//!
//! *The side.* A point outside of the hull tree's box, and farther from the hull than it was moved
//! when it was stored, is outside. Else [`signed_distance`](super::tree::signed_distance) proves
//! it; what it leaves open counts as inside.
//!
//! ```
//! use meshsweep_core::{TightHulls, query::{Budget, tight::is_within, tree::ScratchEntry}};
//! # fn probe(blob: &[u8]) -> Result<(), Box<dyn core::error::Error>> {
//! let hulls = TightHulls::open(blob)?; // of a blob built with `meshsweep build part.stl --for tight --tight 70,200`
//! if let Some(hull) = hulls.finest() {
//!     let mut stack = [ScratchEntry::EMPTY; 64]; // `hull.tree().header().stack_entries` says what this hull needs
//!     let near = is_within(&hull, [0.1, 0.2, 0.3], 0.5, &Budget::EXACT, &mut stack)?;
//!     if near.is_clear() { /* proved: the part is farther than 0.5 */ }
//! }
//! # Ok(()) }
//! ```

mod closest_point;
pub mod format;
mod side;
mod within;

pub use closest_point::closest_point;
pub use format::{TightHull, TightHulls};
pub use within::is_within;
