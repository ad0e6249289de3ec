//! The nearest triangle of a sweep so far, and the bounds of the distance.
//!
//! Triangles are bounded in f32, rounded down with a proved margin. The few triangles of the
//! surface that may hold the answer are evaluated in f64, so that the interval is as wide as one
//! rounding of f32.

use super::front::{Candidate, Refinable, Visit};
use super::geometry::Geometry;
use super::shared_corner::SharedCorner;
use crate::geom::{LANES, Lanes, SweptPoint, point_triangle};
use crate::hull::format::{Hull, Instance};
use crate::num::tolerance::{F32_BOUNDS, REPORTED, U64};
use crate::num::{SOFT_DOUBLE, down_to_f32, lesser, up_to_f32};
use crate::query::{ClosestPoint, Ended, Frame, Interval, ScratchEntry, SweepQueue, Work, before};
use glam::{DVec3, Vec3};

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
    pub(super) distant: bool,
    /// No point of a cut hull's triangles is farther than this from the surface.
    hull_to_surface: f64,
    /// Not below the distance.
    pub(super) upper: f64,
    /// A lower bound above the limit is reported as infinity. The limit is `upper`, unless
    /// [`set_limit`](Self::set_limit) raised it. In f32 it is rounded up, for pruning.
    limit: f64,
    pub(super) limit_f32: f32,
    /// Least lower bound of all triangles that are not refined further.
    pub(super) lower: f64,
    best: Option<Best>,
    exact: u32,
    shared: Option<SharedCorner>,
    /// No triangle was evaluated yet, and one of the surface waits until f32 cannot tell whether it
    /// is the nearest.
    pub(super) defers: bool,
    /// The one that waits, and its lower bound in f32. The limit is not above its upper bound.
    waiting: Option<(Candidate, f32)>,
    /// The nearest triangle of those that were just found. It waits outside the queue.
    pub(super) next: Option<ScratchEntry>,
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
    pub(super) fn share_corners(&mut self, surface_error: f64) {
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
        if self.defers && candidate.refinable == Refinable::Surface {
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
    pub(super) fn settle_waiting(&mut self) {
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
            && candidate.refinable == Refinable::Surface
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
        let upper = match candidate.refinable {
            Refinable::Surface => d.upper,
            Refinable::Cut | Refinable::BySplit => d.upper + self.hull_to_surface,
        };
        if upper < self.upper {
            self.upper = upper;
            self.set_limit(upper);
        }
        let &Candidate { corners, instance, .. } = candidate;
        self.offer(Best { distance_sq: d.distance_sq, instance, corners, weights: [d.u, d.v] });
        if SOFT_DOUBLE
            && candidate.refinable == Refinable::Surface
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

    /// A point of the surface is this near.
    pub(super) fn limit_upper(&mut self, upper: f64) {
        self.upper = upper;
        self.set_limit(upper);
    }

    /// The query point, local frame.
    pub(super) fn point(&self) -> DVec3 {
        self.p
    }

    /// The nearest triangle so far.
    pub(super) fn instance(&self) -> Option<Instance> {
        self.best.map(|best| best.instance)
    }

    /// Triangles that were not looked at may be as near as this.
    pub(super) fn limit_lower(&mut self, bound: f64) {
        self.lower = self.lower.min(bound);
    }

    /// Nothing is nearer than this.
    pub(super) fn raise_lower(&mut self, bound: f64) {
        self.lower = self.lower.max(bound);
    }

    /// Whether the interval meets a tolerance, relative or absolute, if nothing is nearer than
    /// `bound`: as it is reported, with the stored surface's error, and rounded to f32 outward.
    pub(super) fn is_within(&self, within: [f64; 2], bound: f64, surface_error: f64) -> bool {
        self.is_within_from(self.upper, within, bound, surface_error)
    }

    /// The same with another upper bound.
    #[inline]
    pub(super) fn is_within_from(
        &self,
        upper: f64,
        [relative, absolute]: [f64; 2],
        bound: f64,
        surface_error: f64,
    ) -> bool {
        let low = (bound.min(self.lower) - surface_error) * (1.0 - REPORTED);
        let high = (upper + surface_error) * (1.0 + REPORTED);
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
            if candidate.refinable != Refinable::BySplit || *bound == f32::INFINITY {
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
