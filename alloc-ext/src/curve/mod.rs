//! Polygonal curves: fences and tool paths, in 2-D and 3-D.
//!
//! ```text
//! CSV ─ read ─ Polylines ─ encode (stored precision) ─ build (runs and capsules) ─ sections
//! ```

mod build;
mod encode;
mod error;
mod read;

pub use encode::{CurveReport, store};
pub use error::CurveError;
pub use read::{Polyline, read_csv};
