//! What a blob's header says and its records do not.

/// A header that contradicts itself, its records or a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Contradiction {
    /// Number of tight hulls.
    TightHullCount,
    /// Bytes after the last tight hull.
    BytesAfterTightHulls,
    /// Triboxes are not one and two for each split.
    TriboxCount,
    /// Levels of triboxes.
    TriboxLevels,
    /// Grid of the triboxes out of range.
    TriboxGrid,
    /// The matrix of turned triboxes is no rotation.
    TriboxTurn,
    /// The last level of triboxes is not the whole hierarchy.
    LastTriboxLevel,
    /// Triboxes deeper than their header says.
    TriboxDepth,
    /// Points and polylines of a curve.
    CurvePoints,
    /// Nodes of a curve too deep.
    CurveNodes,
    /// Grid of a curve out of range.
    CurveGrid,
    /// Scale, error or box of a curve out of range.
    CurveRange,
    /// Depth of the nodes of a curve.
    CurveDepth,
    /// A distance field without cells.
    FieldCells,
    /// An unknown kind of distance field.
    FieldKind,
    /// Base or step of a distance field's codes.
    FieldStep,
    /// Origin or unit of a distance field.
    FieldUnit,
    /// Entries of a distance field's tree.
    FieldTree,
    /// Size of the section table.
    SectionTableSize,
    /// Bytes after the last section.
    BytesAfterSections,
    /// An empty tree.
    EmptyTree,
    /// More tree records than a blob can address.
    TreeRecords,
    /// Tree grid out of range.
    TreeGrid,
    /// Negative or infinite error bound of the tree.
    TreeError,
    /// The tree's box is inverted.
    TreeBox,
    /// Stack entries of the tree.
    TreeScratch,
    /// Leaves of the tree.
    TreeLeaves,
    /// A tree deeper than 64 nodes.
    TreeDepth,
    /// A tree node without a parent.
    TreeOrphan,
    /// A model that is cut does not deform.
    DeformsWhileCut,
    /// No triangle stands for a part of the surface.
    UncoveredSurface,
    /// Parts of a hull hierarchy without its base.
    HullWithoutBase,
    /// Vertices are not base vertices and two for each split.
    HullVertices,
    /// Too many levels.
    HullLevels,
    /// An empty model.
    EmptyHull,
    /// A cut model has no surface triangles, any other has.
    HullSurface,
    /// More records than a blob can address.
    HullRecords,
    /// Queue capacity.
    HullScratch,
    /// Scale out of range.
    HullScale,
    /// Negative surface error.
    HullError,
    /// A box is inverted or far outside the local frame.
    HullBox,
    /// Grid out of range.
    HullGrid,
    /// Source numbers are not those of the surface.
    SourceNumbers,
    /// The last level is not the whole model.
    LastHullLevel,
}

impl core::fmt::Display for Contradiction {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::TightHullCount => "number of tight hulls",
            Self::BytesAfterTightHulls => "bytes after the last tight hull",
            Self::TriboxCount => "triboxes are not one and two for each split",
            Self::TriboxLevels => "levels of triboxes",
            Self::TriboxGrid => "grid of the triboxes out of range",
            Self::TriboxTurn => "the matrix of turned triboxes is no rotation",
            Self::LastTriboxLevel => "the last level of triboxes is not the whole hierarchy",
            Self::TriboxDepth => "triboxes deeper than their header says",
            Self::CurvePoints => "points and polylines of a curve",
            Self::CurveNodes => "nodes of a curve too deep",
            Self::CurveGrid => "grid of a curve out of range",
            Self::CurveRange => "scale, error or box of a curve out of range",
            Self::CurveDepth => "depth of the nodes of a curve",
            Self::FieldCells => "a distance field without cells",
            Self::FieldKind => "the kind of the distance field",
            Self::FieldStep => "base or step of the distance field's codes",
            Self::FieldUnit => "origin or unit of the distance field",
            Self::FieldTree => "entries of the distance field's tree",
            Self::SectionTableSize => "size of the section table",
            Self::BytesAfterSections => "bytes after the last section",
            Self::EmptyTree => "an empty tree",
            Self::TreeRecords => "more tree records than a blob can address",
            Self::TreeGrid => "tree grid out of range",
            Self::TreeError => "negative or infinite error bound of the tree",
            Self::TreeBox => "the tree's box is inverted",
            Self::TreeScratch => "stack entries of the tree",
            Self::TreeLeaves => "leaves of the tree",
            Self::TreeDepth => "a tree deeper than 64 nodes",
            Self::TreeOrphan => "a tree node without a parent",
            Self::DeformsWhileCut => "a model that is cut does not deform",
            Self::UncoveredSurface => "no triangle stands for a part of the surface",
            Self::HullWithoutBase => "parts of a hull hierarchy without its base",
            Self::HullVertices => "vertices are not base vertices and two for each split",
            Self::HullLevels => "too many levels",
            Self::EmptyHull => "an empty model",
            Self::HullSurface => "a cut model has no surface triangles, any other has",
            Self::HullRecords => "more records than a blob can address",
            Self::HullScratch => "queue capacity",
            Self::HullScale => "scale out of range",
            Self::HullError => "negative surface error",
            Self::HullBox => "a box is inverted or far outside the local frame",
            Self::HullGrid => "grid out of range",
            Self::SourceNumbers => "source numbers are not those of the surface",
            Self::LastHullLevel => "the last level is not the whole model",
        })
    }
}
