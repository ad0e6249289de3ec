//! The bytes that all structures share: the header, the section table, CRCs, reading numbers.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes, kinds of sections, how coordinates are stored |
//! | `bytes` | reading little-endian numbers without a panic |
//! | `header` | the fixed header |
//! | `sections` | the section table |
//! | `error` | [`OpenError`] |

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
