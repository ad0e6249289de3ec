//! First hit and all hits of a segment, on the cover tree.
//!
//! A node is opened because the segment may meet the swept triangle that covers its part of the
//! surface, not because it crosses a hull face; so hits below an unbroken hull (paper 000, Figure
//! 5) are found, wherever the segment starts.

use super::sweep_queue::{Frontier, QueueEntry, Taken};
use crate::geom::{Clipped, SegmentProbe, SegmentTriangle, comes_within, segment_triangle};
use crate::hull::format::{Children, Model, NodeIdx, TriIdx};
use crate::num::{down_to_f32, up_to_f32};
use crate::query::insert;
use crate::query::{AllHits, Budget, Ended, Frame, Hit, QueryError, SegmentHit, Work};
use glam::DVec3;

/// First common point of the closed segment `a b` (input units) and the surface, both facings.
///
/// If [`SegmentHit::is_clear`], that is a proof. A segment that passes within some 1e-15 of the
/// lengths involved, or within the stored surface's error, of an edge may be reported as a hit.
/// Segments in the plane of a triangle hit where they enter it; a segment of zero length hits if
/// its point lies on the surface. Where the stored surface is not exactly the input's (a cut
/// blob, a grid that moved vertices), `hit` is the first place where the surface may be, and
/// [`Ended::Level`] says so.
///
/// Of [`Budget`] only `steps` matters. `queue` as for [`closest_point`](super::closest_point).
///
/// # Errors
/// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`], [`QueryError::NoQueue`],
/// [`QueryError::Tolerance`].
pub fn first_hit(
    model: &Model<'_>,
    a: [f32; 3],
    b: [f32; 3],
    stop: &Budget,
    queue: &mut [QueueEntry],
) -> Result<SegmentHit, QueryError> {
    stop.check()?;
    let mut first = First { best: None, least_lower: f64::INFINITY };
    let traced = trace(model, a, b, stop, queue, &mut first)?;
    let open = f64::from(traced.unopened);
    let hit = first.best.map(|best| Hit {
        t: best.meet.t as f32,
        point: best.point,
        triangle: model.source(TriIdx(best.triangle)),
    });
    let lower = first.least_lower.min(open);
    Ok(SegmentHit {
        lower: if lower.is_finite() { down_to_f32(lower.max(0.0)) } else { f32::INFINITY },
        upper: first.best.map_or(f32::INFINITY, |best| up_to_f32(best.meet.t_upper)),
        hit,
        work: traced.work,
        ended: traced.ended,
    })
}

/// All common points of the closed segment `a b` and the surface, by rising parameter, into `hits`.
///
/// Each triangle that the segment meets gives one hit, so that a segment through an edge or a
/// vertex gives one for each triangle there. What does not fit in `hits` is counted in
/// [`AllHits::dropped`]; the first ones are kept.
///
/// # Errors
/// As [`first_hit`].
pub fn all_hits(
    model: &Model<'_>,
    a: [f32; 3],
    b: [f32; 3],
    queue: &mut [QueueEntry],
    hits: &mut [Hit],
) -> Result<AllHits, QueryError> {
    let mut all = All { model, hits, stored: 0, dropped: 0 };
    let traced = trace(model, a, b, &Budget::EXACT, queue, &mut all)?;
    Ok(AllHits { stored: all.stored, dropped: all.dropped, work: traced.work, ended: traced.ended })
}

/// A triangle that the segment meets.
#[derive(Clone, Copy)]
struct Met {
    meet: SegmentTriangle,
    triangle: u32,
    point: [f32; 3],
}

/// What to do with hits, and how far along the segment it is worth looking.
trait Collect {
    fn add(&mut self, met: Met);
    /// Nothing beyond this parameter matters.
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
    model: &'a Model<'a>,
    hits: &'a mut [Hit],
    stored: usize,
    dropped: u32,
}

impl Collect for All<'_> {
    fn add(&mut self, met: Met) {
        let triangle = self.model.source(TriIdx(met.triangle));
        let hit = Hit { t: met.meet.t as f32, point: met.point, triangle };
        insert(self.hits, &mut self.stored, &mut self.dropped, hit);
    }

    fn limit(&self) -> f32 {
        f32::INFINITY
    }
}

struct Traced {
    work: Work,
    ended: Ended,
    /// Least parameter at which something that was not opened may be hit.
    unopened: f32,
}

fn trace(
    model: &Model<'_>,
    a: [f32; 3],
    b: [f32; 3],
    stop: &Budget,
    queue: &mut [QueueEntry],
    collect: &mut dyn Collect,
) -> Result<Traced, QueryError> {
    if !model.has_hull() {
        return Err(QueryError::NotServed);
    }
    let frame = Frame::of(model.header());
    let (start, end) = (frame.local_end(a)?, frame.local_end(b)?);
    if queue.is_empty() {
        return Err(QueryError::NoQueue);
    }
    let mut traced = Traced {
        work: Work { nodes: 1, ..Work::default() },
        ended: Ended::Exact,
        unopened: f32::INFINITY,
    };
    let surface_error = model.header().surface_error;
    let mut bounds = model.header().surface_box;
    if surface_error > 0.0 {
        bounds.min = (bounds.min - surface_error).map(f32::next_down);
        bounds.max = (bounds.max + surface_error).map(f32::next_up);
    }
    let Some(clipped) = bounds.clip(start, end) else { return Ok(traced) };
    let mut hull = model.header().hull_box;
    hull.min = hull.min.min(bounds.min);
    hull.max = hull.max.max(bounds.max);
    let mut walk = Walk {
        model,
        frame,
        start,
        end,
        probe: SegmentProbe::new(&clipped, &hull),
        clipped,
        surface_error,
        doubtful: false,
    };
    let frontier = Frontier::new(queue, model.capacities().queue);
    walk.run(frontier, stop, collect, &mut traced).ok_or(QueryError::Model)?;
    Ok(traced)
}

struct Walk<'a> {
    model: &'a Model<'a>,
    frame: Frame,
    start: DVec3,
    end: DVec3,
    probe: SegmentProbe,
    clipped: Clipped,
    surface_error: f32,
    /// Something was reported that the stored surface cannot decide.
    doubtful: bool,
}

impl Walk<'_> {
    fn run(
        &mut self,
        mut frontier: Frontier<'_>,
        stop: &Budget,
        collect: &mut dyn Collect,
        traced: &mut Traced,
    ) -> Option<()> {
        frontier.begin_children(1);
        self.visit(0, &mut frontier, collect, &mut traced.work)?;
        while let Some(Taken { entry, .. }) = frontier.pop() {
            if entry.key > collect.limit() {
                continue;
            }
            if traced.work.splits >= stop.steps {
                traced.unopened = entry.key.min(frontier.lower());
                traced.ended = Ended::Steps;
                return Some(());
            }
            self.open(entry, &mut frontier, collect, traced)?;
        }
        if frontier.dropped() <= collect.limit() && frontier.dropped().is_finite() {
            traced.unopened = traced.unopened.min(frontier.dropped());
            traced.ended = Ended::Capacity;
        } else if self.doubtful {
            traced.ended = Ended::Level;
        }
        Some(())
    }

    fn open(
        &mut self,
        entry: QueueEntry,
        frontier: &mut Frontier<'_>,
        collect: &mut dyn Collect,
        traced: &mut Traced,
    ) -> Option<()> {
        traced.work.splits += 1;
        let node = self.model.node(NodeIdx(entry.node))?;
        match node.children {
            Children::Nodes { first, count } => {
                frontier.begin_children(count);
                for child in first..first.checked_add(count)? {
                    self.visit(child, frontier, collect, &mut traced.work)?;
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
        frontier: &mut Frontier<'_>,
        collect: &dyn Collect,
        work: &mut Work,
    ) -> Option<()> {
        work.nodes += 1;
        let (corners, radius) = self.model.bound(NodeIdx(node))?;
        let corners = self.model.positions(corners)?;
        if let Some(key) = self.probe.enter(corners, radius + self.surface_error)
            && key <= collect.limit()
        {
            frontier.push(QueueEntry { key, node });
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
        let Some(key) = self.probe.enter(corners, self.surface_error) else { return Some(()) };
        if key > collect.limit() {
            return Some(());
        }
        work.exact += 1;
        let corners = corners.map(|v| v.as_dvec3());
        let mut met = segment_triangle(self.start, self.end, corners);
        if self.surface_error > 0.0 {
            // The input surface may lie up to `surface_error` from the stored one: a hit may be a
            // miss, a near miss a hit, and the parameter is that uncertain.
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

    /// All that is known below a cut is that the surface may be hit from here on.
    fn cut_node(&mut self, entry: QueueEntry, collect: &mut dyn Collect) {
        self.doubtful = true;
        let t = f64::from(entry.key).max(self.clipped.t_start.min(1.0)).max(0.0);
        let point = self.frame.point(self.start + (self.end - self.start) * t);
        let t_lower = f64::from(entry.key.max(0.0));
        let meet = SegmentTriangle { t, t_lower: t_lower.min(t), t_upper: 1.0 };
        collect.add(Met { meet, triangle: u32::MAX, point });
    }
}
