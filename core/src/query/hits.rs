//! Common points of a segment and a surface.

use super::answer::{Ended, Interval};
use super::work::Work;

/// A common point of a segment and the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hit {
    /// Parameter, 0 at the start of the segment or the motion, 1 at its end.
    pub t: f32,
    /// The point.
    pub point: [f32; 3],
    /// Number of the triangle in the input file. `None` on a cut blob, where the hit is a hull's.
    pub triangle: Option<u32>,
}

impl Hit {
    /// Any value, for filling arrays.
    pub const EMPTY: Hit = Hit { t: f32::INFINITY, point: [0.0; 3], triangle: None };
}

/// First hit of a segment, or first contact of a solid that moves.
///
/// No point of the segment before `t.lower` lies on the surface. If `hit` is `Some` and `ended` is
/// [`Ended::Exact`], the parameter of the first common point lies in `t`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct FirstHit {
    /// The parameter of the first common point. `lower` is infinite if it is proved that there is
    /// none. `upper` is infinite if none is known, and 1 if the hit is not proved.
    pub t: Interval,
    /// The first hit found. With [`Ended::Resolution`] the first place where the surface may be.
    /// With [`Ended::Steps`] or [`Ended::Scratch`] perhaps not the first.
    pub hit: Option<Hit>,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl FirstHit {
    /// No point of the segment lies on the input mesh.
    pub(crate) const CLEAR: FirstHit = FirstHit {
        t: Interval::new(f32::INFINITY, f32::INFINITY),
        hit: None,
        work: Work::NONE,
        ended: Ended::Exact,
    };

    /// Whether it is proved that no point of the segment, or of the solid at any time, lies on the
    /// input mesh.
    pub fn is_clear(&self) -> bool {
        self.t.lower == f32::INFINITY
    }
}

/// How a search for all hits went. The hits are in the caller's slice, by rising `t`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct AllHits {
    /// Hits in the slice.
    pub stored: usize,
    /// Hits that did not fit. The slice keeps the first ones.
    pub dropped: u32,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended. Unless [`Ended::Exact`], more hits may exist.
    pub ended: Ended,
}

/// The caller's slice of hits, kept by rising `t`, then triangle.
pub(crate) struct Hits<'a> {
    slots: &'a mut [Hit],
    pub(crate) stored: usize,
    pub(crate) dropped: u32,
}

impl<'a> Hits<'a> {
    pub(crate) fn new(slots: &'a mut [Hit]) -> Self {
        Hits { slots, stored: 0, dropped: 0 }
    }

    /// Adds a hit. If the slice is full, the hit with the greatest `t` is dropped.
    pub(crate) fn insert(&mut self, hit: Hit) {
        let after = |x: &Hit| x.t > hit.t || (x.t == hit.t && x.triangle > hit.triangle);
        let at = self.slots.iter().take(self.stored).position(after).unwrap_or(self.stored);
        if self.stored < self.slots.len() {
            self.stored += 1;
        } else {
            self.dropped += 1;
        }
        if let Some(tail) = self.slots.get_mut(at..self.stored)
            && !tail.is_empty()
        {
            tail.rotate_right(1);
            if let Some(slot) = tail.first_mut() {
                *slot = hit;
            }
        }
    }

    pub(crate) fn answer(&self, work: Work, ended: Ended) -> AllHits {
        AllHits { stored: self.stored, dropped: self.dropped, work, ended }
    }
}
