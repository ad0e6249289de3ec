//! Hits of a segment that starts outside the hull, by candidate faces on the selectively refined
//! hull (Platis & Theoharis 2003, 3.2.1).
//!
//! Every hull encloses the surface. So between a start outside and the first point of the surface
//! the segment crosses the refined hull. A crossed face that cannot be refined any more is a face
//! of the surface, and the first hit is found. Faces are tested in groups: those of a split lie
//! within its `star_radius` of the vertex that it replaced, and sixteen base faces share a swept
//! triangle. Later hits may lie below an unbroken hull face. [`Hull::all_hits`] finds those.

use super::refined_hull::{Refined, RefinedHull, erased, split_of_face};
use crate::geom::{SweptSegment, segment_triangle};
use crate::hull::format::layout::BASE_GROUP;
use crate::hull::format::{Hull, Named, SplitIdx, VertIdx};
use crate::num::{SOFT_DOUBLE, down_to_f32, up_to_f32};
use crate::query::{
    Budget, Ended, FirstHit, Frame, Hit, Hits, Interval, QueryError, ScratchEntry, Work,
};
use glam::DVec3;

/// The extent of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum OuterSearch {
    /// Until the first hit is certain.
    First,
    /// Until every face that the segment crosses is the surface's: the paper's outer intersections.
    Outer,
}

/// The answer of the refined hull about a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OuterHits {
    /// The parameter of the first common point. `lower` is infinite if no common point exists,
    /// `upper` if none is known.
    pub t: Interval,
    /// Hits in the slice.
    pub stored: usize,
    /// Hits that did not fit.
    pub dropped: u32,
    /// The segment starts inside the base hull's box. The theorem does not hold there, and no hit
    /// was searched for.
    pub starts_inside: bool,
    /// The work of the search. `triangles`: faces tested. `opened`: vertex splits performed.
    /// `bounds`: boxes and bounds of several faces.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl<'t> Hull<'t> {
    /// Hits of the closed segment `a b`, whose start must lie outside the box of the hulls.
    ///
    /// The search starts from `refined` as it stands and leaves it finer, so that segments that lie
    /// together share splits. [`reset`](RefinedHull::reset) it when the segments lie elsewhere:
    /// each search tests the faces that are there. If its memory gets full, the answer says
    /// [`Ended::Scratch`]. `scratch` may have any length. With few entries faces are tested again,
    /// which changes no answer. `hits` gets the hits by rising parameter.
    ///
    /// If `starts_inside` is set in the answer, ask [`first_hit`](Hull::first_hit) instead: the
    /// segment may start between hull and surface. The surface must be stored exactly (no grid
    /// rounding, no cut), or the answer is [`Ended::Resolution`] without any bound. The surface
    /// must not wind around any point negatively. A solid that is turned inside out where it passes
    /// through itself does, and the hulls of that mesh do not enclose it there.
    /// [`first_hit`](Hull::first_hit) has no such conditions. A hit through an edge, in a plane or
    /// at an end of the segment is not proved: the answer ends with [`Ended::Resolution`].
    ///
    /// Of the budget only `steps` matters: vertex splits. Cost: on scanned parts some hundred faces
    /// and some hundred splits a segment. Source: Platis & Theoharis 2003, 3.2 and Table 3.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hit, Hull, RefinedHull, Scratch, OuterSearch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let part = Hull::open(bytes)?;
    /// let (mut refined, mut scratch) = (RefinedHull::<128>::new(), Scratch::<64>::new());
    /// let (a, b, mut hits) = ([-400.0, 1.0, 1.0], [400.0, 1.0, 1.0], [Hit::EMPTY; 8]);
    /// let (first, exact) = (OuterSearch::First, Budget::EXACT);
    /// let found = part.outer_hits(a, b, first, &mut refined, &mut hits, exact, &mut scratch)?;
    /// assert!(!found.starts_inside);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`], [`QueryError::Tolerance`];
    /// [`QueryError::NotEnclosing`] unless the
    /// hierarchy [`encloses`](Hull::encloses) the surface.
    #[expect(
        clippy::too_many_arguments,
        reason = "a segment, and four kinds of the caller's memory"
    )]
    pub fn outer_hits<const SPLITS: usize>(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        search: OuterSearch,
        refined: &mut RefinedHull<'t, SPLITS>,
        hits: &mut [Hit],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<OuterHits, QueryError> {
        budget.check()?;
        outer_hits(self, [a, b], search, erased(&mut refined.state), hits, budget.steps, scratch)
    }
}

fn outer_hits(
    model: &Hull<'_>,
    [a, b]: [[f32; 3]; 2],
    search: OuterSearch,
    refined: &mut Refined,
    hits: &mut [Hit],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<OuterHits, QueryError> {
    if !model.has_hull() {
        return Err(QueryError::NO_HULL);
    }
    if !model.encloses() {
        return Err(QueryError::NotEnclosing);
    }
    let frame = Frame::of(model.header());
    let bounds = model.hull_box();
    let mut out = OuterHits {
        t: FirstHit::CLEAR.t,
        stored: 0,
        dropped: 0,
        starts_inside: false,
        work: Work { bounds: 1, ..Work::NONE },
        ended: Ended::Exact,
    };
    let is_exact = model.header().surface_error == 0.0 && !model.is_cut();
    if SOFT_DOUBLE && is_exact && frame.is_missed([a, b], &bounds) {
        return Ok(out);
    }
    let (start, end) = (frame.local_end(a)?, frame.local_end(b)?);
    let start_f32 = start.as_vec3();
    if start_f32.cmpge(bounds.min).all() && start_f32.cmple(bounds.max).all() {
        out.starts_inside = true;
        out.t.lower = 0.0;
        return Ok(out);
    }
    if !is_exact {
        // The hull encloses the stored surface, and the input's may stick out.
        out.t.lower = 0.0;
        out.ended = Ended::Resolution;
        return Ok(out);
    }
    let Some(clipped) = bounds.clip(start, end) else { return Ok(out) };
    refined.begin(model);
    let mut outer = Descent {
        model,
        frame,
        start,
        end,
        segment: SweptSegment::new(&clipped, &bounds),
        search,
        steps,
        refined,
        candidates: scratch,
        hits: Hits::new(hits),
        out,
        waiting: 0,
        spare: None,
        overflowed: false,
        touch: f32::INFINITY,
    };
    outer.run().ok_or(QueryError::Unchecked)?;
    let first = if search == OuterSearch::First { outer.out.t.upper } else { f32::INFINITY };
    if outer.touch.is_finite() && outer.touch <= first {
        outer.out.ended = outer.out.ended.uncertain();
    }
    let Hits { stored, dropped, .. } = outer.hits;
    Ok(OuterHits { stored, dropped, ..outer.out })
}

struct Descent<'a> {
    model: &'a Hull<'a>,
    frame: Frame,
    start: DVec3,
    end: DVec3,
    segment: SweptSegment,
    search: OuterSearch,
    /// Vertex splits that may be performed.
    steps: u32,
    refined: &'a mut Refined,
    /// Splits of crossed faces, with the parameter at which the segment may enter the face.
    candidates: &'a mut [ScratchEntry],
    hits: Hits<'a, Hit>,
    out: OuterHits,
    waiting: usize,
    /// One candidate that needs none of the caller's memory.
    spare: Option<ScratchEntry>,
    overflowed: bool,
    /// Least parameter of a hit that is not proved.
    touch: f32,
}

impl Descent<'_> {
    fn run(&mut self) -> Option<()> {
        let mut record_hits = true;
        loop {
            self.test_base(record_hits)?;
            self.test_splits(0, record_hits)?;
            while let Some(candidate) = self.next_candidate() {
                self.refine(candidate)?;
            }
            if !self.overflowed {
                return Some(());
            }
            if self.out.work.opened >= self.steps {
                // Faces that did not fit may be hit anywhere.
                self.give_up(0.0, Ended::Steps);
                return Some(());
            }
            // Some candidates did not fit. The live faces that the segment crosses are found again.
            // The first pass recorded the hits. At least one candidate fits, so each pass performs
            // a split or fills the memory.
            self.overflowed = false;
            record_hits = false;
        }
    }

    fn next_candidate(&mut self) -> Option<ScratchEntry> {
        let Some(last) = self.waiting.checked_sub(1) else { return self.spare.take() };
        self.waiting = last;
        self.candidates.get(last).copied()
    }

    /// One candidate: dropped if its face is gone or too far, else the split that refines it is
    /// performed.
    fn refine(&mut self, candidate: ScratchEntry) -> Option<()> {
        let split = SplitIdx(candidate.node());
        if self.beyond(candidate.key()) || self.refined.splits.contains(split) {
            return Some(());
        }
        if self.out.work.opened >= self.steps {
            self.give_up(candidate.key(), Ended::Steps);
            return Some(());
        }
        let before = self.refined.splits.len();
        if !self.refined.perform_with_required(self.model, split)? {
            self.give_up(candidate.key(), Ended::Scratch);
        }
        self.out.work.opened += (self.refined.splits.len() - before) as u32;
        self.test_splits(before, true)
    }

    /// A face that cannot be refined stays. The surface may be hit anywhere on it.
    fn give_up(&mut self, t: f32, ended: Ended) {
        self.out.t.lower = self.out.t.lower.min(t.max(0.0));
        self.out.ended = ended;
    }

    fn test_base(&mut self, record_hits: bool) -> Option<()> {
        let count = self.model.header().base_triangles;
        for group in 0..count.div_ceil(BASE_GROUP) {
            let (corners, radius) = self.model.base_group(group)?;
            if !self.may_meet(corners, radius)? {
                continue;
            }
            for slot in group * BASE_GROUP..count.min((group + 1) * BASE_GROUP) {
                let corners = self.model.base_triangle(slot)?;
                self.test(Named::Base(slot), corners, record_hits)?;
            }
        }
        Some(())
    }

    /// Whether the segment may meet a swept triangle below the limit.
    #[inline]
    fn may_meet(&mut self, corners: [VertIdx; 3], radius: f32) -> Option<bool> {
        self.out.work.bounds += 1;
        let entered = self.segment.enter(self.model.positions(corners)?, radius);
        Some(entered.is_some_and(|t| !self.beyond(t)))
    }

    /// Tests the live faces of the performed splits from a position of the list on.
    fn test_splits(&mut self, from: usize, record_hits: bool) -> Option<()> {
        for position in from..self.refined.splits.len() {
            let index = self.refined.splits.get(position)?;
            let split = self.model.split(index)?;
            if !self.may_meet([split.vertex; 3], split.star_radius)? {
                continue;
            }
            for slot in 0..split.fine_len() {
                self.test(Named::Fine(index, slot as u32), split.fine(slot)?, record_hits)?;
            }
        }
        Some(())
    }

    /// Whether hits from this parameter on cannot change the answer.
    fn beyond(&self, t: f32) -> bool {
        self.search == OuterSearch::First && t > self.out.t.upper
    }

    /// Tests a face if it is live. If the segment may cross it, it is a hit if it is a face of the
    /// surface, else a candidate.
    fn test(&mut self, face: Named, corners: [VertIdx; 3], record_hits: bool) -> Option<()> {
        let split = split_of_face(self.model, corners);
        if split.is_some_and(|split| self.refined.splits.contains(split)) {
            return Some(());
        }
        self.out.work.triangles += 1;
        let positions = self.model.positions(corners)?;
        let Some(t) = self.segment.enter(positions, 0.0) else { return Some(()) };
        if self.beyond(t) {
            return Some(());
        }
        if let Some(split) = split {
            let candidate = ScratchEntry::new(t, split.0);
            if self.refined.splits.is_full() {
                self.give_up(t, Ended::Scratch);
            } else if let Some(slot) = self.candidates.get_mut(self.waiting) {
                *slot = candidate;
                self.waiting += 1;
            } else if self.spare.is_none() {
                self.spare = Some(candidate);
            } else {
                self.overflowed = true;
            }
            return Some(());
        }
        if !record_hits {
            return Some(());
        }
        self.out.work.exact += 1;
        let [p, q, r] = positions.map(|v| v.as_dvec3());
        if let Some(meet) = segment_triangle(self.start, self.end, [p, q, r]) {
            self.out.t.lower = self.out.t.lower.min(down_to_f32(meet.t_lower));
            let upper = if meet.is_certain { up_to_f32(meet.t_upper) } else { 1.0 };
            self.out.t.upper = self.out.t.upper.min(upper);
            if !meet.is_certain {
                self.touch = self.touch.min(down_to_f32(meet.t_lower));
            }
            let point = self.frame.point(self.start + (self.end - self.start) * meet.t);
            let triangle = self.model.number(self.model.instance(face));
            let hit = Hit { t: meet.t as f32, point, triangle };
            self.hits.insert(hit);
        }
        Some(())
    }
}
