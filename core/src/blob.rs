//! Opening a blob: header, section table and CRCs, then the contents of the sections in `check`.

use crate::format::layout::SectionKind;
use crate::format::{Bytes, place_sections, read_header, section};
pub use crate::hull::format::Model;
use crate::hull::format::{Vertices, Widths};
pub use crate::tight::format::{TightHull, TightHulls};
pub use crate::tribox::format::Triboxes;

// Old paths, until the callers have moved.
#[doc(hidden)]
pub mod layout {
    pub use crate::bvh::format::layout::{
        BOXES_BYTES, CONE_BYTES, FAN_PADDING, FRAME_BYTES, LINK_BYTES, SOURCE_BLOCK,
        SOURCE_ENTRY_BYTES, SOURCE_PADDING, TREE_BYTES, TREE_CLOSED, TREE_SINGLE,
    };
    pub use crate::format::layout::field::CRC as HEADER_CRC_AT;
    pub use crate::format::layout::*;
    pub use crate::geom::fan::WIDTH;
    pub use crate::hull::format::layout::{
        BASE_GROUP, LEAF_FLAG, LEVEL_BYTES, MAX_CHILDREN, MAX_RING,
    };
    pub use crate::tight::format::layout::{TIGHT_BYTES, TIGHT_HULL_BYTES, TIGHT_NESTED};
    pub use crate::tribox::format::layout::{
        MAX_TRIBOX_DEPTH, MAX_TRIBOXES, TRIBOX_BYTES, TRIBOX_LEVEL_BYTES, TRIBOX_SPLIT_BYTES,
        TRIBOXES_BYTES, TRIBOXES_SOLID,
    };
}
#[doc(hidden)]
pub use crate::bvh::format::{
    Bvh, BvhChild, BvhHeader, CORNERS, FanLeaf, GridRing, LeafShape, Links,
};
#[doc(hidden)]
pub use crate::format::{Header, OpenError, Section, section_crc};
#[doc(hidden)]
pub use crate::hull::format::{
    Capacities, Children, Level, Node, NodeIdx, Split, SplitIdx, TriIdx, VertIdx,
};
#[doc(hidden)]
pub use crate::tight::format::TightRecord;
#[doc(hidden)]
pub use crate::tribox::format::{TriboxLevel, TriboxesHeader};

impl<'a> Model<'a> {
    /// Opens a blob where it lies, and checks all of it: CRCs, every index, every coordinate, every
    /// order that the queries rely on. Any bytes are safe to open.
    ///
    /// Cost: linear in the blob, no allocation; once per start, not per query. Alignment of `bytes`
    /// does not matter. A program that only asks the box tree links less code with
    /// [`Bvh::open`], one that only asks triboxes with [`Triboxes::open`], one that only asks
    /// tight hulls with [`TightHulls::open`].
    ///
    /// # Errors
    /// [`OpenError`] says what was wanted and what was found.
    pub fn open(bytes: &'a [u8]) -> Result<Model<'a>, OpenError> {
        let header = read_header(bytes)?;
        let all = Bytes(bytes);
        let mut model = Model {
            header,
            widths: Widths::of(&header),
            bytes: all,
            vertices: Vertices::new(header.vertex_format, &[]),
            base: Bytes(&[]),
            groups: Bytes(&[]),
            splits: Bytes(&[]),
            rings: Bytes(&[]),
            radii: Bytes(&[]),
            splits_with: Bytes(&[]),
            cover: Bytes(&[]),
            surface: Bytes(&[]),
            source: Bytes(&[]),
            levels: Bytes(&[]),
        };
        let seen =
            place_sections(&header, all, true, SectionKind::is_hull, |index, kind, data| {
                if Some(data.len()) != model.section_len(kind) {
                    return Err(OpenError::Section { index });
                }
                model.place(kind, data);
                Ok(())
            })?;
        let has = |kind: SectionKind| seen.checked_shr(kind as u32).unwrap_or(0) & 1 != 0;
        let missing = SectionKind::ALL
            .into_iter()
            .filter(|kind| kind.is_hull())
            .find(|&kind| !has(kind) && model.section_len(kind) != Some(0));
        if let Some(section) = missing {
            return Err(OpenError::MissingSection { section });
        }
        // Any section of a tree needs the others.
        if SectionKind::ALL.into_iter().any(|kind| kind.is_tree() && has(kind)) {
            Bvh::open(bytes)?;
        }
        if has(SectionKind::Triboxes) {
            Triboxes::open(bytes)?;
        }
        if has(SectionKind::TightHulls) {
            TightHulls::open(bytes)?;
        }
        let others = [SectionKind::Bvh, SectionKind::Triboxes, SectionKind::TightHulls];
        if others.into_iter().any(has) && !model.has_hull() {
            model.check_without_hull()?;
        } else {
            model.check()?;
        }
        Ok(model)
    }

    /// Sections of the blob, in file order. Entries of a kind that this version does not know are
    /// passed over.
    pub fn sections(&self) -> impl Iterator<Item = Section> + '_ {
        (0..self.header.section_count).filter_map(|index| section(self.bytes, index).ok().flatten())
    }

    /// The box tree, if the blob has one.
    pub fn tree(&self) -> Option<Bvh<'a>> {
        // `open` has checked it.
        Bvh::view(self.bytes.0).ok()
    }

    /// The tribox hierarchy, if the blob has one.
    pub fn triboxes(&self) -> Option<Triboxes<'a>> {
        // `open` has checked it.
        Triboxes::view(self.bytes.0).ok()
    }

    /// The tight hulls, if the blob has them.
    pub fn tight_hulls(&self) -> Option<TightHulls<'a>> {
        // `open` has checked them.
        TightHulls::view(self.bytes.0).ok()
    }

    /// Whether the blob has a hull hierarchy and cover tree. Without, [`tree`](Self::tree),
    /// [`triboxes`](Self::triboxes) or [`tight_hulls`](Self::tight_hulls) are there.
    pub fn has_hull(&self) -> bool {
        self.header.nodes != 0
    }

    fn place(&mut self, kind: SectionKind, data: &'a [u8]) {
        let slot = match kind {
            SectionKind::Vertices => {
                self.vertices = Vertices::new(self.header.vertex_format, data);
                return;
            }
            SectionKind::BaseTriangles => &mut self.base,
            SectionKind::BaseGroups => &mut self.groups,
            SectionKind::Splits => &mut self.splits,
            SectionKind::Rings => &mut self.rings,
            SectionKind::Radii => &mut self.radii,
            SectionKind::SplitsWith => &mut self.splits_with,
            SectionKind::Cover => &mut self.cover,
            SectionKind::Surface => &mut self.surface,
            SectionKind::Source => &mut self.source,
            SectionKind::Levels => &mut self.levels,
            _ => return,
        };
        *slot = Bytes(data);
    }
}
