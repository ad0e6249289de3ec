//! Packs a triangle soup into leaves of one or two fans.
//!
//! ```text
//! cells ─┬─ greedy: seed (front) ─ window ─ candidates (best_leaf, score) ─ leaf ─ remaining ─ next
//!        └─ halves, where they cost less (pack, price)
//! ```
//!
//! | file | owns |
//! | --- | --- |
//! | `pack` | cells on all threads, and their division |
//! | `cells` | which triangles may share a leaf |
//! | `soup` | the triangles of a cell, with numbers of their own |
//! | `price` | what leaves cost: instructions of a query, and bytes |
//! | `greedy` | the leaves of a cell |
//! | `adjacency` | the neighbour across each half-edge |
//! | `remaining` | triangles that are in no leaf yet, and their degrees |
//! | `front` | the queues of seeds |
//! | `window` | the 32 remaining triangles about a seed, as bit masks |
//! | `score` | the score of a candidate leaf |
//! | `best_leaf` | the candidates of a window, and the best one |
//!
//! After Galin & Akkouche, *Fast Processing of Triangle Meshes using Triangle Fans* (2005), section
//! 5. Any soup will do: open, non-manifold, inconsistently wound, with repeated corners. Every
//! triangle is in exactly one fan exactly once.

mod adjacency;
mod best_leaf;
mod cells;
mod front;
mod greedy;
mod pack;
mod price;
mod remaining;
mod score;
mod soup;
mod window;

#[cfg(test)]
mod tests;

use arrayvec::ArrayVec;
pub(super) use pack::{Packed, Packing, pack};
pub(super) use price::{Cost, LeafBytes};

/// Most triangles in a fan, and in a [`FanLeaf`]: the box tree tests a leaf in 8 lanes.
pub(super) const MAX_LEAF_TRIANGLES: usize = 8;

/// Triangles above which a mesh is large: the time to build its tree counts more than a hundredth of
/// a query.
pub(super) const LARGE: usize = 1 << 19;

/// How many candidates the packing looks at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Triangles of a window, 32 at most: as many as a mask has bits. 20 make half a percent more
    /// leaves.
    window: usize,
    /// Runs that are joined with a second run, the longest first.
    pairs: usize,
    /// Candidates whose score is computed in full.
    finalists: usize,
}

impl Effort {
    /// For trees that are stored. More candidates give no better result.
    pub(super) const FULL: Self = Self { window: window::WINDOW, pairs: usize::MAX, finalists: 16 };
    /// For large meshes. Leaves are as many, and take 1 % more instructions by the model, for two
    /// thirds of the time.
    pub(super) const LARGE: Self = Self { window: 20, pairs: 4, finalists: 2 };
    /// For trees that are asked few questions.
    pub(super) const QUICK: Self = Self { window: 16, pairs: 3, finalists: 1 };
}

/// Triangles about one vertex.
///
/// Triangle `i` is `(centre, ring[i], ring[i + 1])`, in the mesh's winding; if `reversed`, it is
/// `(centre, ring[i + 1], ring[i])`. The first corner may be another than in the mesh. `ring` holds
/// one vertex more than there are triangles; for a fan that closes, its last vertex is its first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fan {
    /// The vertex that all triangles share.
    pub(crate) centre: u32,
    /// The vertices around it, in order.
    pub(crate) ring: ArrayVec<u32, { MAX_LEAF_TRIANGLES + 1 }>,
    /// The triangles' numbers, in the ring's order: 1 to [`MAX_LEAF_TRIANGLES`].
    pub(crate) triangles: ArrayVec<u32, MAX_LEAF_TRIANGLES>,
    /// True if the ring runs against the mesh's winding.
    pub(crate) reversed: bool,
}

/// A leaf of the box tree: one fan, or two that share a vertex of their rings.
///
/// It has at most [`MAX_LEAF_TRIANGLES`] triangles. `first` is not reversed; `second` may be. The
/// ring of `second` starts with the last vertex of the ring of `first`, so both are one path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FanLeaf {
    /// The fan at the path's start.
    pub(crate) first: Fan,
    /// The fan at its end, if there are two.
    pub(crate) second: Option<Fan>,
}

impl FanLeaf {
    /// The one or two fans.
    pub(crate) fn fans(&self) -> impl Iterator<Item = &Fan> {
        std::iter::once(&self.first).chain(&self.second)
    }

    /// The triangles' numbers in the order in which the leaf stores them.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = u32> {
        self.fans().flat_map(|fan| fan.triangles.iter().copied())
    }

    /// How many triangles: 1 to [`MAX_LEAF_TRIANGLES`].
    pub(crate) fn triangle_count(&self) -> usize {
        self.fans().map(|fan| fan.triangles.len()).sum()
    }
}
