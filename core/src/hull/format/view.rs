//! Checked views of an opened blob.
//!
//! If [`Hull::open`] returned `Ok`, then every index that the blob stores is in range, every ring
//! vertex exists before its split, and every coordinate is finite. Accessors return `Option` all
//! the same. An index past the end gives `None` (or some record, where its byte offset wraps on a
//! 32-bit target). No path can panic.

use super::index::{SplitIdx, TriIdx, VertIdx};
use super::layout::{LEFT_BEFORE, LEVEL_BYTES, RIGHT_BEFORE, RIGHT_WING, level};
use crate::format::layout::{FLAG_CUT, FLAG_SWEEP_ONLY, VertexFormat, none};
use crate::format::{Bytes, Header};
use crate::geom::Aabb;
use crate::num::{Radius8, Radius16, exp2, up_to_f32};
use glam::Vec3;

/// The hull hierarchy of a blob: nested outer hulls under split tables; or meshes near an open
/// surface, see [`encloses`](Hull::encloses). Copies are cheap: it borrows the bytes and holds the
/// header.
#[derive(Clone, Copy, Debug)]
pub struct Hull<'a> {
    pub(crate) header: Header,
    /// The blob's [`checksum`](crate::Blob::checksum), which names its contents.
    pub(crate) checksum: u32,
    pub(crate) widths: Widths,
    pub(crate) vertices: Vertices<'a>,
    pub(crate) base: Bytes<'a>,
    pub(crate) groups: Bytes<'a>,
    pub(crate) splits: Bytes<'a>,
    pub(crate) rings: Bytes<'a>,
    pub(crate) radii: Bytes<'a>,
    pub(crate) splits_with: Bytes<'a>,
    pub(crate) source_starts: Bytes<'a>,
    pub(crate) source: Bytes<'a>,
    pub(crate) levels: Bytes<'a>,
}

/// Records of the vertex section.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Vertices<'a> {
    F32(&'a [[u8; 12]]),
    Grid16(&'a [[u8; 6]]),
    Grid24(&'a [[u8; 9]]),
}

impl<'a> Vertices<'a> {
    /// The section's bytes as records. Bytes past the last whole record are not read.
    pub(crate) fn new(format: VertexFormat, bytes: &'a [u8]) -> Self {
        match format {
            VertexFormat::F32 => Vertices::F32(bytes.as_chunks().0),
            VertexFormat::Grid16 => Vertices::Grid16(bytes.as_chunks().0),
            VertexFormat::Grid24 => Vertices::Grid24(bytes.as_chunks().0),
        }
    }
}

/// Widths and scales that the header implies, worked out once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Widths {
    pub(crate) vertex: usize,
    pub(crate) split: usize,
    pub(crate) ring: usize,
    pub(crate) start: usize,
    pub(crate) grid_step: f32,
}

impl Widths {
    pub(crate) fn of(header: &Header) -> Self {
        Widths {
            vertex: header.vertex_index_bytes(),
            split: header.split_index_bytes(),
            ring: header.ring_index_bytes(),
            start: header.start_index_bytes(),
            grid_step: exp2(header.grid_exponent) as f32,
        }
    }
}

/// One vertex split: the inverse of an edge collapse (Guéziec 2000, 4.2; Platis & Theoharis 2003,
/// 3.2.1).
///
/// With ring `r[0..k]` counter-clockwise and right wing `m`, the star `(v, r[i], r[i+1])` of
/// `vertex` becomes `(o, r[i], r[i+1])` for `i < m`, `(d, r[i], r[i+1])` for `i ≥ m`, `(o, r[m],
/// d)` and `(o, d, r[0])`.
#[derive(Clone, Copy, Debug)]
pub struct Split<'a> {
    /// The vertex that is replaced.
    pub vertex: VertIdx,
    /// First of the two new vertices; the other is the next.
    pub origin: VertIdx,
    /// Position of the right wing in the ring; the left wing is at 0.
    pub right: usize,
    /// The triangle `(o, r[m], d)` at the right wing `m` stands for a part of what `(v, r[i],
    /// r[i+1])` stands for, where `i` is this: `m` or `m − 1`.
    pub right_parent: usize,
    /// Position in the ring of the coarse triangle whose part `(o, d, r[0])` shares: 0 or the
    /// ring's last.
    pub left_parent: usize,
    /// No point of the fine triangles is farther than this from `vertex`, local frame.
    pub star_radius: f32,
    /// The largest finite certified radius of the triangles that the split removes, local frame.
    pub error: f32,
    /// Number of the split's first triangle, for [`Hull::radius`].
    pub first_triangle: u32,
    ring: Bytes<'a>,
    width: usize,
    len: usize,
}

impl Split<'_> {
    /// Vertices of the ring.
    #[inline(always)]
    pub fn ring_len(&self) -> usize {
        self.len
    }

    /// Ring vertex `i`, `i ≤ ring_len`. The last is the first again.
    #[inline(always)]
    pub fn ring(&self, i: usize) -> Option<VertIdx> {
        let i = if i == self.len { 0 } else { i };
        self.ring.nth(i, self.width).map(VertIdx)
    }

    /// Where a vertex stands in the ring.
    #[inline(always)]
    pub fn find(&self, vertex: VertIdx) -> Option<usize> {
        if self.width == 2 {
            let wanted = u16::try_from(vertex.0).ok()?.to_le_bytes();
            return self.ring.0.as_chunks().0.iter().position(|held| *held == wanted);
        }
        (0..self.len).find(|&i| self.ring(i) == Some(vertex))
    }

    /// Second of the two new vertices.
    #[inline(always)]
    pub fn destination(&self) -> VertIdx {
        VertIdx(self.origin.0.wrapping_add(1))
    }

    /// Corners of coarse triangle `i < ring_len`, which the split removes.
    #[inline]
    pub fn coarse(&self, i: usize) -> Option<[VertIdx; 3]> {
        if i < self.len { Some([self.vertex, self.ring(i)?, self.ring(i + 1)?]) } else { None }
    }

    /// Triangles that the split brings: `ring_len + 2`.
    #[inline(always)]
    pub fn fine_len(&self) -> usize {
        self.len + 2
    }

    /// Corners of fine triangle `slot < fine_len`.
    #[inline(always)]
    pub fn fine(&self, slot: usize) -> Option<[VertIdx; 3]> {
        if slot < self.len {
            let apex = if slot < self.right { self.origin } else { self.destination() };
            Some([apex, self.ring(slot)?, self.ring(slot + 1)?])
        } else if slot == self.len {
            Some([self.origin, self.ring(self.right)?, self.destination()])
        } else if slot == self.len + 1 {
            Some([self.origin, self.destination(), self.ring(0)?])
        } else {
            None
        }
    }
}

/// One level of the hierarchy: the hull after the first `splits` splits. Lengths in the local
/// frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HullLevel {
    /// Triangles of the hull.
    pub faces: u32,
    /// Splits that make it from the base hull.
    pub splits: u32,
    /// No point of the hull is farther than this from the surface.
    pub hull_to_surface: f32,
    /// No point of the surface is farther than this from a triangle that stands for it.
    pub surface_to_hull: f32,
    /// Volume between hull and surface over the surface's volume.
    pub void_ratio: f32,
}

/// Three f32.
#[inline(always)]
pub(super) fn single(&[a, b, c, d, e, f, g, h, i, j, k, l]: &[u8; 12]) -> Vec3 {
    Vec3::new(
        f32::from_le_bytes([a, b, c, d]),
        f32::from_le_bytes([e, f, g, h]),
        f32::from_le_bytes([i, j, k, l]),
    )
}

impl Hull<'_> {
    /// With this many scratch entries [`closest_point`](Self::closest_point),
    /// [`first_hit`](Self::first_hit) and [`all_hits`](Self::all_hits) never end for lack of
    /// memory. Overlaps need [`overlap_entries`](Self::overlap_entries), and a sweep that is kept
    /// needs [`sweep_entries`](Self::sweep_entries).
    pub fn scratch_entries(&self) -> usize {
        self.header.queue_capacity as usize
    }

    /// With this many scratch entries a [`Sweep`](crate::Sweep) never ends for lack of memory,
    /// wherever its point is: one for each triangle of the surface, or of the finest hull of a cut
    /// blob.
    pub fn sweep_entries(&self) -> usize {
        // Triangles that wait stand for different parts of the surface. So no more wait than there
        // are triangles that nothing refines.
        let finest = || self.levels().last().map_or(0, |level| level.faces);
        if self.is_cut() { finest() as usize } else { self.triangle_count() as usize }
    }

    /// Splits of the hierarchy. A [`RefinedHull`](crate::RefinedHull) of as many can be refined to
    /// the surface.
    pub fn split_count(&self) -> u32 {
        self.header.splits
    }

    /// Least and greatest corner of the surface's box, input units, rounded to f32.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        self.header.surface_box.map(|corner| corner.map(|x| (f64::from(x) * self.scale()) as f32))
    }

    /// Triangles of the surface. 0 of a cut blob.
    pub fn triangle_count(&self) -> u32 {
        self.header.surface_triangles
    }

    /// No point of the input surface is farther than this from the stored surface, nor the reverse.
    /// Input units, rounded up.
    pub fn surface_error(&self) -> f32 {
        up_to_f32(f64::from(self.header.surface_error) * self.scale())
    }

    /// Whether finer levels were cut off. Then answers are intervals as wide as the level's error.
    pub fn is_cut(&self) -> bool {
        self.header.flags & FLAG_CUT != 0
    }

    /// Whether every level encloses the surface as it is stored. The input may stick out by
    /// [`surface_error`](Self::surface_error), where that is not 0. The levels of a blob that was
    /// built with `--for sweep` lie near the surface, on both sides of it. Its distances and hits
    /// are as true.
    #[inline(always)]
    pub fn encloses(&self) -> bool {
        self.header.flags & FLAG_SWEEP_ONLY == 0
    }

    /// A level, 0 being the base hull and the last the finest that the blob holds.
    pub fn level(&self, index: u32) -> Option<HullLevel> {
        let at = (index as usize).checked_mul(LEVEL_BYTES)?;
        Some(HullLevel {
            faces: self.levels.u32(at + level::FACES)?,
            splits: self.levels.u32(at + level::SPLITS)?,
            hull_to_surface: self.levels.f32(at + level::HULL_TO_SURFACE)?,
            surface_to_hull: self.levels.f32(at + level::SURFACE_TO_HULL)?,
            void_ratio: self.levels.f32(at + level::VOID_RATIO)?,
        })
    }

    /// Levels, coarse to fine.
    pub fn levels(&self) -> impl Iterator<Item = HullLevel> + '_ {
        (0..self.header.levels).map_while(|index| self.level(index))
    }

    /// Coordinates of a vertex, input units, rounded to f32.
    pub fn vertex(&self, vertex: VertIdx) -> Option<[f32; 3]> {
        let position = self.position(vertex)?;
        Some((position.as_dvec3() * self.scale()).to_array().map(|x| x as f32))
    }
}

/// The records, for the builder and the checker.
#[doc(hidden)]
impl<'a> Hull<'a> {
    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Coordinates of a vertex, local frame.
    #[inline(always)]
    pub fn position(&self, vertex: VertIdx) -> Option<Vec3> {
        match self.vertices {
            Vertices::F32(records) => records.get(vertex.usize()).map(single),
            Vertices::Grid16(records) => {
                self.on_grid(Bytes(records.get(vertex.usize())?).index3(0, 2)?)
            }
            Vertices::Grid24(records) => {
                self.on_grid(Bytes(records.get(vertex.usize())?).index3(0, 3)?)
            }
        }
    }

    /// Exact: `open` made sure that every sum fits in 24 bits.
    #[inline(always)]
    fn on_grid(&self, stored: [u32; 3]) -> Option<Vec3> {
        let [x, y, z] = stored;
        let [ox, oy, oz] = self.header.grid_origin;
        let coordinate =
            |s: u32, o: i32| s.cast_signed().wrapping_add(o) as f32 * self.widths.grid_step;
        Some(Vec3::new(coordinate(x, ox), coordinate(y, oy), coordinate(z, oz)))
    }

    /// Coordinates of three vertices.
    #[inline(always)]
    pub fn positions(&self, [a, b, c]: [VertIdx; 3]) -> Option<[Vec3; 3]> {
        if let Vertices::F32(records) = self.vertices {
            // Reads the format once for three corners: this is the innermost loop of every query.
            return Some([
                single(records.get(a.usize())?),
                single(records.get(b.usize())?),
                single(records.get(c.usize())?),
            ]);
        }
        Some([self.position(a)?, self.position(b)?, self.position(c)?])
    }

    /// Corners of a triangle of the base hull.
    #[inline(always)]
    pub fn base_triangle(&self, index: u32) -> Option<[VertIdx; 3]> {
        let at = (index as usize).wrapping_mul(3 * self.widths.vertex);
        self.base.index3(at, self.widths.vertex).map(|corners| corners.map(VertIdx))
    }

    /// Swept triangle that contains base triangles `16·index .. 16·(index + 1)` and their parts of
    /// the surface: corners and radius.
    #[inline]
    pub fn base_group(&self, index: u32) -> Option<([VertIdx; 3], f32)> {
        let width = self.widths.vertex;
        let at = (index as usize).checked_mul(3 * width + 2)?;
        let corners = self.groups.index3(at, width)?.map(VertIdx);
        Some((corners, Radius16(self.groups.u16(at + 3 * width)?).get()))
    }

    /// Triangles of the surface before those of split `8·index`.
    #[inline]
    pub fn source_start(&self, index: u32) -> Option<u32> {
        let width = self.widths.start;
        self.source_starts.index((index as usize).checked_mul(width)?, width)
    }

    /// Number of a surface triangle in the input file.
    #[inline(always)]
    pub fn source(&self, triangle: TriIdx) -> Option<u32> {
        let width = self.header.source_index_bytes();
        self.source.index(triangle.usize().checked_mul(width)?, width)
    }

    /// A vertex split ("splits with" gives its number).
    #[inline(always)]
    pub fn split(&self, split: SplitIdx) -> Option<Split<'a>> {
        let i = split.usize();
        let Widths { vertex: wv, ring: wr, .. } = self.widths;
        let bytes = wv + wr + 3;
        let at = i.wrapping_mul(bytes);
        let vertex = VertIdx(self.splits.index(at, wv)?);
        let start = self.splits.index(at + wv, wr)?;
        let wings = self.splits.u8(at + wv + wr)?;
        let right = usize::from(wings & RIGHT_WING);
        let star_radius = Radius8(self.splits.u8(at + wv + wr + 1)?).get();
        let error = Radius8(self.splits.u8(at + wv + wr + 2)?).get();
        let end = if split.0.checked_add(1)? < self.header.splits {
            self.splits.index(at + bytes + wv, wr)?
        } else {
            self.header.rings
        };
        let len = end.checked_sub(start)? as usize;
        let ring = self.rings.slice((start as usize).wrapping_mul(wv), len.wrapping_mul(wv))?;
        Some(Split {
            vertex,
            origin: VertIdx(self.header.base_vertices.checked_add(split.0.checked_mul(2)?)?),
            right,
            right_parent: right.wrapping_sub(usize::from(wings & RIGHT_BEFORE != 0)),
            left_parent: if wings & LEFT_BEFORE != 0 { len.wrapping_sub(1) } else { 0 },
            star_radius,
            error,
            first_triangle: self
                .header
                .base_triangles
                .checked_add(start)?
                .checked_add(split.0.checked_mul(2)?)?,
            ring: Bytes(ring),
            width: wv,
            len,
        })
    }

    /// The split that replaces a vertex ("splits with"), `None` for a vertex of the surface and
    /// beyond a cut.
    #[inline(always)]
    pub fn split_of(&self, vertex: VertIdx) -> Option<SplitIdx> {
        self.stored_split(self.stored_split_of(vertex)?)
    }

    /// "Splits with" as it is stored. "None" is greater than any split.
    #[inline(always)]
    pub(crate) fn stored_split_of(&self, vertex: VertIdx) -> Option<u32> {
        self.splits_with.nth(vertex.usize(), self.widths.split)
    }

    /// The split of a stored number.
    #[inline(always)]
    pub(crate) fn stored_split(&self, stored: u32) -> Option<SplitIdx> {
        if stored == none(self.widths.split) { None } else { Some(SplitIdx(stored)) }
    }

    /// The split that brings a vertex ("split before", as a vertex of a ring), `None` for the base
    /// hull's.
    #[inline(always)]
    pub fn made_by(&self, vertex: VertIdx) -> Option<SplitIdx> {
        vertex.0.checked_sub(self.header.base_vertices).map(|past_base| SplitIdx(past_base / 2))
    }

    /// Whether a vertex is the first (0) or the second (1) that its split brings.
    #[inline(always)]
    pub(crate) fn which(&self, vertex: VertIdx) -> u32 {
        vertex.0.wrapping_sub(self.header.base_vertices) & 1
    }

    /// The vertex that a split brings first (0) or second (1).
    #[inline(always)]
    pub(crate) fn brought_by(&self, split: SplitIdx, which: u32) -> VertIdx {
        VertIdx(self.header.base_vertices.wrapping_add(split.0.wrapping_mul(2)).wrapping_add(which))
    }

    /// The vertex that a split replaces, without the rest of its record.
    #[inline(always)]
    pub(crate) fn replaced_by(&self, split: SplitIdx) -> Option<VertIdx> {
        let Widths { vertex: wv, ring: wr, .. } = self.widths;
        self.splits.index(split.usize().wrapping_mul(wv + wr + 3), wv).map(VertIdx)
    }

    /// Star radius and error of a split, without the rest of its record.
    #[inline(always)]
    pub(crate) fn star_radius_and_error(&self, split: SplitIdx) -> Option<[f32; 2]> {
        let bytes = self.widths.vertex + self.widths.ring + 3;
        let at = split.usize().wrapping_mul(bytes).wrapping_add(bytes - 2);
        let [star_radius, error] = self.splits.array::<2>(at)?;
        Some([Radius8(star_radius).get(), Radius8(error).get()])
    }

    /// Certified radius of a triangle of any level, local frame: base triangles first, then those
    /// of each split ([`Split::first_triangle`]). The triangle swept by it contains its part of the
    /// surface.
    #[inline(always)]
    pub fn radius(&self, triangle: u32) -> Option<f32> {
        self.radii.u8(triangle as usize).map(|code| Radius8(code).get())
    }

    /// Whether a triangle stands for a part of the surface. Its number is that of its radius.
    #[inline(always)]
    pub(crate) fn has_part(&self, triangle: u32) -> bool {
        self.encloses() || self.radius(triangle).is_some_and(f32::is_finite)
    }

    /// Box of every vertex of every level, local frame.
    pub(crate) fn hull_box(&self) -> Aabb {
        Aabb::of(self.header.hull_box)
    }

    /// Whether there is a hull hierarchy. Always, of a view that [`Hull::open`] returned.
    pub fn has_hull(&self) -> bool {
        self.header.base_triangles != 0
    }

    /// Input units of one unit of the local frame: a power of two.
    #[inline]
    pub fn scale(&self) -> f64 {
        exp2(self.header.scale_exponent)
    }
}
