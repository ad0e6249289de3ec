//! The fixed header of a blob. It holds the counts of the hull hierarchy and the scale of all
//! structures.

use super::bytes::Bytes;
use super::error::OpenError;
use super::layout::{
    FLAG_CUT, FLAG_SWEEP_ONLY, HEADER_BYTES, MAGIC, VERSION_MAJOR, VERSION_MINOR, VertexFormat,
    field, index_bytes,
};

/// The fixed header. Lengths are in the local frame: input units divided by `2^scale_exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Header {
    /// Bytes of header and section table.
    pub header_bytes: u32,
    /// Bytes of the blob.
    pub total_bytes: u32,
    /// Entries of the section table.
    pub section_count: u32,
    /// See [`FLAG_CUT`](super::layout::FLAG_CUT) and
    /// [`FLAG_SWEEP_ONLY`](super::layout::FLAG_SWEEP_ONLY).
    pub flags: u32,
    /// Input coordinate = local coordinate × 2^this.
    pub scale_exponent: i32,
    /// How coordinates are stored.
    pub vertex_format: VertexFormat,
    /// Grid formats: local coordinate = (stored + origin) × 2^this.
    pub grid_exponent: i32,
    /// Grid formats: added to the stored integers.
    pub grid_origin: [i32; 3],
    /// Vertices of all levels of the hull hierarchy: `base_vertices + 2 · splits`.
    pub vertices: u32,
    /// Vertices of the base hull.
    pub base_vertices: u32,
    /// Triangles of the base hull.
    pub base_triangles: u32,
    /// Vertex splits.
    pub splits: u32,
    /// Ring entries of all splits.
    pub rings: u32,
    /// Triangles of the surface; 0 in a cut blob.
    pub surface_triangles: u32,
    /// Records of the level table.
    pub levels: u32,
    /// Triangles of the input file, an upper bound of every source number plus one.
    pub input_triangles: u32,
    /// No point of the input surface is farther than this from the stored surface, nor the other
    /// way round.
    pub surface_error: f32,
    /// Box of every vertex of every level.
    pub hull_box: [[f32; 3]; 2],
    /// Box of the surface.
    pub surface_box: [[f32; 3]; 2],
    /// Queue entries with which no sweep runs out of them.
    pub queue_capacity: u32,
    /// Longest chain of splits in which each split needs the one before it.
    pub dependency_depth: u32,
}

impl Header {
    /// Reads and checks the fixed header. The caller checks the CRC.
    pub(crate) fn read(bytes: Bytes<'_>) -> Result<Header, OpenError> {
        let short = OpenError::Truncated { needed: HEADER_BYTES as u32, found: bytes.len() as u32 };
        if bytes.slice(field::MAGIC, MAGIC.len()).ok_or(short)? != MAGIC {
            return Err(OpenError::NotABlob);
        }
        if bytes.len() < HEADER_BYTES {
            return Err(short);
        }
        let word = |at: usize| bytes.u32(at).ok_or(short);
        let version = bytes.u16(field::VERSION_MAJOR).ok_or(short)?;
        if version != VERSION_MAJOR {
            return Err(OpenError::Version { found: version });
        }
        let finite = |is_finite: bool, field: &'static str| {
            if is_finite { Ok(()) } else { Err(OpenError::NotFinite { field }) }
        };
        let float = |at: usize, name: &'static str| {
            let x = f32::from_bits(word(at)?);
            finite(x.is_finite(), name).map(|()| x)
        };
        let corner = |at: usize, name: &'static str| {
            let corner = bytes.u32x3(at).ok_or(short)?.map(f32::from_bits);
            finite(corner.iter().all(|x| x.is_finite()), name).map(|()| corner)
        };
        let code = bytes.u8(field::VERTEX_FORMAT).ok_or(short)?;
        let vertex_format =
            VertexFormat::from_code(code).ok_or(OpenError::VertexFormat { found: code })?;
        let header = Header {
            header_bytes: word(field::HEADER_BYTES)?,
            total_bytes: word(field::TOTAL_BYTES)?,
            section_count: word(field::SECTION_COUNT)?,
            flags: word(field::FLAGS)?,
            scale_exponent: word(field::SCALE_EXPONENT)?.cast_signed(),
            vertex_format,
            grid_exponent: word(field::GRID_EXPONENT)?.cast_signed(),
            grid_origin: bytes.u32x3(field::GRID_ORIGIN).ok_or(short)?.map(u32::cast_signed),
            vertices: word(field::VERTICES)?,
            base_vertices: word(field::BASE_VERTICES)?,
            base_triangles: word(field::BASE_TRIANGLES)?,
            splits: word(field::SPLITS)?,
            rings: word(field::RINGS)?,
            surface_triangles: word(field::SURFACE_TRIANGLES)?,
            levels: word(field::LEVELS)?,
            input_triangles: word(field::INPUT_TRIANGLES)?,
            surface_error: float(field::SURFACE_ERROR, "surface error")?,
            hull_box: [
                corner(field::HULL_BOX, "hull box")?,
                corner(field::HULL_BOX + 12, "hull box")?,
            ],
            surface_box: [
                corner(field::SURFACE_BOX, "surface box")?,
                corner(field::SURFACE_BOX + 12, "surface box")?,
            ],
            queue_capacity: word(field::QUEUE_CAPACITY)?,
            dependency_depth: word(field::DEPENDENCY_DEPTH)?,
        };
        let zero =
            |at: usize, len: usize| bytes.slice(at, len).is_some_and(|b| b.iter().all(|&b| b == 0));
        if !zero(field::RESERVED_BESIDE_FORMAT, 3)
            || !zero(field::RESERVED_BESIDE_RINGS, 4)
            || !zero(field::RESERVED, 8)
            || header.flags & !(FLAG_CUT | FLAG_SWEEP_ONLY) != 0
        {
            return Err(OpenError::Reserved);
        }
        Ok(header)
    }

    /// Writes the fixed header, its CRC left zero.
    pub fn write(&self) -> [u8; HEADER_BYTES] {
        let mut out = [0u8; HEADER_BYTES];
        let mut put = |at: usize, bytes: &[u8]| {
            for (slot, byte) in out.iter_mut().skip(at).zip(bytes) {
                *slot = *byte;
            }
        };
        put(field::MAGIC, &MAGIC);
        put(field::VERSION_MAJOR, &VERSION_MAJOR.to_le_bytes());
        put(field::VERSION_MINOR, &VERSION_MINOR.to_le_bytes());
        let b = |corner: [f32; 3]| corner.map(f32::to_bits);
        let words = [
            (field::HEADER_BYTES, self.header_bytes),
            (field::TOTAL_BYTES, self.total_bytes),
            (field::SECTION_COUNT, self.section_count),
            (field::FLAGS, self.flags),
            (field::SCALE_EXPONENT, self.scale_exponent.cast_unsigned()),
            (field::VERTEX_FORMAT, u32::from(self.vertex_format.code())),
            (field::GRID_EXPONENT, self.grid_exponent.cast_unsigned()),
            (field::VERTICES, self.vertices),
            (field::BASE_VERTICES, self.base_vertices),
            (field::BASE_TRIANGLES, self.base_triangles),
            (field::SPLITS, self.splits),
            (field::RINGS, self.rings),
            (field::SURFACE_TRIANGLES, self.surface_triangles),
            (field::LEVELS, self.levels),
            (field::INPUT_TRIANGLES, self.input_triangles),
            (field::SURFACE_ERROR, self.surface_error.to_bits()),
            (field::QUEUE_CAPACITY, self.queue_capacity),
            (field::DEPENDENCY_DEPTH, self.dependency_depth),
        ];
        for (at, word) in words {
            put(at, &word.to_le_bytes());
        }
        for (at, triple) in [
            (field::GRID_ORIGIN, self.grid_origin.map(i32::cast_unsigned)),
            (field::HULL_BOX, b(self.hull_box[0])),
            (field::HULL_BOX + 12, b(self.hull_box[1])),
            (field::SURFACE_BOX, b(self.surface_box[0])),
            (field::SURFACE_BOX + 12, b(self.surface_box[1])),
        ] {
            for (i, word) in triple.into_iter().enumerate() {
                put(at + 4 * i, &word.to_le_bytes());
            }
        }
        out
    }

    /// Bytes of a vertex index.
    pub fn vertex_index_bytes(&self) -> usize {
        index_bytes(self.vertices as usize)
    }

    /// Bytes of a split index.
    pub fn split_index_bytes(&self) -> usize {
        index_bytes(self.splits as usize)
    }

    /// Bytes of a position in the rings.
    pub fn ring_index_bytes(&self) -> usize {
        index_bytes(self.rings as usize)
    }

    /// Bytes of a position in the source numbers.
    pub fn start_index_bytes(&self) -> usize {
        index_bytes(self.surface_triangles as usize)
    }

    /// Bytes of a triangle number of the input file.
    pub fn source_index_bytes(&self) -> usize {
        index_bytes(self.input_triangles as usize)
    }

    /// Bytes of one split record.
    pub fn split_bytes(&self) -> usize {
        self.vertex_index_bytes() + self.ring_index_bytes() + 3
    }

    /// Bytes of one base group.
    pub fn group_bytes(&self) -> usize {
        3 * self.vertex_index_bytes() + 2
    }
}
