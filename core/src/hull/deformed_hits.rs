//! Segments against a mesh that deforms: at a key frame, or moved freely.

use super::frame_hull::FrameHull;
use super::moved_hull::MovedHull;
use super::segment_hits::segment_questions;
use crate::query::{AllHits, Budget, FirstHit, QueryError, ScratchEntry, TriangleHit};

segment_questions! {
    FrameHull<'_>, |hull| hull;
    /// First common point of the closed segment `a b` (input units) and the surface at this frame.
    ///
    /// All as for [`Hull::first_hit`](crate::Hull::first_hit), of the mesh whose vertices are
    /// interpolated from those of the input files. Between keys the surface is known to 1.5
    /// millionths of the largest coordinate, so no hit is proved there: the answer is clear, or
    /// ends with [`Ended::Resolution`](crate::Ended::Resolution).
    ///
    /// # Errors
    /// Those of [`Hull::first_hit`](crate::Hull::first_hit).
    first_hit;
    /// All common points of the closed segment `a b` (input units) and the surface at this frame,
    /// by rising parameter, into `hits`. As [`Hull::all_hits`](crate::Hull::all_hits), with what
    /// [`first_hit`](Self::first_hit) says.
    ///
    /// # Errors
    /// Those of [`Hull::first_hit`](crate::Hull::first_hit).
    all_hits;
}

segment_questions! {
    MovedHull<'_, '_>, |hull| &hull;
    /// First common point of the closed segment `a b` (input units) and the moved surface.
    ///
    /// All as for [`Hull::first_hit`](crate::Hull::first_hit), of the mesh whose vertices are where
    /// the last update put them.
    ///
    /// # Errors
    /// Those of [`Hull::first_hit`](crate::Hull::first_hit); [`QueryError::NoPose`] after an update
    /// that failed.
    first_hit;
    /// All common points of the closed segment `a b` (input units) and the moved surface, by rising
    /// parameter, into `hits`. As [`Hull::all_hits`](crate::Hull::all_hits), of the mesh whose
    /// vertices are where the last update put them.
    ///
    /// # Errors
    /// Those of [`first_hit`](Self::first_hit).
    all_hits;
}
