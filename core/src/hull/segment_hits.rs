//! First hit and all hits of a segment, on the split tables.
//!
//! A triangle is refined if the segment may meet the swept triangle that contains its part of the
//! surface, whether or not it crosses a hull face. So hits below an unbroken hull (Platis &
//! Theoharis 2003, Figure 5) are found, wherever the segment starts.

use super::front::{Candidate, Front, Refinable, Visit};
use super::geometry::{Geometry, frame};
use crate::geom::{Aabb, Clipped, SegmentTriangle, SweptSegment, comes_within, way_triangle};
use crate::hull::format::{Hull, Instance};
use crate::num::{SOFT_DOUBLE, down_to_f32, up_to_f32};
use crate::query::{
    AllHits, Budget, Ended, FirstHit, Frame, Hit, Hits, Interval, QueryError, ScratchEntry,
    SweepQueue, Taken, TriangleHit, Work,
};
use glam::DVec3;

/// `first_hit` and `all_hits` of a kind of hull, and what of it they ask.
macro_rules! segment_questions {
    (
        $hull:ty, |$this:ident| $model:expr;
        $(#[$first:meta])* first_hit;
        $(#[$all:meta])* all_hits;
    ) => {
        impl $hull {
            $(#[$first])*
            #[inline(never)]
            pub fn first_hit(
                &self,
                a: [f32; 3],
                b: [f32; 3],
                budget: Budget,
                scratch: &mut [ScratchEntry],
            ) -> Result<FirstHit, QueryError> {
                let $this = self;
                $crate::hull::geometry::Geometry::check($this)?;
                $crate::hull::segment_hits::first_hit($model, [a, b], &budget, scratch)
            }

            $(#[$all])*
            #[inline(never)]
            pub fn all_hits(
                &self,
                a: [f32; 3],
                b: [f32; 3],
                hits: &mut [TriangleHit],
                budget: Budget,
                scratch: &mut [ScratchEntry],
            ) -> Result<AllHits, QueryError> {
                let $this = self;
                $crate::hull::geometry::Geometry::check($this)?;
                $crate::hull::segment_hits::all_hits($model, [a, b], hits, &budget, scratch)
            }
        }
    };
}
pub(super) use segment_questions;

segment_questions! {
    Hull<'_>, |hull| hull;
    /// First common point of the closed segment `a b` (input units) and the surface, both facings.
    ///
    /// If [`FirstHit::is_clear`], that is a proof. A segment that passes within some 1e-15 of the
    /// lengths involved, or within the surface error, of the surface may be reported as a hit.
    /// Segments in the plane of a triangle hit where they enter it. A segment of no length hits if
    /// its point lies on the surface. If the segment touches the surface within rounding, through
    /// an edge or a vertex, in a plane or at an end, the hit is not proved, and the answer ends
    /// with [`Ended::Resolution`]. So it does on a cut blob, and where a grid moved vertices: there
    /// `hit` is the first place where the surface may be.
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
    first_hit;
    /// All common points of the closed segment `a b` (input units) and the surface, by rising
    /// parameter, into `hits`.
    ///
    /// Each triangle that the segment meets gives one hit. So a segment through an edge or a vertex
    /// gives one for each triangle there. [`AllHits::dropped`] counts the hits that do not fit; the
    /// slice keeps the first ones. Each hit tells whether it is certain
    /// ([`TriangleHit::is_certain`]). No triangle is missing unless the search ended early
    /// ([`AllHits::is_complete`]): what may be met is a hit. Arguments and cost as for
    /// [`first_hit`](Hull::first_hit).
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Scratch, TriangleHit};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let (a, b, mut hits) = ([-400.0, 1.0, 1.0], [400.0, 1.0, 1.0], [TriangleHit::EMPTY; 8]);
    /// let found = part.all_hits(a, b, &mut hits, Budget::EXACT, &mut scratch)?;
    /// assert!(hits[..found.stored].is_sorted_by(|x, y| x.hit.t <= y.hit.t));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`first_hit`](Hull::first_hit).
    all_hits;
}

/// [`Hull::first_hit`], of a hull at rest or deformed.
pub(super) fn first_hit<'a>(
    model: &(impl Geometry<'a> + Copy),
    ends: [[f32; 3]; 2],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<FirstHit, QueryError> {
    let mut first = First::NONE;
    let traced = trace(model, ends, budget, scratch, &mut first)?;
    Ok(first.answer(model.tables(), &traced))
}

/// [`Hull::all_hits`], of a hull at rest or deformed.
pub(super) fn all_hits<'a>(
    model: &(impl Geometry<'a> + Copy),
    ends: [[f32; 3]; 2],
    hits: &mut [TriangleHit],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
) -> Result<AllHits, QueryError> {
    let mut all = All::new(model.tables(), hits);
    let traced = trace(model, ends, budget, scratch, &mut all)?;
    Ok(all.answer(&traced))
}

/// A triangle that the segment meets.
#[derive(Clone, Copy)]
pub(super) struct Met {
    meet: SegmentTriangle,
    instance: Instance,
    point: [f32; 3],
}

/// A question's visitor for hits.
pub(super) trait Collect {
    /// Takes a hit. Hits beyond the returned parameter are not wanted any more.
    fn add(&mut self, met: Met) -> f32;
}

pub(super) struct First {
    best: Option<Met>,
    least_lower: f64,
}

impl First {
    pub(super) const NONE: First = First { best: None, least_lower: f64::INFINITY };

    pub(super) fn answer(&self, tables: &Hull<'_>, traced: &Traced) -> FirstHit {
        let open = f64::from(traced.unopened);
        let hit = self.best.map(|best| Hit {
            t: best.meet.t as f32,
            point: best.point,
            triangle: tables.number(best.instance),
        });
        let lower = self.least_lower.min(open);
        let lower = if lower.is_finite() { down_to_f32(lower.max(0.0)) } else { f32::INFINITY };
        let upper = self.best.map_or(f32::INFINITY, |Met { meet, .. }| {
            if meet.is_certain { up_to_f32(meet.t_upper) } else { 1.0 }
        });
        let t = Interval { lower, upper };
        let is_touch = self.best.is_some_and(|best| !best.meet.is_certain);
        let ended = if is_touch { traced.ended.uncertain() } else { traced.ended };
        FirstHit { t, hit, work: traced.work, ended }
    }
}

impl Collect for First {
    fn add(&mut self, met: Met) -> f32 {
        self.least_lower = self.least_lower.min(met.meet.t_lower);
        let earlier = self.best.is_none_or(|best| {
            met.meet.t < best.meet.t || (met.meet.t == best.meet.t && met.instance < best.instance)
        });
        if earlier {
            self.best = Some(met);
        }
        self.best.map_or(f32::INFINITY, |best| up_to_f32(best.meet.t_upper))
    }
}

pub(super) struct All<'a, 'h> {
    model: &'h Hull<'a>,
    hits: Hits<'h, TriangleHit>,
    /// Some hits are not proved.
    has_touches: bool,
}

impl<'a, 'h> All<'a, 'h> {
    pub(super) fn new(model: &'h Hull<'a>, hits: &'h mut [TriangleHit]) -> Self {
        All { model, hits: Hits::new(hits), has_touches: false }
    }

    pub(super) fn answer(&self, traced: &Traced) -> AllHits {
        let ended = if self.has_touches { traced.ended.uncertain() } else { traced.ended };
        self.hits.answer(traced.work, ended, false)
    }
}

impl Collect for All<'_, '_> {
    fn add(&mut self, met: Met) -> f32 {
        let triangle = self.model.number(met.instance);
        let hit = Hit { t: met.meet.t as f32, point: met.point, triangle };
        let is_certain = met.meet.is_certain;
        self.has_touches |= !is_certain;
        self.hits.insert(TriangleHit { hit, is_certain });
        f32::INFINITY
    }
}

pub(super) struct Traced {
    work: Work,
    ended: Ended,
    /// Least parameter of a hit in unopened triangles.
    unopened: f32,
}

#[cfg_attr(not(meshsweep_wide), inline(never))]
fn trace<'a, G: Geometry<'a> + Copy, C: Collect>(
    model: &G,
    [a, b]: [[f32; 3]; 2],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    collect: &mut C,
) -> Result<Traced, QueryError> {
    let space = Space::of(model, budget, scratch)?;
    let Space { frame, bounds, .. } = space;
    if SOFT_DOUBLE && frame.is_missed([a, b], &bounds) {
        return Ok(Traced::MISSED);
    }
    let (start, end) = (frame.local_end(a)?, frame.local_end(b)?);
    let line = [start, end, end - start];
    trace_line(model, &space, line, budget, scratch, collect)
}

/// Where a mesh lies.
#[derive(Clone, Copy)]
pub(super) struct Space {
    pub(super) frame: Frame,
    surface_error: f32,
    /// The box of the surface, with its error.
    pub(super) bounds: Aabb,
}

impl Space {
    /// Refuses the budget, the scratch memory, or tables without hulls.
    #[inline(always)]
    pub(super) fn of<'a>(
        model: &impl Geometry<'a>,
        budget: &Budget,
        scratch: &[ScratchEntry],
    ) -> Result<Space, QueryError> {
        budget.check_with(scratch)?;
        if !model.tables().has_hull() {
            return Err(QueryError::NO_HULL);
        }
        let surface_error = up_to_f32(model.surface_error());
        let mut bounds = model.surface_box();
        if surface_error > 0.0 {
            bounds.min = (bounds.min - surface_error).map(f32::next_down);
            bounds.max = (bounds.max + surface_error).map(f32::next_up);
        }
        Ok(Space { frame: frame(model), surface_error, bounds })
    }
}

impl Traced {
    /// The box of the surface is missed.
    const MISSED: Traced = Traced {
        work: Work { bounds: 1, ..Work::NONE },
        ended: Ended::Exact,
        unopened: f32::INFINITY,
    };
}

/// Collects the hits of a segment: its start, its end, and the way between them.
#[inline(always)]
pub(super) fn trace_line<'a, G: Geometry<'a> + Copy, C: Collect>(
    model: &G,
    &Space { frame, surface_error, bounds }: &Space,
    [start, end, way]: [DVec3; 3],
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    collect: &mut C,
) -> Result<Traced, QueryError> {
    let Some(clipped) = bounds.clip(start, end) else { return Ok(Traced::MISSED) };
    let mut hull = model.vertex_box();
    hull.min = hull.min.min(bounds.min);
    hull.max = hull.max.max(bounds.max);
    let mut along = Along {
        frame,
        start,
        end,
        way,
        segment: SweptSegment::new(&clipped, &hull),
        clipped,
        surface_error,
        doubtful: false,
        exact: 0,
        collect,
        limit: f32::INFINITY,
    };
    let mut front = Front::new(model, scratch, budget.steps);
    let (ended, unopened) = run(&mut front, &mut along).ok_or(QueryError::Unchecked)?;
    let work = Work { exact: along.exact, ..front.work };
    Ok(Traced { work, ended, unopened })
}

/// Why the search ended, and the least parameter of a hit in triangles that it did not refine.
fn run<'a, G: Geometry<'a>, C: Collect>(
    front: &mut Front<'_, G>,
    along: &mut Along<'_, C>,
) -> Option<(Ended, f32)> {
    front.begin(along)?;
    while let Some(Taken { entry, .. }) = front.queue.pop() {
        let instance = Instance(entry.node());
        if entry.key() > along.limit {
            continue;
        }
        if front.is_spent() {
            return Some((Ended::Steps, entry.key().min(front.queue.lower())));
        }
        front.open(instance, along)?;
    }
    let unopened = front.queue.dropped();
    if unopened <= along.limit && unopened.is_finite() {
        return Some((Ended::Scratch, unopened));
    }
    Some((if along.doubtful { Ended::Resolution } else { Ended::Exact }, f32::INFINITY))
}

/// A segment, and the collector of its hits.
struct Along<'c, C: Collect> {
    frame: Frame,
    start: DVec3,
    end: DVec3,
    /// From `start` to `end`. Of a ray it is exact, and `end` is rounded.
    way: DVec3,
    segment: SweptSegment,
    clipped: Clipped,
    surface_error: f32,
    /// A reported hit is one that the stored surface cannot decide.
    doubtful: bool,
    exact: u32,
    collect: &'c mut C,
    /// Hits beyond this parameter are not wanted.
    limit: f32,
}

impl<C: Collect> Visit for Along<'_, C> {
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn visit(&mut self, found: &[Candidate], queue: &mut SweepQueue<'_>) {
        for candidate in found {
            let reach = candidate.radius + self.surface_error;
            let Some(key) = self.segment.enter(candidate.corners, reach) else { continue };
            if key > self.limit {
                continue;
            }
            match candidate.refinable {
                Refinable::BySplit => queue.push(ScratchEntry::new(key, candidate.instance.0)),
                Refinable::Surface => self.meet(candidate, key),
                Refinable::Cut => self.may_meet(candidate.instance, key),
            }
        }
    }
}

impl<C: Collect> Along<'_, C> {
    /// Evaluates a triangle of the surface.
    fn meet(&mut self, candidate: &Candidate, key: f32) {
        self.exact += 1;
        let corners = candidate.corners.map(|v| v.as_dvec3());
        let mut met = way_triangle([self.start, self.end], self.way, corners);
        if self.surface_error > 0.0 {
            // The input surface may lie up to `surface_error` from the stored one. So a hit may be
            // a miss, a near miss a hit, and the parameter is uncertain by as much.
            if met.is_none()
                && !comes_within(self.start, self.end, corners, f64::from(self.surface_error))
            {
                return;
            }
            self.doubtful = true;
            let enter = f64::from(key.max(0.0));
            let t = met.map_or(enter, |meet| meet.t);
            met =
                Some(SegmentTriangle { t, t_lower: enter.min(t), t_upper: 1.0, is_certain: false });
        }
        if let Some(meet) = met {
            self.add(meet, candidate.instance);
        }
    }

    /// Beyond a cut the surface may be hit from here on.
    fn may_meet(&mut self, instance: Instance, key: f32) {
        self.doubtful = true;
        let t = f64::from(key).max(self.clipped.t_start.min(1.0)).max(0.0);
        let t_lower = f64::from(key.max(0.0));
        let t_lower = t_lower.min(t);
        self.add(SegmentTriangle { t, t_lower, t_upper: 1.0, is_certain: false }, instance);
    }

    fn add(&mut self, meet: SegmentTriangle, instance: Instance) {
        let point = self.frame.point(self.start + self.way * meet.t);
        self.limit = self.collect.add(Met { meet, instance, point });
    }
}
