//! Closest point by the sweeping process (Guéziec 2000, 3.2 and 4.3) on the cover tree.
//!
//! Any cut of the forest of swept triangles covers the surface, so a node may be opened without the
//! splits that a consistent mesh would need first (`core/DESIGN.md`, "Cut"). Nodes are bounded in
//! f32, rounded down with a proved margin; The few triangles that may hold the answer are evaluated
//! in f64, so that the interval is as wide as one rounding of f32.

use crate::geom::{Aabb, LANES, Lanes, Support, SweptPoint, point_triangle};
use crate::hull::format::{Children, Hull, NodeIdx, TriIdx};
use crate::num::tolerance::{F32_BOUNDS, HULL_FAR, REPORTED, U64};
use crate::num::{down_to_f32, up_to_f32};
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
    #[inline]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        budget.check()?;
        let Budget { relative, absolute, steps } = budget;
        closest_point(self, point, [relative, absolute], steps, scratch)
    }
}

/// Takes the tolerances as numbers, not a budget, so that a program with constant tolerances links
/// no code for others.
fn closest_point(
    hull: &Hull<'_>,
    point: [f32; 3],
    [relative, absolute]: [f32; 2],
    steps: u32,
    scratch: &mut [ScratchEntry],
) -> Result<ClosestPoint, QueryError> {
    if !hull.has_hull() {
        return Err(QueryError::NO_HULL);
    }
    let frame = Frame::of(hull.header());
    let p = frame.local(point)?;
    if scratch.is_empty() {
        return Err(QueryError::NoScratch);
    }
    let mut sweep = Sweep::new(hull, p);
    let ended = if p.abs().max_element() > HULL_FAR {
        sweep.far()?;
        if hull.is_cut() { Ended::Resolution } else { Ended::Exact }
    } else {
        let queue = SweepQueue::new(scratch, hull.scratch_entries());
        let tolerant = relative > 0.0 || absolute > 0.0;
        let (relative, absolute) = (f64::from(relative), frame.length(absolute));
        sweep.run(queue, tolerant, [relative, absolute], steps).ok_or(QueryError::Unchecked)?
    };
    if sweep.best.is_none() {
        // Stopped before any triangle was reached: only the box is known.
        let lower = sweep.lower;
        sweep.far()?;
        sweep.lower = sweep.lower.max(lower.min(sweep.upper));
    }
    Ok(sweep.answer(&frame, ended))
}

/// `first .. first + count` in runs of at most [`LANES`]: where each begins and how long it is.
#[inline(always)]
fn chunks(first: u32, count: u32) -> impl Iterator<Item = (u32, usize)> {
    let run = LANES as u32;
    (0..count.div_ceil(run))
        .map(move |i| (first.wrapping_add(i * run), (count - i * run).min(run) as usize))
}

/// The best triangle so far.
#[derive(Clone, Copy)]
struct Best {
    distance_sq: f64,
    triangle: u32,
    point: DVec3,
}

/// State of one query.
struct Sweep<'a> {
    model: &'a Hull<'a>,
    p: DVec3,
    swept: SweptPoint,
    /// Not below the distance; f64 for the answer, f32 rounded up for pruning.
    upper: f64,
    upper_f32: f32,
    /// Least lower bound of all evaluated triangles and of all unopened nodes.
    lower: f64,
    best: Option<Best>,
    cut: bool,
    /// Beyond [`F32_BOUNDS`]: bounds in f64.
    distant: bool,
    work: Work,
}

impl<'a> Sweep<'a> {
    fn new(model: &'a Hull<'a>, p: DVec3) -> Self {
        // In f32's normal range the conversion is exact; below, it costs less than
        // `tolerance::UNDERFLOW`.
        let swept = SweptPoint::new(p.as_vec3(), &model.hull_box());
        Sweep {
            model,
            p,
            swept,
            upper: f64::INFINITY,
            upper_f32: f32::INFINITY,
            lower: f64::INFINITY,
            best: None,
            cut: false,
            distant: p.abs().max_element() > F32_BOUNDS,
            work: Work::default(),
        }
    }

    fn run(
        &mut self,
        mut queue: SweepQueue<'_>,
        tolerant: bool,
        [relative, absolute]: [f64; 2],
        steps: u32,
    ) -> Option<Ended> {
        let surface_error = f64::from(self.model.header().surface_error);
        let mut met_tolerance = false;
        let mut next = Some(ScratchEntry::new(0.0, 0));
        while let Some(Taken { entry, least }) = queue.take(next, self.best.is_none()) {
            let key = f64::from(entry.key());
            let beaten = entry.key() > self.upper_f32;
            let tolerated = tolerant && {
                // The reported interval: with the stored surface's error, and rounded to f32
                // outward.
                let low = (key.min(self.lower) - surface_error) * (1.0 - REPORTED);
                let high = (self.upper + surface_error) * (1.0 + REPORTED);
                high <= low * (1.0 + relative) || high - low <= absolute
            };
            if beaten || tolerated {
                if !beaten {
                    self.lower = self.lower.min(key);
                    met_tolerance = true;
                }
                if least {
                    break;
                }
                next = None;
                continue;
            }
            if self.work.splits >= steps {
                self.lower = self.lower.min(key).min(f64::from(queue.lower()));
                return Some(Ended::Steps);
            }
            next = self.open(NodeIdx(entry.node()), key, &mut queue)?;
        }
        let dropped = f64::from(queue.dropped());
        if dropped < self.upper {
            self.lower = self.lower.min(dropped);
            return Some(Ended::Scratch);
        }
        Some(if met_tolerance {
            Ended::Tolerance
        } else if self.cut {
            Ended::Resolution
        } else {
            Ended::Exact
        })
    }

    /// Replaces a node by its children, and returns the nearest child node instead of queueing it.
    /// `None`: the model is unchecked.
    #[inline]
    fn open(
        &mut self,
        node: NodeIdx,
        key: f64,
        queue: &mut SweepQueue<'_>,
    ) -> Option<Option<ScratchEntry>> {
        self.work.splits += 1;
        let node = self.model.node(node)?;
        match node.children {
            Children::Nodes { first, count } => {
                queue.begin_children(count);
                let mut nearest: Option<ScratchEntry> = None;
                for (from, lanes) in chunks(first, count) {
                    if self.distant {
                        self.visit_distant(from, lanes, queue)?;
                        continue;
                    }
                    let (supports, radii) = self.bounds(from, lanes)?;
                    for (node, (support, radius)) in
                        (from..).zip(supports.into_iter().zip(radii)).take(lanes)
                    {
                        let Some(key) = self.swept.bound(support, radius, self.upper_f32) else {
                            continue;
                        };
                        let entry = ScratchEntry::new(key, node);
                        match &mut nearest {
                            Some(near) if !before(&entry, near) => queue.push(entry),
                            Some(near) => queue.push(core::mem::replace(near, entry)),
                            None => nearest = Some(entry),
                        }
                    }
                }
                return Some(nearest);
            }
            Children::Triangles { first, count } => {
                for (from, lanes) in chunks(first, count) {
                    self.triangles(from, lanes)?;
                }
            }
            Children::Cut => self.cut_node(node.corners, key)?,
        }
        Some(None)
    }

    /// Queues nodes by bounds in f64, for a query so far away that f32 gives all parts of the model
    /// the same bound.
    #[cold]
    fn visit_distant(
        &mut self,
        first: u32,
        count: usize,
        queue: &mut SweepQueue<'_>,
    ) -> Option<()> {
        self.work.nodes += count as u32;
        for (node, _) in (first..).zip(0..count) {
            let (corners, radius) = self.model.bound(NodeIdx(node))?;
            let [a, b, c] = self.model.positions(corners)?.map(|v| v.as_dvec3());
            let lower = point_triangle(self.p, a, b, c).lower - f64::from(radius) * (1.0 + U64);
            if lower <= self.upper {
                queue.push(ScratchEntry::new(down_to_f32(lower.max(0.0)), node));
            }
        }
        Some(())
    }

    /// Supporting planes and radii of up to four nodes.
    #[inline(always)]
    fn bounds(&mut self, first: u32, count: usize) -> Option<([Support; LANES], [f32; LANES])> {
        self.work.nodes += count as u32;
        let mut lanes = Lanes::EMPTY;
        let mut radii = [0f32; LANES];
        for ((lane, radius), node) in radii.iter_mut().enumerate().zip(first..).take(count) {
            let (corners, stored) = self.model.bound(NodeIdx(node))?;
            self.swept.load(&mut lanes, lane, self.model.positions(corners)?);
            *radius = stored;
        }
        Some((lanes.supports(count), radii))
    }

    /// Up to four triangles of the surface: a bound in f32, and the interval in f64 of those whose
    /// bound is not above the limit.
    #[inline(always)]
    fn triangles(&mut self, first: u32, count: usize) -> Option<()> {
        self.work.triangles += count as u32;
        let mut lanes = Lanes::EMPTY;
        for (lane, triangle) in (0..LANES).zip(first..).take(count) {
            self.swept.load(&mut lanes, lane, self.corners(TriIdx(triangle))?);
        }
        if self.distant {
            for triangle in (first..).take(count) {
                self.evaluate(TriIdx(triangle), self.corners(TriIdx(triangle))?);
            }
            return Some(());
        }
        let mut bounds = [f32::INFINITY; LANES];
        for (bound, support) in bounds.iter_mut().zip(lanes.supports(count)).take(count) {
            *bound = self.swept.bound(support, 0.0, self.upper_f32).unwrap_or(f32::INFINITY);
        }
        // Nearest first: each evaluation may spare others, and on a Cortex-M f64 runs in software.
        for _ in 0..count {
            let mut nearest = (f32::INFINITY, 0);
            for (bound, triangle) in bounds.iter().zip(first..) {
                if *bound < nearest.0 {
                    nearest = (*bound, triangle);
                }
            }
            let (bound, triangle) = nearest;
            if bound > self.upper_f32 || bound == f32::INFINITY {
                break;
            }
            if let Some(done) = bounds.get_mut(triangle.wrapping_sub(first) as usize) {
                *done = f32::INFINITY;
            }
            self.evaluate(TriIdx(triangle), self.corners(TriIdx(triangle))?);
        }
        Some(())
    }

    #[inline(always)]
    fn corners(&self, triangle: TriIdx) -> Option<[Vec3; 3]> {
        self.model.positions(self.model.surface_triangle(triangle)?)
    }

    fn evaluate(&mut self, triangle: TriIdx, corners: [Vec3; 3]) {
        self.work.exact += 1;
        let [a, b, c] = corners.map(|v| v.as_dvec3());
        let d = point_triangle(self.p, a, b, c);
        self.lower = self.lower.min(d.lower);
        self.improve(d.upper);
        let nearer = self.best.is_none_or(|best| {
            d.distance_sq < best.distance_sq
                || (d.distance_sq == best.distance_sq && triangle.0 < best.triangle)
        });
        if nearer {
            let point = a + (b - a) * d.u + (c - a) * d.v;
            self.best = Some(Best { distance_sq: d.distance_sq, triangle: triangle.0, point });
        }
    }

    fn improve(&mut self, upper: f64) {
        if upper < self.upper {
            self.upper = upper;
            self.upper_f32 = up_to_f32(upper);
        }
    }

    /// A node whose children were cut off: the surface is within the level's certified distance of
    /// its triangle.
    fn cut_node(&mut self, corners: [crate::hull::format::VertIdx; 3], key: f64) -> Option<()> {
        self.work.exact += 1;
        self.cut = true;
        let [a, b, c] = self.model.positions(corners)?.map(|v| v.as_dvec3());
        let d = point_triangle(self.p, a, b, c);
        let error = self.model.level(self.model.header().levels.checked_sub(1)?)?.hull_to_surface;
        self.lower = self.lower.min(key);
        self.improve(d.upper + f64::from(error));
        if self.best.is_none_or(|best| d.distance_sq < best.distance_sq) {
            let point = a + (b - a) * d.u + (c - a) * d.v;
            self.best = Some(Best { distance_sq: d.distance_sq, triangle: u32::MAX, point });
        }
        Some(())
    }

    /// The interval that the surface's box gives, with any point of the surface. From far enough
    /// away every point is the closest, within a rounding of f32.
    fn far(&mut self) -> Result<(), QueryError> {
        let (near, far) = Aabb::of(self.model.header().surface_box).distance_range(self.p);
        self.lower = near;
        self.upper = far;
        let corner = match self.model.surface_triangle(TriIdx(0)) {
            Some([corner, ..]) => corner,
            None => self.model.base_triangle(0).ok_or(QueryError::Unchecked)?[0],
        };
        let point = self.model.position(corner).ok_or(QueryError::Unchecked)?.as_dvec3();
        let triangle = if self.model.is_cut() { u32::MAX } else { 0 };
        self.best = Some(Best { distance_sq: 0.0, triangle, point });
        Ok(())
    }

    fn answer(&self, frame: &Frame, ended: Ended) -> ClosestPoint {
        let triangle = self.best.and_then(|best| self.model.source(TriIdx(best.triangle)));
        let upper = self.upper;
        let point = self.best.map_or(DVec3::ZERO, |best| best.point);
        ClosestPoint {
            distance: Interval::new(frame.lower(self.lower.min(upper)), frame.upper(upper)),
            point: frame.point(point),
            triangle,
            work: self.work,
            ended,
        }
    }
}
