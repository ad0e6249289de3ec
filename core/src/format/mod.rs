//! The bytes that all structures share. `core/FORMAT.md` is the normative text.
//!
//! | file | owns |
//! | --- | --- |
//! | `layout` | sizes, offsets of header fields, kinds of sections, vertex formats |
//! | `bytes` | reading little-endian numbers without a panic |
//! | `header` | the fixed header |
//! | `sections` | the section table and the CRCs |
//! | `error` | [`OpenError`]: why a blob was not opened |
//! | `contradiction` | [`Contradiction`]: what a header says and its records do not |

/// `?` of an `Option` in a constant function, where Rust has no `?` yet.
macro_rules! some {
    ($value:expr) => {
        match $value {
            Some(value) => value,
            None => return None,
        }
    };
}

/// `?` of a `Result`, or of an `Option` with an error for `None`, in a constant function.
macro_rules! ok {
    ($value:expr) => {
        match $value {
            Ok(value) => value,
            Err(error) => return Err(error),
        }
    };
    ($value:expr, $error:expr) => {
        match $value {
            Some(value) => value,
            None => return Err($error),
        }
    };
}
pub(crate) use {ok, some};

mod bytes;
mod contradiction;
mod error;
mod header;
pub mod layout;
mod sections;

pub(crate) use bytes::Bytes;
pub use contradiction::Contradiction;
pub use error::{HeaderField, OpenError};
pub use header::Header;
pub use sections::{Section, section_crc};
pub(crate) use sections::{SectionTable, section};
