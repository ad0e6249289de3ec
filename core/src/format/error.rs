//! Why a blob was not opened.

use super::contradiction::Contradiction;
use super::layout::{SectionKind, VERSION_MAJOR};

/// Why a blob was not opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum OpenError {
    /// Fewer bytes than the header announces, or than a header has.
    Truncated {
        /// Bytes needed.
        needed: u32,
        /// Bytes given.
        found: u32,
    },
    /// More bytes than the header announces: not one blob, or a damaged header.
    TrailingBytes {
        /// Bytes announced.
        expected: u32,
        /// Bytes given.
        found: u32,
    },
    /// The first eight bytes are not `meshswep`.
    NotABlob,
    /// Another major version of the format.
    Version {
        /// Version of the blob.
        found: u16,
    },
    /// An unknown vertex format.
    VertexFormat {
        /// The code.
        found: u8,
    },
    /// A number is not finite and must be.
    NotFinite {
        /// Which one.
        field: HeaderField,
    },
    /// A reserved byte is not zero.
    Reserved,
    /// Counts that contradict each other or a limit.
    Counts {
        /// The fault.
        what: Contradiction,
    },
    /// The header or a section does not have its stored CRC.
    Crc {
        /// Which section; `None` for the header.
        section: Option<SectionKind>,
    },
    /// A section is listed twice, out of order, misaligned, overlapping, outside the blob or of the
    /// wrong length.
    Section {
        /// Index in the section table.
        index: u32,
    },
    /// A required section is missing.
    MissingSection {
        /// Which.
        section: SectionKind,
    },
    /// A record refers to something that does not exist, or its links form a cycle.
    Record {
        /// Which section.
        section: SectionKind,
        /// Which record.
        index: u32,
    },
}

/// A number of the header that must be finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum HeaderField {
    /// How far the stored surface may be from the input mesh.
    SurfaceError,
    /// The box of the hulls.
    HullBox,
    /// The box of the surface.
    SurfaceBox,
}

impl core::fmt::Display for HeaderField {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::SurfaceError => "surface error",
            Self::HullBox => "hull box",
            Self::SurfaceBox => "surface box",
        })
    }
}

impl core::fmt::Display for OpenError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            OpenError::Truncated { needed, found } => {
                write!(f, "the blob is cut short: {needed} bytes are needed, {found} are there")
            }
            OpenError::TrailingBytes { expected, found } => {
                write!(f, "the blob should have {expected} bytes and has {found}")
            }
            OpenError::NotABlob => write!(f, "not a meshsweep blob"),
            OpenError::Version { found } => {
                write!(
                    f,
                    "format version {found}, and this reader knows version {VERSION_MAJOR}: build \
                     the blob again"
                )
            }
            OpenError::VertexFormat { found } => write!(f, "unknown vertex format {found}"),
            OpenError::NotFinite { field } => write!(f, "{field}: not a finite number"),
            OpenError::Reserved => write!(f, "reserved header bytes are not zero"),
            OpenError::Counts { what } => write!(f, "contradictory header: {what}"),
            OpenError::Crc { section: None } => write!(f, "the header is damaged (CRC)"),
            OpenError::Crc { section: Some(kind) } => {
                write!(f, "section \"{}\" is damaged (CRC)", kind.name())
            }
            OpenError::Section { index } => write!(f, "section table: entry {index} is malformed"),
            OpenError::MissingSection { section } => {
                let (name, build_for) = (section.name(), section.build_for());
                write!(f, "section \"{name}\" is missing: build the blob with --for {build_for}")
            }
            OpenError::Record { section, index } => {
                write!(f, "section \"{}\": record {index} refers to nothing", section.name())
            }
        }
    }
}

impl core::error::Error for OpenError {}
