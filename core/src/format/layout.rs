//! Sizes and offsets that all structures share. The reader of this crate, the writer of `meshsweep`
//! and the checker use these constants. `core/FORMAT.md` is the normative text.

/// First eight bytes of every blob.
pub const MAGIC: [u8; 8] = *b"meshswep";
/// A reader refuses any other major version.
pub const VERSION_MAJOR: u16 = 3;
/// A reader accepts any minor version. It ignores the additions of a later one. A writer writes the
/// least minor version that has all section kinds of the blob, see [`SectionKind::minor`].
pub const VERSION_MINOR: u16 = 0;
/// Bytes of the fixed part of the header; the section table follows.
pub const HEADER_BYTES: usize = 160;
/// Bytes of one entry of the section table: kind, offset, length, CRC, each a u32.
pub const SECTION_ENTRY_BYTES: usize = 16;
/// Every section starts at a multiple of this.
pub const SECTION_ALIGNMENT: usize = 4;
/// Most levels. Faces double from one level to the next, so no blob needs 32.
pub const MAX_LEVELS: u32 = 32;
/// Most sections that a table may list.
pub const MAX_SECTIONS: usize = 32;
/// Header flag: finer levels were cut off. The triangles of the surface are not in the blob.
pub const FLAG_CUT: u32 = 1;
/// Header flag: the levels of the hull hierarchy enclose nothing. Triangles with an infinite radius
/// stand for no part of the surface.
pub const FLAG_SWEEP_ONLY: u32 = 2;

/// The contents of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
#[non_exhaustive]
pub enum SectionKind {
    /// Coordinates, base vertices first, then two for each split.
    Vertices = 1,
    /// Corners of the base hull's triangles.
    BaseTriangles = 2,
    /// One record for each split, coarse to fine: vertex, start of its ring, position of the right
    /// wing in the ring, star radius, error.
    Splits = 3,
    /// Rings of all splits: the vertices that must exist before the split.
    Rings = 4,
    /// One byte for each triangle of each level: its certified radius.
    Radii = 5,
    /// For each vertex the split that replaces it.
    SplitsWith = 6,
    /// For each eighth split the triangles of the surface that come before its own.
    SourceStarts = 7,
    /// For each triangle of the surface its number in the input file.
    Source = 9,
    /// Level table, coarse to fine.
    Levels = 10,
    /// One swept triangle for each group of triangles of the base hull. It contains them and their
    /// parts of the surface.
    BaseGroups = 11,
    /// The box tree's header: counts, grid and error bound.
    Bvh = 12,
    /// Links to the children of each node of the box tree.
    TreeLinks = 13,
    /// Boxes of the children of each node, in a frame that they share: for distances.
    TreeFrames = 14,
    /// Boxes of the children of each node, axis-aligned: for segments.
    TreeBoxes = 15,
    /// Vertices of the leaves: one or two triangle fans each.
    TreeFans = 16,
    /// For each triangle of the box tree its number in the input file.
    TreeSource = 17,
    /// For each leaf of the box tree a cone that contains the normals of its triangles.
    TreeCones = 18,
    /// A hierarchy of triboxes. Each level is a union of 1, 2, 4, … triboxes that contains the
    /// mesh.
    Triboxes = 19,
    /// Tight hulls of the mesh: each a blob with a box tree of its own, and the distances of its
    /// faces from the mesh.
    TightHulls = 20,
    /// Polygonal curves, and a hierarchy of capsules over their points.
    Curves = 21,
    /// For each vertex of the surface its number in the input file.
    VertexNumbers = 22,
    /// Key frames: the vertices of all levels, and the radius of each triangle.
    KeyFrames = 23,
    /// For each node of the box tree the moments of its triangles: for winding numbers.
    TreeMoments = 24,
    /// For each triangle of the box tree whether its other side tells inside from outside.
    TreeTurned = 25,
    /// For each triangle of the box tree whether it tells no side.
    TreeSideless = 26,
    /// For each polyline of the curves which side of it is allowed.
    CurveZones = 27,
    /// The distance field: codes of a lattice's corners, and the errors of its cells.
    Sdf = 28,
}

impl SectionKind {
    /// All kinds, in the order in which a writer emits them.
    pub const ALL: [SectionKind; 27] = [
        SectionKind::Levels,
        SectionKind::Vertices,
        SectionKind::BaseTriangles,
        SectionKind::BaseGroups,
        SectionKind::Splits,
        SectionKind::Rings,
        SectionKind::SplitsWith,
        SectionKind::Radii,
        SectionKind::SourceStarts,
        SectionKind::Source,
        SectionKind::Bvh,
        SectionKind::TreeLinks,
        SectionKind::TreeFrames,
        SectionKind::TreeBoxes,
        SectionKind::TreeFans,
        SectionKind::TreeSource,
        SectionKind::TreeCones,
        SectionKind::TreeMoments,
        SectionKind::TreeTurned,
        SectionKind::TreeSideless,
        SectionKind::Triboxes,
        SectionKind::TightHulls,
        SectionKind::Curves,
        SectionKind::CurveZones,
        SectionKind::VertexNumbers,
        SectionKind::KeyFrames,
        SectionKind::Sdf,
    ];

    /// The kind with this number.
    pub(crate) const fn from_code(code: u32) -> Option<Self> {
        let mut kinds: &[SectionKind] = &Self::ALL;
        while let Some((kind, rest)) = kinds.split_first() {
            if *kind as u32 == code {
                return Some(*kind);
            }
            kinds = rest;
        }
        None
    }

    /// Whether the section belongs to the hull hierarchy.
    pub const fn is_hull(self) -> bool {
        (self as u32) < SectionKind::Bvh as u32
    }

    /// Whether the section belongs to the box tree.
    pub fn is_bvh(self) -> bool {
        let first = !self.is_hull() && (self as u32) < SectionKind::Triboxes as u32;
        first
            || matches!(
                self,
                SectionKind::TreeMoments | SectionKind::TreeTurned | SectionKind::TreeSideless
            )
    }

    /// Whether the section is for a hull hierarchy that deforms.
    pub fn is_deform(self) -> bool {
        matches!(self, SectionKind::VertexNumbers | SectionKind::KeyFrames)
    }

    /// Whether the section belongs to the curves.
    pub fn is_curve(self) -> bool {
        matches!(self, SectionKind::Curves | SectionKind::CurveZones)
    }

    /// Whether the section is the distance field.
    pub fn is_sdf(self) -> bool {
        self == SectionKind::Sdf
    }

    /// The newest minor version: the one that has all kinds.
    pub fn newest_minor() -> u16 {
        Self::ALL.iter().map(|kind| kind.minor()).max().unwrap_or(VERSION_MINOR)
    }

    /// The first minor version with this kind.
    pub fn minor(self) -> u16 {
        match self {
            SectionKind::Sdf => 5,
            SectionKind::CurveZones => 4,
            SectionKind::TreeTurned | SectionKind::TreeSideless => 3,
            SectionKind::TreeMoments => 2,
            _ => u16::from(self.is_deform()),
        }
    }

    /// The value of `meshsweep build --for` that writes the section.
    pub fn build_for(self) -> BuildFor {
        match self {
            SectionKind::TreeBoxes => BuildFor::Segment,
            SectionKind::TreeCones => BuildFor::Cull,
            SectionKind::TreeMoments => BuildFor::Winding,
            SectionKind::Triboxes => BuildFor::Triboxes,
            SectionKind::TightHulls => BuildFor::Tight,
            SectionKind::Sdf => BuildFor::Sdf,
            _ if self.is_curve() => BuildFor::Curve,
            _ if self.is_deform() => BuildFor::Deform,
            _ if self.is_hull() => BuildFor::Hull,
            _ => BuildFor::Closest,
        }
    }

    /// The kind's name as `info` prints it.
    pub fn name(self) -> &'static str {
        match self {
            SectionKind::Vertices => "vertices",
            SectionKind::BaseTriangles => "base triangles",
            SectionKind::Splits => "splits",
            SectionKind::Rings => "rings (split before)",
            SectionKind::Radii => "radii",
            SectionKind::SplitsWith => "splits with",
            SectionKind::SourceStarts => "source starts",
            SectionKind::Source => "source numbers",
            SectionKind::Levels => "levels",
            SectionKind::BaseGroups => "base groups",
            SectionKind::Bvh => "tree header",
            SectionKind::TreeLinks => "tree links",
            SectionKind::TreeFrames => "tree boxes for distances",
            SectionKind::TreeBoxes => "tree boxes for segments",
            SectionKind::TreeFans => "tree fans",
            SectionKind::TreeSource => "tree source numbers",
            SectionKind::TreeCones => "tree normal cones",
            SectionKind::Triboxes => "triboxes",
            SectionKind::TightHulls => "tight hulls",
            SectionKind::Curves => "curves",
            SectionKind::VertexNumbers => "vertex numbers",
            SectionKind::KeyFrames => "key frames",
            SectionKind::TreeMoments => "tree moments",
            SectionKind::TreeTurned => "tree turned triangles",
            SectionKind::TreeSideless => "tree sideless triangles",
            SectionKind::CurveZones => "curve zones",
            SectionKind::Sdf => "distance field",
        }
    }
}

/// A value of `meshsweep build --for`. It prints as that value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BuildFor {
    /// Distances on the box tree.
    Closest,
    /// Segments and overlaps on the box tree.
    Segment,
    /// The hull hierarchy.
    Hull,
    /// Normal cones of the box tree's leaves.
    Cull,
    /// Triboxes.
    Triboxes,
    /// Tight hulls.
    Tight,
    /// Polygonal curves.
    Curve,
    /// A hull hierarchy that deforms.
    Deform,
    /// Moments of the box tree's nodes.
    Winding,
    /// The distance field.
    Sdf,
}

impl core::fmt::Display for BuildFor {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            BuildFor::Closest => "closest",
            BuildFor::Segment => "segment",
            BuildFor::Hull => "hull",
            BuildFor::Cull => "cull",
            BuildFor::Triboxes => "triboxes",
            BuildFor::Tight => "tight",
            BuildFor::Curve => "curve",
            BuildFor::Deform => "deform",
            BuildFor::Winding => "winding",
            BuildFor::Sdf => "sdf",
        })
    }
}

/// How coordinates are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexFormat {
    /// Three f32.
    F32,
    /// Three u16 on the header's grid.
    Grid16,
    /// Three 24-bit unsigned integers on the header's grid.
    Grid24,
}

impl VertexFormat {
    /// The byte that the header stores.
    pub fn code(self) -> u8 {
        match self {
            VertexFormat::F32 => 0,
            VertexFormat::Grid16 => 1,
            VertexFormat::Grid24 => 2,
        }
    }

    /// The format that a header byte names.
    pub const fn from_code(code: u8) -> Option<Self> {
        match code {
            0 => Some(VertexFormat::F32),
            1 => Some(VertexFormat::Grid16),
            2 => Some(VertexFormat::Grid24),
            _ => None,
        }
    }

    /// Bytes of one vertex.
    pub fn vertex_bytes(self) -> usize {
        match self {
            VertexFormat::F32 => 12,
            VertexFormat::Grid16 => 6,
            VertexFormat::Grid24 => 9,
        }
    }
}

/// Bytes of an index into `count` things, 1 to 4. One value is kept for "none".
pub const fn index_bytes(count: usize) -> usize {
    if count <= 0xFF {
        1
    } else if count <= 0xFFFF {
        2
    } else if count <= 0xFF_FFFF {
        3
    } else {
        4
    }
}

/// The value that says "none" in an index of `bytes` bytes.
pub const fn none(bytes: usize) -> u32 {
    match bytes {
        1 => 0xFF,
        2 => 0xFFFF,
        3 => 0xFF_FFFF,
        _ => 0xFFFF_FFFF,
    }
}

/// Offsets in the fixed header.
pub mod field {
    /// First eight bytes.
    pub const MAGIC: usize = 0;
    /// u16.
    pub const VERSION_MAJOR: usize = 8;
    /// u16.
    pub const VERSION_MINOR: usize = 10;
    /// u32: header and section table.
    pub const HEADER_BYTES: usize = 12;
    /// u32: the blob.
    pub const TOTAL_BYTES: usize = 16;
    /// u32.
    pub const SECTION_COUNT: usize = 20;
    /// u32.
    pub const FLAGS: usize = 24;
    /// i32.
    pub const SCALE_EXPONENT: usize = 28;
    /// u8.
    pub const VERTEX_FORMAT: usize = 32;
    /// Three zeros.
    pub const RESERVED_BESIDE_FORMAT: usize = 33;
    /// i32.
    pub const GRID_EXPONENT: usize = 36;
    /// Three i32.
    pub const GRID_ORIGIN: usize = 40;
    /// u32.
    pub const VERTICES: usize = 52;
    /// u32.
    pub const BASE_VERTICES: usize = 56;
    /// u32.
    pub const BASE_TRIANGLES: usize = 60;
    /// u32.
    pub const SPLITS: usize = 64;
    /// u32.
    pub const RINGS: usize = 68;
    /// Four zeros.
    pub const RESERVED_BESIDE_RINGS: usize = 72;
    /// u32.
    pub const SURFACE_TRIANGLES: usize = 76;
    /// u32.
    pub const LEVELS: usize = 80;
    /// u32.
    pub const INPUT_TRIANGLES: usize = 84;
    /// f32.
    pub const SURFACE_ERROR: usize = 88;
    /// Six f32: least corner, greatest corner.
    pub const HULL_BOX: usize = 92;
    /// Six f32: least corner, greatest corner.
    pub const SURFACE_BOX: usize = 116;
    /// u32.
    pub const QUEUE_CAPACITY: usize = 140;
    /// u32.
    pub const DEPENDENCY_DEPTH: usize = 144;
    /// Eight zeros.
    pub const RESERVED: usize = 148;
    /// u32: of the header with this field left out, and of the section table.
    pub const CRC: usize = 156;
}

/// Offsets in an entry of the section table.
pub mod entry {
    /// u32.
    pub const KIND: usize = 0;
    /// u32.
    pub const OFFSET: usize = 4;
    /// u32.
    pub const BYTES: usize = 8;
    /// u32.
    pub const CRC: usize = 12;
}
