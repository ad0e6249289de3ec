//! Sections to bytes, and a blob to source text. It knows sections, and no builder.

pub mod source;

use meshsweep_core::internal::format::layout::{
    HEADER_BYTES, SECTION_ALIGNMENT, SECTION_ENTRY_BYTES, VertexFormat, field,
};
use meshsweep_core::internal::format::{Header, section_crc};
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::{Blob, SectionKind};

/// The sections of one structure, and the header of a blob that holds this structure alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Sections {
    /// Header; [`assemble`] fills in lengths and the number of sections.
    pub header: Header,
    /// Kinds and bodies. Empty ones are not written.
    pub bodies: Vec<(SectionKind, Vec<u8>)>,
}

impl Sections {
    /// Sections of a structure without a hull hierarchy. `bounds` is the box of the surface;
    /// `surface_error` and `bounds` are in the local frame.
    pub fn new(
        scale_exponent: i32,
        surface_error: f32,
        input_triangles: u32,
        bounds: Aabb,
        bodies: Vec<(SectionKind, Vec<u8>)>,
    ) -> Self {
        let header = Header {
            header_bytes: 0,
            total_bytes: 0,
            section_count: 0,
            flags: 0,
            scale_exponent,
            vertex_format: VertexFormat::F32,
            grid_exponent: 0,
            grid_origin: [0; 3],
            vertices: 0,
            base_vertices: 0,
            base_triangles: 0,
            splits: 0,
            rings: 0,
            surface_triangles: 0,
            levels: 0,
            input_triangles,
            surface_error,
            hull_box: bounds.corners(),
            surface_box: bounds.corners(),
            queue_capacity: 0,
            dependency_depth: 0,
        };
        Self { header, bodies }
    }

    /// A blob of this structure alone.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        assemble([self])
    }
}

/// The sections of a blob whose kinds are wanted, copied unchanged.
#[must_use]
pub fn copied(blob: &Blob<'_>, is_wanted: fn(SectionKind) -> bool) -> Vec<(SectionKind, Vec<u8>)> {
    let wanted = blob.sections().filter(|section| is_wanted(section.kind));
    let bodies = wanted.filter_map(|section| {
        let bytes = blob.bytes().get(section.offset as usize..)?.get(..section.bytes as usize)?;
        Some((section.kind, bytes.to_vec()))
    });
    bodies.collect()
}

/// A blob of structures of the same mesh, in the order in which the format names their sections.
/// Without structures it does not open. Same sections, same bytes.
///
/// The header is that of a hull hierarchy, or of the first structure if there is none.
#[must_use]
pub fn assemble<'a>(structures: impl IntoIterator<Item = &'a Sections>) -> Vec<u8> {
    let place = |kind: SectionKind| SectionKind::ALL.iter().position(|&other| other == kind);
    let mut structures: Vec<&Sections> = structures.into_iter().collect();
    structures.sort_by_key(|of| of.bodies.first().and_then(|&(kind, _)| place(kind)));
    let bare =
        Sections::new(0, 0.0, 0, Aabb { min: [0.0; 3].into(), max: [0.0; 3].into() }, vec![]);
    let mut header = structures.first().map_or(bare.header, |first| first.header);
    for of in &structures {
        debug_assert_eq!(of.header.scale_exponent, header.scale_exponent, "of another mesh");
        header.input_triangles = header.input_triangles.max(of.header.input_triangles);
    }
    let mut bodies: Vec<&(SectionKind, Vec<u8>)> =
        structures.iter().flat_map(|of| &of.bodies).filter(|(_, body)| !body.is_empty()).collect();
    bodies.sort_by_key(|(kind, _)| place(*kind));
    join(header, &bodies)
}

fn join(mut header: Header, bodies: &[&(SectionKind, Vec<u8>)]) -> Vec<u8> {
    let table_bytes = HEADER_BYTES + bodies.len() * SECTION_ENTRY_BYTES;
    let mut table = Vec::new();
    let mut out = vec![0u8; table_bytes];
    for (kind, body) in bodies {
        out.resize(out.len().next_multiple_of(SECTION_ALIGNMENT), 0);
        for word in [*kind as u32, out.len() as u32, body.len() as u32, section_crc(body)] {
            table.extend(word.to_le_bytes());
        }
        out.extend(body);
    }
    header.header_bytes = table_bytes as u32;
    header.section_count = bodies.len() as u32;
    header.total_bytes = out.len() as u32;
    out[..HEADER_BYTES].copy_from_slice(&header.write());
    let minor = bodies.iter().map(|(kind, _)| kind.minor()).max().unwrap_or(0);
    out[field::VERSION_MINOR..][..2].copy_from_slice(&minor.to_le_bytes());
    out[HEADER_BYTES..table_bytes].copy_from_slice(&table);
    let mut covered = out[..field::CRC].to_vec();
    covered.extend(&out[field::CRC + 4..table_bytes]);
    out[field::CRC..field::CRC + 4].copy_from_slice(&section_crc(&covered).to_le_bytes());
    out
}
