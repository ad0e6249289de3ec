//! Common points of a segment and a surface.

use super::answer::Ended;
use super::work::Work;

/// A common point of a segment and the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter, 0 at the segment's start, 1 at its end.
    pub t: f32,
    /// The point.
    pub point: [f32; 3],
    /// Number of the triangle in the input file; `None` on a cut blob, where the hit is a hull's.
    pub triangle: Option<u32>,
}

impl Hit {
    /// Any value, for filling arrays.
    pub const EMPTY: Hit = Hit { t: f32::INFINITY, point: [0.0; 3], triangle: None };
}

/// First hit of a segment.
///
/// The segment is proved clear of the surface before `lower` (everywhere, if `lower` is infinite).
/// If `hit` is there and `ended` is [`Ended::Exact`], the first common point has a parameter in
/// `lower ..= upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentHit {
    /// No common point below this parameter; infinity if there is none at all.
    pub lower: f32,
    /// The first common point, if there is one, is not above this parameter; infinity if none is
    /// known. 1 where the segment touches an edge or a plane so flatly that rounding leaves
    /// more open.
    pub upper: f32,
    /// The first hit found. With [`Ended::Level`] only the first place where the surface may be;
    /// with [`Ended::Steps`] or [`Ended::Capacity`] perhaps not the first.
    pub hit: Option<Hit>,
    /// What it cost.
    pub work: Work,
    /// Why it ended.
    pub ended: Ended,
}

impl SegmentHit {
    /// Proved: no point of the segment lies on the input mesh.
    pub fn is_clear(&self) -> bool {
        self.lower == f32::INFINITY
    }
}

/// How a search for all hits went; the hits are in the caller's slice, by rising `t`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AllHits {
    /// Hits in the slice.
    pub stored: usize,
    /// Hits that did not fit; those kept are the first.
    pub dropped: u32,
    /// What it cost.
    pub work: Work,
    /// Why it ended. Unless [`Ended::Exact`], more hits may exist.
    pub ended: Ended,
}

/// Adds a hit to those found so far, kept by rising `t`, then triangle; counts what falls off the
/// end.
pub(crate) fn insert(hits: &mut [Hit], stored: &mut usize, dropped: &mut u32, hit: Hit) {
    let after = |x: &Hit| x.t > hit.t || (x.t == hit.t && x.triangle > hit.triangle);
    let at = hits.iter().take(*stored).position(after).unwrap_or(*stored);
    if *stored < hits.len() {
        *stored += 1;
    } else {
        *dropped += 1;
    }
    if let Some(tail) = hits.get_mut(at..*stored)
        && !tail.is_empty()
    {
        tail.rotate_right(1);
        if let Some(slot) = tail.first_mut() {
            *slot = hit;
        }
    }
}
