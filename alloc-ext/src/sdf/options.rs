//! The options of a field.

use meshsweep_core::{SdfKind, SdfLayout};

/// Bytes of a field unless told otherwise.
pub const BYTES: u32 = 16 << 10;

/// How to build a field.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SdfOptions {
    /// Most bytes of the section. The header and one cell of a lattice take 105: of fewer bytes
    /// there is this lattice. One leaf of a tree takes 101: of fewer bytes there is no tree, and
    /// [`FieldTooSmall`](crate::BuildError::FieldTooSmall) if one was asked for.
    pub bytes: u32,
    /// The width that an interval in the field may have at most, in the mesh's unit. The field is
    /// then the one of the fewest bytes found whose intervals are proved to be as narrow
    /// everywhere. `None`: as narrow as the bytes allow.
    pub error: Option<f64>,
    /// Part of the distance that is added to the error: intervals may be as much wider. Without an
    /// error it has no effect.
    pub relative: f64,
    /// Distance about the mesh's box that the field covers, in the mesh's unit. `None`: a tenth of
    /// the box's diagonal.
    pub margin: Option<f64>,
    /// What distances mean. `None`: signed if the mesh is closed and has sides, else surface.
    pub kind: Option<SdfKind>,
    /// How the field lies in its bytes. `None`: in the layout of the smaller mean width, or of one
    /// that is nearly as small; with an error in the one of fewer bytes.
    pub layout: Option<SdfLayout>,
}

impl Default for SdfOptions {
    fn default() -> Self {
        Self { bytes: BYTES, error: None, relative: 0.0, margin: None, kind: None, layout: None }
    }
}

impl SdfOptions {
    setters! {
        /// Sets the [bytes](Self::bytes).
        with_bytes: u32 => bytes,
        /// Sets the [error](Self::error).
        with_error: Option<f64> => error,
        /// Sets the [relative](Self::relative) one.
        with_relative: f64 => relative,
        /// Sets the [margin](Self::margin).
        with_margin: Option<f64> => margin,
        /// Sets the [kind](Self::kind).
        with_kind: Option<SdfKind> => kind,
        /// Sets the [layout](Self::layout).
        with_layout: Option<SdfLayout> => layout,
    }
}
