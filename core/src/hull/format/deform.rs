//! The sections of a hull hierarchy that deforms: numbers of vertices, and key frames.

use super::index::VertIdx;
use super::layout::{KEY_BYTES, KEYS_HEADER_BYTES, MAX_KEYS, NUMBERS_HEADER_BYTES, key};
use super::view::Hull;
use crate::format::Contradiction;
use crate::format::layout::{SectionKind, index_bytes};
use crate::format::{Bytes, OpenError, SectionTable};
use crate::geom::Aabb;
use crate::num::Radius8;
use crate::num::tolerance::DEFORM_COARSE;
use glam::Vec3;

/// The hull hierarchy of a mesh that deforms: between key frames ([`at_frame`]), or by any
/// motion of its vertices ([`moved`]). Copies are cheap: it borrows the bytes and holds the header.
///
/// [`at_frame`]: DeformableHull::at_frame
/// [`moved`]: DeformableHull::moved
#[derive(Clone, Copy, Debug)]
pub struct DeformableHull<'a> {
    hull: Hull<'a>,
    numbers: Bytes<'a>,
    keys: Bytes<'a>,
}

/// A key frame but the first, which is the hull as it is stored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key<'a> {
    /// No vertex of the file's mesh is farther than this from the stored one.
    pub(crate) error: f32,
    /// Box of every vertex of every level.
    pub(crate) vertex_box: Aabb,
    vertices: &'a [[u8; 12]],
    radii: Bytes<'a>,
}

impl Key<'_> {
    #[inline(always)]
    pub(crate) fn position(&self, vertex: VertIdx) -> Option<Vec3> {
        self.vertices.get(vertex.usize()).map(super::view::single)
    }

    /// See [`Hull::radius`].
    #[inline(always)]
    pub(crate) fn radius(&self, triangle: u32) -> Option<f32> {
        self.radii.u8(triangle as usize).map(|code| Radius8(code).get())
    }
}

impl<'a> DeformableHull<'a> {
    /// Opens the hull hierarchy of a blob and checks all of it, as [`Hull::open`], and what it
    /// needs to deform. Any bytes are safe to open.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was not built `--for deform`.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<DeformableHull<'a>, OpenError> {
        let hull = Hull::open(bytes)?;
        let table = SectionTable::view(bytes)?;
        table.check_crcs(SectionKind::is_deform)?;
        let opened = DeformableHull::locate(hull, &table)?;
        opened.check()?;
        Ok(opened)
    }

    /// A view of a blob that was checked before.
    pub(crate) fn view(bytes: &'a [u8]) -> Result<DeformableHull<'a>, OpenError> {
        let table = SectionTable::view(bytes)?;
        DeformableHull::locate(Hull::locate(&table)?, &table)
    }

    fn locate(hull: Hull<'a>, table: &SectionTable<'a>) -> Result<Self, OpenError> {
        let section = |kind: SectionKind, wanted: fn(&Hull<'_>, Bytes<'_>) -> Option<usize>| {
            let data = Bytes(table.bytes(kind));
            let is_whole = !table.has(kind) || wanted(&hull, data) == Some(data.len());
            if is_whole { Ok(data) } else { Err(table.malformed(kind)) }
        };
        let numbers = section(SectionKind::VertexNumbers, numbers_len)?;
        let keys = section(SectionKind::KeyFrames, keys_len)?;
        if numbers.len() == 0 {
            return Err(OpenError::MissingSection { section: SectionKind::VertexNumbers });
        }
        Ok(DeformableHull { hull, numbers, keys })
    }

    fn check(&self) -> Result<(), OpenError> {
        if self.hull.is_cut() {
            return Err(OpenError::Counts { what: Contradiction::DeformsWhileCut });
        }
        for rank in 0..surface_vertices(&self.hull) {
            if self.number(rank).is_none_or(|number| number >= self.input_vertices()) {
                let section = SectionKind::VertexNumbers;
                return Err(OpenError::Record { section, index: rank });
            }
        }
        for index in 1..self.frames() {
            let bad = OpenError::Record { section: SectionKind::KeyFrames, index };
            let key = self.key(index).ok_or(bad)?;
            let Aabb { min, max } = key.vertex_box;
            let is_box =
                min.cmple(max).all() && min.abs().max(max.abs()).max_element() <= DEFORM_COARSE;
            let is_error = key.error >= 0.0 && key.error.is_finite();
            if !is_box || !is_error {
                return Err(bad);
            }
            for vertex in 0..self.hull.header().vertices {
                let inside = key
                    .position(VertIdx(vertex))
                    .is_some_and(|p| p.cmpge(min).all() && p.cmple(max).all());
                if !inside {
                    return Err(bad);
                }
            }
            // A triangle stands for a part of the surface at every frame, or at none.
            let mut triangle = 0;
            while let (Some(at_rest), false) = (self.hull.radius(triangle), self.hull.encloses()) {
                let at_key = key.radius(triangle).ok_or(bad)?;
                if at_key.is_finite() != at_rest.is_finite() {
                    return Err(bad);
                }
                triangle = triangle.wrapping_add(1);
            }
        }
        Ok(())
    }

    /// The hull at rest, which answers all questions of a hull hierarchy. It is that of the first
    /// mesh.
    pub fn rest(&self) -> Hull<'a> {
        self.hull
    }

    /// The same where it lies.
    #[inline(always)]
    pub(crate) fn tables(&self) -> &Hull<'a> {
        &self.hull
    }

    /// With this many scratch entries no closest point ends for lack of memory.
    pub fn scratch_entries(&self) -> usize {
        self.hull.scratch_entries()
    }

    /// Vertices of the input file. [`MovedHull::update`](crate::MovedHull::update) asks for the
    /// places of some of these numbers.
    pub fn input_vertices(&self) -> u32 {
        self.numbers.u32(0).unwrap_or(0)
    }

    /// Vertex records that a moved hull needs: one for each vertex of each level.
    pub fn vertex_records(&self) -> usize {
        self.hull.header().vertices as usize
    }

    /// Key frames of the blob, the mesh at rest among them; 1 of a blob that was built from one
    /// mesh. Frames count from 0.
    pub fn frames(&self) -> u32 {
        self.keys.u32(0).map_or(1, |others| others.saturating_add(1))
    }

    /// Number in the input file of a vertex of the surface, by its rank among those.
    #[inline(always)]
    pub(crate) fn number(&self, rank: u32) -> Option<u32> {
        let width = index_bytes(self.input_vertices() as usize);
        let at = (rank as usize).wrapping_mul(width).wrapping_add(NUMBERS_HEADER_BYTES);
        self.numbers.index(at, width)
    }

    /// A key frame from 1 on.
    pub(crate) fn key(&self, frame: u32) -> Option<Key<'a>> {
        let count = self.keys.u32(0)? as usize;
        let index = (frame as usize).checked_sub(1).filter(|&index| index < count)?;
        let head = KEYS_HEADER_BYTES + index * KEY_BYTES;
        let [vertices, radii] = key_body(&self.hull)?;
        let body = KEYS_HEADER_BYTES + count * KEY_BYTES;
        let at = body.checked_add(index.checked_mul(vertices.checked_add(radii)?)?)?;
        let corner = |field: usize| {
            self.keys.u32x3(head + field).map(|bits| Vec3::from_array(bits.map(f32::from_bits)))
        };
        Some(Key {
            error: self.keys.f32(head + key::ERROR)?,
            vertex_box: Aabb { min: corner(key::BOX)?, max: corner(key::BOX + 12)? },
            vertices: self.keys.slice(at, vertices)?.as_chunks().0,
            radii: Bytes(self.keys.slice(at.checked_add(vertices)?, radii)?),
        })
    }
}

/// The records, for the builder and the checker.
#[doc(hidden)]
impl DeformableHull<'_> {
    /// See [`number`](Self::number).
    pub fn vertex_number(&self, rank: u32) -> Option<u32> {
        self.number(rank)
    }
}

/// Vertices that no split replaces.
fn surface_vertices(hull: &Hull<'_>) -> u32 {
    hull.header().vertices.saturating_sub(hull.header().splits)
}

fn numbers_len(hull: &Hull<'_>, numbers: Bytes<'_>) -> Option<usize> {
    let each = index_bytes(numbers.u32(0)? as usize);
    (surface_vertices(hull) as usize).checked_mul(each)?.checked_add(NUMBERS_HEADER_BYTES)
}

/// Bytes of the vertices and of the radii of one key frame.
fn key_body(hull: &Hull<'_>) -> Option<[usize; 2]> {
    let vertices = (hull.header().vertices as usize).checked_mul(12)?;
    Some([vertices, hull.section_len(SectionKind::Radii)?])
}

fn keys_len(hull: &Hull<'_>, keys: Bytes<'_>) -> Option<usize> {
    let count = keys.u32(0).filter(|count| (1..MAX_KEYS).contains(count))? as usize;
    let [vertices, radii] = key_body(hull)?;
    let each = vertices.checked_add(radii)?.checked_add(KEY_BYTES)?;
    each.checked_mul(count)?.checked_add(KEYS_HEADER_BYTES)
}
