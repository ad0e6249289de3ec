//! Polygonal curves: fences and tool paths, in 2-D and 3-D.
//!
//! ```text
//! CSV ─ read ─ Polylines ─ encode (stored precision) ─ build (runs and capsules) ─ sections
//! ```

pub use crate::error::CurveError;

mod build;
mod encode;
mod read;

pub use encode::{CurveOptions, CurveReport, build};
pub use meshsweep_core::Zone;
pub use read::{Polyline, read_csv};
