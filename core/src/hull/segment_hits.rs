//! First hit and all hits of a segment, on the cover tree.
//!
//! A node is opened if the segment may meet the swept triangle that covers its part of the surface,
//! whether or not it crosses a hull face. So hits below an unbroken hull (Platis & Theoharis 2003,
//! Figure 5) are found, wherever the segment starts.

use crate::geom::{Aabb, Clipped, SegmentTriangle, SweptSegment, comes_within, segment_triangle};
use crate::hull::format::{Children, Hull, NodeIdx, TriIdx};
use crate::num::{down_to_f32, up_to_f32};
use crate::query::{
    AllHits, Budget, Ended, FirstHit, Frame, Hit, Hits, Interval, QueryError, ScratchEntry,
    SweepQueue, Taken, Work,
};
use glam::DVec3;

impl Hull<'_> {
    /// First common point of the closed segment `a b` (input units) and the surface, both facings.
    ///
    /// If [`FirstHit::is_clear`], that is a proof. A segment that passes within some 1e-15 of the
    /// lengths involved, or within the surface error, of an edge may be reported as a hit. Segments
    /// in the plane of a triangle hit where they enter it. A segment of no length hits if its point
    /// lies on the surface. On a cut blob, and where a grid moved vertices, `hit` is the first
    /// place where the surface may be, and the answer ends with [`Ended::Resolution`].
    ///
    /// `scratch` as for [`closest_point`](Hull::closest_point). Of the budget only `steps` matters.
    /// Cost: some dozens of nodes on scanned parts.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let (a, b) = ([400.0, 0.0, 0.0], [300.0, 0.0, 0.0]);
    /// assert!(part.first_hit(a, b, Budget::EXACT, &mut scratch)?.is_clear());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`], [`QueryError::NoScratch`],
    /// [`QueryError::Tolerance`].
    pub fn first_hit(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        let mut first = First { best: None, least_lower: f64::INFINITY };
        let traced = trace(self, [a, b], &budget, scratch, &mut first)?;
        let open = f64::from(traced.unopened);
        let hit = first.best.map(|best| Hit {
            t: best.meet.t as f32,
            point: best.point,
            triangle: self.source(TriIdx(best.triangle)),
        });
        let lower = first.least_lower.min(open);
        let lower = if lower.is_finite() { down_to_f32(lower.max(0.0)) } else { f32::INFINITY };
        let upper = first.best.map_or(f32::INFINITY, |best| up_to_f32(best.meet.t_upper));
        let t = Interval { lower, upper };
        Ok(FirstHit { t, hit, work: traced.work, ended: traced.ended })
    }

    /// All common points of the closed segment `a b` (input units) and the surface, by rising
    /// parameter, into `hits`.
    ///
    /// Each triangle that the segment meets gives one hit. So a segment through an edge or a vertex
    /// gives one for each triangle there. [`AllHits::dropped`] counts the hits that do not fit; the
    /// slice keeps the first ones. Arguments and cost as for [`first_hit`](Hull::first_hit).
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hit, Hull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let (a, b, mut hits) = ([-400.0, 1.0, 1.0], [400.0, 1.0, 1.0], [Hit::EMPTY; 8]);
    /// let found = part.all_hits(a, b, &mut hits, Budget::EXACT, &mut scratch)?;
    /// assert!(hits[..found.stored].is_sorted_by(|x, y| x.t <= y.t));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`first_hit`](Hull::first_hit).
    pub fn all_hits(
        &self,
        a: [f32; 3],
        b: [f32; 3],
        hits: &mut [Hit],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<AllHits, QueryError> {
        let mut all = All { model: self, hits: Hits::new(hits) };
        let traced = trace(self, [a, b], &budget, scratch, &mut all)?;
        Ok(all.hits.answer(traced.work, traced.ended))
    }
}

/// A triangle that the segment meets.
#[derive(Clone, Copy)]
struct Met {
    meet: SegmentTriangle,
    triangle: u32,
    point: [f32; 3],
}

/// A question's visitor for hits, and its limit along the segment.
trait Collect {
    fn add(&mut self, met: Met);
    /// Hits beyond this parameter are not wanted.
    fn limit(&self) -> f32;
}

struct First {
    best: Option<Met>,
    least_lower: f64,
}

impl Collect for First {
    fn add(&mut self, met: Met) {
        self.least_lower = self.least_lower.min(met.meet.t_lower);
        let earlier = self.best.is_none_or(|best| {
            met.meet.t < best.meet.t || (met.meet.t == best.meet.t && met.triangle < best.triangle)
        });
        if earlier {
            self.best = Some(met);
        }
    }

    fn limit(&self) -> f32 {
        self.best.map_or(f32::INFINITY, |best| up_to_f32(best.meet.t_upper))
    }
}

struct All<'a> {
    model: &'a Hull<'a>,
    hits: Hits<'a>,
}

impl Collect for All<'_> {
    fn add(&mut self, met: Met) {
        let triangle = self.model.source(TriIdx(met.triangle));
        let hit = Hit { t: met.meet.t as f32, point: met.point, triangle };
        self.hits.insert(hit);
    }

    fn limit(&self) -> f32 {
        f32::INFINITY
    }
}

struct Traced {
    work: Work,
    ended: Ended,
    /// Least parameter of a hit in unopened nodes.
    unopened: f32,
}

fn trace(
    model: &Hull<'_>,
    [a, b]: [[f32; 3]; 2],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    collect: &mut dyn Collect,
) -> Result<Traced, QueryError> {
    budget.check()?;
    if !model.has_hull() {
        return Err(QueryError::NO_HULL);
    }
    let frame = Frame::of(model.header());
    let (start, end) = (frame.local_end(a)?, frame.local_end(b)?);
    if scratch.is_empty() {
        return Err(QueryError::NoScratch);
    }
    let mut traced = Traced {
        work: Work { nodes: 1, ..Work::default() },
        ended: Ended::Exact,
        unopened: f32::INFINITY,
    };
    let surface_error = model.header().surface_error;
    let mut bounds = Aabb::of(model.header().surface_box);
    if surface_error > 0.0 {
        bounds.min = (bounds.min - surface_error).map(f32::next_down);
        bounds.max = (bounds.max + surface_error).map(f32::next_up);
    }
    let Some(clipped) = bounds.clip(start, end) else { return Ok(traced) };
    let mut hull = model.hull_box();
    hull.min = hull.min.min(bounds.min);
    hull.max = hull.max.max(bounds.max);
    let mut walk = Walk {
        model,
        frame,
        start,
        end,
        segment: SweptSegment::new(&clipped, &hull),
        clipped,
        surface_error,
        doubtful: false,
    };
    let queue = SweepQueue::new(scratch, model.scratch_entries());
    walk.run(queue, budget, collect, &mut traced).ok_or(QueryError::Unchecked)?;
    Ok(traced)
}

struct Walk<'a> {
    model: &'a Hull<'a>,
    frame: Frame,
    start: DVec3,
    end: DVec3,
    segment: SweptSegment,
    clipped: Clipped,
    surface_error: f32,
    /// A reported hit is one that the stored surface cannot decide.
    doubtful: bool,
}

impl Walk<'_> {
    fn run(
        &mut self,
        mut queue: SweepQueue<'_>,
        budget: &Budget,
        collect: &mut dyn Collect,
        traced: &mut Traced,
    ) -> Option<()> {
        queue.begin_children(1);
        self.visit(0, &mut queue, collect, &mut traced.work)?;
        while let Some(Taken { entry, .. }) = queue.pop() {
            if entry.key() > collect.limit() {
                continue;
            }
            if traced.work.splits >= budget.steps {
                traced.unopened = entry.key().min(queue.lower());
                traced.ended = Ended::Steps;
                return Some(());
            }
            self.open(entry, &mut queue, collect, traced)?;
        }
        if queue.dropped() <= collect.limit() && queue.dropped().is_finite() {
            traced.unopened = traced.unopened.min(queue.dropped());
            traced.ended = Ended::Scratch;
        } else if self.doubtful {
            traced.ended = Ended::Resolution;
        }
        Some(())
    }

    fn open(
        &mut self,
        entry: ScratchEntry,
        queue: &mut SweepQueue<'_>,
        collect: &mut dyn Collect,
        traced: &mut Traced,
    ) -> Option<()> {
        traced.work.splits += 1;
        let node = self.model.node(NodeIdx(entry.node()))?;
        match node.children {
            Children::Nodes { first, count } => {
                queue.begin_children(count);
                for child in first..first.checked_add(count)? {
                    self.visit(child, queue, collect, &mut traced.work)?;
                }
            }
            Children::Triangles { first, count } => {
                for triangle in first..first.checked_add(count)? {
                    self.triangle(TriIdx(triangle), collect, &mut traced.work)?;
                }
            }
            Children::Cut => self.cut_node(entry, collect),
        }
        Some(())
    }

    #[inline]
    fn visit(
        &self,
        node: u32,
        queue: &mut SweepQueue<'_>,
        collect: &dyn Collect,
        work: &mut Work,
    ) -> Option<()> {
        work.nodes += 1;
        let (corners, radius) = self.model.bound(NodeIdx(node))?;
        let corners = self.model.positions(corners)?;
        if let Some(key) = self.segment.enter(corners, radius + self.surface_error)
            && key <= collect.limit()
        {
            queue.push(ScratchEntry::new(key, node));
        }
        Some(())
    }

    #[inline]
    fn triangle(
        &mut self,
        triangle: TriIdx,
        collect: &mut dyn Collect,
        work: &mut Work,
    ) -> Option<()> {
        work.triangles += 1;
        let corners = self.model.positions(self.model.surface_triangle(triangle)?)?;
        let Some(key) = self.segment.enter(corners, self.surface_error) else { return Some(()) };
        if key > collect.limit() {
            return Some(());
        }
        work.exact += 1;
        let corners = corners.map(|v| v.as_dvec3());
        let mut met = segment_triangle(self.start, self.end, corners);
        if self.surface_error > 0.0 {
            // The input surface may lie up to `surface_error` from the stored one. So a hit may be
            // a miss, a near miss a hit, and the parameter is uncertain by as much.
            if met.is_none()
                && !comes_within(self.start, self.end, corners, f64::from(self.surface_error))
            {
                return Some(());
            }
            self.doubtful = true;
            let enter = f64::from(key.max(0.0));
            let t = met.map_or(enter, |meet| meet.t);
            met = Some(SegmentTriangle { t, t_lower: enter.min(t), t_upper: 1.0 });
        }
        if let Some(meet) = met {
            let point = self.frame.point(self.start + (self.end - self.start) * meet.t);
            collect.add(Met { meet, triangle: triangle.0, point });
        }
        Some(())
    }

    /// Below a cut the surface may be hit from here on.
    fn cut_node(&mut self, entry: ScratchEntry, collect: &mut dyn Collect) {
        self.doubtful = true;
        let t = f64::from(entry.key()).max(self.clipped.t_start.min(1.0)).max(0.0);
        let point = self.frame.point(self.start + (self.end - self.start) * t);
        let t_lower = f64::from(entry.key().max(0.0));
        let meet = SegmentTriangle { t, t_lower: t_lower.min(t), t_upper: 1.0 };
        collect.add(Met { meet, triangle: u32::MAX, point });
    }
}
