//! Closest point by the sweeping process (Guéziec 2000, 3.2 and 4.3) on the split tables.
//!
//! Triangles are bounded in f32, rounded down with a proved margin. The few triangles of the
//! surface that may hold the answer are evaluated in f64, so that the interval is as wide as one
//! rounding of f32.

use super::geometry::Geometry;
use super::shared_corner::SharedCorner;
use super::sweep::{Candidate, Fate, Front, Visit, triangles};
use crate::geom::{LANES, Lanes, SweptPoint, point_triangle};
use crate::hull::format::{Hull, Instance};
use crate::num::tolerance::{F32_BOUNDS, HULL_FAR, REPORTED, U64};
use crate::num::{SOFT_DOUBLE, down_to_f32, lesser, up_to_f32};
use crate::query::{
    Budget, ClosestPoint, Ended, Frame, Interval, QueryError, ScratchEntry, SweepQueue, Taken,
    Work, before,
};
use glam::{DVec3, Vec3};

impl Hull<'_> {
    /// Closest point of the surface to `point` (input units), with an interval that contains the
    /// distance to the input mesh.
    ///
    /// `scratch`: [`scratch_entries`](Hull::scratch_entries) make overflow impossible. More give a
    /// tighter interval to a query that stops early. With fewer the interval still holds, and the
    /// answer may say [`Ended::Scratch`]. A point on the surface has a lower bound of 0. Of
    /// equidistant triangles the answer is the least in blob order, whatever the order of visits. A
    /// point farther than 2^40 times the model's size gets the interval of the model's box.
    ///
    /// Cost: some hundreds of nodes and triangles near a scanned part. The worst case is all of
    /// them, at the centre of a sphere. Where time is bounded, set [`Budget::with_steps`]. The box
    /// tree ([`Bvh`](crate::Bvh)) answers the same question much faster. Source: Guéziec 2000, 4.3.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Hull, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let (part, mut scratch) = (Hull::open(bytes)?, Scratch::<256>::new());
    /// let near = part.closest_point([300.0, 0.0, 0.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower > 0.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::Tolerance`], [`QueryError::NoScratch`].
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        budget.check_with(scratch)?;
        let Budget { relative, absolute, steps } = budget;
        closest_point(self, point, [relative, absolute], steps, scratch)
    }
}

/// Takes the tolerances as numbers, not a budget, so that a program with constant tolerances links
/// no code for others.
pub(super) fn closest_point<'a, G: Geometry<'a>>(
    hull: &G,
    point: [f32; 3],
    [relative, absolute]: [f32; 2],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    let is_cut = hull.tables().is_cut();
    if !hull.tables().has_hull() {
        return Err(QueryError::NO_HULL);
    }
    let frame = hull.frame();
    let p = frame.local(point)?;
    let mut nearest = Nearest::new(hull, p).ok_or(QueryError::Unchecked)?;
    let (mut work, mut ended) = (Work::NONE, Ended::Exact);
    if p.abs().max_element() > HULL_FAR {
        nearest.settle_by_box(hull).ok_or(QueryError::Unchecked)?;
        if is_cut {
            ended = Ended::Resolution;
        }
    } else {
        let tolerance = (relative > 0.0 || absolute > 0.0)
            .then(|| [f64::from(relative), frame.length(absolute)]);
        if tolerance.is_none() {
            nearest.defers = steps >= triangles(hull.tables()) && !nearest.distant;
            if SOFT_DOUBLE {
                nearest.share_corners(frame.surface_error());
            }
        }
        let mut front = Front::new(hull, scratch, steps);
        ended = search(&mut front, &mut nearest, tolerance).ok_or(QueryError::Unchecked)?;
        work = nearest.work(front.work);
    }
    nearest.settle_unreached(hull).ok_or(QueryError::Unchecked)?;
    Ok(nearest.answer(hull.tables(), &frame, work, ended))
}

/// The best triangle so far.
#[derive(Clone, Copy, Debug)]
struct Best {
    distance_sq: f64,
    /// Of the surface or, of a cut blob, of a hull.
    instance: Instance,
    /// Its corners, and the barycentric coordinates of the closest point. That point is computed
    /// for the answer alone.
    corners: [Vec3; 3],
    weights: [f64; 2],
}

impl Best {
    fn point(&self) -> DVec3 {
        let [a, b, c] = self.corners.map(|v| v.as_dvec3());
        let [u, v] = self.weights;
        a + (b - a) * u + (c - a) * v
    }
}

/// A query point, the nearest triangle so far, and bounds of the distance.
#[derive(Debug)]
pub(super) struct Nearest {
    p: DVec3,
    swept: SweptPoint,
    /// Beyond [`F32_BOUNDS`]: bounds in f64.
    distant: bool,
    /// No point of a cut hull's triangles is farther than this from the surface.
    hull_to_surface: f64,
    /// Not below the distance.
    upper: f64,
    /// A lower bound above the limit is reported as infinity. The limit is `upper`, unless
    /// [`set_limit`](Self::set_limit) raised it. In f32 it is rounded up, for pruning.
    limit: f64,
    limit_f32: f32,
    /// Least lower bound of all triangles that are not refined further.
    lower: f64,
    best: Option<Best>,
    exact: u32,
    shared: Option<SharedCorner>,
    /// No triangle was evaluated yet, and one of the surface waits until f32 cannot tell whether it
    /// is the nearest.
    defers: bool,
    /// The one that waits, and its lower bound in f32. The limit is not above its upper bound.
    waiting: Option<(Candidate, f32)>,
    /// The nearest triangle of those that were just found. It waits outside the queue.
    next: Option<ScratchEntry>,
}

impl Nearest {
    pub(super) fn new<'a>(geometry: &impl Geometry<'a>, p: DVec3) -> Option<Self> {
        let model = geometry.tables();
        // In f32's normal range the conversion is exact; below, it costs less than
        // `tolerance::UNDERFLOW`.
        let swept = SweptPoint::new(p.as_vec3(), &geometry.vertex_box());
        let last = model.level(model.header().levels.checked_sub(1)?)?;
        Some(Nearest {
            p,
            swept,
            distant: p.abs().max_element() > F32_BOUNDS,
            hull_to_surface: f64::from(last.hull_to_surface),
            upper: f64::INFINITY,
            limit: f64::INFINITY,
            limit_f32: f32::INFINITY,
            lower: f64::INFINITY,
            best: None,
            exact: 0,
            shared: None,
            defers: false,
            waiting: None,
            next: None,
        })
    }

    /// From now on triangles at a corner that is known are not evaluated again. What is reported
    /// without a tolerance keeps its bits, the bounds in f64 do not.
    fn share_corners(&mut self, surface_error: f64) {
        self.shared = SharedCorner::new(self.p, self.swept.norms(), surface_error);
    }

    /// Bounds of up to four triangles, infinite above the limit.
    #[inline(always)]
    pub(super) fn bounds(&self, found: &[Candidate]) -> [f32; LANES] {
        let mut bounds = [f32::INFINITY; LANES];
        if self.distant {
            self.distant_bounds(found, &mut bounds);
            return bounds;
        }
        if !Lanes::PAY {
            for (bound, candidate) in bounds.iter_mut().zip(found) {
                let Candidate { corners, radius, .. } = candidate;
                if let Some(lower) = self.swept.lower(*corners, *radius, self.limit_f32) {
                    *bound = lower;
                }
            }
            return bounds;
        }
        let mut lanes = Lanes::EMPTY;
        for (lane, candidate) in found.iter().enumerate() {
            self.swept.load(&mut lanes, lane, candidate.corners);
        }
        let supports = lanes.supports(found.len());
        for ((bound, support), candidate) in bounds.iter_mut().zip(supports).zip(found) {
            if let Some(lower) = self.swept.bound(support, candidate.radius, self.limit_f32) {
                *bound = lower;
            }
        }
        bounds
    }

    /// Bounds in f64, for a query so far away that f32 gives all parts of the model the same one.
    #[cold]
    fn distant_bounds(&self, found: &[Candidate], bounds: &mut [f32; LANES]) {
        for (bound, candidate) in bounds.iter_mut().zip(found) {
            let [a, b, c] = candidate.corners.map(|v| v.as_dvec3());
            let radius = f64::from(candidate.radius) * (1.0 + U64);
            let lower = point_triangle(self.p, a, b, c).lower - radius;
            if lower <= self.limit {
                *bound = down_to_f32(lower.max(0.0));
            }
        }
    }

    /// Takes a triangle that is not refined, with its lower bound. Before any triangle was
    /// evaluated, one of the surface waits, until a second one may be the nearest as well.
    fn take(&mut self, candidate: &Candidate, lower: f32) {
        if self.defers && candidate.fate == Fate::Surface {
            let upper = self.swept.upper(candidate.corners);
            self.limit_f32 = lesser(self.limit_f32, upper);
            self.settle_waiting();
            if self.defers && upper < f32::INFINITY {
                self.waiting = Some((*candidate, lower));
                return;
            }
        }
        if lower <= self.limit_f32 {
            self.settle(candidate);
        }
    }

    /// Evaluates the triangle that waits, if it may be the nearest.
    fn settle_waiting(&mut self) {
        if let Some((candidate, lower)) = self.waiting.take()
            && lower <= self.limit_f32
        {
            self.settle(&candidate);
        }
    }

    /// Evaluates a triangle that is not refined, unless its closest point is known.
    fn settle(&mut self, candidate: &Candidate) {
        if !self.is_known(candidate) {
            self.evaluate(candidate);
        }
    }

    /// Whether the closest point of a triangle is known. Then the triangle needs no evaluation.
    fn is_known(&mut self, candidate: &Candidate) -> bool {
        if SOFT_DOUBLE
            && candidate.fate == Fate::Surface
            && candidate.radius == 0.0
            && let Some(shared) = &self.shared
            && let Some((distance_sq, point)) = shared.find(candidate.corners)
        {
            self.exact += 1;
            let instance = candidate.instance;
            self.offer(Best { distance_sq, instance, corners: [point; 3], weights: [0.0; 2] });
            return true;
        }
        false
    }

    /// A triangle may be the nearest so far.
    #[inline(always)]
    fn offer(&mut self, other: Best) {
        let nearer = self.best.is_none_or(|best| {
            other.distance_sq < best.distance_sq
                || (other.distance_sq == best.distance_sq && other.instance < best.instance)
        });
        if nearer {
            self.best = Some(other);
        }
    }

    /// Evaluates a triangle that is not refined, and returns a lower bound of its distance.
    pub(super) fn evaluate(&mut self, candidate: &Candidate) -> f64 {
        self.exact += 1;
        self.defers = false;
        let [a, b, c] = candidate.corners.map(|v| v.as_dvec3());
        let d = point_triangle(self.p, a, b, c);
        // The triangle swept by its radius contains a part of the surface.
        let radius = f64::from(candidate.radius);
        let lower = d.lower - radius * (1.0 + U64);
        self.lower = self.lower.min(lower);
        let upper = match candidate.fate {
            Fate::Surface => d.upper,
            Fate::Cut | Fate::Splits => d.upper + self.hull_to_surface,
        };
        if upper < self.upper {
            self.upper = upper;
            self.set_limit(upper);
        }
        let &Candidate { corners, instance, .. } = candidate;
        self.offer(Best { distance_sq: d.distance_sq, instance, corners, weights: [d.u, d.v] });
        if SOFT_DOUBLE
            && candidate.fate == Fate::Surface
            && candidate.radius == 0.0
            && let Some(shared) = &mut self.shared
        {
            shared.learn(candidate.corners, &d);
        }
        lower
    }

    pub(super) fn upper(&self) -> f64 {
        self.upper
    }

    /// The nearest triangle so far.
    pub(super) fn instance(&self) -> Option<Instance> {
        self.best.map(|best| best.instance)
    }

    /// Triangles that were not looked at may be as near as this.
    pub(super) fn lower_to(&mut self, bound: f64) {
        self.lower = self.lower.min(bound);
    }

    /// Nothing is nearer than this.
    pub(super) fn raise_to(&mut self, bound: f64) {
        self.lower = self.lower.max(bound);
    }

    /// Whether the interval meets a tolerance, relative or absolute, if nothing is nearer than
    /// `bound`: as it is reported, with the stored surface's error, and rounded to f32 outward.
    pub(super) fn is_within(
        &self,
        [relative, absolute]: [f64; 2],
        bound: f64,
        surface_error: f64,
    ) -> bool {
        let low = (bound.min(self.lower) - surface_error) * (1.0 - REPORTED);
        let high = (self.upper + surface_error) * (1.0 + REPORTED);
        high <= low * (1.0 + relative) || high - low <= absolute
    }

    /// A lower bound that is reported as infinity is above this.
    pub(super) fn limit(&self) -> f64 {
        self.limit
    }

    pub(super) fn set_limit(&mut self, limit: f64) {
        self.limit = limit;
        self.limit_f32 = up_to_f32(limit);
    }

    /// The work of a front, and of the triangles evaluated here.
    pub(super) fn work(&self, front: Work) -> Work {
        Work { exact: self.exact, ..front }
    }

    /// The interval that the surface's box gives, with any point of the surface. From far enough
    /// away every point is the closest, within a rounding of f32.
    pub(super) fn settle_by_box<'a>(&mut self, geometry: &impl Geometry<'a>) -> Option<()> {
        let model = geometry.tables();
        (self.lower, self.upper) = geometry.surface_box().distance_range(self.p);
        let instance = model.last_part()?;
        let ([corner, ..], _) = geometry.triangle(model.corners(instance)?, 0, true)?;
        self.best =
            Some(Best { distance_sq: 0.0, instance, corners: [corner; 3], weights: [0.0; 2] });
        Some(())
    }

    /// If no triangle was reached: the interval of the box, with the lower bound of the search.
    pub(super) fn settle_unreached<'a>(&mut self, geometry: &impl Geometry<'a>) -> Option<()> {
        if self.best.is_none() {
            let lower = self.lower;
            self.settle_by_box(geometry)?;
            self.lower = self.lower.max(lower.min(self.upper));
        }
        Some(())
    }

    pub(super) fn answer(
        &self,
        model: &Hull<'_>,
        frame: &Frame,
        work: Work,
        ended: Ended,
    ) -> ClosestPoint {
        let triangle = self.best.and_then(|best| model.number(best.instance));
        let upper = self.upper;
        let point = self.best.map_or(DVec3::ZERO, |best| best.point());
        ClosestPoint {
            distance: Interval::new(frame.lower(self.lower.min(upper)), frame.upper(upper)),
            point: frame.point(point),
            triangle,
            work,
            ended,
        }
    }
}

impl Visit for Nearest {
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn visit(&mut self, found: &[Candidate], queue: &mut SweepQueue<'_>) {
        let mut bounds = self.bounds(found);
        for (bound, candidate) in bounds.iter_mut().zip(found) {
            if candidate.fate != Fate::Splits || *bound == f32::INFINITY {
                continue;
            }
            let entry = ScratchEntry::new(*bound, candidate.instance.0);
            *bound = f32::INFINITY;
            match &mut self.next {
                Some(near) if !before(&entry, near) => queue.push(entry),
                Some(near) => queue.push(core::mem::replace(near, entry)),
                None => self.next = Some(entry),
            }
        }
        // Nearest first: each evaluation may spare others, and on a Cortex-M f64 runs in software.
        for _ in 0..found.len() {
            let mut nearest = (f32::INFINITY, 0);
            for (lane, bound) in bounds.iter().enumerate() {
                if *bound < nearest.0 {
                    nearest = (*bound, lane);
                }
            }
            let (bound, lane) = nearest;
            if bound > self.limit_f32 || bound == f32::INFINITY {
                break;
            }
            bounds[lane % LANES] = f32::INFINITY;
            if let Some(candidate) = found.get(lane) {
                self.take(candidate, bound);
            }
        }
    }
}

/// Refines until no triangle that waits may be nearer than the best one, or until the tolerance is
/// met.
fn search<'a, G: Geometry<'a>>(
    front: &mut Front<'_, G>,
    nearest: &mut Nearest,
    tolerance: Option<[f64; 2]>,
) -> Option<Ended> {
    let error = front.model.surface_error();
    // Least key of the triangles that the tolerance spared.
    let mut spared = f64::INFINITY;
    front.begin(nearest)?;
    while let Some(Taken { entry, least }) =
        front.queue.take(nearest.next.take(), nearest.limit_f32 == f32::INFINITY)
    {
        let key = f64::from(entry.key());
        let instance = Instance(entry.node());
        let beaten = entry.key() > nearest.limit_f32;
        let tolerated =
            tolerance.is_some_and(|within| nearest.is_within(within, key.min(spared), error));
        if beaten || tolerated {
            if !beaten {
                spared = spared.min(key);
            }
            if least {
                // All entries that wait are farther.
                break;
            }
            continue;
        }
        if front.is_spent() {
            nearest.settle_waiting();
            let waiting = f64::from(front.queue.lower());
            nearest.lower = nearest.lower.min(spared).min(key).min(waiting);
            return Some(Ended::Steps);
        }
        front.open(instance, nearest)?;
    }
    nearest.settle_waiting();
    let dropped = f64::from(front.queue.dropped());
    nearest.lower = nearest.lower.min(spared).min(dropped);
    // Beyond a cut, a triangle that was evaluated later may have widened the interval again.
    let is_met = spared < nearest.upper
        && tolerance.is_some_and(|within| nearest.is_within(within, spared, error));
    Some(if dropped < nearest.upper {
        Ended::Scratch
    } else if is_met {
        Ended::Tolerance
    } else if front.model.tables().is_cut() {
        Ended::Resolution
    } else {
        Ended::Exact
    })
}
