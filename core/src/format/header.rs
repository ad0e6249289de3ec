//! The fixed header of a blob. It holds the counts of the hull hierarchy and the scale of all
//! structures.

use super::bytes::Bytes;
use super::error::{HeaderField, OpenError};
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
    #[inline(never)]
    pub(crate) const fn read(bytes: Bytes<'_>) -> Result<Header, OpenError> {
        let short = OpenError::Truncated { needed: HEADER_BYTES as u32, found: bytes.len() as u32 };
        let magic: [u8; MAGIC.len()] = ok!(bytes.array(field::MAGIC), short);
        if u64::from_le_bytes(magic) != u64::from_le_bytes(MAGIC) {
            return Err(OpenError::NotABlob);
        }
        let Some(head) = bytes.slice(0, HEADER_BYTES) else { return Err(short) };
        let head = Bytes(head);
        let version = ok!(head.u16(field::VERSION_MAJOR), short);
        if version != VERSION_MAJOR {
            return Err(OpenError::Version { found: version });
        }
        let code = ok!(head.u8(field::VERTEX_FORMAT), short);
        let vertex_format =
            ok!(VertexFormat::from_code(code), OpenError::VertexFormat { found: code });
        let header = Header {
            header_bytes: head.word(field::HEADER_BYTES),
            total_bytes: head.word(field::TOTAL_BYTES),
            section_count: head.word(field::SECTION_COUNT),
            flags: head.word(field::FLAGS),
            scale_exponent: head.word(field::SCALE_EXPONENT).cast_signed(),
            vertex_format,
            grid_exponent: head.word(field::GRID_EXPONENT).cast_signed(),
            grid_origin: head.i32x3(field::GRID_ORIGIN),
            vertices: head.word(field::VERTICES),
            base_vertices: head.word(field::BASE_VERTICES),
            base_triangles: head.word(field::BASE_TRIANGLES),
            splits: head.word(field::SPLITS),
            rings: head.word(field::RINGS),
            surface_triangles: head.word(field::SURFACE_TRIANGLES),
            levels: head.word(field::LEVELS),
            input_triangles: head.word(field::INPUT_TRIANGLES),
            surface_error: f32::from_bits(head.word(field::SURFACE_ERROR)),
            hull_box: [head.corner(field::HULL_BOX), head.corner(field::HULL_BOX + 12)],
            surface_box: [head.corner(field::SURFACE_BOX), head.corner(field::SURFACE_BOX + 12)],
            queue_capacity: head.word(field::QUEUE_CAPACITY),
            dependency_depth: head.word(field::DEPENDENCY_DEPTH),
        };
        if !header.surface_error.is_finite() {
            return Err(OpenError::NotFinite { field: HeaderField::SurfaceError });
        }
        if !is_finite(&header.hull_box) {
            return Err(OpenError::NotFinite { field: HeaderField::HullBox });
        }
        if !is_finite(&header.surface_box) {
            return Err(OpenError::NotFinite { field: HeaderField::SurfaceBox });
        }
        if !head.is_zero(field::RESERVED_BESIDE_FORMAT, 3)
            || !head.is_zero(field::RESERVED_BESIDE_RINGS, 4)
            || !head.is_zero(field::RESERVED, 8)
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

const fn is_finite([low, high]: &[[f32; 3]; 2]) -> bool {
    let [[a, b, c], [x, y, z]] = [low, high];
    a.is_finite()
        && b.is_finite()
        && c.is_finite()
        && x.is_finite()
        && y.is_finite()
        && z.is_finite()
}
