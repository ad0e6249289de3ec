//! Checked views of tight hulls: outer hulls of few faces, each with a box tree of its own and a
//! certified distance from each face to the mesh.
//!
//! If [`TightHulls::open`] returned `Ok`, then every hull's tree is one that [`Bvh::open`]
//! accepts, has as many triangles as the hull has faces, and every distance is finite and at least
//! 0. Accessors return `Option` all the same. No path can panic.

use super::layout::{TIGHT_HULL_BYTES, record};
use crate::bvh::tree::format::Bvh;
use crate::format::{Bytes, some};
use crate::num::Radius16;
use crate::num::lesser;

/// The record of a tight hull. Lengths are in input units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TightRecord {
    /// Faces.
    pub faces: u32,
    /// No point of the hull is farther than this from the mesh.
    pub slack: f32,
    /// No point of the mesh is farther than this from the hull.
    pub depth: f32,
    /// Excess of the hull's volume over the mesh's, divided by the mesh's. 0 if the mesh bounds no
    /// volume.
    pub void_ratio: f32,
}

/// The tight hulls of a blob, coarse to fine. Copies are cheap: it borrows the bytes.
#[derive(Clone, Copy, Debug)]
pub struct TightHulls<'a> {
    pub(crate) records: &'a [[u8; TIGHT_HULL_BYTES]],
    /// The section.
    pub(crate) data: Bytes<'a>,
}

/// A tight hull: a closed surface of few triangles that encloses the mesh, and bounds of its
/// distance from the mesh.
///
/// Its [box tree](Self::bvh) answers every question about the hull itself: whether two hulls
/// [overlap](Bvh::overlap), where a segment [enters](Bvh::first_hit). Its own methods answer about
/// the mesh inside. Copies are cheap.
#[derive(Clone, Copy, Debug)]
pub struct TightHull<'a> {
    pub(crate) bvh: Bvh<'a>,
    pub(crate) record: TightRecord,
    pub(crate) slacks: &'a [[u8; 2]],
    pub(crate) bytes: &'a [u8],
}

/// Places of a hull's parts in the section.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) offset: u32,
    pub(crate) bytes: u32,
}

/// A record of the table.
pub(crate) const fn read(record: &[u8; TIGHT_HULL_BYTES]) -> (Place, TightRecord) {
    let bytes = Bytes(record);
    let place = Place { offset: bytes.word(record::OFFSET), bytes: bytes.word(record::BYTES) };
    let of = TightRecord {
        faces: bytes.word(record::FACES),
        slack: f32::from_bits(bytes.word(record::SLACK)),
        depth: f32::from_bits(bytes.word(record::DEPTH)),
        void_ratio: f32::from_bits(bytes.word(record::VOID_RATIO)),
    };
    (place, of)
}

impl TightRecord {
    /// Writes the record. The hull's blob lies at `offset` in the section and has this many
    /// `bytes`.
    pub fn write(&self, offset: u32, bytes: u32) -> [u8; TIGHT_HULL_BYTES] {
        let lengths = [self.slack, self.depth, self.void_ratio].map(f32::to_bits);
        let words = [offset, bytes, self.faces].into_iter().chain(lengths);
        let mut out = [0u8; TIGHT_HULL_BYTES];
        out.iter_mut().zip(words.flat_map(u32::to_le_bytes)).for_each(|(slot, byte)| *slot = byte);
        out
    }
}

impl<'a> TightHulls<'a> {
    /// Number of hulls, at least one.
    pub const fn count(&self) -> u32 {
        self.records.len() as u32
    }

    /// The records, coarse to fine.
    pub fn records(&self) -> impl Iterator<Item = TightRecord> + 'a {
        self.records.iter().map(|record| read(record).1)
    }

    /// Hull `index`, 0 being the coarsest. Cost: some thousand instructions. Keep the hull, not its
    /// number.
    pub const fn get(&self, index: u32) -> Option<TightHull<'a>> {
        let (_, rest) = some!(self.records.split_at_checked(index as usize));
        let (place, record) = read(some!(rest.first()));
        let (bytes, slacks) = some!(self.parts(place, record.faces));
        let Ok(bvh) = Bvh::view(bytes) else { return None };
        Some(TightHull { bvh, record, slacks, bytes })
    }

    /// The finest hull: the tightest.
    pub const fn finest(&self) -> Option<TightHull<'a>> {
        self.get(self.count().wrapping_sub(1))
    }

    /// A hull's blob, and the distances of its faces.
    pub(crate) const fn parts(
        &self,
        place: Place,
        faces: u32,
    ) -> Option<(&'a [u8], &'a [[u8; 2]])> {
        let bytes = some!(self.data.slice(place.offset as usize, place.bytes as usize));
        let after = some!((place.offset as usize).checked_add(place.bytes as usize));
        let slacks = some!(self.data.slice(after, some!((faces as usize).checked_mul(2))));
        Some((bytes, slacks.as_chunks().0))
    }
}

impl<'a> TightHull<'a> {
    /// The hull's own box tree. Source numbers are those of its faces.
    pub const fn bvh(&self) -> &Bvh<'a> {
        &self.bvh
    }

    /// With this many scratch entries no question about one point ends for lack of memory.
    pub const fn scratch_entries(&self) -> usize {
        self.bvh.scratch_entries()
    }

    /// The hull as a blob of its own: a box tree, without the distances to the mesh.
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// Its record.
    pub fn record(&self) -> &TightRecord {
        &self.record
    }

    /// No point of a face is farther than this from the mesh, input units. Not above the
    /// [record's](TightRecord::slack).
    #[inline]
    pub fn slack(&self, face: u32) -> Option<f32> {
        let stored = Radius16(u16::from_le_bytes(*self.slacks.get(face as usize)?)).get();
        // The code of a distance may be rounded up beyond the largest.
        Some(lesser(self.record.slack, stored))
    }
}
