//! Common points of a segment and a surface.

use super::answer::{Ended, Interval};
use super::work::Work;

/// A common point of a segment and the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hit {
    /// Parameter, 0 at the start of the segment or the motion, 1 at its end. Of a ray, 1 at the end
    /// of its direction; at most [`f32::MAX`], and then `point` tells where.
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
    /// none. `upper` is infinite if none is known. If the hit is not proved, it is 1, and of a ray
    /// the parameter of a point behind the model, or infinite.
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

/// A triangle that a segment meets, or may meet: one of all hits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TriangleHit {
    /// Where the stored triangle is met.
    pub hit: Hit,
    /// Whether it is proved that the segment meets the input's triangle. Where it passes an inner
    /// edge of a fan of the box tree, this is proved of the triangles beside the edge together: the
    /// first of their hits is certain, and the segment meets this triangle or one beside it. So the
    /// segment meets at least as many triangles as hits are certain.
    ///
    /// No hit is certain on a cut blob.
    pub is_certain: bool,
}

impl TriangleHit {
    /// Any value, for filling arrays.
    pub const EMPTY: TriangleHit = TriangleHit { hit: Hit::EMPTY, is_certain: false };
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
    /// Whether it is proved that the segment meets no other triangle: none that is neither in the
    /// slice nor counted as dropped. Always false if the search ended early.
    pub is_complete: bool,
    /// The work of the search.
    pub work: Work,
    /// Why the search ended. [`Ended::Exact`]: every hit is certain, and there are no others.
    pub ended: Ended,
}

impl AllHits {
    /// No triangle is met.
    pub(crate) const NONE: AllHits =
        AllHits { stored: 0, dropped: 0, is_complete: true, work: Work::NONE, ended: Ended::Exact };
}

/// What the caller's slice of hits holds.
pub(crate) trait Listed: Copy {
    fn hit(&self) -> &Hit;
}

impl Listed for Hit {
    fn hit(&self) -> &Hit {
        self
    }
}

impl Listed for TriangleHit {
    fn hit(&self) -> &Hit {
        &self.hit
    }
}

/// Puts an element at a place of a slice that is kept in order, of which `stored` are in use. If
/// all are, the last one leaves: the new one, where the place is behind them. Returns how many are
/// in use then.
#[inline(always)]
pub(crate) fn insert_at<T>(slots: &mut [T], stored: usize, at: usize, element: T) -> usize {
    let stored = if stored < slots.len() { stored + 1 } else { stored };
    if let Some(tail) = slots.get_mut(at..stored)
        && !tail.is_empty()
    {
        tail.rotate_right(1);
        if let Some(first) = tail.first_mut() {
            *first = element;
        }
    }
    stored
}

/// The caller's slice of hits, kept by rising `t`, then triangle.
pub(crate) struct Hits<'a, H> {
    slots: &'a mut [H],
    pub(crate) stored: usize,
    pub(crate) dropped: u32,
}

impl<'a, H: Listed> Hits<'a, H> {
    pub(crate) fn new(slots: &'a mut [H]) -> Self {
        Hits { slots, stored: 0, dropped: 0 }
    }

    /// Adds a hit. If the slice is full, the hit with the greatest `t` is dropped.
    pub(crate) fn insert(&mut self, listed: H) {
        let hit = listed.hit();
        let after = |x: &H| {
            let x = x.hit();
            x.t > hit.t || (x.t == hit.t && x.triangle > hit.triangle)
        };
        let at = self.slots.iter().take(self.stored).position(after).unwrap_or(self.stored);
        self.dropped += u32::from(self.stored == self.slots.len());
        self.stored = insert_at(self.slots, self.stored, at, listed);
    }
}

impl Hits<'_, TriangleHit> {
    /// Makes a hit certain that was inserted, unless it was dropped.
    pub(crate) fn prove(&mut self, hit: &Hit) {
        let mut listed = self.slots.iter_mut().take(self.stored);
        if let Some(found) = listed.find(|listed| !listed.is_certain && listed.hit == *hit) {
            found.is_certain = true;
        }
    }

    /// The answer of a search. `lacks`: a triangle may be met that was not inserted.
    pub(crate) fn answer(&self, work: Work, ended: Ended, lacks: bool) -> AllHits {
        let ended_early = matches!(ended, Ended::Steps | Ended::Scratch);
        let is_complete = !(lacks || ended_early);
        AllHits { stored: self.stored, dropped: self.dropped, is_complete, work, ended }
    }
}
