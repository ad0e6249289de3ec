//! The bytes that all structures share. `core/FORMAT.md` is the normative text.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes, offsets of header fields, kinds of sections, vertex formats |
//! | `bytes` | reading little-endian numbers without a panic |
//! | `header` | the fixed header |
//! | `sections` | the section table and the CRCs |
//! | `error` | [`OpenError`]: why a blob was not opened |

mod bytes;
mod error;
mod header;
pub mod layout;
mod sections;

pub(crate) use bytes::Bytes;
pub use error::OpenError;
pub use header::Header;
pub use sections::{Section, section_crc};
pub(crate) use sections::{place_sections, read_header, section};
