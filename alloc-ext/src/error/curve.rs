//! What can be wrong with a curve, said so that its owner can mend it.

use crate::counted::Counted;
use meshsweep_core::internal::curve::format::layout::MAX_POINTS;
use std::fmt;

/// Why a curve was refused. Lines and fields count from 1, polylines from 0.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CurveError {
    /// A header line does not name the columns x and y.
    Header {
        /// Where.
        line: u64,
    },
    /// A line has too few or too many fields.
    Fields {
        /// Where.
        line: u64,
        /// Fields wanted.
        wanted: usize,
        /// Fields found.
        found: usize,
    },
    /// A field is no number of f32's range.
    Number {
        /// Where.
        line: u64,
        /// Which one.
        field: usize,
        /// What it says.
        text: String,
    },
    /// A field of the column zone names no zone.
    Zone {
        /// Where.
        line: u64,
        /// What it says.
        text: String,
    },
    /// A column that is not named zone holds zones.
    ZoneColumn {
        /// Where.
        line: u64,
        /// The column's name.
        name: String,
    },
    /// The corners of a zone lie on one line, so that it bounds no area.
    FlatZone {
        /// Its last line.
        line: u64,
        /// Its corners.
        corners: usize,
    },
    /// An exclusion zone in memory is not closed.
    OpenZone {
        /// Which polyline.
        polyline: usize,
    },
    /// A polyline has one point only.
    OnePoint {
        /// The line of the point.
        line: u64,
    },
    /// A polyline in memory has fewer than two points, or a coordinate that is not finite in f32.
    Polyline {
        /// Which one.
        polyline: usize,
    },
    /// There are no points.
    NoPoints,
    /// More points than a blob can hold.
    TooMany {
        /// Points.
        points: usize,
    },
    /// No coordinate reaches the smallest normal f32.
    TooSmall {
        /// The largest.
        largest: f64,
    },
}

impl CurveError {
    /// Whether the message begins with a line of the file.
    pub(super) fn names_line(&self) -> bool {
        matches!(
            self,
            Self::Header { .. }
                | Self::Fields { .. }
                | Self::Number { .. }
                | Self::Zone { .. }
                | Self::ZoneColumn { .. }
                | Self::FlatZone { .. }
                | Self::OnePoint { .. }
        )
    }
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header { line } => {
                write!(f, "line {line}: the header names no columns x and y; write x,y or x,y,z")
            }
            Self::Fields { line, wanted, found } => write!(
                f,
                "line {line}: {}, and a point needs {wanted}; mend the line",
                Counted(*found, "field")
            ),
            Self::Number { line, field, text } => {
                let text: String = text.chars().take(40).collect();
                if ["inclusion", "exclusion"].iter().any(|zone| text.eq_ignore_ascii_case(zone)) {
                    return write!(
                        f,
                        "line {line}, field {field}: {text:?} is no number; name the columns in a \
                         first line: x,y,zone"
                    );
                }
                write!(
                    f,
                    "line {line}, field {field}: {text:?} is no finite number of single precision; \
                     write it like -1.25 or 3e-4"
                )
            }
            Self::Zone { line, text } => {
                let text: String = text.chars().take(40).collect();
                write!(f, "line {line}: {text:?} is no zone; write inclusion or exclusion")
            }
            Self::ZoneColumn { line, name } => {
                write!(f, "line {line}: the column {name:?} holds zones; name it zone")
            }
            Self::FlatZone { line, corners } => write!(
                f,
                "line {line}: a zone of {} ends here that bounds no area; give it three that are \
                 not on one line",
                Counted(*corners, "corner")
            ),
            Self::OpenZone { polyline } => {
                write!(f, "polyline {polyline} is an exclusion zone and not closed; close it")
            }
            Self::OnePoint { line } => {
                write!(f, "line {line}: a polyline of one point; give it two, or remove it")
            }
            Self::Polyline { polyline } => write!(
                f,
                "polyline {polyline}: fewer than two points, or a coordinate that is not finite in \
                 single precision"
            ),
            Self::NoPoints => f.write_str("no points; write one x,y or x,y,z a line"),
            Self::TooMany { points } => write!(
                f,
                "{points} points are more than a blob can hold ({}); split the curve",
                MAX_POINTS - 1
            ),
            Self::TooSmall { largest } => write!(
                f,
                "the largest coordinate is {largest:e}, below single precision; choose a smaller \
                 unit"
            ),
        }
    }
}

impl std::error::Error for CurveError {}
