//! A structure that answers distances or segments, and the dials that it is built with.

use super::options::{For, Options};
use crate::surface::VertexBits;
use std::fmt;

/// A structure that answers distances or segments, and the dials that it is built with. `Display`
/// prints the options with which the program builds it; of a cut level, those of the hierarchy to
/// cut, and that `cut --level` follows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Recipe {
    /// A box tree for distances.
    Tree(VertexBits),
    /// A box tree for segments, and for the distance of two models.
    SegmentTree(VertexBits),
    /// A hull hierarchy for sweeps.
    Sweep(VertexBits),
    /// The hull hierarchy of a closed mesh, for segments from outside on the refined hull.
    Hull(VertexBits),
    /// The hull hierarchy of a closed mesh, cut after its coarsest level
    /// of which no point is farther than this from the mesh, input units.
    CutLevel(f32),
    /// A tight hull of at most so many faces, not polished.
    Tight(u32),
    /// At most so many triboxes.
    Triboxes(u32),
    /// A distance field of so many bytes: signed, if the mesh is closed. Of a lattice and a tree
    /// the narrower.
    Sdf(u32),
    /// The same and a box tree for distances.
    TreeWithSdf(u32),
    /// Curves.
    Curve(VertexBits),
}

impl Recipe {
    /// The options that build it; of a cut level, those that build the hierarchy to cut.
    pub(super) fn options(self) -> Options {
        let serving = |question| Options { asked: vec![question], ..Options::default() };
        match self {
            Self::Tree(bits) => Options { vertex_bits: bits, ..serving(For::Closest) },
            Self::SegmentTree(bits) => Options { vertex_bits: bits, ..serving(For::Segment) },
            Self::Sweep(bits) => Options { vertex_bits: bits, ..serving(For::Sweep) },
            Self::Hull(bits) => Options { vertex_bits: bits, ..serving(For::Hull) },
            Self::CutLevel(_) => serving(For::Hull),
            Self::Tight(faces) => Options {
                tight: vec![faces],
                tight_for: Some([true, false]),
                effort: Some(0.0),
                ..serving(For::Tight)
            },
            Self::Triboxes(count) => Options { triboxes: Some(count), ..serving(For::Triboxes) },
            Self::Sdf(bytes) => Options { sdf_bytes: Some(bytes), ..serving(For::Sdf) },
            Self::TreeWithSdf(bytes) => Options {
                asked: vec![For::Closest, For::Sdf],
                sdf_bytes: Some(bytes),
                ..Options::default()
            },
            Self::Curve(bits) => Options { vertex_bits: bits, ..serving(For::Curve) },
        }
    }

    /// Structure and dials in words.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Tree(bits) | Self::SegmentTree(bits) => format!("box tree, {bits} bits"),
            Self::Sweep(bits) => format!("sweep, {bits} bits"),
            Self::Hull(bits) => format!("refined hull, {bits} bits"),
            Self::CutLevel(error) => format!("cut level, error {error}"),
            Self::Tight(faces) => format!("tight hull, {faces} faces"),
            Self::Triboxes(count) => format!("triboxes, {count}"),
            Self::Sdf(bytes) => format!("distance field, {bytes} bytes"),
            Self::TreeWithSdf(bytes) => format!("field first, {bytes} bytes"),
            Self::Curve(bits) => format!("curve, {bits} bits"),
        }
    }
}

impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.options().fmt(f)?;
        match self {
            Self::CutLevel(_) => f.write_str(", then cut --level"),
            _ => Ok(()),
        }
    }
}
