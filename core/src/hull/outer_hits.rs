//! Hits of a segment that starts outside the hull, by candidate faces on the selectively refined
//! hull (Platis & Theoharis 2003, 3.2.1).
//!
//! Every hull encloses the surface. So between a start outside and the first point of the surface
//! the segment crosses the refined hull. A crossed face that cannot be refined any more is a face
//! of the surface, and the first hit is found. Faces are tested in groups: those of a split lie
//! within its `reach` of the vertex that it replaced, and sixteen base faces share a swept
//! triangle. Later hits may lie below an unbroken hull face. [`Hull::all_hits`] finds those.

use super::refined_hull::{Face, Refined, RefinedHull};
use crate::geom::{SweptSegment, segment_triangle};
use crate::hull::format::layout::BASE_GROUP;
use crate::hull::format::{Hull, SplitIdx, VertIdx};
use crate::num::{down_to_f32, up_to_f32};
use crate::query::{Budget, Ended, FirstHit, Frame, Hit, Hits, Interval, QueryError, Work};
use glam::DVec3;

/// The extent of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Search {
    /// Until the first hit is certain.
    First,
    /// Until every face that the segment crosses is the surface's: the paper's outer intersections.
    Outer,
}

/// The answer of the refined hull about a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// The work of the search. `triangles`: faces tested. `splits`: vertex splits performed.
    /// `nodes`: boxes and bounds of several faces.
    pub work: Work,
    /// Why the search ended.
    pub ended: Ended,
}

impl Hull<'_> {
    /// Hits of the closed segment `a b`, whose start must lie outside the box of the hulls.
    ///
    /// `refined` is working memory of any size ([`RefinedHull`]). The search resets it to the base
    /// hull. `hits` gets the hits by rising parameter. If `starts_inside` is set in the answer, ask
    /// [`first_hit`](Hull::first_hit) instead: the segment may start between hull and surface. The
    /// surface must be stored exactly (no grid rounding, no cut), or the answer is
    /// [`Ended::Resolution`] without any bound. The surface must not wind around any point
    /// negatively. A solid that is turned inside out where it passes through itself does, and the
    /// hulls of that mesh do not enclose it there. [`first_hit`](Hull::first_hit) has no such
    /// conditions.
    ///
    /// Of the budget only `steps` matters: vertex splits. Cost: faces tested and splits as in Table
    /// 3 of Platis & Theoharis 2003.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Face, Hit, Hull, RefinedHull, Search};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let part = Hull::open(bytes)?;
    /// let (mut performed, mut swept, mut faces) = ([0; 64], [0; 64], [Face::EMPTY; 64]);
    /// let mut refined = RefinedHull::new(&mut performed, &mut swept, &mut faces);
    /// let (a, b, mut hits) = ([-400.0, 1.0, 1.0], [400.0, 1.0, 1.0], [Hit::EMPTY; 8]);
    /// let exact = Budget::EXACT;
    /// let found = part.outer_hits(a, b, Search::First, &mut refined, &mut hits, exact)?;
    /// assert!(!found.starts_inside);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`].
    pub fn outer_hits(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        search: Search,
        refined: &mut RefinedHull<'_>,
        hits: &mut [Hit],
        budget: Budget,
    ) -> Result<OuterHits, QueryError> {
        let model = self;
        if !model.has_hull() {
            return Err(QueryError::NO_HULL);
        }
        let frame = Frame::of(model.header());
        let (start, end) = (frame.local_end(a)?, frame.local_end(b)?);
        let bounds = model.hull_box();
        let mut out = OuterHits {
            t: FirstHit::CLEAR.t,
            stored: 0,
            dropped: 0,
            starts_inside: false,
            work: Work { nodes: 1, ..Work::NONE },
            ended: Ended::Exact,
        };
        let start_f32 = start.as_vec3();
        if start_f32.cmpge(bounds.min).all() && start_f32.cmple(bounds.max).all() {
            out.starts_inside = true;
            out.t.lower = 0.0;
            return Ok(out);
        }
        if model.header().surface_error > 0.0 || model.is_cut() {
            // The hull encloses the stored surface, and the input's may stick out.
            out.t.lower = 0.0;
            out.ended = Ended::Resolution;
            return Ok(out);
        }
        let Some(clipped) = bounds.clip(start, end) else { return Ok(out) };
        refined.reset();
        let mut sweep = Sweep {
            model,
            frame,
            start,
            end,
            segment: SweptSegment::new(&clipped, &bounds),
            search,
            steps: budget.steps,
            refined,
            hits: Hits::new(hits),
            out,
            waiting: 0,
            spare: None,
            overflowed: false,
        };
        sweep.run().ok_or(QueryError::Unchecked)?;
        let Hits { stored, dropped, .. } = sweep.hits;
        Ok(OuterHits { stored, dropped, ..sweep.out })
    }
}

struct Sweep<'a, 'f> {
    model: &'a Hull<'a>,
    frame: Frame,
    start: DVec3,
    end: DVec3,
    segment: SweptSegment,
    search: Search,
    /// Vertex splits that may be performed.
    steps: u32,
    refined: &'a mut RefinedHull<'f>,
    hits: Hits<'a>,
    out: OuterHits,
    waiting: usize,
    /// One candidate that needs none of the caller's memory.
    spare: Option<Face>,
    overflowed: bool,
}

impl Sweep<'_, '_> {
    fn run(&mut self) -> Option<()> {
        self.test_base(true)?;
        loop {
            while let Some(face) = self.next_candidate() {
                self.refine(face)?;
            }
            if !self.overflowed {
                return Some(());
            }
            if self.out.work.splits >= self.steps {
                // Faces that did not fit may be hit anywhere.
                self.give_up(0.0, Ended::Steps);
                return Some(());
            }
            // Some candidates did not fit: the live faces that the segment crosses are found again
            // from the tables. At least one fits, and all can be refined, so the hull gets finer
            // each time.
            self.overflowed = false;
            self.test_base(false)?;
            self.test_splits(0, self.model.header().splits, false)?;
        }
    }

    fn next_candidate(&mut self) -> Option<Face> {
        let Some(last) = self.waiting.checked_sub(1) else { return self.spare.take() };
        self.waiting = last;
        self.refined.candidates.get(last).copied()
    }

    /// One candidate: dropped if it is gone or too far, else replaced by the split that refines it.
    fn refine(&mut self, face: Face) -> Option<()> {
        let corners = face.corners(self.model)?;
        if self.beyond(face.enter_at()) || !self.refined.is_alive(self.model, corners) {
            return Some(());
        }
        let split = RefinedHull::split_of_face(self.model, corners)?;
        if self.out.work.splits >= self.steps {
            self.give_up(face.enter_at(), Ended::Steps);
            return Some(());
        }
        match self.refined.refine(self.model, split)? {
            Refined::Splits(count) => {
                self.out.work.splits += count;
                if (self.refined.fresh.len() as u32) < count {
                    return self.test_splits(0, split.0.checked_add(1)?, true);
                }
                // By position: testing borrows the hull.
                for i in 0..count as usize {
                    let split = self.refined.fresh.get(i).copied()?;
                    if let Some(word) = self.refined.swept.get_mut(split.usize() / 32) {
                        *word |= 1 << (split.0 % 32);
                    }
                    self.test_split(split, true)?;
                }
                Some(())
            }
            Refined::Scratch => {
                self.give_up(face.enter_at(), Ended::Scratch);
                Some(())
            }
        }
    }

    /// A face that cannot be refined stays. The surface may be hit anywhere on it.
    fn give_up(&mut self, t: f32, ended: Ended) {
        self.out.t.lower = self.out.t.lower.min(t.max(0.0));
        self.out.ended = ended;
    }

    fn test_base(&mut self, first_time: bool) -> Option<()> {
        let count = self.model.header().base_triangles;
        for group in 0..count.div_ceil(BASE_GROUP) {
            let (corners, radius) = self.model.base_group(group)?;
            if !self.may_meet(corners, radius)? {
                continue;
            }
            for slot in group * BASE_GROUP..count.min((group + 1) * BASE_GROUP) {
                let corners = self.model.base_triangle(slot)?;
                if first_time || self.refined.is_alive(self.model, corners) {
                    self.test(Face::base(slot), corners, first_time)?;
                }
            }
        }
        Some(())
    }

    /// Whether the segment may meet a swept triangle below the limit.
    #[inline]
    fn may_meet(&mut self, corners: [VertIdx; 3], radius: f32) -> Option<bool> {
        self.out.work.nodes += 1;
        let entered = self.segment.enter(self.model.positions(corners)?, radius);
        Some(entered.is_some_and(|t| !self.beyond(t)))
    }

    /// Faces of the performed splits in a range. With `fresh` only those not visited before.
    fn test_splits(&mut self, from: u32, to: u32, fresh: bool) -> Option<()> {
        for index in from / 32..to.div_ceil(32) {
            let performed = self.refined.performed.get(index as usize).copied().unwrap_or(0);
            let swept = self.refined.swept.get(index as usize).copied().unwrap_or(0);
            let mut bits = if fresh { performed & !swept } else { performed };
            if let Some(word) = self.refined.swept.get_mut(index as usize) {
                *word |= bits;
            }
            while bits != 0 {
                let split = SplitIdx(index * 32 + bits.trailing_zeros());
                bits &= bits - 1;
                self.test_split(split, fresh)?;
            }
        }
        Some(())
    }

    fn test_split(&mut self, index: SplitIdx, fresh: bool) -> Option<()> {
        let split = self.model.split(index)?;
        if !self.may_meet([split.vertex; 3], split.reach)? {
            return Some(());
        }
        for slot in 0..split.fine_len() {
            let corners = split.fine(slot)?;
            if self.refined.is_alive(self.model, corners) {
                self.test(Face::fine(index, slot as u32), corners, fresh)?;
            }
        }
        Some(())
    }

    /// Whether hits from this parameter on cannot change the answer.
    fn beyond(&self, t: f32) -> bool {
        self.search == Search::First && t > self.out.t.upper
    }

    /// Tests a live face. One that the segment may cross is a hit if it is a face of the surface,
    /// else a candidate.
    fn test(&mut self, face: Face, corners: [VertIdx; 3], record_hits: bool) -> Option<()> {
        self.out.work.triangles += 1;
        let positions = self.model.positions(corners)?;
        let Some(t) = self.segment.enter(positions, 0.0) else { return Some(()) };
        if self.beyond(t) {
            return Some(());
        }
        if let Some(split) = RefinedHull::split_of_face(self.model, corners) {
            if !self.refined.holds(split) {
                self.give_up(t, Ended::Scratch);
            } else if let Some(slot) = self.refined.candidates.get_mut(self.waiting) {
                *slot = face.entered_at(t);
                self.waiting += 1;
            } else if self.spare.is_none() {
                self.spare = Some(face.entered_at(t));
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
            self.out.t.upper = self.out.t.upper.min(up_to_f32(meet.t_upper));
            let point = self.frame.point(self.start + (self.end - self.start) * meet.t);
            let triangle = self.model.number(face.instance(self.model));
            let hit = Hit { t: meet.t as f32, point, triangle };
            self.hits.insert(hit);
        }
        Some(())
    }
}
